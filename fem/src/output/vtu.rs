//! One frame for ParaView: a VTK unstructured grid in XML, version 1.0, arrays inline in base64.
//!
//! Points are where the nodes started; `U_mm` is the way from there, so that the filter *Warp By Vector* with scale 0.001
//! shows the deformed robot.
//!
//! | array | of | meaning |
//! |---|---|---|
//! | `U_mm` | node | displacement from the start \[mm\] |
//! | `velocity_m_s` | node | velocity \[m/s\] |
//! | `contact_pressure_kPa` | node | pressure between layers \[kPa\]; absent without contact |
//! | `von_mises_MPa`, `stress_1_MPa`, `stress_2_MPa` | element | Cauchy stress: von Mises, principal \[MPa\] |
//! | `strain_1`, `strain_2` | element | principal Green–Lagrange strains |
//! | `thickness_mm` | element | thickness now \[mm\] |
//! | `wrinkle_state` | element | 0 taut, 1 wrinkled, 2 slack |
//! | `part_id` | element | index of its part in the mesh, from 0 |
//!
//! Format: VTK file formats, <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>.

use std::io::{Error, Write};
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::atomic::replace;
use super::frame::Frame;
use crate::mesh::Part;
use crate::{FemError, Mesh};

const TRIANGLE: u8 = 5;
const QUAD: u8 = 9;

/// Writes one frame to `path`, whole or not at all.
///
/// # Errors
/// [`FemError::Stopped`] if a number is not finite or the frame does not fit the mesh; [`FemError::Io`] if the disk
/// refuses. An earlier file at `path` is then untouched.
pub fn write_vtu(path: &Path, mesh: &Mesh, frame: &Frame) -> Result<(), FemError> {
    frame.check(mesh)?;
    replace(path, &mut |out| write(out, mesh, frame))
}

fn write(out: &mut dyn Write, mesh: &Mesh, frame: &Frame) -> Result<(), Error> {
    let (nodes, elements) = (mesh.points.len(), mesh.elements());
    writeln!(out, r#"<?xml version="1.0"?>"#)?;
    writeln!(out, r#"<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">"#)?;
    writeln!(out, "<UnstructuredGrid>\n<FieldData>")?;
    let time = array_of(r#"type="Float64" Name="TimeValue" NumberOfTuples="1""#, frame.time_s.to_le_bytes());
    out.write_all(time.as_bytes())?;
    writeln!(out, "</FieldData>\n<Piece NumberOfPoints=\"{nodes}\" NumberOfCells=\"{elements}\">")?;
    write_points(out, mesh)?;
    write_cells(out, mesh)?;
    write_point_data(out, mesh, frame)?;
    write_cell_data(out, mesh, frame)?;
    writeln!(out, "</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

fn write_points(out: &mut dyn Write, mesh: &Mesh) -> Result<(), Error> {
    writeln!(out, "<Points>")?;
    vectors(out, "Points", (0..mesh.points.len()).map(|i| mesh.start_of(i)))?;
    writeln!(out, "</Points>")
}

fn write_cells(out: &mut dyn Write, mesh: &Mesh) -> Result<(), Error> {
    let corners = || elements(mesh).map(|(_, part, i)| part.nodes(i));
    let connectivity = corners().flatten().map(|&node| i64::from(node));
    let offsets = corners().scan(0, |end: &mut i64, nodes| {
        *end += nodes.len() as i64;
        Some(*end)
    });
    let types = corners().flat_map(|nodes| [if nodes.len() == 4 { QUAD } else { TRIANGLE }]);
    writeln!(out, "<Cells>")?;
    integers(out, "connectivity", connectivity)?;
    integers(out, "offsets", offsets)?;
    out.write_all(array_of(r#"type="UInt8" Name="types""#, types).as_bytes())?;
    writeln!(out, "</Cells>")
}

fn write_point_data(out: &mut dyn Write, mesh: &Mesh, frame: &Frame) -> Result<(), Error> {
    let moved = |(i, now): (usize, &[f64; 3])| {
        let start = mesh.start_of(i);
        [0, 1, 2].map(|k| (now[k] - start[k]) * 1e3)
    };
    writeln!(out, r#"<PointData Vectors="U_mm">"#)?;
    vectors(out, "U_mm", frame.positions.iter().enumerate().map(moved))?;
    vectors(out, "velocity_m_s", frame.velocities.iter().copied())?;
    if !frame.contact_pressure_pa.is_empty() {
        scalars(out, "contact_pressure_kPa", frame.contact_pressure_pa.iter().map(|p| p * 1e-3))?;
    }
    writeln!(out, "</PointData>")
}

fn write_cell_data(out: &mut dyn Write, mesh: &Mesh, frame: &Frame) -> Result<(), Error> {
    let fields = &frame.fields;
    writeln!(out, r#"<CellData Scalars="von_mises_MPa">"#)?;
    scalars(out, "von_mises_MPa", fields.von_mises_pa.iter().map(|s| s * 1e-6))?;
    scalars(out, "stress_1_MPa", fields.principal_stress_pa.iter().map(|s| s[0] * 1e-6))?;
    scalars(out, "stress_2_MPa", fields.principal_stress_pa.iter().map(|s| s[1] * 1e-6))?;
    scalars(out, "strain_1", fields.principal_strain.iter().map(|e| e[0]))?;
    scalars(out, "strain_2", fields.principal_strain.iter().map(|e| e[1]))?;
    scalars(out, "thickness_mm", fields.thickness_m.iter().map(|t| t * 1e3))?;
    integers(out, "wrinkle_state", fields.wrinkle_state.iter().map(|&state| i64::from(state)))?;
    integers(out, "part_id", elements(mesh).map(|(id, _, _)| id as i64))?;
    writeln!(out, "</CellData>")
}

/// Part index, part and number within the part of every element in mesh order.
fn elements(mesh: &Mesh) -> impl Iterator<Item = (usize, &Part, usize)> {
    mesh.parts.iter().enumerate().flat_map(|(id, part)| (0..part.len()).map(move |i| (id, part, i)))
}

fn vectors(out: &mut dyn Write, name: &str, values: impl Iterator<Item = [f64; 3]>) -> Result<(), Error> {
    let head = format!(r#"type="Float64" Name="{name}" NumberOfComponents="3""#);
    out.write_all(array_of(&head, values.flatten().flat_map(f64::to_le_bytes)).as_bytes())
}

fn scalars(out: &mut dyn Write, name: &str, values: impl Iterator<Item = f64>) -> Result<(), Error> {
    let head = format!(r#"type="Float64" Name="{name}""#);
    out.write_all(array_of(&head, values.flat_map(f64::to_le_bytes)).as_bytes())
}

fn integers(out: &mut dyn Write, name: &str, values: impl Iterator<Item = i64>) -> Result<(), Error> {
    let head = format!(r#"type="Int64" Name="{name}""#);
    out.write_all(array_of(&head, values.flat_map(i64::to_le_bytes)).as_bytes())
}

/// One array: 8 bytes of length and the values, as one run of base64.
fn array_of(head: &str, values: impl IntoIterator<Item = u8>) -> String {
    let mut bytes = vec![0; 8];
    bytes.extend(values);
    let length = bytes.len() as u64 - 8;
    bytes[..8].copy_from_slice(&length.to_le_bytes());
    format!("<DataArray {head} format=\"binary\">{}</DataArray>\n", STANDARD.encode(bytes))
}

#[cfg(test)]
#[path = "vtu_tests.rs"]
mod tests;
