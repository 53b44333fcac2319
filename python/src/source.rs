//! The text that a scenario comes from.

use crate::errors::raised;
use crate::inputs::Change;
use ibr::ScenarioFile;
use pyo3::prelude::*;
use std::sync::{Arc, OnceLock};

/// The text of a scenario, or its source text with the numbers that were set.
pub(crate) struct ScenarioSource {
    pub base: Arc<ScenarioFile>,
    pub changes: Vec<Change>,
    pub file: OnceLock<Arc<ScenarioFile>>,
}

impl ScenarioSource {
    /// With its text, which is written at the first use.
    pub(crate) fn file(&self) -> PyResult<&Arc<ScenarioFile>> {
        if let Some(file) = self.file.get() {
            return Ok(file);
        }
        let changes: Vec<_> = self.changes.iter().map(Change::written).collect();
        let file = self.base.with_in_space(&changes).map_err(raised)?;
        Ok(self.file.get_or_init(|| Arc::new(file)))
    }
}
