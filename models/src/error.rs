//! Errors of the models: a refused scenario, and a state without a solution.

use crate::root::POLE;
use crate::term::Extreme;
use spelling::units::Range;
use thiserror::Error;

/// Why a scenario was refused; `span` is the byte range in the text it was read from.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{message}")]
pub struct ScenarioError {
    /// The fault in one sentence that names the key and its value.
    pub message: String,
    /// What to write instead; `None` where the message already names it.
    pub help: Option<String>,
    /// Byte range of the culprit in the scenario text.
    pub span: Option<(usize, usize)>,
}

/// What a text gives, or why it is refused.
pub(crate) type Checked<T> = Result<T, ScenarioError>;

pub(crate) fn fault(message: impl Into<String>) -> ScenarioError {
    ScenarioError { message: message.into(), help: None, span: None }
}

impl ScenarioError {
    pub(crate) fn help(self, help: impl Into<String>) -> ScenarioError {
        ScenarioError { help: Some(help.into()), ..self }
    }

    /// Refuses a place of the text for it.
    pub(crate) fn at<T>(self, span: std::ops::Range<usize>) -> Checked<T> {
        self.within((span.start, span.end))
    }

    pub(crate) fn within<T>(self, span: (usize, usize)) -> Checked<T> {
        Err(ScenarioError { span: Some(span), ..self })
    }

    /// Line, fault and what to type, in one line: for programs that show no text around it.
    ///
    /// ```
    /// let text = "[body]\nradius_mm = 40\nlength_mm = 360\npressure = 2\n";
    /// let error = models::Scenario::parse(text).unwrap_err().in_text(text);
    /// assert!(error.starts_with("line 4: unknown field `pressure`"), "{error}");
    /// ```
    pub fn in_text(&self, text: &str) -> String {
        let line = |(start, _): (usize, usize)| text.bytes().take(start).filter(|byte| *byte == b'\n').count() + 1;
        let place = self.span.map_or(String::new(), |span| format!("line {}: ", line(span)));
        let help = self.help.as_ref().map_or(String::new(), |help| format!("; {help}"));
        format!("{place}{}{help}", self.message)
    }
}

/// Station \[mm\] and pressures \[kPa\] at which nothing balances.
#[expect(missing_docs, reason = "fields have the words and units of the message")]
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("s = {s_mm:.1} mm for P = {p_act_kpa:.3} kPa, p_b = {p_body_kpa:.3} kPa")]
pub struct FailurePlace {
    pub s_mm: f64,
    pub p_act_kpa: f64,
    pub p_body_kpa: f64,
}

/// Reason for which a model has no prediction, inverse or pressures.
#[expect(missing_docs, reason = "fields have the words and units of their message")]
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Unsolved {
    /// A pressure out of its bounds.
    #[error("{}", bounds.refusal(*value_pa))]
    BadPressure { bounds: Range, value_pa: f64 },
    /// A target place or limits that mean nothing.
    #[error("{what}")]
    BadAim { what: &'static str },
    /// The call covers planar robots only, and this robot has strips round the body.
    #[error(
        "{subject} is built for planar robots; this one has strips round the body, for which ibr predict gives the shape at pressures"
    )]
    InSpace { subject: &'static str },
    /// A time out of its bounds.
    #[error("{}", Range::TIME.refusal(*t_s))]
    BadTime { t_s: f64 },
    /// The moment balance of a stretch has no root.
    #[error(
        "no equilibrium at {place}: \
         the imbalance goes from {low:.3e} to {high:.3e} N·m; the outer loads exceed what wall and actuator can carry"
    )]
    NoEquilibrium { place: FailurePlace, low: f64, high: f64 },
    /// The same, because of a formula of the scenario.
    #[error(
        "no equilibrium at {place}: the formula {} gives {} at \
         kappa = {:.2} 1/m (theta = {:.3}); it must stay finite, and within what wall and actuator can carry, at all pressures and bends",
        extreme.formula, moment(extreme.moment), extreme.kappa, extreme.theta
    )]
    Formula { extreme: Extreme, place: FailurePlace },
    /// A law of a place has no value at the geometry of the scenario.
    #[error(
        "cannot balance the robot at {place}: {law} has no value at this \
         geometry. Try: a larger body.radius_mm, a smaller actuator.width_mm, or the robot without {law}"
    )]
    NoValue { law: &'static str, place: FailurePlace },
    /// Moments and shape did not settle.
    #[error(
        "moments and shape did not agree after {iterations} iterations at P = {p_act_kpa:.3} kPa: \
         residual {residual:.3e} N·m; the robot is close to collapse under its load"
    )]
    NotConverged { iterations: usize, p_act_kpa: f64, residual: f64 },
    /// The target tip is out of reach.
    #[error(
        "{what} {target:.4} {unit} is out of reach: pressures from 0 to {p_max_kpa} kPa give {lowest:.4} to {highest:.4} {unit}"
    )]
    OutOfReach { what: &'static str, target: f64, lowest: f64, highest: f64, unit: &'static str, p_max_kpa: f64 },
    /// The robot jumps past the target tip, or has no equilibrium there.
    #[error(
        "the robot snaps past {what} {target:.4} {unit}: {below:.4} {unit} at {low_kpa:.6} kPa and {above:.4} {unit} at {high_kpa:.6} kPa, \
         with {between} between"
    )]
    Jump {
        what: &'static str,
        target: f64,
        unit: &'static str,
        low_kpa: f64,
        below: f64,
        high_kpa: f64,
        above: f64,
        between: &'static str,
    },
}

/// What a model answers, or why it cannot.
pub type Solved<T = ()> = Result<T, Unsolved>;

fn moment(size: f64) -> String {
    if size < POLE { format!("{size:.3e} N·m") } else { "no finite moment".into() }
}
