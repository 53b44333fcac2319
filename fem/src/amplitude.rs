//! Quantities over time.

/// A quantity over time.
#[derive(Debug, Clone, PartialEq)]
pub enum Amplitude {
    /// Always the same.
    Constant(f64),
    /// Fifth-order smooth steps between (time \[s\], value) points: a + (b − a) ξ³(10 − 15ξ + 6ξ²); constant outside.
    Smooth(Vec<(f64, f64)>),
    /// Straight lines between (time \[s\], value) points; constant outside.
    Linear(Vec<(f64, f64)>),
}

impl Amplitude {
    /// Value at time `t` \[s\].
    pub fn at(&self, t: f64) -> f64 {
        let (points, smooth) = match self {
            Amplitude::Constant(value) => return *value,
            Amplitude::Smooth(points) => (points, true),
            Amplitude::Linear(points) => (points, false),
        };
        let Some(next) = points.iter().position(|p| p.0 > t) else { return points.last().map_or(0.0, |p| p.1) };
        if next == 0 {
            return points[0].1;
        }
        let ((t0, a), (t1, b)) = (points[next - 1], points[next]);
        let xi = (t - t0) / (t1 - t0);
        let share = if smooth { xi * xi * xi * (10.0 + xi * (-15.0 + 6.0 * xi)) } else { xi };
        a + (b - a) * share
    }

    /// Largest absolute value it ever takes.
    pub fn peak(&self) -> f64 {
        match self {
            Amplitude::Constant(value) => value.abs(),
            Amplitude::Smooth(points) | Amplitude::Linear(points) => points.iter().fold(0.0, |m, p| m.max(p.1.abs())),
        }
    }
}
