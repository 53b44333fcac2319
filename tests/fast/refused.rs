//! What every refusal has in common.

use crate::support::Folder;

/// The manifest of a folder with a report.
pub(crate) const MANIFEST: &str =
    r#"{"schema": "ibr.manifest", "version": 1, "outputs": [{"name": "report.html", "sha256": ""}]}"#;

/// A folder with an earlier report, which no refused command may touch.
pub(crate) fn with_report() -> Folder {
    let folder = Folder::new();
    folder.write("report/report.html", "<p>an earlier report");
    folder.write("report/manifest.json", MANIFEST);
    folder
}

/// Runs a command that must be refused: with this code, nothing on standard output but an object with `--json`, these words in the message (which
/// may be wrapped), no panic, and not one byte changed on disk.
pub(crate) fn refuse(folder: &Folder, args: &[&str], code: i32, words: &[&str]) {
    let before = folder.contents();
    let ran = folder.run(args);
    let message = unwrapped(&ran.stderr);
    assert_eq!(ran.code, code, "{args:?}: {message}");
    // With --json the same message comes as one object.
    match args.contains(&"--json") {
        true => assert!(ran.json("ibr.error")["exit_code"] == code, "{args:?}: {}", ran.stdout),
        false => assert_eq!(ran.stdout, "", "{args:?}"),
    }
    for part in words {
        assert!(message.contains(part), "{args:?}: no `{part}` in: {message}");
    }
    assert!(!message.contains("panicked") && !message.contains("RUST_BACKTRACE"), "{message}");
    let after = folder.contents();
    let changed: Vec<_> =
        before.iter().filter(|(file, bytes)| after.get(*file) != Some(*bytes)).map(|(file, _)| file).collect();
    assert!(after == before, "{args:?}: files have changed: {changed:?}, {} were, {} are", before.len(), after.len());
}

/// A message without the frame and the line breaks that are drawn around it.
fn unwrapped(text: &str) -> String {
    let words = text.split_whitespace().filter(|word| *word != "│" && *word != "·");
    words.collect::<Vec<_>>().join(" ")
}
