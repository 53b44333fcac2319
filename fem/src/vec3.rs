//! Vectors of three numbers, written out so that the order of additions is fixed.

/// Three coordinates x, y and z of a point or vector.
pub type V3 = [f64; 3];

/// Four numbers for every node: x, y, z and [`crate::NODE`]'s padding.
pub type Nodes = [[f64; 4]];

/// x, y, z of node `i` of an array of stride [`crate::NODE`].
#[inline(always)]
pub fn node(q: &Nodes, i: usize) -> V3 {
    let [x, y, z, _] = q[i];
    [x, y, z]
}
/// x, y, z with the fourth number of a node, 0.
pub(crate) fn padded([x, y, z]: V3) -> [f64; 4] {
    [x, y, z, 0.0]
}
/// a/b, 0 unless b is above 0.
#[inline]
pub(crate) fn share(a: f64, b: f64) -> f64 {
    if b > 0.0 { a / b } else { 0.0 }
}
/// The value where it counts, 0 elsewhere.
pub(crate) fn where_so(counts: bool, value: f64) -> f64 {
    if counts { value } else { 0.0 }
}
/// Sum a + b of two vectors.
#[inline(always)]
pub fn add(a: V3, b: V3) -> V3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}
/// Difference a − b of two vectors.
#[inline(always)]
pub fn sub(a: V3, b: V3) -> V3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
/// Product s a of a vector and a number.
#[inline(always)]
pub fn scale(a: V3, s: f64) -> V3 {
    [a[0] * s, a[1] * s, a[2] * s]
}
/// Sum a + s b, the step from a along b.
#[inline(always)]
pub fn along(a: V3, s: f64, b: V3) -> V3 {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}
/// Scalar product a · b of two vectors.
#[inline(always)]
pub fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
/// a × b
///
/// ```
/// use fem::vec3::{cross, dot};
/// let (a, b) = ([1.0, 2.0, 3.0], [-2.0, 0.5, 4.0]);
/// assert_eq!([dot(a, cross(a, b)), dot(b, cross(a, b))], [0.0; 2]);
/// ```
#[inline(always)]
pub fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
/// Euclidean length of a vector, √(a · a).
#[inline(always)]
pub fn norm(a: V3) -> f64 {
    dot(a, a).sqrt()
}
/// a over its length; not a number for the zero vector.
pub(crate) fn direction(a: V3) -> V3 {
    let length = norm(a);
    [a[0] / length, a[1] / length, a[2] / length]
}
/// a over its length; `None` for a zero or not finite vector.
pub fn unit(a: V3) -> Option<V3> {
    let length = norm(a);
    (length > 0.0 && length.is_finite()).then(|| scale(a, 1.0 / length))
}

/// Area vector of a flat or warped element: ½ d₁ × d₂ of a quad's diagonals, ½ e₁ × e₂ of a triangle.
pub(crate) fn area(x: &[V3]) -> V3 {
    let [a, b] = if x.len() == 4 { [sub(x[2], x[0]), sub(x[3], x[1])] } else { [sub(x[1], x[0]), sub(x[2], x[0])] };
    scale(cross(a, b), 0.5)
}
/// The low and the high corner of the box round points.
pub(crate) fn bounds(points: impl Iterator<Item = V3>) -> [V3; 2] {
    points.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], p| {
        [[0, 1, 2].map(|k| low[k].min(p[k])), [0, 1, 2].map(|k| high[k].max(p[k]))]
    })
}
pub(crate) fn extent(points: impl Iterator<Item = V3>) -> V3 {
    let [low, high] = bounds(points);
    sub(high, low)
}
pub(crate) fn centre(x: &[V3]) -> V3 {
    scale(x.iter().fold([0.0; 3], |sum, p| add(sum, *p)), 1.0 / x.len() as f64)
}
