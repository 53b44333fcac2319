//! Block on a slope with Coulomb friction: what contact must reproduce.
//!
//! `a = g (sin α − μ cos α)`, or rest while tan α ≤ μ. Lost to friction over a way u: m g μ u cos α. Rigid block, one
//! friction coefficient for rest and sliding, no air drag.

/// Acceleration down a slope α between 0 and π/2, starting from rest \[m/s²\]; 0 where the block sticks.
pub fn acceleration_m_per_s2(gravity_m_per_s2: f64, slope: f64, friction: f64) -> f64 {
    (gravity_m_per_s2 * (slope.sin() - friction * slope.cos())).max(0.0)
}

/// Distance after a time from rest, `½ a t²` \[m\].
pub fn distance_m(gravity_m_per_s2: f64, slope: f64, friction: f64, time_s: f64) -> f64 {
    0.5 * acceleration_m_per_s2(gravity_m_per_s2, slope, friction) * time_s * time_s
}

/// Energy lost to friction after a time, per mass: `g μ cos α` times the distance \[J/kg\].
pub fn dissipated_j_per_kg(gravity_m_per_s2: f64, slope: f64, friction: f64, time_s: f64) -> f64 {
    gravity_m_per_s2 * friction * slope.cos() * distance_m(gravity_m_per_s2, slope, friction, time_s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn height_lost_is_speed_gained_plus_friction() {
        let (g, slope, mu, t) = (9.81, 0.6, 0.3, 0.7);
        let speed = acceleration_m_per_s2(g, slope, mu) * t;
        let height = distance_m(g, slope, mu, t) * f64::sin(slope);
        assert!((g * height - 0.5 * speed * speed - dissipated_j_per_kg(g, slope, mu, t)).abs() < 1e-14);
    }

    #[test]
    fn the_block_sticks_up_to_the_friction_angle_and_no_further() {
        let angle = f64::atan(0.3);
        assert_eq!(acceleration_m_per_s2(9.81, angle - 1e-6, 0.3), 0.0);
        assert!(acceleration_m_per_s2(9.81, angle + 1e-6, 0.3) > 0.0);
        assert_eq!(acceleration_m_per_s2(9.81, std::f64::consts::FRAC_PI_2, 0.3), 9.81);
    }
}
