//! Problems with known answers: what `ibr verify` runs and prints, and what the slow tests assert.
//!
//! A check builds a [`fem::Problem`], runs it with the real engine and compares with a closed form
//! (`verification::exact`), a conservation law or a published band. To add one: one new file here and one line in [`CHECKS`].

mod apart;
mod balloon;
pub mod bias;
mod bias_tube;
pub(crate) mod bodies;
mod cantilever;
mod coupons;
mod drops;
mod energy;
mod fold;
pub(crate) mod folded;
mod folded_start;
mod friction;
mod gradient;
mod hanging;
mod long_pouch;
mod patch;
mod pillow;
mod pleats;
mod pulled;
mod reversal;
mod ring;
mod robots;
mod run;
mod setup;
mod slope;
mod strip;
mod tube;

use fem::FemError;
pub use run::{Choice, Figures, verify};

/// A problem with a known answer.
#[derive(Debug, Clone, Copy)]
pub struct Check {
    /// Short name, as in `ibr verify --only NAME`.
    pub name: &'static str,
    /// One plain sentence: the simulation and its known answer.
    pub sentence: &'static str,
    /// Where the known answer comes from.
    pub source: &'static str,
    /// True if it takes more than a few CPU-seconds; `ibr verify` runs it only when asked for all.
    pub slow: bool,
    /// Runs the problem and compares its numbers.
    pub run: fn() -> CheckResult,
}

/// Numbers and curves that a check found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CheckOutcome {
    /// Numbers of the engine, each with its known one.
    pub lines: Vec<CheckedNumber>,
    /// Curves worth a picture; may be empty.
    pub figure: Option<Figure>,
}

/// One number against a known one.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckedNumber {
    /// Name of the compared number, with its unit.
    pub quantity: String,
    /// Number that the engine gave, in the same unit.
    pub measured: f64,
    /// Known number or bounds that it is compared with.
    pub against: Against,
}

/// The reference of a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Against {
    /// A known value and the largest relative error that passes.
    Value {
        /// Known value, in the unit of the line.
        exact: f64,
        /// Largest relative error with which the check passes.
        tolerance: f64,
    },
    /// Must not exceed this (residuals, rounding).
    AtMost(f64),
    /// Must reach this (rates of convergence).
    AtLeast(f64),
    /// From the first to the second, a published band.
    Between(f64, f64),
}

/// A figure: curves over common axes.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Title that is printed above the figure.
    pub title: String,
    /// Label of the horizontal axis, with unit.
    pub x: String,
    /// Label of the vertical axis, with unit.
    pub y: String,
    /// Curves of engine and known answer over common axes.
    pub curves: Vec<FigureCurve>,
}

/// One curve of a figure, of the engine or exact.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureCurve {
    /// Words of the curve in the legend.
    pub label: String,
    /// Points (x, y) in the units of the axes.
    pub points: Vec<[f64; 2]>,
    /// True for the known answer (drawn as a line), false for the engine (drawn as marks).
    pub exact: bool,
}

/// Checks that `ibr verify` can run, quick ones first.
pub const CHECKS: &[Check] = &[
    patch::UNIFORM,
    patch::BENDING,
    patch::TWO,
    patch::RIGID,
    gradient::CHECK,
    energy::CHECK,
    strip::SMALL,
    strip::LARGE,
    strip::ROLL,
    fold::STRIP,
    coupons::LINEAR,
    coupons::RUBBER,
    coupons::WOVEN,
    drops::BALL_ON_FLOOR,
    drops::BALL_ON_SHEET,
    drops::CROSSED,
    folded::CHECK,
    slope::CHECK,
    bodies::RIGID,
    bodies::TIES,
    bodies::SCALED,
    hanging::CHECK,
    friction::INCLINE,
    friction::CAPSTAN,
    reversal::CHECK,
    bodies::SEALED,
    tube::CHECK,
    ring::CHECK,
    long_pouch::CHECK,
    cantilever::SLOPE,
    bias_tube::CHECK,
    balloon::CHECK,
    pleats::CHECK,
    folded_start::CHECK,
    fold::SEALED,
    pillow::CHECK,
    cantilever::WRINKLING,
    bias::CHECK,
    robots::CHECK,
    robots::FOLDS,
];

/// Outcome of a check, or why its run stopped.
pub type CheckResult = Result<CheckOutcome, FemError>;

impl Check {
    const fn quick(
        name: &'static str,
        sentence: &'static str,
        source: &'static str,
        run: fn() -> CheckResult,
    ) -> Check {
        Check { name, sentence, source, slow: false, run }
    }

    const fn slow(name: &'static str, sentence: &'static str, source: &'static str, run: fn() -> CheckResult) -> Check {
        Check { slow: true, ..Check::quick(name, sentence, source, run) }
    }
}

impl From<Vec<CheckedNumber>> for CheckOutcome {
    fn from(lines: Vec<CheckedNumber>) -> CheckOutcome {
        CheckOutcome { lines, figure: None }
    }
}

impl CheckOutcome {
    fn drawn(lines: Vec<CheckedNumber>, figure: Figure) -> CheckOutcome {
        CheckOutcome { lines, figure: Some(figure) }
    }
}

impl Figure {
    fn new(title: &str, [x, y]: [&str; 2], curves: Vec<FigureCurve>) -> Figure {
        Figure { title: title.into(), x: x.into(), y: y.into(), curves }
    }
}

impl FigureCurve {
    fn exact(label: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>) -> FigureCurve {
        FigureCurve { label: label.into(), points: points.into_iter().collect(), exact: true }
    }

    fn engine(label: impl Into<String>, points: impl IntoIterator<Item = [f64; 2]>) -> FigureCurve {
        FigureCurve { exact: false, ..FigureCurve::exact(label, points) }
    }
}

impl Against {
    /// True if a number is good enough. A number that is not a number never is.
    pub fn holds(self, measured: f64) -> bool {
        match self {
            Against::Value { exact, tolerance } => (measured - exact).abs() <= tolerance * exact.abs(),
            Against::AtMost(limit) => measured <= limit,
            Against::AtLeast(limit) => measured >= limit,
            Against::Between(low, high) => (low..=high).contains(&measured),
        }
    }
}

impl CheckedNumber {
    fn new(quantity: impl Into<String>, measured: f64, against: Against) -> CheckedNumber {
        CheckedNumber { quantity: quantity.into(), measured, against }
    }

    /// A number against a known value.
    pub fn value(quantity: impl Into<String>, measured: f64, exact: f64, tolerance: f64) -> CheckedNumber {
        CheckedNumber::new(quantity, measured, Against::Value { exact, tolerance })
    }

    /// A number that must not exceed a limit.
    pub fn at_most(quantity: impl Into<String>, measured: f64, limit: f64) -> CheckedNumber {
        CheckedNumber::new(quantity, measured, Against::AtMost(limit))
    }

    /// A number that must reach a limit.
    pub fn at_least(quantity: impl Into<String>, measured: f64, limit: f64) -> CheckedNumber {
        CheckedNumber::new(quantity, measured, Against::AtLeast(limit))
    }

    /// A number that must lie in a band.
    pub fn between(quantity: impl Into<String>, measured: f64, low: f64, high: f64) -> CheckedNumber {
        CheckedNumber::new(quantity, measured, Against::Between(low, high))
    }

    /// Relative error, where there is a known value other than 0.
    pub fn error(&self) -> Option<f64> {
        match self.against {
            Against::Value { exact, .. } if exact != 0.0 => Some(self.measured / exact - 1.0),
            _ => None,
        }
    }

    /// True if the number is good enough.
    pub fn passes(&self) -> bool {
        self.against.holds(self.measured)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn not_a_number_passes_nothing() {
        let lines = [
            CheckedNumber::value("", f64::NAN, 1.0, 0.1),
            CheckedNumber::at_most("", f64::NAN, 1.0),
            CheckedNumber::at_least("", f64::NAN, 1.0),
            CheckedNumber::between("", f64::NAN, 0.0, 1.0),
        ];
        assert!(lines.iter().all(|line| !line.passes()));
    }

    #[test]
    fn the_checks_that_take_milliseconds_pass() {
        for check in [patch::UNIFORM, patch::BENDING, patch::TWO, patch::RIGID, gradient::CHECK] {
            for line in (check.run)().unwrap().lines {
                assert!(line.passes(), "{}: {line:?}", check.name);
            }
        }
    }

    #[test]
    fn names_are_unique() {
        for (i, check) in CHECKS.iter().enumerate() {
            assert!(CHECKS[..i].iter().all(|other| other.name != check.name), "{}", check.name);
        }
    }
}
