//! Names that no table can hold: not UTF-8, with what a terminal obeys, too long; and streams that end badly.
#![cfg(unix)]

use crate::case::{Ran, clean, ended, unwrapped};
use std::ffi::OsStr;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use std::process::{Command, Stdio};

/// A name with a byte that is no text.
const NO_TEXT: &[u8] = b"caf\xe9.toml";
/// A name that turns the terminal red and names its window.
const ESCAPE: &[u8] = b"\x1b[31m\x1b]0;title\x07.toml";

fn ibr(at: &Path, words: &[&[u8]]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ibr"));
    command.args(words.iter().map(|word| OsStr::from_bytes(word))).current_dir(at).env("NO_COLOR", "1");
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn ran(at: &Path, words: &[&[u8]]) -> Ran {
    ended(ibr(at, words).spawn().unwrap()).unwrap()
}

/// Every command that takes a file, with a file of that name and without.
#[test]
fn odd_names_are_read_or_refused_and_never_reach_the_terminal_raw() {
    let commands: [&[&[u8]]; 9] = [
        &[b"predict"],
        &[b"pattern"],
        &[b"compare", b"epam-textbook"],
        &[b"data", b"check"],
        &[b"data", b"import"],
        &[b"characterize"],
        &[b"simulate", b"--export", b"out.inp"],
        &[b"challenge", b"reveal"],
        &[b"predict", b"epam-textbook", b"--out"],
    ];
    let long = [b"x".repeat(5000), b".toml".to_vec()].concat();
    for name in [NO_TEXT, ESCAPE, &long] {
        for command in commands {
            for is_there in [false, true] {
                let folder = tempfile::tempdir().unwrap();
                let path = folder.path().join(OsStr::from_bytes(name));
                if is_there && std::fs::write(path, models::shipped("epam-textbook").unwrap()).is_err() {
                    continue;
                }
                let found = ran(folder.path(), &[command, &[name]].concat());
                let typed = [command, &[&name[..8]]].concat().join(&b' ');
                let what = format!("{:?}: {}", String::from_utf8_lossy(&typed), found.stderr);
                assert!([0, 2, 3].contains(&found.code), "{what}");
                clean(&found).unwrap_or_else(|why| panic!("{why} {what}"));
            }
        }
    }
}

/// Labels of a good table are the user's; they are shown, and obeyed by nobody.
#[test]
fn labels_with_escapes_are_printed_without_them() {
    let folder = tempfile::tempdir().unwrap();
    let text = data::set_file("synthetic-epam", "markers.csv").unwrap();
    let labelled: String = text.lines().map(|line| line.replace(",load,6,", ",load,\x1b[31m6,") + "\n").collect();
    std::fs::write(folder.path().join("odd.csv"), labelled).unwrap();
    for words in
        [&[&b"data"[..], b"check", b"odd.csv"][..], &[b"compare", b"epam-textbook", b"odd.csv", b"--out", b"r"]]
    {
        let found = ran(folder.path(), words);
        assert_eq!(found.code, 0, "{}", found.stderr);
        clean(&found).unwrap();
    }
}

#[test]
fn a_terminal_that_takes_no_more_is_an_error_and_a_closed_pipe_is_none() {
    let folder = tempfile::tempdir().unwrap();
    let Ok(full) = std::fs::File::options().write(true).open("/dev/full") else { return };
    let mut command = ibr(folder.path(), &[b"list"]);
    let output = command.stdout(full).output().unwrap();
    let message = unwrapped(&String::from_utf8_lossy(&output.stderr));
    assert!(output.status.code() == Some(3) && message.contains("cannot print"), "{message}");
    let mut child = ibr(folder.path(), &[b"list"]).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.code() == Some(0) && output.stderr.is_empty(), "{output:?}");
}

/// Files and folders that may not be read or written; the superuser may all the same.
#[test]
fn what_may_not_be_read_or_written_is_named() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let closed = folder.path().join("closed.toml");
    std::fs::write(&closed, models::shipped("epam-textbook").unwrap()).unwrap();
    std::fs::set_permissions(&closed, std::fs::Permissions::from_mode(0o000)).unwrap();
    let may_all = std::fs::read(&closed).is_ok();
    let dir = folder.path().join("dir");
    std::fs::create_dir(&dir).unwrap();
    std::fs::set_permissions(&dir, std::fs::Permissions::from_mode(0o555)).unwrap();
    if may_all {
        println!("skipped: this user may read and write everything");
        return;
    }
    for (words, name) in [
        (&[&b"predict"[..], b"closed.toml"][..], "closed.toml"),
        (&[b"predict", b"epam-textbook", b"--out", b"dir/new"], "dir/new"),
        (&[b"simulate", b"pillow", b"--end", b"1ms", b"--out", b"dir/new"], "dir/new"),
    ] {
        let found = ran(folder.path(), words);
        assert!(found.code == 3 && unwrapped(&found.stderr).contains(name), "{}", found.stderr);
        clean(&found).unwrap();
    }
}
