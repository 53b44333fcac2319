//! Kills at any moment and full disks of every size: a folder of results is the older one or the new one, and a run goes on.
#![cfg(unix)]

use crate::alone;
use crate::support::{Folder, Ran, assert_hashes};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Kills of reports, and of runs.
const KILLS: u32 = 40;

/// Commands that write a folder of results, quick ones.
const REPORTS: [&str; 4] = [
    "compare epam-textbook synthetic-epam --out report",
    "predict epam --pressure 10kPa,20kPa --out report",
    "diagnose epam-textbook synthetic-epam --out report",
    "data generate epam-textbook --force --out report",
];

fn words(command: &str) -> Vec<&str> {
    command.split(' ').collect()
}

/// Files below a folder by name.
fn files(folder: &Folder, name: &str) -> BTreeMap<PathBuf, Vec<u8>> {
    let root = folder.path(name);
    folder.contents().into_iter().filter(|(path, _)| path.starts_with(&root)).collect()
}

/// What the second command leaves where the first one was and the kill came: all of one of them.
fn assert_whole(folder: &Folder, old: &BTreeMap<PathBuf, Vec<u8>>, what: &str) -> bool {
    let found = files(folder, "report");
    if found == *old {
        return false;
    }
    let names = assert_hashes(&folder.path("report"));
    assert_eq!(found.len(), names.len() + 1, "{what}: {:?}", found.keys());
    true
}

#[test]
fn a_report_that_is_killed_at_any_moment_is_the_older_one_or_the_new_one() {
    let _alone = alone();
    let (mut older, mut newer, mut met) = (0, 0, 0);
    for command in REPORTS {
        let folder = Folder::new();
        assert_eq!(folder.run(&words(command)).code, 0, "{command}");
        let began = Instant::now();
        assert_eq!(folder.run(&words(command)).code, 0, "{command}");
        let takes = began.elapsed();
        let count = KILLS / REPORTS.len() as u32;
        for kill in 0..count {
            let old = files(&folder, "report");
            let mut child = folder.ibr(&words(command)).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            // A third by the clock, the others as soon as something is written, and a little later each.
            let patience = Instant::now();
            let wait = if kill % 3 == 0 { takes.mul_f64(f64::from(kill) / f64::from(count)) } else { Duration::MAX };
            while patience.elapsed() < wait.min(10 * takes) && child.try_wait().unwrap().is_none() {
                if kill % 3 > 0 && is_writing(&folder, child.id()) {
                    std::thread::sleep(Duration::from_micros(400 * u64::from(kill)));
                    break;
                }
            }
            child.kill().unwrap();
            child.wait().unwrap();
            met += usize::from(is_writing(&folder, child.id()));
            match assert_whole(&folder, &old, &format!("{command}, kill {kill}")) {
                true => newer += 1,
                false => older += 1,
            }
        }
    }
    println!("{older} kills left the older report, {newer} the new one; {met} came while files were written");
    // How many do depends on the machine; what is whole may not.
    assert!(older >= 5 && met >= 1, "{older} older, {newer} new, {met} while writing");
}

/// The process makes files ready beside the report.
fn is_writing(folder: &Folder, process: u32) -> bool {
    folder.path(&format!(".report.incomplete-{process}")).exists()
}

/// A disk that takes files of so many blocks of 512 bytes.
fn with_limit(folder: &Folder, blocks: u32, command: &str) -> Ran {
    let line = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" {command}");
    let ran = Command::new("sh").args(["-c", &line, env!("CARGO_BIN_EXE_ibr")]).current_dir(folder.path("")).output();
    Ran::from(ran.unwrap())
}

#[test]
fn a_disk_that_is_full_leaves_the_older_report_and_says_so() {
    let _alone = alone();
    for command in REPORTS {
        let folder = Folder::new();
        assert_eq!(folder.run(&words(command)).code, 0, "{command}");
        let old = files(&folder, "report");
        let largest = old.values().map(Vec::len).max().unwrap() as u32 / 512 + 1;
        let mut failed = 0;
        for blocks in [0, 1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024].into_iter().filter(|blocks| *blocks < largest) {
            let ran = with_limit(&folder, blocks, command);
            assert!(!ran.stderr.contains("panicked"), "{command}, {blocks} blocks: {}", ran.stderr);
            assert!(ran.code != 0 && ran.stderr.contains("cannot write"), "{command}, {blocks}: {}", ran.stderr);
            assert!(files(&folder, "report") == old, "{command}, {blocks} blocks: the older report has changed");
            assert_eq!(folder.contents().len(), old.len(), "{command}, {blocks} blocks: files are left beside it");
            failed += 1;
        }
        assert!(failed >= 3, "{command}: only {failed} sizes");
    }
}

const RUN: &str = "simulate my.toml --checkpoint-every 20ms --out run";

fn with_case() -> Folder {
    let text = fem::case::shipped_case("pillow").unwrap();
    let text = text.replace("elements = 32 ", "elements = 24 ");
    let folder = Folder::new();
    folder.write("my.toml", text);
    folder
}

/// All files of the run but the manifest, which says when and how it was made.
fn results(folder: &Folder) -> BTreeMap<PathBuf, Vec<u8>> {
    let root = folder.path("run");
    let inside = |path: &Path| path.strip_prefix(&root).unwrap().to_path_buf();
    let found = files(folder, "run").into_iter().map(|(path, bytes)| (inside(&path), bytes));
    found.filter(|(path, _)| path != Path::new("manifest.json")).collect()
}

/// Goes on as whoever finds the folder would.
fn finish(folder: &Folder, what: &str) {
    let ran = folder.run(&words(&format!("{RUN} --resume")));
    assert_eq!(ran.code, 0, "{what}: {}", ran.stderr);
}

#[test]
fn a_run_that_is_killed_over_and_over_ends_with_the_same_bytes() {
    let _alone = alone();
    let whole = with_case();
    let began = Instant::now();
    assert_eq!(whole.run(&words(RUN)).code, 0);
    let (takes, whole) = (began.elapsed(), results(&whole));
    let mut unfinished = 0;
    for trial in 0..KILLS / 5 {
        let folder = with_case();
        // Each goes a little further than the one before it.
        for kill in 0..5_u32 {
            let more = if kill == 0 { RUN.to_string() } else { format!("{RUN} --resume") };
            let mut child = folder.ibr(&words(&more)).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
            std::thread::sleep(takes.mul_f64(f64::from((7 * trial + 13 * kill) % 50) / 120.0));
            child.kill().unwrap();
            child.wait().unwrap();
            unfinished += usize::from(!folder.path("run/manifest.json").exists());
        }
        finish(&folder, &format!("trial {trial}"));
        assert!(results(&folder) == whole, "trial {trial}: other bytes");
    }
    println!("{unfinished} of {KILLS} kills met an unfinished run");
    // How many do depends on the machine; the bytes above may not.
    assert!(unfinished >= 10, "{unfinished}: the kills came too late");
}

#[test]
fn a_run_on_a_full_disk_stops_with_a_reason_and_goes_on_when_there_is_room() {
    let _alone = alone();
    let whole = with_case();
    assert_eq!(whole.run(&words(RUN)).code, 0);
    let whole = results(&whole);
    let mut failed = 0;
    for blocks in [0, 1, 4, 8, 16, 32, 48, 96] {
        let folder = with_case();
        let ran = with_limit(&folder, blocks, RUN);
        assert!(!ran.stderr.contains("panicked"), "{blocks} blocks: {}", ran.stderr);
        if ran.code != 0 {
            failed += 1;
            assert!(ran.code == 3 && ran.stderr.contains("File too large"), "{blocks} blocks: {}", ran.stderr);
            assert!(ran.stderr.contains("help:"), "{blocks} blocks: {}", ran.stderr);
            finish(&folder, &format!("{blocks} blocks"));
        }
        assert!(results(&folder) == whole, "{blocks} blocks: other bytes");
    }
    assert!(failed >= 4, "only {failed} sizes were too small");
}
