//! Errors of the models.

use crate::root::POLE;
use crate::term::Extreme;
use thiserror::Error;

/// Why a scenario was refused; `span` is the byte range in the text it was read from.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{message}")]
pub struct ScenarioError {
    /// What is wrong.
    pub message: String,
    /// What to type instead.
    pub help: Option<String>,
    /// Byte range of the culprit in the scenario text.
    pub span: Option<(usize, usize)>,
}

impl ScenarioError {
    /// Line, what is wrong there and what to type, in one line: for programs that show no text around it.
    ///
    /// ```
    /// let text = "[body]\nradius_mm = 40\nlength_mm = 360\npressure = 2\n";
    /// let told = models::Scenario::parse(text).unwrap_err().in_text(text);
    /// assert!(told.starts_with("line 4: unknown field `pressure`"), "{told}");
    /// ```
    pub fn in_text(&self, text: &str) -> String {
        let line = |(start, _): (usize, usize)| text.bytes().take(start).filter(|byte| *byte == b'\n').count() + 1;
        let place = self.span.map_or(String::new(), |span| format!("line {}: ", line(span)));
        let help = self.help.as_ref().map_or(String::new(), |help| format!("; {help}"));
        format!("{place}{}{help}", self.message)
    }
}

/// Why no prediction came out.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Unsolved {
    /// A pressure out of its bounds.
    #[error("{message}; {help}")]
    BadPressure {
        /// What is wrong.
        message: String,
        /// What to write.
        help: &'static str,
    },
    /// A wanted place or limits that mean nothing.
    #[error("{what}")]
    BadAim {
        /// What is wrong.
        what: &'static str,
    },
    /// Built for planar robots alone.
    #[error(
        "{what} is built for planar robots; this one has strips round the body, for which ibr predict gives the shape at pressures"
    )]
    InSpace {
        /// What was asked for.
        what: &'static str,
    },
    /// A time out of its bounds.
    #[error("{message}; {help}")]
    BadTime {
        /// What is wrong.
        message: String,
        /// What to write.
        help: &'static str,
    },
    /// The moment balance of a stretch has no root.
    #[error(
        "no equilibrium at s = {s_mm:.1} mm for P = {p_act_kpa:.3} kPa, p_b = {p_body_kpa:.3} kPa: \
         the imbalance goes from {low:.3e} to {high:.3e} N·m; the outer loads exceed what wall and actuator can carry"
    )]
    NoEquilibrium {
        /// Place \[mm\].
        s_mm: f64,
        /// Actuator pressure there \[kPa\].
        p_act_kpa: f64,
        /// Body pressure \[kPa\].
        p_body_kpa: f64,
        /// Imbalance at the lower end of the search interval.
        low: f64,
        /// Imbalance at its upper end.
        high: f64,
    },
    /// The same, because of a formula of the scenario.
    #[error(
        "no equilibrium at s = {s_mm:.1} mm for P = {p_act_kpa:.3} kPa, p_b = {p_body_kpa:.3} kPa: the formula {} gives {} at \
         kappa = {:.2} 1/m (theta = {:.3}); it must stay finite, and within what wall and actuator can carry, at all pressures and bends",
        extreme.formula, moment(extreme.moment), extreme.kappa, extreme.theta
    )]
    Formula {
        /// Where the formula is largest.
        extreme: Extreme,
        /// Place \[mm\].
        s_mm: f64,
        /// Actuator pressure there \[kPa\].
        p_act_kpa: f64,
        /// Body pressure \[kPa\].
        p_body_kpa: f64,
    },
    /// Moments and shape did not settle.
    #[error(
        "moments and shape did not agree after {iterations} iterations at P = {p_act_kpa:.3} kPa: \
         residual {residual:.3e} N·m; the robot is close to collapse under its load"
    )]
    NotConverged {
        /// Iterations made.
        iterations: usize,
        /// Actuator pressure of channel 0 \[kPa\].
        p_act_kpa: f64,
        /// Largest remaining imbalance \[N·m\].
        residual: f64,
    },
    /// The wanted tip cannot be had.
    #[error(
        "{what} {wanted:.4} {unit} is out of reach: pressures from 0 to {p_max_kpa} kPa give {lowest:.4} to {highest:.4} {unit}"
    )]
    OutOfReach {
        /// Which quantity.
        what: &'static str,
        /// Wanted value.
        wanted: f64,
        /// Lowest value found.
        lowest: f64,
        /// Highest value found.
        highest: f64,
        /// Unit of the three.
        unit: &'static str,
        /// Largest pressure searched \[kPa\].
        p_max_kpa: f64,
    },
    /// The wanted tip lies where the robot jumps, or between stretches without equilibrium.
    #[error(
        "{what} {wanted:.4} {unit} is passed over: it is {below:.4} {unit} at {low_kpa:.6} kPa and {above:.4} {unit} at {high_kpa:.6} kPa, \
         with {between} between"
    )]
    Jump {
        /// Which quantity.
        what: &'static str,
        /// Wanted value.
        wanted: f64,
        /// Unit of the values.
        unit: &'static str,
        /// Pressure before \[kPa\].
        low_kpa: f64,
        /// Value there.
        below: f64,
        /// Pressure beyond \[kPa\].
        high_kpa: f64,
        /// Value there.
        above: f64,
        /// What is between the two.
        between: &'static str,
    },
}

fn moment(size: f64) -> String {
    if size < POLE { format!("{size:.3e} N·m") } else { "no finite moment".into() }
}
