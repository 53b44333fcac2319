//! Which format a file has, by its content.

use super::build::MeshFile;
use super::scan::Scan;
use super::{abaqus, gmsh, stl};

pub(super) struct MeshFormat {
    pub(super) name: &'static str,
    is: fn(&FileHead) -> bool,
    pub(super) read: Read,
}

#[derive(Clone, Copy)]
pub(super) enum Read {
    Text(fn(&mut Scan) -> Result<MeshFile, String>),
    Bytes(fn(&[u8]) -> Result<MeshFile, String>),
}

struct FileHead<'a> {
    bytes: &'a [u8],
    /// The first line that is neither blank nor a comment.
    line: &'a str,
    word: &'a str,
}

/// All formats; the first that fits is taken.
static FORMATS: [MeshFormat; 4] = [
    MeshFormat { name: "STL (binary)", is: |head| stl::is_binary(head.bytes), read: Read::Bytes(stl::read_binary) },
    MeshFormat { name: "STL", is: |head| head.word == "solid", read: Read::Text(stl::read) },
    MeshFormat { name: "Gmsh", is: |head| head.word.starts_with('$'), read: Read::Text(gmsh::read) },
    MeshFormat { name: "Abaqus", is: |head| head.line.starts_with('*'), read: Read::Text(abaqus::read) },
];

/// Formats that are known and not read, by what they begin with.
const OTHERS: [(&str, &str); 14] = [
    ("MeshVersionFormatted", "Medit"),
    ("v ", "OBJ"),
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

pub(super) fn format(bytes: &[u8]) -> Result<&'static MeshFormat, String> {
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(4096)]);
    let text = text.trim_start_matches('\u{feff}');
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty());
    let first = lines().find(|line| !line.starts_with('#')).unwrap_or("");
    let head = FileHead { bytes, line: first, word: first.split_whitespace().next().unwrap_or("") };
    if let Some(format) = FORMATS.iter().find(|format| (format.is)(&head)) {
        return Ok(format);
    }
    let begin = lines().next().unwrap_or("");
    let readable = "Gmsh (.msh), Abaqus (.inp) and STL are read";
    Err(match OTHERS.iter().find(|(magic, _)| begin.starts_with(magic)) {
        Some((_, name)) => {
            format!(
                "this is {name}, which is not read; convert it, for example: meshio convert FILE FILE.inp. {readable}"
            )
        }
        None => {
            let shown: String = begin.chars().filter(|c| !c.is_control()).take(40).collect();
            format!("this is not a known mesh format: the file begins with `{shown}`. {readable}")
        }
    })
}

#[cfg(test)]
mod tests {
    use super::FORMATS;
    use std::path::Path;

    #[test]
    fn every_format_has_a_fixture_bad_input_a_fuzz_reader_and_a_line_in_the_document() {
        let at = |path: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
        let names = |folder: &str| -> Vec<String> {
            let files = std::fs::read_dir(at(folder)).unwrap();
            files.map(|file| file.unwrap().file_name().to_string_lossy().into_owned()).collect()
        };
        let text = |path: &str| std::fs::read_to_string(at(path)).unwrap();
        let read = |name: &String| super::super::read(&at("fem/tests/meshes").join(name)).unwrap().format;
        let fixtures: Vec<&str> = names("fem/tests/meshes").iter().map(read).collect();
        for format in &FORMATS {
            let name = format.name.split(' ').next().unwrap_or_default();
            let kind = format!("mesh-{}", name.to_lowercase());
            assert!(fixtures.contains(&name), "fem/tests/meshes has no {name} file");
            assert!(names("tests/zoo").iter().any(|file| file.starts_with(&kind)), "tests/zoo has no {kind}*.toml");
            assert!(text("fuzz/src/readers.rs").contains(&format!("\"{kind}\"")), "fuzz/src/readers.rs has no {kind}");
            assert!(text("docs/case.md").contains(&format!("\n| {name}")), "docs/case.md has no row for {name}");
        }
    }
}
