//! Settings of a diagnosis: what it tries, at which level it decides, what it excludes.

use crate::diagnosis::candidates::WITHOUT;
use crate::error::CompareError;
use crate::evaluate::check_level;
use models::Scenario;

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
    /// Effects that cannot be here, and [`PRESSURES_ARE_RIGHT`].
    pub not: Vec<String>,
    /// Search pairs of effects when one is not enough.
    pub pairs: bool,
    /// Try the robot with all mechanisms of the shipped one, or with none.
    pub other_design: bool,
    /// Search for the experiment that separates the remaining explanations.
    pub next_experiment: bool,
    /// Compute what moment the base lacks at the measured bends.
    pub missing_moment: bool,
    /// Learn a law of the missing moment, also where the verdict names an effect or nothing.
    pub learn: bool,
}

/// Entry of [`Options::not`] that declares the pressures right although they look like a slip.
pub const PRESSURES_ARE_RIGHT: &str = "pressure_slip";

impl Options {
    /// Whether something was said not to be here.
    pub fn excludes(&self, name: &str) -> bool {
        self.not.iter().any(|not| not == name)
    }

    /// Refuses what a diagnosis cannot do.
    ///
    /// # Errors
    /// A number outside its range, an excluded effect that does not exist or that the scenario has.
    pub fn check(&self, scenario: &Scenario) -> Result<(), CompareError> {
        check_level(self.alpha, self.tolerance_m)?;
        let catalogue = scenario.catalogue();
        let surplus: Vec<String> = scenario.effects.iter().map(|own| format!("{WITHOUT}{}", own.name)).collect();
        let names = catalogue.effects().map(|effect| effect.name).chain([PRESSURES_ARE_RIGHT]);
        let names: Vec<&str> = names.chain(surplus.iter().map(String::as_str)).collect();
        if let Some(name) = self.not.iter().find(|name| !names.contains(&name.as_str())) {
            return Err(CompareError::refused(format!("--not {name}: no such effect"), spelling::known(name, &names)));
        }
        if let Some(own) = scenario.effects.iter().find(|own| self.excludes(&own.name)) {
            let message = format!("--not {}: the scenario has this effect", own.name);
            let help =
                format!("take it out of the scenario file; if it is there for sure: --not \"{WITHOUT}{}\"", own.name);
            return Err(CompareError::refused(message, help));
        }
        Ok(())
    }
}

impl Options {
    /// The same without a next experiment and without the missing moment, for a call that needs neither.
    pub fn without_advice(self) -> Options {
        Options { next_experiment: false, missing_moment: false, ..self }
    }
}

impl Default for Options {
    fn default() -> Self {
        Options {
            alpha: 0.01,
            sigma_m: None,
            tolerance_m: None,
            refit_present: false,
            keep_bending: false,
            not: Vec::new(),
            pairs: true,
            other_design: true,
            next_experiment: true,
            missing_moment: true,
            learn: false,
        }
    }
}
