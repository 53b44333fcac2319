//! Results as tables and sentences, and as JSON.

pub mod bench_diagnosis;
pub mod breakdown;
pub mod characterized;
pub mod check;
pub mod comparison;
pub mod demo;
pub mod designed;
pub mod diagnosis;
pub mod diagnosis_tables;
pub mod engines;
pub mod extension;
pub mod held;
pub mod imported;
pub mod linear;
pub mod lists;
pub mod nearest;
pub mod one_number;
pub mod paper;
pub mod pattern;
pub mod predicted;
pub mod run;
pub mod run_robot;
pub mod several_runs;
pub mod swept;
pub mod validation;

use fem::record::RecordShape;
use serde::Serialize;

/// An answer as JSON of a shape in its first version.
pub fn as_json(schema: &'static str, body: &impl Serialize) -> serde_json::Value {
    RecordShape { schema, version: 1 }.stamped(body)
}
