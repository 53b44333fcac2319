//! Loads that a section can carry by statics: wall tensions that are not negative, and a pull of at most what the gas leaves it.
//!
//! ```text
//! wall and pulls   Σ T + Σ N = p_b A + F         all T ≥ 0, all N ≥ 0
//! moment           M = p_b m − (p_b A + F) q      q, the mean place of T and N over the axis, is in the convex section K
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | M, F | moment of the outer loads about the axis, and their tension along it | N·m, N |
//! | A, m | area of the section, and its first moment about the axis | m², m³ |
//! | K | the disc of radius R; up to the line of action of a pull that draws the wall in, and out to one outside the wall | m |
//!
//! In the plane, with one pull at D from the far side and F = 0, the bounds are `p_b A (D − ȳ)` against the bend and `π p_b R³` with it:
//! a load that helps the pull leaves it slack, and a slack strip does not draw the wall in. Valid for membranes. Derived here.

use crate::root::halved;
use crate::space::direction;
use std::f64::consts::PI;

/// Force and geometry of a strip at its state of equilibrium.
pub(crate) struct StripPull {
    pub azimuth_rad: f64,
    /// Distance of its line of action from the axis \[m\].
    pub from_axis_m: f64,
    /// Area that the section has less than a round one \[m²\].
    pub lost_m2: f64,
    /// First moment of the section about the axis, towards the strip \[m³\].
    pub first_m3: f64,
}

pub(crate) struct Statics<'a> {
    pub p_body_pa: f64,
    pub radius_m: f64,
    pub moment_nm: [f64; 2],
    pub tension_n: f64,
    pub pulls: &'a mut dyn Iterator<Item = StripPull>,
}

const HALVINGS: usize = 60;

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl Statics<'_> {
    /// Moment of the loads over the one that the section can carry in its direction \[-\]: above 1 it has folded. Compression along the
    /// axis beyond the gas's tension folds it too.
    pub(crate) fn share(self) -> f64 {
        let size = self.moment_nm[0].hypot(self.moment_nm[1]);
        let away = self.moment_nm.map(|m| -m / size);
        let round_m2 = PI * self.radius_m.powi(2);
        let (mut area_m2, mut first_m3, mut ends) = (round_m2, [0.0; 2], Vec::new());
        for pull in self.pulls {
            let e = direction(pull.azimuth_rad);
            // A load towards a strip relieves it.
            if dot(e, away) > 0.0 {
                area_m2 -= pull.lost_m2;
                first_m3 = [first_m3[0] + pull.first_m3 * e[0], first_m3[1] + pull.first_m3 * e[1]];
                ends.push((e, pull.from_axis_m));
            }
        }
        let thrust = self.p_body_pa * area_m2 + self.tension_n;
        if size == 0.0 || thrust <= 0.0 {
            return (-self.tension_n / (self.p_body_pa * round_m2)).max(0.0);
        }
        let place = |moment: f64| [0, 1].map(|i| (self.p_body_pa * first_m3[i] + moment * away[i]) / thrust);
        let high = self.radius_m.max(ends.iter().fold(0.0, |most, end| most.max(end.1)));
        let high = 2.0 * (high * thrust + self.p_body_pa * first_m3[0].hypot(first_m3[1]));
        let high = halved([0.0, high], HALVINGS, |moment| gauge(place(moment), self.radius_m, &ends) < 1.0)[1];
        size / high
    }
}

/// Size of a place in the section K, 1 at its edge; `ends` are directions and distances of the pulls.
fn gauge(place: [f64; 2], radius_m: f64, ends: &[([f64; 2], f64)]) -> f64 {
    let size = place[0].hypot(place[1]);
    let disc = size / radius_m;
    // Outside the wall the edge is a tangent from the pull to the disc.
    let within = |(e, end): &([f64; 2], f64)| {
        let (angle, tangent) = ((dot(place, *e) / size).clamp(-1.0, 1.0).acos(), (radius_m / end).min(1.0).acos());
        if angle < tangent { disc * (tangent - angle).cos() } else { disc }
    };
    let hull = ends.iter().map(within).fold(disc, f64::min);
    ends.iter().filter(|end| end.1 < radius_m).map(|(e, end)| dot(place, *e) / end).fold(hull, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 0.04;

    fn share(moment_nm: [f64; 2], tension_n: f64, pulls: Vec<StripPull>) -> f64 {
        let pulls = &mut pulls.into_iter();
        Statics { p_body_pa: 2e3, radius_m: RADIUS, moment_nm, tension_n, pulls }.share()
    }

    fn pull(azimuth_rad: f64, from_axis_m: f64) -> StripPull {
        StripPull { azimuth_rad, from_axis_m, lost_m2: 0.0, first_m3: 0.0 }
    }

    #[test]
    fn a_tube_folds_at_pi_p_r_cubed_in_every_direction_and_under_its_thrust_alone() {
        let (hinge, thrust) = (PI * 2e3 * RADIUS.powi(3), PI * 2e3 * RADIUS.powi(2));
        for moment in [[hinge, 0.0], [-hinge, 0.0], [0.6 * hinge, -0.8 * hinge]] {
            assert!((share(moment, 0.0, Vec::new()) - 1.0).abs() < 1e-12, "{moment:?}");
            // Half of the thrust is gone, and half of the moment.
            assert!((share(moment, -0.5 * thrust, Vec::new()) - 2.0).abs() < 1e-12);
        }
        assert!((share([0.0; 2], -2.0 * thrust, Vec::new()) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn against_the_bend_a_pull_outside_the_wall_carries_by_its_distance_and_one_in_a_drawn_in_wall_less() {
        let thrust = PI * 2e3 * RADIUS.powi(2);
        for end in [0.03, 0.04, 0.06] {
            let against = |moment: f64| share([-moment, 0.0], 0.0, vec![pull(0.0, end)]);
            assert!((against(thrust * end) - 1.0).abs() < 1e-12, "{end}");
            assert!((share([thrust * RADIUS, 0.0], 0.0, vec![pull(0.0, end)]) - 1.0).abs() < 1e-12, "{end}: with it");
        }
        // Two pulls at a right angle share a load between them; across both, the wall alone carries.
        let pair = |moment: [f64; 2]| share(moment, 0.0, vec![pull(0.0, 0.06), pull(0.5 * PI, 0.06)]);
        assert!((pair([-thrust * 0.06, 0.0]) - 1.0).abs() < 1e-12);
        assert!((pair([thrust * RADIUS, 0.0]) - 1.0).abs() < 1e-12);
    }

    /// The handbook's numbers: 0.305 N·m in the section of the ePAM, whose gas has 0.358 N·m about the far side.
    #[test]
    fn the_drawn_in_section_of_the_epam_carries_three_quarters_of_the_round_one() {
        let drawn = crate::section::CutSection::drawn_in(RADIUS, 0.06, 0.06).unwrap();
        let lost_m2 = PI * RADIUS.powi(2) - drawn.area_m2;
        let first_m3 = drawn.area_m2 * (drawn.centroid_m - RADIUS);
        let pull = StripPull { azimuth_rad: 0.0, from_axis_m: drawn.chord_m - RADIUS, lost_m2, first_m3 };
        let carried = 2e3 * drawn.area_m2 * (drawn.chord_m - drawn.centroid_m);
        assert!((carried - 0.305).abs() < 1e-3, "{carried}");
        assert!((share([-carried, 0.0], 0.0, vec![pull]) - 1.0).abs() < 1e-12);
    }
}
