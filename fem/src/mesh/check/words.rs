//! How messages about meshes name things.

use crate::mesh::Part;
use crate::vec3::V3;
use crate::{FemError, Result};

/// Element `i` of a part, as messages name it.
pub(crate) fn describe(part: &Part, i: usize) -> String {
    let nodes: Vec<String> = part.nodes(i).iter().map(|n| (u64::from(*n) + 1).to_string()).collect();
    format!("element {} of part `{}` (nodes {})", i + 1, part.name, nodes.join(", "))
}

/// A place, as messages give it.
pub(super) fn millimetres(x: V3) -> String {
    // Adding 0 turns −0 into 0.
    let [x, y, z] = x.map(|v| (v * 1e4).round() / 10.0 + 0.0);
    format!("({x:.1}, {y:.1}, {z:.1}) mm")
}

pub(super) fn fault<T>(message: String) -> Result<T> {
    Err(FemError::Mesh(message))
}

/// "; did you mean `x`?", or nothing.
pub(super) fn meant<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    spelling::nearest(wrong, known).map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}
