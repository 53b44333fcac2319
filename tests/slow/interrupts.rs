//! Ctrl-C at any moment: exit code 130, and the earlier report or the whole new one, never a piece.
#![cfg(unix)]

use crate::alone;
use crate::support::{Folder, Ran, assert_hashes};
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Of a folder with a report.
const MANIFEST: &str =
    r#"{"schema": "ibr.manifest", "version": 1, "outputs": [{"name": "report.html", "sha256": ""}]}"#;

fn with_report() -> Folder {
    let folder = Folder::new();
    folder.write("report/report.html", "<p>an earlier report");
    folder.write("report/manifest.json", MANIFEST);
    folder
}

fn start(folder: &Folder) -> Child {
    let mut demo = folder.ibr(&["demo", "--out", "report"]);
    demo.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// A script in the background ignores SIGINT, and so does what it starts until that sets its own handler.
fn interrupts_are_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|hex| u64::from_str_radix(hex.trim(), 16).ok()).is_some_and(|mask| mask & 0b10 != 0)
}

/// Sends SIGINT and waits for the end.
fn interrupt(child: Child) -> Ran {
    let kill = format!("kill -INT {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    // Before the first line of main has run, the signal itself ends the process; shells call that 130 as well.
    let early = output.status.signal() == Some(2);
    let ran = Ran::from(output);
    assert!(ran.code == 130 || early, "{}: {}", ran.code, ran.stderr);
    assert!(!ran.stderr.contains("panicked"), "{}", ran.stderr);
    ran
}

#[test]
fn an_interrupt_while_computing_leaves_the_earlier_report_and_nothing_else() {
    let _alone = alone();
    let whole = Instant::now();
    assert!(start(&with_report()).wait().unwrap().success());
    let whole = whole.elapsed();
    let waits = [Duration::from_millis(20), whole / 8, whole / 4, whole / 2];
    let first = usize::from(interrupts_are_ignored());
    for wait in waits.into_iter().skip(first) {
        let folder = with_report();
        let before = folder.contents();
        let child = start(&folder);
        std::thread::sleep(wait);
        let ran = interrupt(child);
        assert!(folder.contents() == before, "after {wait:?}: {:?}", folder.contents().keys());
        // The demonstration tells its story as it goes; it must not tell of a report.
        assert!(
            !ran.stdout.contains("report.html") && !ran.stderr.contains("report:"),
            "{} {}",
            ran.stdout,
            ran.stderr
        );
        assert!(ran.stderr.contains("interrupted; nothing was written") || ran.code == -1, "{}", ran.stderr);
    }
}

#[test]
fn an_interrupt_while_writing_lets_the_whole_report_be_written() {
    let _alone = alone();
    for _ in 0..2 {
        let folder = with_report();
        let child = start(&folder);
        let patience = Instant::now();
        while folder.contents().len() < 4 {
            assert!(patience.elapsed() < Duration::from_secs(120), "no file was written");
            std::thread::sleep(Duration::from_millis(1));
        }
        let ran = interrupt(child);
        assert!(ran.stderr.contains("the results were already complete"), "{}", ran.stderr);
        let names = assert_hashes(&folder.path("report"));
        assert_eq!(folder.contents().len(), names.len() + 1, "temporary files: {:?}", folder.contents().keys());
    }
}
