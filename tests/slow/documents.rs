//! Every command line printed in a document runs, and prints what stands below it.
#![cfg(unix)]

use crate::alone;
use crate::support::{Folder, repository};
use std::path::Path;
use std::process::Command;

#[test]
fn every_ibr_command_line_of_the_documents_runs() {
    let _alone = alone();
    let (mut tried, mut compared) = (0, 0);
    for document in documents() {
        let text = std::fs::read_to_string(&document).unwrap();
        // One folder per document: a line may use what an earlier one has made.
        let folder = Folder::new();
        for (line, shown) in command_lines(&text) {
            let printed = run(&folder, &document, &line);
            for part in &shown {
                assert!(
                    printed.contains(part.trim_end_matches('…')),
                    "{}: {line}\n{part}\n{printed}",
                    document.display()
                );
            }
            (tried, compared) = (tried + 1, compared + shown.len());
        }
    }
    println!("{tried} command lines, {compared} lines of output");
    assert!(tried >= 5, "the README shows how to start: {tried} lines found");
    assert!(compared >= 5, "and what they print: {compared} lines found");
}

#[test]
fn the_table_of_robots_in_the_readme_is_what_the_command_prints() {
    let _alone = alone();
    let printed = Folder::new().run(&["compare", "--engines", "--stored"]).stdout;
    let readme = std::fs::read_to_string(repository().join("README.md")).unwrap();
    for name in ["| sPAM", "| cPAM", "| ePAM", "| fPAM"] {
        let row = |text: &str| text.lines().find(|line| line.starts_with(name)).map(numbers).unwrap();
        let (told, known) = (row(&readme), row(&printed));
        assert!(told.len() >= 5 && told.iter().all(|n| known.contains(n)), "{name}: {told:?}, printed {known:?}");
    }
}

fn numbers(line: &str) -> Vec<String> {
    let parts = line.split(|c: char| !c.is_ascii_digit() && c != '.').filter(|part| part.contains('.'));
    parts.map(String::from).collect()
}

fn documents() -> Vec<std::path::PathBuf> {
    let folders = [repository(), repository().join("docs")];
    let entries = folders.iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten();
    let paths = entries.map(|entry| entry.unwrap().path());
    let mut found: Vec<_> = paths.filter(|path| path.extension().is_some_and(|end| end == "md")).collect();
    found.sort();
    found
}

/// Lines of code blocks that call the command, as `ibr …` or through cargo, each with the output shown below it where
/// it stands behind a `$`; a backslash at the end joins the next, `…` stands for the rest of a line.
fn command_lines(text: &str) -> Vec<(String, Vec<String>)> {
    let (mut inside, mut session) = (false, false);
    let mut found: Vec<(String, Vec<String>)> = Vec::new();
    for line in text.replace("\\\n", " ").lines().map(str::trim) {
        let command = line.trim_start_matches("$ ").replacen("cargo run --release -- ", "ibr ", 1);
        if line.starts_with("```") {
            (inside, session) = (!inside, false);
        } else if inside && command.starts_with("ibr ") {
            session = line.starts_with("$ ");
            found.push((command, Vec::new()));
        } else if session {
            found.last_mut().unwrap().1.push(line.to_string());
        }
    }
    found
}

fn run(folder: &Folder, document: &Path, line: &str) -> String {
    let binary = Path::new(env!("CARGO_BIN_EXE_ibr")).parent().unwrap();
    let path = format!("{}:{}", binary.display(), std::env::var("PATH").unwrap_or_default());
    let mut shell = Command::new("sh");
    let output = shell.args(["-c", line]).current_dir(folder.path(".")).env("PATH", path).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    // A bench may miss what is wanted.
    let missed = line.starts_with("ibr bench") && output.status.code() == Some(1);
    assert!(output.status.success() || missed, "{}: {line}\n{message}", document.display());
    String::from_utf8_lossy(&output.stdout).into_owned()
}
