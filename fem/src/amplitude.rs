//! Quantities that change over time: pressures, displacements, multipliers of loads.

/// A scalar as a function of the simulated time.
#[derive(Debug, Clone, PartialEq)]
pub enum Amplitude {
    /// The same value at all times.
    Constant(f64),
    /// Fifth-order smooth steps between (time \[s\], value) points: a + (b − a) ξ³(10 − 15ξ + 6ξ²); constant outside.
    Smooth(Vec<(f64, f64)>),
    /// Straight lines between (time \[s\], value) points; constant outside.
    Linear(Vec<(f64, f64)>),
    /// ln(value + floor) runs at one rate from point to point, eased in over the first tenth of the time and out over the last
    /// four: equal shares, not equal amounts, in equal times. Values are above −floor.
    Growing {
        /// Points (time \[s\], value) in rising order of time.
        points: Vec<(f64, f64)>,
        /// Value from which growth is by shares.
        floor: f64,
    },
}

impl Amplitude {
    /// Value at time `t` \[s\].
    ///
    /// ```
    /// let ramp = fem::problem::Amplitude::Smooth(vec![(0.0, 0.0), (2.0, 8.0)]);
    /// assert_eq!((ramp.at(0.0), ramp.at(1.0), ramp.at(9.0)), (0.0, 4.0, 8.0));
    /// ```
    pub fn at(&self, t: f64) -> f64 {
        if let Amplitude::Constant(value) = self {
            return *value;
        }
        let points = self.points();
        let Some(next) = points.iter().position(|p| p.0 > t) else { return points.last().map_or(0.0, |p| p.1) };
        if next == 0 {
            return points[0].1;
        }
        let ((t0, a), (t1, b)) = (points[next - 1], points[next]);
        let xi = (t - t0) / (t1 - t0);
        match self {
            Amplitude::Linear(_) => a + (b - a) * xi,
            Amplitude::Growing { floor, .. } => {
                a + (a + floor) * (eased(xi) * ((b - a) / (a + floor)).ln_1p()).exp_m1()
            }
            _ => a + (b - a) * xi * xi * xi * (10.0 + xi * (-15.0 + 6.0 * xi)),
        }
    }

    /// Largest absolute value it ever takes.
    pub fn peak(&self) -> f64 {
        match self {
            Amplitude::Constant(value) => value.abs(),
            _ => self.points().iter().fold(0.0, |m, p| m.max(p.1.abs())),
        }
    }

    /// Its (time \[s\], value) points; none of a constant.
    pub fn points(&self) -> &[(f64, f64)] {
        match self {
            Amplitude::Constant(_) => &[],
            Amplitude::Smooth(points) | Amplitude::Linear(points) | Amplitude::Growing { points, .. } => points,
        }
    }
}

/// Shares of the time in which [`Amplitude::Growing`] gathers speed, and loses it.
const EASE_IN: f64 = 0.1;
const EASE_OUT: f64 = 0.4;

/// From 0 to 1 at one rate but for the ends, where the rate follows 3x² − 2x³.
fn eased(xi: f64) -> f64 {
    let end = |ease: f64, x: f64| ease * x * x * x * (1.0 - 0.5 * x);
    let whole = 1.0 - 0.5 * (EASE_IN + EASE_OUT);
    let way = if xi < EASE_IN {
        end(EASE_IN, xi / EASE_IN)
    } else if xi > 1.0 - EASE_OUT {
        whole - end(EASE_OUT, (1.0 - xi) / EASE_OUT)
    } else {
        xi - 0.5 * EASE_IN
    };
    way / whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_meets_its_points_and_takes_equal_times_for_equal_ratios() {
        let floor = 2.0;
        let growing = Amplitude::Growing { points: vec![(1.0, 0.0), (3.0, 30.0), (4.0, 30.0), (5.0, 0.0)], floor };
        assert_eq!([0.0, 1.0, 3.5, 9.0].map(|t| growing.at(t)), [0.0, 0.0, 30.0, 0.0]);
        assert!((growing.at(3.0 - 1e-9) - 30.0).abs() < 1e-12 && growing.peak() == 30.0);
        // Between the ends, the same factor in the same time, up and down.
        let factor = |t: f64, dt: f64| (growing.at(t + dt) + floor) / (growing.at(t) + floor);
        let once = 16_f64.powf(0.1 / 2.0 / 0.75);
        for (t, dt, wanted) in [(1.2, 0.1, once), (1.7, 0.1, once), (2.1, 0.1, once), (4.1, 0.05, 1.0 / once)] {
            assert!((factor(t, dt) / wanted - 1.0).abs() < 1e-12, "{t}: {}", factor(t, dt));
        }
    }

    #[test]
    fn growth_has_no_corner() {
        let growing = Amplitude::Growing { points: vec![(0.0, 0.0), (1.0, 30.0)], floor: 1e12 };
        let rate = |t: f64| (growing.at(t + 1e-6) - growing.at(t - 1e-6)) / 2e-6 / 30.0;
        for t in [1e-5, EASE_IN, 1.0 - EASE_OUT, 1.0 - 1e-5] {
            let jump = (rate(t + 1e-5) - rate(t - 1e-5)).abs();
            assert!(jump < 1e-3, "{t}: {jump}");
        }
        assert!(rate(1e-5) < 1e-3 && rate(1.0 - 1e-5) < 1e-3);
    }
}
