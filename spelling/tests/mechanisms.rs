//! A third mechanism of contraction must not pass silently as "not a pouch": code asks by `match`, or asks the actuator.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use std::fs;
use std::path::{Path, PathBuf};

/// Where names of actuators stand as text, and why they may.
const NAMED: &[(&str, &str)] = &[
    ("models/src/actuators/", "their own files"),
    ("models/src/scenario/mod.rs", "names of shipped scenarios"),
    ("models/src/effects/", "typical sizes, which another actuator takes from the effect"),
    ("data/src/published.rs", "how a publication writes its robots"),
    ("compare/src/study/paper/", "sentences of a publication on its robots"),
    ("compare/src/demo.rs", "the shipped robot of the demo"),
    ("src/commands/demo.rs", "the shipped robot of the demo"),
    ("src/commands/fem_inputs.rs", "the robots of the publication"),
    ("challenge/src/truth.rs", "the robots of the bench"),
    ("challenge/src/bench/made.rs", "the robots of the bench"),
    ("verification/src/checks/robots.rs", "shipped robots that are checked"),
    ("fuzz/src/readers.rs", "shipped robots to break"),
];

/// Rust files that ship, and what of them is not a test.
fn sources() -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let members = "spelling models fem data compare report src challenge verification sweep fuzz python capi web";
    let mut folders: Vec<PathBuf> = members.split(' ').map(|member| root.join(member)).collect();
    let mut found = Vec::new();
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()) {
            let name = path.strip_prefix(&root).unwrap().display().to_string();
            if path.is_dir() && !["target", "tests", "benches"].iter().any(|other| name.ends_with(other)) {
                folders.push(path);
            } else if name.ends_with(".rs") && !name.ends_with("tests.rs") {
                let text = fs::read_to_string(&path).unwrap();
                let tests = text.find("#[cfg(test)]\nmod").unwrap_or(text.len());
                let code = text[..tests].lines().map(|line| line.split("//").next().unwrap_or_default());
                found.push((name, code.collect::<Vec<_>>().join("\n")));
            }
        }
    }
    found
}

#[test]
fn no_code_compares_a_family_or_the_name_of_an_actuator() {
    let names = ["spam", "cpam", "epam", "fpam"].map(|name| format!("\"{name}\""));
    for (file, code) in sources() {
        let may_name = NAMED.iter().any(|(place, _)| file.starts_with(place));
        for line in code.lines() {
            assert!(!line.contains("= Family::"), "{file}: ask by match, or ask the actuator: {}", line.trim());
            let named = names.iter().find(|name| line.contains(*name));
            assert!(may_name || named.is_none(), "{file}: {} as text: {}", named.unwrap(), line.trim());
        }
    }
}
