//! Bad input of every kind, one after another: `cargo test --release --test zoo`.
//!
//! A table a kind, `*.toml` in this folder: a good file, the command that reads it, and what can be wrong with it. Beside its own
//! list every table goes through what can be wrong with any file (`common.rs`). Whatever is refused has to say where and what to
//! do, in time, without a panic or a character that a terminal obeys, and with everything on disk left as it was.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a panic is the failure to report")]

mod case;
mod common;
mod paths;
mod table;

use case::Case;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Runs beside each other: a run waits for its process most of its time.
const AT_ONCE: usize = 4;

fn failures(cases: &[Case]) -> Vec<String> {
    let (next, failed) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || {
        while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
            if let Err(why) = case.run() {
                failed.lock().unwrap().push(format!("{}: {why}", case.name));
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..AT_ONCE {
            scope.spawn(work);
        }
    });
    let mut failed = failed.into_inner().unwrap();
    failed.sort();
    failed
}

#[test]
fn nothing_bad_is_taken_for_good() {
    let only = std::env::var("IBR_ZOO").unwrap_or_default();
    let mut cases: Vec<Case> = table::tables().iter().flat_map(table::Table::cases).collect();
    cases.retain(|case| case.name.contains(&only));
    assert!(cases.len() >= 300 || !only.is_empty(), "{} cases", cases.len());
    let failed = failures(&cases);
    assert!(failed.is_empty(), "{} of {} cases:\n{}", failed.len(), cases.len(), failed.join("\n"));
    println!("{} cases", cases.len());
}
