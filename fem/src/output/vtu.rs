//! One frame for ParaView, VTK, PyVista and meshio: a VTK unstructured grid in XML, version 1.0, arrays compressed by zlib, in base64
//! in their tags. meshio 5.3.5 reads neither raw appended arrays nor texts, so names are in the names of arrays.
//!
//! Points are where the nodes are \[mm\]: a series opens as the deformed robot, moving. `displacement_mm` is the way from the start
//! in the same unit, so *Warp By Vector* with factor −1 gives the start.
//!
//! | array | of | meaning |
//! |---|---|---|
//! | `displacement_mm` | node | displacement from the start \[mm\] |
//! | `velocity_m_s` | node | velocity \[m/s\]; not of robots, which are read at rest |
//! | `contact_pressure_kPa` | node | pressure between layers \[kPa\]; absent without contact |
//! | `von_mises_MPa`, `stress_1_MPa`, `stress_2_MPa` | element | Cauchy stress: von Mises, principal \[MPa\] |
//! | `direction_1`, `direction_2` | element | directions of the principal stresses, vectors of length 127 in whole numbers (0.3°) |
//! | `strain_1`, `strain_2` | element | principal Green–Lagrange strains |
//! | `thickness_mm` | element | thickness now \[mm\] |
//! | `wrinkle_state` | element | 0 taut, 1 wrinkled, 2 slack |
//! | `part_id` | element | number of its part, from 0 |
//! | `part_id NAME` | frame | number of the part of this name |
//! | `chamber_kPa NAME`, `chamber_cm3 NAME` | frame | gauge pressure and volume of the chamber of this name |
//! | `hold_kPa` | frame | actuator pressure of the present or next hold; robots only |
//! | `TimeValue` | frame | time \[s\] |
//!
//! Numbers of the frame are f64, all others f32 without the digits that would be noise and not compress: places in steps of at most
//! 8e-6 of the largest coordinate at the start (2 µm in a robot), other numbers with 11 bits (0.05 % of each value). History and
//! readings have all digits.
//!
//! Format: VTK file formats, <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>.

use std::io::{Error, Write};
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::frame::MeshFrame;
use crate::mesh::Part;
use crate::output::replace;
use crate::vec3::V3;
use crate::{Mesh, Result};

const TRIANGLE: u8 = 5;
const QUAD: u8 = 9;
/// Fast: slower levels save another half per cent.
const LEVEL: u8 = 1;
/// Bits of a number that are kept after the leading one.
const BITS: u32 = 10;
/// Bits of the largest coordinate that are kept after the leading one.
const PLACE_BITS: i32 = 17;
const DIRECTION: f64 = 127.0;

/// Writes one frame to `path`, whole or not at all.
pub(crate) fn write_vtu(path: &Path, mesh: &Mesh, frame: &MeshFrame) -> Result<()> {
    frame.check(mesh)?;
    let bytes = FileTags::of(mesh, frame);
    replace(path, &mut |out| bytes.write(out))
}

/// The tags of a file, with the arrays in them.
#[derive(Default)]
struct FileTags {
    tags: String,
}

impl FileTags {
    fn of(mesh: &Mesh, frame: &MeshFrame) -> FileTags {
        let mut grid = FileTags::default();
        grid.within("FieldData", |grid| grid.about(mesh, frame));
        grid.tags +=
            &format!("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.points.len(), mesh.elements());
        let step = step_mm(mesh);
        let mm = |x: &[f64; 3]| x.map(|x| on_steps(x * 1e3, step));
        grid.within("Points", |grid| grid.vectors("Points", frame.positions.iter().map(mm)));
        grid.within("Cells", |grid| grid.cells(mesh));
        grid.within("PointData Vectors=\"displacement_mm\"", |grid| grid.point_data(mesh, frame));
        grid.within("CellData Scalars=\"von_mises_MPa\"", |grid| grid.cell_data(mesh, frame));
        grid.tags += "</Piece>\n";
        grid
    }

    fn write(&self, out: &mut dyn Write) -> Result<(), Error> {
        writeln!(out, r#"<?xml version="1.0"?>"#)?;
        let head = r#"type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64""#;
        writeln!(out, "<VTKFile {head} compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>")?;
        writeln!(out, "{}</UnstructuredGrid>\n</VTKFile>", self.tags)
    }

    fn about(&mut self, mesh: &Mesh, frame: &MeshFrame) {
        self.field("TimeValue", frame.time_s);
        for (id, part) in mesh.parts.iter().enumerate() {
            self.field(&format!("part_id {}", part.name), id as f64);
        }
        for chamber in &frame.chambers {
            self.field(&format!("chamber_kPa {}", chamber.name), chamber.pressure_pa * 1e-3);
            self.field(&format!("chamber_cm3 {}", chamber.name), chamber.volume_m3 * 1e6);
        }
        if let Some(pa) = frame.hold_pa {
            self.field("hold_kPa", pa * 1e-3);
        }
    }

    fn cells(&mut self, mesh: &Mesh) {
        let corners = || elements(mesh).map(|(_, part, i)| part.nodes(i));
        let offsets = corners().scan(0, |end: &mut u32, nodes| {
            *end += nodes.len() as u32;
            Some(*end)
        });
        self.integers("connectivity", corners().flatten().copied());
        self.integers("offsets", offsets);
        self.bytes("types", corners().map(|nodes| if nodes.len() == 4 { QUAD } else { TRIANGLE }));
    }

    fn point_data(&mut self, mesh: &Mesh, frame: &MeshFrame) {
        let step = step_mm(mesh);
        let moved = |(i, now): (usize, &[f64; 3])| {
            let start = mesh.start_of(i);
            [0, 1, 2].map(|k| on_steps((now[k] - start[k]) * 1e3, step))
        };
        self.vectors("displacement_mm", frame.positions.iter().enumerate().map(moved));
        if frame.hold_pa.is_none() {
            self.vectors("velocity_m_s", frame.velocities.iter().map(|v| v.map(kept)));
        }
        if !frame.contact_pressure_pa.is_empty() {
            self.scalars("contact_pressure_kPa", frame.contact_pressure_pa.iter().map(|p| p * 1e-3));
        }
    }

    fn cell_data(&mut self, mesh: &Mesh, frame: &MeshFrame) {
        let fields = &frame.fields;
        self.scalars("von_mises_MPa", fields.von_mises_pa.iter().map(|s| s * 1e-6));
        for k in 0..2 {
            let number = k + 1;
            self.scalars(&format!("stress_{number}_MPa"), fields.principal_stress_pa.iter().map(|s| s[k] * 1e-6));
            self.directions(&format!("direction_{number}"), fields.principal_direction.iter().map(|d| d[k]));
            self.scalars(&format!("strain_{number}"), fields.principal_strain.iter().map(|e| e[k]));
        }
        self.scalars("thickness_mm", fields.thickness_m.iter().map(|t| t * 1e3));
        self.bytes("wrinkle_state", fields.wrinkle_state.iter().copied());
        self.integers("part_id", elements(mesh).map(|(id, _, _)| id as u32));
    }

    fn within(&mut self, element: &str, inner: impl FnOnce(&mut FileTags)) {
        self.tags += &format!("<{element}>\n");
        inner(self);
        self.tags += &format!("</{}>\n", element.split(' ').next().unwrap_or(element));
    }

    fn directions(&mut self, name: &str, values: impl Iterator<Item = V3>) {
        let bytes: Vec<u8> = values.flatten().flat_map(|v| ((v * DIRECTION).round() as i8).to_le_bytes()).collect();
        self.array(&format!("type=\"Int8\" Name=\"{name}\" NumberOfComponents=\"3\""), &bytes);
    }

    fn vectors(&mut self, name: &str, values: impl Iterator<Item = [f32; 3]>) {
        let bytes: Vec<u8> = values.flatten().flat_map(f32::to_le_bytes).collect();
        self.array(&format!("type=\"Float32\" Name=\"{name}\" NumberOfComponents=\"3\""), &bytes);
    }

    fn scalars(&mut self, name: &str, values: impl Iterator<Item = f64>) {
        let bytes: Vec<u8> = values.flat_map(|v| kept(v).to_le_bytes()).collect();
        self.array(&format!("type=\"Float32\" Name=\"{name}\""), &bytes);
    }

    fn integers(&mut self, name: &str, values: impl Iterator<Item = u32>) {
        let bytes: Vec<u8> = values.flat_map(u32::to_le_bytes).collect();
        self.array(&format!("type=\"Int32\" Name=\"{name}\""), &bytes);
    }

    fn bytes(&mut self, name: &str, values: impl Iterator<Item = u8>) {
        self.array(&format!("type=\"UInt8\" Name=\"{name}\""), &values.collect::<Vec<u8>>());
    }

    fn field(&mut self, name: &str, value: f64) {
        let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        self.array(&format!("type=\"Float64\" Name=\"{name}\" NumberOfTuples=\"1\""), &value.to_le_bytes());
    }

    /// One array: the number of blocks, their size, the size of a shorter last one (0: there is none) and the size of each when
    /// compressed, in base64; then the block, in base64.
    fn array(&mut self, head: &str, bytes: &[u8]) {
        let packed = miniz_oxide::deflate::compress_to_vec_zlib(bytes, LEVEL);
        let sizes = [1, bytes.len(), 0, packed.len()].map(|number| (number as u64).to_le_bytes());
        let [sizes, packed] = [sizes.as_flattened(), &packed].map(|bytes| STANDARD.encode(bytes));
        self.tags += &format!("<DataArray {head} format=\"binary\">{sizes}{packed}</DataArray>\n");
    }
}

/// Step of places: a power of two \[mm\].
fn step_mm(mesh: &Mesh) -> f64 {
    let starts = (0..mesh.points.len()).flat_map(|i| mesh.start_of(i));
    let largest = starts.map(f64::abs).fold(0.0, f64::max) * 1e3;
    if largest > 0.0 { 2_f64.powi(largest.log2().floor() as i32 - PLACE_BITS) } else { 2_f64.powi(-PLACE_BITS) }
}

fn on_steps(value: f64, step: f64) -> f32 {
    ((value / step).round() * step) as f32
}

/// The nearest number with [`BITS`] after the leading one.
fn kept(value: f64) -> f32 {
    let cut = 23 - BITS;
    let half = (1_u32 << cut) >> 1;
    f32::from_bits((value as f32).to_bits().saturating_add(half) >> cut << cut)
}

/// Part index, part and number within the part of every element in mesh order.
fn elements(mesh: &Mesh) -> impl Iterator<Item = (usize, &Part, usize)> {
    mesh.parts.iter().enumerate().flat_map(|(id, part)| (0..part.len()).map(move |i| (id, part, i)))
}

#[cfg(test)]
#[path = "vtu_tests.rs"]
mod tests;
