//! Comments, messages and documents use the field's words: idioms that make a reader stop are counted, and their number only falls.
//!
//! `cargo test -p ibr-spelling --test plain_words -- --nocapture` prints the count of each.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use std::fs;
use std::path::{Path, PathBuf};

/// How many there are. Lower it after a change that removed some.
const AT_MOST: usize = 1881;

/// Words that stand for another one: what to write instead is in CONTRIBUTING.md.
const IDIOMS: [&str; 21] = [
    "told",
    "tells",
    "tell",
    "is said",
    "says",
    "held against",
    "beside",
    "stands",
    "hangs on",
    "lies",
    "wanted",
    "those of",
    "that of",
    "what is",
    "of its own",
    "is no",
    "nobody",
    "by itself",
    "gone on with",
    "anew",
    "taken off",
];

const FOLDERS: [&str; 14] = [
    "models",
    "fem",
    "data",
    "compare",
    "report",
    "src",
    "sweep",
    "spelling/src",
    "python",
    "capi",
    "web",
    "challenge",
    "verification",
    "docs",
];

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir()
            && !matches!(name.as_str(), "target" | "tests" | "sets" | "node_modules")
            && !name.starts_with('.')
        {
            files(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs" || end == "md") && !name.contains("tests") {
            found.push(path);
        }
    }
}

/// Comments and text in quotes of Rust code; the whole of a document.
fn prose(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    if path.extension().is_some_and(|end| end == "md") {
        return text;
    }
    let of_line = |line: &str| match line.split_once("//") {
        Some((_, comment)) => comment.to_string(),
        None => line.split('"').skip(1).step_by(2).collect::<Vec<_>>().join(" "),
    };
    text.lines().map(of_line).collect::<Vec<_>>().join(" ")
}

#[test]
fn idioms_become_fewer() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut paths = vec![root.join("README.md"), root.join("CONTRIBUTING.md"), root.join("ARCHITECTURE.md")];
    FOLDERS.iter().for_each(|folder| files(&root.join(folder), &mut paths));
    let signs = |c: char| if c.is_alphanumeric() || c == '_' { c.to_ascii_lowercase() } else { ' ' };
    let all: String = paths.iter().map(|path| prose(path).chars().map(signs).collect::<String>() + " ").collect();
    let words = format!(" {} ", all.split_whitespace().collect::<Vec<_>>().join("  "));
    let counts = IDIOMS.map(|idiom| (words.matches(&format!(" {} ", idiom.replace(' ', "  "))).count(), idiom));
    println!("{counts:?}");
    let total: usize = counts.iter().map(|(count, _)| count).sum();
    assert!(total <= AT_MOST, "{total} idioms, {AT_MOST} before: {counts:?}");
}
