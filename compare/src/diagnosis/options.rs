//! Settings of a diagnosis.

/// Settings of [`crate::diagnosis::diagnose`]; `Default` is what the command line uses.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Level of the one corrected p-value.
    pub alpha: f64,
    /// Camera noise of one coordinate \[m\], used only if there is a single run.
    pub sigma_m: Option<f64>,
    /// Differences up to this are good enough \[m\]; `None`: the larger of 0.15 mm and 0.5 % of d_max.
    pub tolerance_m: Option<f64>,
    /// Fit the parameters of the scenario's own effects along with the base.
    pub refit_present: bool,
    /// Keep the scenario's bending stiffness: it was measured separately.
    pub keep_bending: bool,
    /// Search pairs of effects when one is not enough.
    pub pairs: bool,
    /// Look for the next experiment.
    pub next_experiment: bool,
    /// Look at the missing moment.
    pub missing_moment: bool,
    /// Learn a law of the missing moment, also where the verdict names an effect or nothing.
    pub learn: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            alpha: 0.01,
            sigma_m: None,
            tolerance_m: None,
            refit_present: false,
            keep_bending: false,
            pairs: true,
            next_experiment: true,
            missing_moment: true,
            learn: false,
        }
    }
}
