//! Small vector algebra of mesh tools.

/// a − b.
pub(super) fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
/// a·b.
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
/// a × b.
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
/// |a|.
pub(super) fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}
/// s a.
pub(super) fn scale(a: [f64; 3], s: f64) -> [f64; 3] {
    [a[0] * s, a[1] * s, a[2] * s]
}
/// a + b.
pub(super) fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Area vector of a flat or warped element: ½ d₁ × d₂ of a quad's diagonals, ½ e₁ × e₂ of a triangle.
pub(super) fn area(x: &[[f64; 3]]) -> [f64; 3] {
    let [a, b] = if x.len() == 4 { [sub(x[2], x[0]), sub(x[3], x[1])] } else { [sub(x[1], x[0]), sub(x[2], x[0])] };
    scale(cross(a, b), 0.5)
}

/// Mean of the corners.
pub(super) fn centre(x: &[[f64; 3]]) -> [f64; 3] {
    scale(x.iter().fold([0.0; 3], |sum, p| add(sum, *p)), 1.0 / x.len() as f64)
}
