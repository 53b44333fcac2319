//! Mesh to text.

use std::fmt::{Display, Write};
use std::path::Path;

use crate::FemError;
use crate::atomic::replace;
use crate::mesh::check::numbers;
use crate::mesh::{Mesh, Part};

/// Node numbers on one line of a set.
const PER_LINE: usize = 16;

/// Writes a mesh file. An earlier file of this name stays until the new one is complete.
///
/// # Errors
/// [`FemError::Io`] if it cannot be written, [`FemError::Mesh`] if the mesh cannot be told in a file.
pub fn write(path: &Path, mesh: &Mesh) -> Result<(), FemError> {
    let text = text(mesh)?;
    replace(path, &mut |out| out.write_all(text.as_bytes()))
}

/// The text of a mesh file.
///
/// # Errors
/// [`FemError::Mesh`] for a name with spaces or `#`, a coordinate that is not a number, a node number out of range.
pub fn text(mesh: &Mesh) -> Result<String, FemError> {
    numbers(mesh)?;
    let mut out = String::from("mesh 1\n");
    block(&mut out, "nodes", &mesh.points, floats);
    for (keyword, places) in [("membrane", &mesh.membrane), ("start", &mesh.start)] {
        if !places.is_empty() {
            block(&mut out, keyword, places, floats);
        }
    }
    for part in &mesh.parts {
        part_text(&mut out, part)?;
    }
    for (name, nodes) in &mesh.sets {
        let lines: Vec<&[u32]> = nodes.chunks(PER_LINE).collect();
        line(&mut out, format_args!("set {} {}", word(name)?, nodes.len()));
        lines.iter().for_each(|nodes| line(&mut out, numbers_from_one(nodes)));
    }
    if !mesh.ties.is_empty() {
        block(&mut out, "ties", &mesh.ties, |tie| {
            let pairs: Vec<String> = tie.to.iter().map(|(n, w)| format!("{} {w:?}", *n as u64 + 1)).collect();
            format!("{} {}", tie.node as u64 + 1, pairs.join(" "))
        });
    }
    line(&mut out, format_args!("end {} {}", mesh.points.len(), mesh.elements()));
    Ok(out)
}

fn part_text(out: &mut String, part: &Part) -> Result<(), FemError> {
    line(out, format_args!("part {}", word(&part.name)?));
    for (side, name) in [("front", &part.front), ("back", &part.back)] {
        if let Some(name) = name {
            line(out, format_args!("{side} {}", word(name)?));
        }
    }
    if part.layer != 0 {
        line(out, format_args!("layer {}", part.layer));
    }
    if !part.warp.is_empty() {
        block(out, "warp", &part.warp, floats);
    }
    if !part.quads.is_empty() {
        block(out, "quads", &part.quads, |q| numbers_from_one(q));
    }
    if !part.triangles.is_empty() {
        block(out, "triangles", &part.triangles, |t| numbers_from_one(t));
    }
    Ok(())
}

/// A keyword with the number of lines, then the lines.
fn block<T>(out: &mut String, keyword: &str, rows: &[T], row: impl Fn(&T) -> String) {
    line(out, format_args!("{keyword} {}", rows.len()));
    rows.iter().for_each(|r| line(out, row(r)));
}

fn line(out: &mut String, text: impl Display) {
    // Writing to a string cannot fail.
    let _ = writeln!(out, "{text}");
}

/// `{:?}` prints the shortest digits that are read back to the same bits, with an exponent where that is shorter.
fn floats(x: &[f64; 3]) -> String {
    format!("{:?} {:?} {:?}", x[0], x[1], x[2])
}

fn numbers_from_one(nodes: &[u32]) -> String {
    nodes.iter().map(|n| (*n as u64 + 1).to_string()).collect::<Vec<_>>().join(" ")
}

/// A name that can stand in a file.
fn word(name: &str) -> Result<&str, FemError> {
    if name.is_empty() || name.contains(|c: char| c.is_whitespace() || c == '#') {
        let message =
            format!("the name `{name}` cannot be written to a mesh file; use one word without spaces and `#`");
        return Err(FemError::Mesh(message));
    }
    Ok(name)
}
