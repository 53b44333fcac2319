//! Closest points of two segments and of the lines through them.

use crate::vec3::{V3, along, cross, dot, sub};

/// Lines at one moment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lines {
    /// e₁ × e₂.
    pub product: V3,
    /// |e₁ × e₂|² over |e₁|² |e₂|²: sine squared of the angle between them.
    pub sine_square: f64,
    /// Place of the closest points, 0 to 1 within the segments.
    pub place: [f64; 2],
    /// From the second to the first, dotted with e₁ × e₂.
    pub triple: f64,
}

/// Lines through two segments. Parallel lines have places that are not numbers.
#[inline]
pub(super) fn lines([p, q]: [V3; 2], [r, s]: [V3; 2]) -> Lines {
    let (e1, e2, w) = (sub(q, p), sub(s, r), sub(p, r));
    let m = cross(e1, e2);
    let (a, b, c, d, e) = (dot(e1, e1), dot(e1, e2), dot(e2, e2), dot(e1, w), dot(e2, w));
    let square = dot(m, m);
    let inverse = 1.0 / square;
    let place = [(b * e - c * d) * inverse, (a * e - b * d) * inverse];
    Lines { product: m, sine_square: square / (a * c), place, triple: dot(w, m) }
}

/// Closest points of two segments: their places, and the vector from the second to the first.
pub(super) fn closest([p, q]: [V3; 2], [r, s]: [V3; 2]) -> (f64, f64, V3) {
    let (e1, e2, w) = (sub(q, p), sub(s, r), sub(p, r));
    let (a, b, c, d, e) = (dot(e1, e1), dot(e1, e2), dot(e2, e2), dot(e1, w), dot(e2, w));
    let square = a * c - b * b;
    let over = |x: f64, y: f64| if y > 0.0 { (x / y).clamp(0.0, 1.0) } else { 0.0 };
    let mut u = if square > 1e-12 * a * c { over(b * e - c * d, square) } else { 0.5 };
    let free = (b * u + e) / c;
    let v = if c > 0.0 { free.clamp(0.0, 1.0) } else { 0.0 };
    if v != free {
        u = over(b * v - d, a);
    }
    (u, v, along(along(w, u, e1), -v, e2))
}
