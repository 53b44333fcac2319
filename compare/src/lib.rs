//! Residuals, metrics and reports: the only crate that knows both model and measurement.
