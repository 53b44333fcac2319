//! Tests of the command `ibr` as a user meets it.
//!
//! A new test belongs into the module of what the user was doing: `json` if a program reads the answer, `predict`,
//! `compare`, `characterize`, `design`, `diagnose`, `add`, `generate`, `in_space`, `simulate` and `robots` for what those commands promise, `slips` for data that are
//! not what they say, `scenario_errors` and
//! `data_errors` for files that are wrong, `arguments` for wrong options, `output` for what lands on disk, `shell` for help,
//! completions and pipes.
//! Whatever needs an optimised build or more than a few seconds belongs into `tests/slow`.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a panic is the failure to report")]

mod add;
mod arguments;
mod challenge;
mod characterize;
mod compare;
mod data_errors;
mod design;
mod diagnose;
mod examples;
mod export;
mod generate;
mod held;
mod import;
mod in_space;
mod json;
mod json_schema;
mod json_source;
mod json_types;
mod output;
mod pattern;
mod predict;
mod refused;
mod robots;
mod runs;
mod scenario_errors;
mod session;
mod shell;
mod simulate;
mod slips;
#[path = "../support/mod.rs"]
mod support;
mod sweep;
