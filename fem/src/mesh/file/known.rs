//! Which format a file has, by its content.

use super::scan::Scan;
use super::{MeshFile, abaqus, gmsh, medit, obj, stl};

/// A format of mesh files.
pub(super) struct Format {
    /// Name for messages.
    pub(super) name: &'static str,
    is: fn(&Head) -> bool,
    pub(super) read: Read,
}

/// How a format is read.
#[derive(Clone, Copy)]
pub(super) enum Read {
    /// Our own.
    Own,
    /// Line by line.
    Text(fn(&mut Scan) -> Result<MeshFile, String>),
    /// From all bytes.
    Bytes(fn(&[u8]) -> Result<MeshFile, String>),
}

/// What a file begins with.
struct Head<'a> {
    bytes: &'a [u8],
    /// The first line that says something.
    line: &'a str,
    /// Its first word.
    word: &'a str,
}

/// All formats; the first that fits is taken.
static FORMATS: [Format; 7] = [
    Format { name: "", is: |head| head.word == "mesh", read: Read::Own },
    Format { name: "STL (binary)", is: |head| stl::is_binary(head.bytes), read: Read::Bytes(stl::read_binary) },
    Format { name: "STL", is: |head| head.word == "solid", read: Read::Text(stl::read) },
    Format { name: "Gmsh", is: |head| head.word.starts_with('$'), read: Read::Text(gmsh::read) },
    Format { name: "Medit", is: |head| head.word == "MeshVersionFormatted", read: Read::Text(medit::read) },
    Format { name: "Abaqus", is: |head| head.line.starts_with('*'), read: Read::Text(abaqus::read) },
    Format { name: "OBJ", is: |head| OBJ_WORDS.contains(&head.word), read: Read::Text(obj::read) },
];

const OBJ_WORDS: [&str; 8] = ["v", "vn", "vt", "o", "g", "f", "mtllib", "usemtl"];

/// Formats that are known and not read, by what they begin with.
const OTHERS: [(&str, &str); 12] = [
    ("# vtk", "VTK"),
    ("<VTKFile", "VTK"),
    ("<?xml", "XML, perhaps VTK or XDMF"),
    ("ply", "PLY"),
    ("OFF", "OFF"),
    ("PK", "a ZIP archive, perhaps 3MF"),
    ("\u{fffd}HDF", "HDF5, perhaps MED, CGNS or VTKHDF"),
    ("CDF", "Exodus"),
    ("ISO-10303", "STEP, a shape without a mesh"),
    ("CEND", "Nastran"),
    ("BEGIN BULK", "Nastran"),
    ("-1", "Universal (UNV)"),
];

/// The format of a file.
pub(super) fn format(bytes: &[u8]) -> Result<&'static Format, String> {
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]);
    let text = text.trim_start_matches('\u{feff}');
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty());
    let first = lines().find(|line| !line.starts_with('#')).unwrap_or("");
    let head = Head { bytes, line: first, word: first.split_whitespace().next().unwrap_or("") };
    if let Some(format) = FORMATS.iter().find(|format| (format.is)(&head)) {
        return Ok(format);
    }
    let begin = lines().next().unwrap_or("");
    let readable =
        "Gmsh (.msh), Abaqus (.inp), STL, OBJ and Medit (.mesh) are read, and our own (.ibrmesh: docs/case.md)";
    Err(match OTHERS.iter().find(|(magic, _)| begin.starts_with(magic)) {
        Some((_, name)) => {
            format!(
                "this is {name}, which is not read; convert it, for example: meshio convert FILE FILE.inp. {readable}"
            )
        }
        None => {
            let shown: String = begin.chars().filter(|c| !c.is_control()).take(40).collect();
            format!("this is no mesh that is known: it begins with `{shown}`. {readable}; our own begins with `mesh 1`")
        }
    })
}
