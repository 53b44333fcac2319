//! Every command line printed in a document runs.
#![cfg(unix)]

use crate::alone;
use crate::support::{Folder, repository};
use std::path::Path;
use std::process::Command;

#[test]
fn every_ibr_command_line_of_the_documents_runs() {
    let _alone = alone();
    let mut tried = 0;
    for document in documents() {
        let text = std::fs::read_to_string(&document).unwrap();
        // One folder per document: a line may use what an earlier one has made.
        let folder = Folder::new();
        for line in command_lines(&text) {
            run(&folder, &document, &line);
            tried += 1;
        }
    }
    println!("{tried} command lines");
    assert!(tried >= 5, "the README shows how to start: {tried} lines found");
}

fn documents() -> Vec<std::path::PathBuf> {
    let folders = [repository(), repository().join("docs")];
    let entries = folders.iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten();
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut found: Vec<_> = paths.filter(|path| path.extension().is_some_and(|end| end == "md")).collect();
    found.sort();
    found
}

/// Lines of code blocks that call the command, as `ibr …` or through cargo; a backslash at the end joins the next.
fn command_lines(text: &str) -> Vec<String> {
    let mut inside = false;
    let mut found = Vec::new();
    for line in text.replace("\\\n", " ").lines().map(str::trim) {
        if line.starts_with("```") {
            inside = !inside;
        } else if inside {
            let command = line.trim_start_matches("$ ").replacen("cargo run --release -- ", "ibr ", 1);
            if command.starts_with("ibr ") {
                found.push(command);
            }
        }
    }
    found
}

fn run(folder: &Folder, document: &Path, line: &str) {
    let binary = Path::new(env!("CARGO_BIN_EXE_ibr")).parent().unwrap();
    let path = format!("{}:{}", binary.display(), std::env::var("PATH").unwrap_or_default());
    let mut shell = Command::new("sh");
    let output = shell.args(["-c", line]).current_dir(folder.path(".")).env("PATH", path).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    // A bench may miss what is wanted.
    let missed = line.starts_with("ibr bench") && output.status.code() == Some(1);
    assert!(output.status.success() || missed, "{}: {line}\n{message}", document.display());
}
