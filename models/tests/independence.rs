//! A controller links `models` alone: no heavy dependencies, no files, no printing.

#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::Command;

#[test]
fn no_table_plot_optimiser_or_command_line_library_is_pulled_in() {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let arguments = ["tree", "--manifest-path", manifest, "-p", "ibr-models", "-e", "normal,build", "--prefix", "none"];
    let output = Command::new(env!("CARGO")).args(arguments).arg("--offline").output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8(output.stdout).unwrap();
    let names: Vec<&str> = tree.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.contains(&"ibr-models") && names.contains(&"toml"), "{tree}");
    for unwanted in ["polars", "plotters", "argmin", "clap", "nalgebra", "rayon"] {
        assert!(!names.iter().any(|name| name.starts_with(unwanted)), "{unwanted} in\n{tree}");
    }
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn the_library_touches_no_file_environment_or_terminal() {
    let mut files = Vec::new();
    sources(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src")), &mut files);
    assert!(files.len() > 30);
    for path in files {
        let text = std::fs::read_to_string(&path).unwrap();
        for word in ["std::fs", "std::io", "std::env", "std::process", "std::net", "println!", "eprint", "print!("] {
            assert!(!text.contains(word), "{} uses {word}", path.display());
        }
    }
}
