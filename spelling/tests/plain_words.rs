//! Comments, messages and documents use the field's words: idioms that make a reader stop are counted, and their number only falls.
//!
//! `cargo test -p ibr-spelling --test plain_words -- --nocapture` prints the count of each.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use std::fs;
use std::path::{Path, PathBuf};

/// How many there are. Lower it after a change that removed some.
const AT_MOST: usize = 5;

/// Idioms, and what to write instead.
const IDIOMS: [(&str, &str); 21] = [
    ("told", "reported, given"),
    ("tells", "prints, reports"),
    ("tell", "print, report"),
    ("is said", "is stated"),
    ("says", "states, gives"),
    ("held against", "compared with"),
    ("beside", "next to, together with, in addition to"),
    ("stands", "is, remains"),
    ("hangs on", "depends on"),
    ("lies", "is"),
    ("wanted", "target, requested"),
    ("those of", "the noun again, or a possessive"),
    ("that of", "the noun again, or a possessive"),
    ("what is", "the name of the thing"),
    ("of its own", "own, separate"),
    ("is no", "is not a, does not exist"),
    ("nobody", "a subject that exists"),
    ("by itself", "alone, separately"),
    ("gone on with", "resumed"),
    ("anew", "again, recomputed"),
    ("taken off", "subtracted, removed"),
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
    let count = |idiom: &str| words.matches(&format!(" {} ", idiom.replace(' ', "  "))).count();
    let counts = IDIOMS.map(|(idiom, instead)| (count(idiom), idiom, instead));
    println!("{counts:?}");
    let total: usize = counts.iter().map(|(count, ..)| count).sum();
    assert!(total <= AT_MOST, "{total} idioms, {AT_MOST} before: {counts:?}");
}
