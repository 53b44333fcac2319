//! Documents stay readable: a short README, short sentences, links that lead somewhere.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use std::fs;
use std::path::{Path, PathBuf};

/// Words of the longest sentence, and the median of each document.
const LONGEST: usize = 30;
const MEDIAN: usize = 16;

/// The changelog is a list of lines, not sentences of a text; its links are checked all the same.
const WITHOUT_PROSE: &str = "CHANGELOG.md";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn documents() -> Vec<PathBuf> {
    let folders = [root(), root().join("docs"), root().join("docs/verification"), root().join("benches")];
    let entries = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap());
    let paths = entries.map(|entry| entry.unwrap().path());
    paths.filter(|path| path.extension().is_some_and(|end| end == "md")).collect()
}

/// Blocks of text outside code: paragraphs, items and cells of tables, each in one piece.
fn blocks(text: &str) -> Vec<String> {
    let (mut found, mut inside) = (vec![String::new()], false);
    for line in text.lines().map(str::trim) {
        if line.starts_with("```") {
            inside = !inside;
            found.push(String::new());
        } else if line.starts_with('|') {
            found.extend(line.split(" | ").map(String::from));
            found.push(String::new());
        } else if line.is_empty() || inside || line.starts_with('#') || line.starts_with('!') {
            found.push(String::new());
        } else {
            if line.starts_with("- ") || line.split_once(". ").is_some_and(|(n, _)| n.parse::<u32>().is_ok()) {
                found.push(String::new());
            }
            let last = found.last_mut().unwrap();
            last.push_str(line);
            last.push(' ');
        }
    }
    found
}

/// Numbers of words of the sentences of a block; code in backquotes and a link are a word each, signs are none.
fn sentences(block: &str) -> Vec<(usize, String)> {
    let plain: String = block.split('`').enumerate().map(|(i, s)| if i % 2 == 0 { s } else { "x" }).collect();
    let plain = plain.replace("et al.", "et al");
    let words = |s: &str| s.split_whitespace().filter(|w| w.contains(char::is_alphanumeric)).count();
    let parts = plain.split_inclusive(' ').fold(vec![String::new()], |mut parts, word| {
        parts.last_mut().unwrap().push_str(word);
        if word.trim_end().trim_end_matches([')', '*', '"']).ends_with(['.', '?', '!']) {
            parts.push(String::new());
        }
        parts
    });
    parts.into_iter().map(|s| (words(&s), s)).filter(|(count, _)| *count > 0).collect()
}

#[test]
fn the_readme_is_short() {
    let text = fs::read_to_string(root().join("README.md")).unwrap();
    assert!(text.lines().count() <= 110, "{} lines", text.lines().count());
    let long = text.lines().filter(|line| !line.starts_with('|') && line.chars().count() > 120);
    assert_eq!(long.collect::<Vec<_>>(), Vec::<&str>::new(), "longer than 120 characters");
}

#[test]
fn sentences_are_short() {
    let mut faults = Vec::new();
    for path in documents().iter().filter(|path| !path.ends_with(WITHOUT_PROSE)) {
        let text = fs::read_to_string(path).unwrap();
        let blocks = blocks(&text);
        let all: Vec<_> = blocks.iter().flat_map(|block| sentences(block)).collect();
        let long = all.iter().filter(|(words, _)| *words > LONGEST);
        faults.extend(long.map(|(words, sentence)| format!("{}: {words} words: {sentence}", path.display())));
        // Cells of tables are fragments: they would make every median small.
        let prose = blocks.iter().filter(|block| block.ends_with(' '));
        let mut counts: Vec<_> = prose.flat_map(|block| sentences(block)).map(|(words, _)| words).collect();
        counts.sort_unstable();
        if counts.get(counts.len() / 2).is_some_and(|median| *median > MEDIAN) {
            faults.push(format!("{}: median of {} words", path.display(), counts[counts.len() / 2]));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn links_lead_to_files_and_headings() {
    let mut faults = Vec::new();
    for path in documents() {
        let text = fs::read_to_string(&path).unwrap();
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(file) };
            let known = || fs::read_to_string(&target).is_ok_and(|text| anchors(&text).contains(&heading.to_string()));
            if !link.starts_with("http") && !(target.exists() && (heading.is_empty() || known())) {
                faults.push(format!("{}: {link}", path.display()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn files_that_are_named_exist() {
    let folders = "models/ fem/ data/ compare/ challenge/ src/ tests/ benches/ docs/ spelling/ studies/";
    let mut faults = Vec::new();
    for path in documents().iter().filter(|path| !path.ends_with(WITHOUT_PROSE)) {
        let text = fs::read_to_string(path).unwrap();
        let tokens = text.split(|c: char| c.is_whitespace() || matches!(c, '`' | '(' | ')' | ';' | ','));
        let named =
            tokens.filter(|t| folders.split(' ').any(|folder| t.starts_with(folder)) && !t.contains(['<', '*', '#']));
        let exists = |t: &str| [root(), path.parent().unwrap().into()].iter().any(|folder| folder.join(t).exists());
        faults.extend(named.filter(|t| !exists(t)).map(|t| format!("{}: {t}", path.display())));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Names of headings as links have them.
fn anchors(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim());
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    headings.map(|h| h.to_lowercase().replace(' ', "-").chars().filter(kept).collect()).collect()
}

#[test]
fn a_long_sentence_is_found_and_code_is_none() {
    let text = "One two. Three `a. b c` four\nfive et al. six.\n\n```\nnot this\n```\n- item one.\n| a b | c |\n";
    let counts: Vec<_> = blocks(text).iter().flat_map(|block| sentences(block)).map(|(words, _)| words).collect();
    assert_eq!(counts, [2, 7, 2, 2, 1]);
}
