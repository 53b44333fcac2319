//! Vectors in the coordinates of a tracking file.

/// The component of a place along a direction; parts that the direction does not have are not read.
pub(super) fn along(direction: [f64; 3], place: [f64; 3]) -> f64 {
    (0..3).filter(|axis| direction[*axis] != 0.0).map(|axis| direction[axis] * place[axis]).sum()
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

pub(super) fn unit_vector(v: [f64; 3]) -> Option<[f64; 3]> {
    Some(along(v, v).sqrt()).filter(|size| *size > 0.0).map(|size| v.map(|part| part / size))
}

/// The one of a direction and its opposite that is nearer to a vector.
pub(super) fn towards(direction: [f64; 3], vector: [f64; 3]) -> [f64; 3] {
    if along(direction, vector) < 0.0 { direction.map(|part| -part) } else { direction }
}
