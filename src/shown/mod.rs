//! Results as tables and sentences, and as JSON.

pub mod comparison;
pub mod demo;
pub mod diagnosis;
pub(crate) mod diagnosis_tables;
pub(crate) mod engines;
pub mod extension;
pub(crate) mod held;
pub mod predicted;
pub mod run;
pub mod validation;

use fem::record::RecordShape;
use serde::Serialize;

/// An answer as JSON of a shape in its first version.
pub fn as_json(schema: &'static str, body: &impl Serialize) -> serde_json::Value {
    RecordShape { schema, version: 1 }.stamped(body)
}
