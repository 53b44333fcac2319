//! A user's own effect: a moment written as a formula in the scenario, checked and compiled once.
//!
//! ```text
//! M = f(κ, …) in N·m, positive towards the actuator      E = −∫₀^κ M dκ' per metre of body
//! ```
//!
//! | name | meaning | unit in the formula |
//! |---|---|---|
//! | `kappa` | curvature of the place, per length of the taut generator | 1/m |
//! | `theta` | κ L₀: bend of one actuator unit (of the whole muscle for an fPAM) | rad |
//! | `p_act`, `p_body` | pressure in the actuator of the place, in the body | Pa |
//! | `s` | station along the body | m |
//! | `R`, `B` | body radius; effective bending stiffness of the place | m, N·m² |
//! | `pull` | moment of the gas in the actuator at this bend, P dv/dκ; a formula with it acts where an actuator is | N·m |
//!
//! Parameters enter in SI. The energy is integrated to rounding over the formula's own corners, so the force is its slope and
//! the ledger stays true. **Validity**: up to the author of the formula; a moment that falls with κ may leave no
//! equilibrium, or several.

mod compile;
mod integral;
mod program;
mod pull;

use crate::assembly::Assembly;
use crate::effects::{Effect, Group, Needs, Parameter, Stage};
use crate::error::{Checked, fault};
use crate::root::POLE;
use crate::site::SideEffects;
use crate::term::{Account, Extreme, LedgerLine, Pose, Remembering, Term};
use compile::{Compiled, Name, compile};
use integral::integral;
use program::{INPUTS, KAPPA, Op, PULL, STATION, VARIABLES, run};
use pull::PullTerm;
use spelling::units::{self, Dimension};
use std::sync::Arc;

pub(crate) use program::{MOST_PARAMETERS, is_variable};

/// An effect of the scenario's own.
#[derive(Debug, Clone)]
pub struct Formula {
    /// Name of its table in `[effects.<name>]`, not one of the catalogue.
    pub name: String,
    /// Text of the moment as the scenario has it.
    pub moment: String,
    /// One plain sentence for a user.
    pub sentence: String,
    /// What measurements show where it acts.
    pub differs: String,
    /// What to measure or change on the robot.
    pub remedy: String,
    /// Its parameters, in the order of the text.
    pub parameters: Vec<FormulaParameter>,
    program: Arc<[Op]>,
    uses_station: bool,
    uses_pull: bool,
}

/// A parameter of a [`Formula`]: its words, and its numbers as in [`Parameter`].
#[derive(Debug, Clone, PartialEq)]
pub struct FormulaParameter {
    /// Name in the formula and key in the scenario.
    pub key: String,
    /// Unit of the value in the scenario; the formula has it in SI.
    pub unit: String,
    /// Meaning in a few words, for reports and messages.
    pub meaning: String,
    /// Its numbers; the words there are empty.
    pub numbers: Parameter<'static>,
}

impl FormulaParameter {
    fn entry(&self) -> Parameter<'_> {
        Parameter { key: &self.key, symbol: &self.key, unit: &self.unit, meaning: &self.meaning, ..self.numbers }
    }
}

impl PartialEq for Formula {
    fn eq(&self, other: &Self) -> bool {
        let texts = |f: &Formula| [&f.name, &f.moment, &f.sentence, &f.differs, &f.remedy].map(String::clone);
        texts(self) == texts(other) && self.parameters == other.parameters
    }
}

impl Formula {
    /// Compiles the text and checks its parameters: names, units, and values where it will be asked for.
    pub(crate) fn new(
        [name, moment, sentence, differs, remedy]: [String; 5],
        parameters: Vec<FormulaParameter>,
    ) -> Checked<Formula> {
        let Compiled { program, dimension, used } = compile(&moment, &names(&parameters))?;
        let whole = (0, moment.len());
        let slip = |message: String, help: &str| fault(message).help(help).within(whole);
        if !dimension.is(Dimension::MOMENT) {
            let message = format!("the moment comes out in {}, not in N m", dimension.words());
            return slip(message, &units_help(&parameters));
        }
        if let Some(idle) = parameters.iter().zip(&used[VARIABLES.len()..]).find(|(_, used)| !**used) {
            return slip(format!("the parameter {} does not occur in the formula", idle.0.key), "use it or remove it");
        }
        let (program, uses_station, uses_pull) = (program.into(), used[STATION], used[PULL]);
        let formula = Formula { name, moment, sentence, differs, remedy, parameters, program, uses_station, uses_pull };
        match formula.misbehaves() {
            Some((message, help)) => slip(message, help),
            None => Ok(formula),
        }
    }

    /// Its entry for a catalogue, with its parameters in the form of the catalogue's.
    pub(crate) fn effect<'a>(&'a self, parameters: &'a [Parameter<'a>]) -> Effect<'a> {
        Effect {
            name: &self.name,
            group: Group::Body,
            stage: Stage::Balance,
            history: false,
            formula: &self.moment,
            sentence: &self.sentence,
            differs: &self.differs,
            remedy: &self.remedy,
            validity: "up to the author of the formula",
            reference: "the scenario's own formula",
            parameters,
            needs: Needs::Body,
            add: |_, _| {},
        }
    }

    /// Its moment \[N·m\] at κ, θ, P, p_b, s, R, B, pull and parameters, all in SI.
    pub fn moment_at(&self, place: &[f64; VARIABLES.len()], values: &[f64]) -> f64 {
        let mut inputs = [0.0; INPUTS];
        inputs[..VARIABLES.len()].copy_from_slice(place);
        inputs[VARIABLES.len()..][..values.len()].copy_from_slice(values);
        run(&self.program, &inputs)
    }

    pub(crate) fn parameters(&self) -> Vec<Parameter<'_>> {
        self.parameters.iter().map(FormulaParameter::entry).collect()
    }

    /// Adds it to a model under construction; values in SI.
    pub(crate) fn add(&self, values: &[f64], assembly: &mut Assembly) {
        assembly.varies |= self.uses_station;
        let name: Arc<str> = self.name.as_str().into();
        for site in &mut assembly.sites {
            let mut inputs = [0.0; INPUTS];
            (inputs[5], inputs[6]) = (site.radius_m, site.bending.stiffness);
            inputs[VARIABLES.len()..][..values.len()].copy_from_slice(values);
            let (name, program, unit_m) = (Arc::clone(&name), Arc::clone(&self.program), site.shape.length_m);
            if self.uses_pull {
                if let Some(term) = PullTerm::new(program, site, inputs) {
                    site.act(term, SideEffects::SHIFT);
                }
                continue;
            }
            site.body_terms.push(Box::new(FormulaTerm { name, program, unit_m, inputs }));
        }
    }

    /// Values that cannot be, at some of the places where it will be asked: message and what to do.
    fn misbehaves(&self) -> Option<(String, &'static str)> {
        for (k, set) in ["neutral", "typical", "lower", "upper"].into_iter().enumerate() {
            let mut inputs = [0.0; INPUTS];
            for (input, p) in inputs[VARIABLES.len()..].iter_mut().zip(&self.parameters) {
                let p = p.numbers;
                *input = [p.neutral, p.typical, p.lower, p.upper][k] * p.si;
            }
            for place in PLACES {
                inputs[..VARIABLES.len()].copy_from_slice(&place);
                let moment = run(&self.program, &inputs);
                let at = format!("at the {set} values, kappa = {} 1/m, p_act = {} kPa", place[KAPPA], place[2] / 1e3);
                if !moment.is_finite() {
                    return Some((format!("the moment is {moment} {at}"), "it must be finite over all bounds"));
                }
                if set == "neutral" && moment != 0.0 {
                    let help = "choose neutral values at which the formula is exactly zero";
                    return Some((format!("the moment is {moment:.3e} N m {at}"), help));
                }
            }
        }
        None
    }
}

/// Where a formula is tried: κ, θ, P, p_b, s, R, B, pull in SI.
const PLACES: [[f64; 8]; 7] = [
    [0.0, 0.0, 0.0, 2e3, 0.0, 0.04, 0.0, 0.0],
    [0.0, 0.0, 30e3, 2e3, 0.36, 0.04, 1.0, 1e6],
    [1e-3, 6e-5, 10e3, 2e3, 0.18, 0.04, 1.0, 50.0],
    [0.7, 0.042, 10e3, 2e3, 0.03, 0.04, 1.0, 2.0],
    [-0.7, -0.042, 0.0, 2e3, 0.03, 0.04, 1.0, 0.0],
    [4.0, 0.24, 30e3, 4e3, 0.33, 0.04, 6.0, 3.0],
    [20.0, 1.2, 100e3, 1e3, 0.36, 0.02, 6.0, 1.0],
];

fn names(parameters: &[FormulaParameter]) -> Vec<Name<'_>> {
    let own = parameters.iter().map(|p| {
        let dimension = units::parse(&p.unit).map_or(Dimension::NONE, |(_, dimension)| dimension);
        Name { name: &p.key, dimension }
    });
    VARIABLES.iter().map(|(name, dimension)| Name { name, dimension: *dimension }).chain(own).collect()
}

fn units_help(parameters: &[FormulaParameter]) -> String {
    let own: Vec<String> = parameters.iter().map(|p| format!("{} in {}", p.key, p.unit)).collect();
    format!(
        "kappa is in 1/m, theta in rad, p_act and p_body in Pa, s and R in m, B in N m2, pull in N m; {}",
        own.join(", ")
    )
}

struct FormulaTerm {
    name: Arc<str>,
    program: Arc<[Op]>,
    unit_m: f64,
    inputs: [f64; INPUTS],
}

impl FormulaTerm {
    fn moment(&self, inputs: &mut [f64; INPUTS], kappa: f64) -> f64 {
        (inputs[KAPPA], inputs[KAPPA + 1]) = (kappa, kappa * self.unit_m);
        run(&self.program, inputs)
    }

    fn inputs(&self, at: &Pose) -> [f64; INPUTS] {
        let mut inputs = self.inputs;
        (inputs[2], inputs[3], inputs[4]) = (at.p_act_pa, at.p_body_pa, at.s_m);
        inputs
    }
}

impl Term for FormulaTerm {
    fn line(&self) -> LedgerLine {
        LedgerLine::new("formula", Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        self.add_force(at, force);
        let mut inputs = self.inputs(at);
        -integral(&mut |kappa| self.moment(&mut inputs, kappa), at.q[0])
    }

    fn add_force(&self, at: &Pose, force: &mut [f64]) {
        force[0] += self.moment(&mut self.inputs(at), at.q[0]);
    }
}

impl Remembering for FormulaTerm {
    fn extreme(&self, at: &Pose, within: [f64; 2]) -> Option<Extreme> {
        let mut inputs = self.inputs(at);
        let mut size = |kappa: f64| match self.moment(&mut inputs, kappa).abs() {
            size if size.is_nan() => f64::INFINITY,
            size => size,
        };
        let (near, far) = (largest(&mut size, within), largest(&mut size, within.map(|kappa| BEYOND * kappa)));
        let (kappa, moment) = if far.1 > POLE { far } else { near };
        Some(Extreme { formula: self.name.to_string(), kappa, theta: kappa * self.unit_m, moment })
    }
}

/// How much farther a pole is looked for: before it a moment grows too.
const BEYOND: f64 = 1.5;
const POINTS: u32 = 400;
/// Thirds cut off around the best of them: a pole is found to rounding.
const THIRDS: u32 = 200;

/// The largest value of f and its place: the best of a grid, then narrowed.
fn largest(f: &mut dyn FnMut(f64) -> f64, [low, high]: [f64; 2]) -> (f64, f64) {
    let step = (high - low) / f64::from(POINTS);
    let mut best = (low, f(low));
    for i in 1..=POINTS {
        let x = low + step * f64::from(i);
        let value = f(x);
        if value > best.1 {
            best = (x, value);
        }
    }
    let (mut a, mut b) = ((best.0 - step).max(low), (best.0 + step).min(high));
    for _ in 0..THIRDS {
        let (left, right) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
        let (at_left, at_right) = (f(left), f(right));
        best = [(left, at_left), (right, at_right)]
            .into_iter()
            .fold(best, |best, at| if at.1 > best.1 { at } else { best });
        if at_left > at_right { b = right } else { a = left }
    }
    best
}

#[cfg(test)]
mod tests;
