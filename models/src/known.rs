//! How a number came to be known; measured, published, assumed, calibrated and predicted never mix.

/// How a number came to be known; every report keeps these apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Known {
    /// Measured by the user or in the named dataset.
    Measured,
    /// Printed in a publication, and taken from there.
    Published,
    /// Taken as likely, without a measurement.
    Assumed,
    /// Fitted to data that the report names.
    Calibrated,
    /// Computed from inputs that were not fitted to what it is compared with.
    Predicted,
}

impl Known {
    /// The word used in tables and plots.
    pub fn word(self) -> &'static str {
        ["measured", "published", "assumed", "calibrated", "predicted"][self as usize]
    }
}
