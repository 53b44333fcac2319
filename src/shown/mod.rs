//! Results as tables and sentences, and as JSON.

pub(crate) mod bench_diagnosis;
pub(crate) mod breakdown;
pub(crate) mod characterized;
pub(crate) mod check;
pub mod comparison;
pub(crate) mod demo;
pub(crate) mod designed;
pub mod diagnosis;
pub(crate) mod diagnosis_tables;
pub(crate) mod engines;
pub mod extension;
pub(crate) mod held;
pub(crate) mod one_number;
pub(crate) mod paper;
pub mod predicted;
pub mod run;
pub(crate) mod several_runs;
pub(crate) mod swept;
pub mod validation;

use fem::record::RecordShape;
use serde::Serialize;

/// An answer as JSON of a shape in its first version.
pub fn as_json(schema: &'static str, body: &impl Serialize) -> serde_json::Value {
    RecordShape { schema, version: 1 }.stamped(body)
}
