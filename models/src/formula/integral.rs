//! The integral of a formula to rounding, over its own corners.

/// Nodes and weights of Lobatto's rule with five points on \[−1, 1\]: it sees the ends, so a corner close to one is not missed.
const LOBATTO: [(f64, f64); 5] = [
    (-1.0, 0.1),
    (-0.654_653_670_707_977_1, 49.0 / 90.0),
    (0.0, 32.0 / 45.0),
    (0.654_653_670_707_977_1, 49.0 / 90.0),
    (1.0, 0.1),
];
/// Halvings of the interval around a corner: its share of the integral is then below rounding.
const HALVINGS: u32 = 40;

/// ∫₀^end f, halved three times and then where two halves disagree with the whole.
pub(super) fn integral(f: &mut dyn FnMut(f64) -> f64, end: f64) -> f64 {
    let whole = lobatto(f, 0.0, end);
    let size = whole.abs() + f(end).abs() * end.abs();
    refined(f, (0.0, end), whole, 1e-14 * size, HALVINGS)
}

fn refined(f: &mut dyn FnMut(f64) -> f64, (a, b): (f64, f64), whole: f64, error: f64, left: u32) -> f64 {
    let middle = 0.5 * (a + b);
    let (low, high) = (lobatto(f, a, middle), lobatto(f, middle, b));
    if left == 0 || (left < HALVINGS - 2 && (low + high - whole).abs() <= error) {
        return low + high;
    }
    refined(f, (a, middle), low, error, left - 1) + refined(f, (middle, b), high, error, left - 1)
}

fn lobatto(f: &mut dyn FnMut(f64) -> f64, a: f64, b: f64) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    LOBATTO.iter().map(|(x, weight)| weight * f(middle + half * x)).sum::<f64>() * half
}
