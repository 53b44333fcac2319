//! Tests that need an optimised build: `cargo test --release --test slow` (`./check.sh` runs it).
//!
//! A new test belongs into the module of what it measures or runs to its end: `characterize`, `demo`, `engine` (the finite
//! element engine against known answers), `interrupts`, `kills`, `learned` (laws that no catalogue has), `low_pressure` (roofs: both engines), `simulate`,
//! `in_space` (strips round the body: both engines), `large_file`, `open_chamber` (chambers open along an axis), `figures` (speed and known numbers), `documents` (command
//! lines of the documents). Whatever takes less than a second in an unoptimised build belongs into `tests/fast`.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a panic is the failure to report")]

mod characterize;
mod demo;
mod discovery;
mod documents;
mod engine;
mod figures;
mod in_space;
mod interrupts;
mod kills;
mod large_file;
mod learned;
mod low_pressure;
mod open_chamber;
mod robots;
mod simulate;
mod story;
#[path = "../support/mod.rs"]
mod support;

use std::sync::{Mutex, MutexGuard, PoisonError};

/// Held by every test of this binary: they measure time and memory, and shall not disturb each other.
static ALONE: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}
