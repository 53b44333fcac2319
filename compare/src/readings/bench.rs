//! Bench tests compared with a model: a beam under a load, a muscle in a testing machine.
//!
//! The model of a beam is the `[body]` of a scenario, loaded at its tip. The model of a muscle is the scenario's actuator alone
//! between two grips ([`models::Machine`]), in the size that the table gives; without a scenario the ideal braid (Chou and Hannaford
//! 1996) on plugs, as braids are clamped (`end_fittings`, published). A mean with its standard deviation and n gets a verdict: is the
//! model within the 95 % interval of the mean?

use data::Bench;
use data::bench::BenchRow;
use models::actuators::ActuatorShape;
use models::scenario::ActuatorChoice;
use models::{Loads, Machine, Model, Scenario};
use serde::Serialize;
use std::f64::consts::FRAC_PI_2;

use crate::CompareError;
use crate::fit::numbers::{largest, least, mean};
use crate::stats::t_975;
use crate::wording;
use models::Known;

/// A bench table compared with the model's values, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparedBench {
    /// Which table is compared with which model.
    pub title: String,
    /// Name of the measured quantity, with its unit.
    pub quantity: String,
    /// How the model's numbers are known.
    pub known: Known,
    /// Compared rows, in the order of the table.
    pub rows: Vec<HeldRow>,
    /// Remarks on the comparison, such as values that had to be assumed.
    pub notes: Vec<String>,
}

/// One measured number next to the model's.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HeldRow {
    /// At which pressure, size and load.
    pub at: String,
    /// As measured, in the unit of the title.
    pub measured: f64,
    /// By the model; none where it finds no equilibrium.
    pub model: Option<f64>,
    /// Half-width of the 95 % interval of the mean, t s/√n, where scatter and number are known.
    #[serde(rename = "interval_half")]
    pub half: Option<f64>,
    /// Whether the model was fitted to this row.
    pub fitted: bool,
}

impl HeldRow {
    /// Model over measurement less one; `None` if the model has no value or the measurement is 0.
    pub fn off(&self) -> Option<f64> {
        self.model.filter(|_| self.measured != 0.0).map(|m| m / self.measured - 1.0)
    }

    /// In words; empty where the table has no scatter.
    pub fn verdict(&self) -> String {
        match (self.model, self.half) {
            _ if self.fitted => "fitted".into(),
            (None, _) => "collapsed".into(),
            (Some(_), None) => String::new(),
            (Some(m), Some(half)) if (m - self.measured).abs() <= half => "agrees".into(),
            (Some(m), Some(half)) => format!("off by {:.1} intervals", (m - self.measured).abs() / half),
        }
    }
}

impl ComparedBench {
    /// Root mean square of the shares by which the model is off, of rows it was not fitted to.
    pub fn rms(&self) -> Option<f64> {
        let all: Vec<f64> = self.rows.iter().filter(|r| !r.fitted).filter_map(HeldRow::off).collect();
        (!all.is_empty()).then(|| mean(all.iter().map(|o| o * o)).sqrt())
    }
}

/// Holds a table against a model; `calibrate` fits the one number that is usually not known (E t of a beam, the braid angle of
/// a muscle) to one row, which is then marked.
///
/// # Errors
/// A kind without a model, or a scenario that is missing.
pub fn held(bench: &Bench, given: Option<&Scenario>, calibrate: bool) -> Result<ComparedBench, CompareError> {
    let beam = is_beam(bench)?;
    let scenario = own_or_braid(bench, given)?;
    let of_one_specimen: &[&str] = if beam { &["p_body", "radius"] } else { &["muscle"] };
    let (mut rows, mut notes) = (Vec::new(), Vec::new());
    for group in bench.rows.chunk_by(|a, b| of_one_specimen.iter().all(|key| a.get(key) == b.get(key))) {
        let mut trial = Trial { scenario: scenario.clone(), bias_rad: None };
        let mut fitted = calibrated_on(group).filter(|_| calibrate);
        if let Some(row) = fitted {
            let (is_met, note) = match beam {
                true => trial.calibrate_wall(row, &trial.specimen_of(bench, &group[0])?),
                false => trial.calibrate_angle(row),
            };
            notes.push(note);
            fitted = fitted.filter(|_| is_met);
        }
        for row in group {
            let specimen = trial.specimen_of(bench, row)?;
            let sd = if beam { "deflection_sd" } else { "force_sd" };
            let unit = match (beam, is_free(row)) {
                (true, _) => 1e3,
                (false, true) => 100.0,
                (false, false) => 1.0,
            };
            rows.push(HeldRow {
                at: place(row, &specimen),
                measured: unit * measured(row),
                model: modelled(row, &specimen).map(|v| unit * v),
                half: half(row, sd, unit).filter(|_| !is_free(row)),
                fitted: fitted.is_some_and(|f| f.line == row.line),
            });
        }
    }
    let (what, quantity) = if beam { ("Inflated beam", "deflection mm") } else { ("Muscle", "value") };
    let known = match (rows.iter().any(|row| row.fitted), beam) {
        (true, _) => Known::Calibrated,
        (false, true) => Known::Predicted,
        (false, false) => Known::Assumed,
    };
    let top_pa = bench.rows.iter().filter_map(|row| row.get("p_act")).fold(0.0, f64::max);
    if let Some(given) = given.filter(|given| top_pa > given.p_max_pa) {
        let (top, most) = (wording::value(1e-3 * top_pa), wording::value(1e-3 * given.p_max_pa));
        notes.push(format!("the table goes to {top} kPa, above the scenario's max_pressure_kpa = {most}"));
    }
    if calibrate && !rows.iter().any(|row| row.fitted) && notes.is_empty() {
        notes.push(NOTHING_FREE.into());
    }
    if beam && !calibrate && scenario.wall.stiffness_n_per_m.is_none() {
        notes.push(NO_WALL.into());
    }
    let title = format!("{what}, {} against {}", scenario.name, bench.file);
    Ok(ComparedBench { title, quantity: quantity.into(), known, rows, notes })
}

/// Whether the table is one of beams; else it is one of muscles.
///
/// # Errors
/// A kind without a model.
pub(crate) fn is_beam(bench: &Bench) -> Result<bool, CompareError> {
    match bench.kind.name {
        "load_deflection" => Ok(true),
        "force_contraction" => Ok(false),
        _ => refuse(bench, "no model is compared with it", "ibr characterize reads it"),
    }
}

pub(crate) fn refuse<T>(bench: &Bench, problem: &str, help: &str) -> Result<T, CompareError> {
    Err(CompareError::told(format!("{}: {problem}: {help}", bench.file)))
}

fn half(row: &BenchRow, sd: &str, unit: f64) -> Option<f64> {
    let (sd, n) = (row.get(sd)?, row.get("n")?);
    Some(unit * t_975(n as usize - 1) * sd / n.sqrt())
}

/// What a row measured: a deflection \[m\], a force \[N\] or, without a force, a contraction \[-\].
pub(crate) fn measured(row: &BenchRow) -> f64 {
    let force = |row: &BenchRow| if is_free(row) { row.value("contraction") } else { row.value("force") };
    row.get("deflection").unwrap_or_else(|| force(row))
}

/// Whether a muscle is free: its contraction was measured, not its force.
pub(crate) fn is_free(row: &BenchRow) -> bool {
    row.get("force") == Some(0.0)
}

/// The model's value for a row's specimen; none where it finds no equilibrium.
pub(crate) fn modelled(row: &BenchRow, specimen: &Scenario) -> Option<f64> {
    match row.get("load") {
        Some(load) => deflection_m(specimen, load),
        None => {
            let machine = Machine::new(specimen)?;
            let p = row.value("p_act");
            if is_free(row) { Some(machine.free_contraction(p)) } else { machine.pull_n(p, row.value("contraction")) }
        }
    }
}

/// A scenario in which something is tried, and a yarn angle that goes before the table's.
#[derive(Clone)]
pub(crate) struct Trial {
    pub scenario: Scenario,
    pub bias_rad: Option<f64>,
}

impl Trial {
    /// The scenario in the size and at the pressure of a row; the error is the missing number and the remedy.
    pub(crate) fn specimen(&self, row: &BenchRow) -> Result<Scenario, [&'static str; 2]> {
        let scenario = &self.scenario;
        if row.get("load").is_some() {
            let radius_m = row.get("radius").unwrap_or(scenario.radius_m);
            return Ok(Scenario { p_body_pa: row.value("p_body"), radius_m, ..scenario.clone() });
        }
        let ActuatorChoice { kind, shape, .. } = scenario.actuator;
        let diameter = row.get("diameter");
        let bias = self.bias_rad.or(row.get("bias").map(f64::to_radians));
        if !scenario.actuator.exists() {
            return Err(["the scenario has no actuator", "name one with [actuator], or none"]);
        }
        if kind.has_pouches() && diameter.or(bias).is_some() {
            return Err([
                "the table describes a tube of yarns, and the scenario's actuator is a pouch",
                "name a scenario with kind = \"fpam\", or none",
            ]);
        }
        let bias_rad = bias.unwrap_or(shape.bias_rad);
        let width_m = diameter.map_or(shape.width_m, |d| FRAC_PI_2 * d);
        // What pulls nothing may have any size.
        let width_m = if width_m.is_nan() && is_free(row) { ANY_WIDTH_M } else { width_m };
        if bias_rad.is_nan() || width_m.is_nan() {
            let help = "add bias_deg and diameter_mm, name a scenario before the table, or add --calibrate";
            return Err(["a muscle needs its size and its yarns' angle", help]);
        }
        let told = row.get("length").unwrap_or(shape.length_m);
        let length_m = if told.is_nan() { LONG * width_m } else { told };
        let shape = ActuatorShape { length_m, width_m, bias_rad, ..shape };
        let actuator = ActuatorChoice { shape, count: 1, start_m: 0.0, ..scenario.actuator };
        Ok(Scenario { length_m, actuator, zones: Vec::new(), ..scenario.clone() })
    }

    fn specimen_of(&self, bench: &Bench, row: &BenchRow) -> Result<Scenario, CompareError> {
        self.specimen(row).or_else(|[problem, help]| refuse(bench, problem, help))
    }

    /// E t that gives a beam the deflection of a row; it falls with E t. Whether there is one, in words too.
    fn calibrate_wall(&mut self, row: &BenchRow, beam: &Scenario) -> (bool, String) {
        let off = |e: f64| {
            let mut beam = beam.clone();
            beam.wall.stiffness_n_per_m = Some(e);
            deflection_m(&beam, row.value("load")).map_or(f64::INFINITY, |v| v - row.value("deflection"))
        };
        let at = format!("{:.0} kPa, {:.0} mm", 1e-3 * beam.p_body_pa, 1e3 * beam.radius_m);
        self.scenario.wall.stiffness_n_per_m = met([1e3, 1e8], off);
        match self.scenario.wall.stiffness_n_per_m {
            Some(e) => (true, format!("{at}: E t = {} kN/m, calibrated on the first load", wording::value(1e-3 * e))),
            None => (false, format!("{at}: no E t between 1 kN/m and 100 MN/m gives the first load's deflection")),
        }
    }

    /// Angle at rest of the yarns with which the model shortens so far without load; contraction falls with it.
    fn calibrate_angle(&mut self, row: &BenchRow) -> (bool, String) {
        let off = |bias_rad: f64| {
            let specimen = Trial { bias_rad: Some(bias_rad), ..self.clone() }.specimen(row);
            let model = specimen.ok().and_then(|specimen| modelled(row, &specimen));
            model.map_or(f64::NAN, |model| model - row.value("contraction"))
        };
        self.bias_rad = met(YARNS_DEG.map(f64::to_radians), off);
        match self.bias_rad {
            Some(rad) => (true, format!("yarns at {:.1}°, calibrated on the largest contraction", rad.to_degrees())),
            None => {
                (false, format!("no yarns from {}° to {}° give the largest contraction", YARNS_DEG[0], YARNS_DEG[1]))
            }
        }
    }
}

/// Angles of yarns between which a muscle shortens.
const YARNS_DEG: [f64; 2] = [15.0, 54.7];

/// Where what falls between two places passes 0, by halves of the ratio.
fn met([mut low, mut high]: [f64; 2], off: impl Fn(f64) -> f64) -> Option<f64> {
    if !(off(low) > 0.0 && off(high) < 0.0) {
        return None;
    }
    for _ in 0..50 {
        let middle = (low * high).sqrt();
        *(if off(middle) > 0.0 { &mut low } else { &mut high }) = middle;
    }
    Some((low * high).sqrt())
}

/// The row on which the number of a specimen is calibrated: the least load of a beam, the largest contraction of a free muscle.
fn calibrated_on(group: &[BenchRow]) -> Option<&BenchRow> {
    let loaded = group.iter().filter(|r| r.get("load").is_some_and(|load| load > 0.0) && r.value("deflection") > 0.0);
    match group[0].get("load") {
        Some(_) => least(loaded, |row| row.value("load")),
        None => largest(group, |row| row.value("contraction")).filter(|row| is_free(row) && row.get("bias").is_none()),
    }
}

/// Flat width of a free muscle of unknown size \[m\].
pub(crate) const ANY_WIDTH_M: f64 = 0.02;
const LONG: f64 = 1e6;

/// Why a calibration changed nothing.
const NOTHING_FREE: &str =
    "nothing to calibrate: a beam needs a row with load and deflection, a muscle one with force 0 and no bias_deg";

/// What a beam without a fabric is compared as.
const NO_WALL: &str = "the scenario has no wall_stiffness_n_per_m, so the wall does not stretch and deflections are the least possible; \
                       --calibrate takes E t from the first load of each beam";

/// The scenario for a table without one: for a muscle the ideal braid on plugs, whose size and angle the table must give.
///
/// # Errors
/// A beam without a scenario.
pub(crate) fn own_or_braid(bench: &Bench, scenario: Option<&Scenario>) -> Result<Scenario, CompareError> {
    if let Some(scenario) = scenario {
        return Ok(scenario.clone());
    }
    let braid = models::shipped("fpam-textbook").and_then(|text| Scenario::parse(text).ok());
    let Some(mut braid) = braid.filter(|_| bench.kind.name == "force_contraction") else {
        return refuse(bench, "a beam needs a scenario", "put scenario.toml next to the table, or name one before it");
    };
    let shape = &mut braid.actuator.shape;
    (shape.width_m, shape.length_m, shape.bias_rad) = (f64::NAN, f64::NAN, f64::NAN);
    Ok(Scenario { name: "ideal braid on plugs".into(), ..braid.bare().with_effect("end_fittings", &[1.0]) })
}

/// A row in words: size, pressure, load.
pub(crate) fn place(row: &BenchRow, specimen: &Scenario) -> String {
    if let Some(load) = row.get("load") {
        return format!("{:.0} mm, {:.0} kPa, {load:.2} N", 1e3 * specimen.radius_m, 1e-3 * specimen.p_body_pa);
    }
    let told = |key, word| row.get(key).map_or(String::new(), |v| format!("{:.0} mm {word}, ", 1e3 * v));
    let muscle = row.get("muscle").map_or(String::new(), |n| format!("muscle {n}, "));
    let at = match is_free(row) {
        true => "free: contraction %".into(),
        false => format!("{:.1} %: force N", 100.0 * row.value("contraction")),
    };
    format!("{muscle}{}{}{:.0} kPa, {at}", told("diameter", "thick"), told("length", "long"), 1e-3 * row.value("p_act"))
}

/// Tip deflection from where the tip is without the force, under a force across it; none beyond collapse.
fn deflection_m(beam: &Scenario, force_n: f64) -> Option<f64> {
    let known = beam.effects.iter().find(|e| e.name == "tip_load").map_or([0.0; 2], |e| [e.values[0], e.values[1]]);
    let tip = |force_n: f64| {
        let model = Model::new(&beam.with_effect("tip_load", &[known[0], known[1] - force_n]));
        let mut out = model.prediction();
        model.predict(&Loads::uniform(beam.p_body_pa, 0.0), &mut out).ok()?;
        (out.tip.x_m > 0.0).then_some(out.tip.y_m)
    };
    let at_rest = if beam.effects.is_empty() { 0.0 } else { tip(0.0)? };
    Some(at_rest - tip(force_n)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(name: &str) -> (Bench, Option<Scenario>) {
        let bench = data::bench::bench(name).unwrap().unwrap();
        let scenario = bench.scenario.as_ref().map(|(_, text)| Scenario::parse(text).unwrap());
        (bench, scenario)
    }

    #[test]
    fn a_beam_fitted_to_its_first_load_meets_it_and_no_other_row_is_fitted() {
        let (bench, scenario) = set("breukels-2011-beams");
        let held = held(&bench, scenario.as_ref(), true).unwrap();
        let fitted: Vec<_> = held.rows.iter().filter(|r| r.fitted).collect();
        assert_eq!((fitted.len(), held.rows.len()), (6, 36));
        assert!(fitted.iter().all(|r| r.off().unwrap().abs() < 1e-6), "{fitted:?}");
    }

    /// With a model that is not an ideal braid too: the closed form of the braid's angle does not meet it.
    #[test]
    fn a_muscle_fitted_to_its_largest_contraction_meets_it() {
        let (bench, _) = set("mckibben-free");
        let textbook = Scenario::parse(models::shipped("fpam-textbook").unwrap()).unwrap();
        let flat_ended = Scenario { p_max_pa: 1e6, ..textbook.with_effect("flat_ends", &[2.0]) };
        for scenario in [None, Some(&flat_ended)] {
            let held = held(&bench, scenario, true).unwrap();
            let fitted: Vec<_> = held.rows.iter().filter(|r| r.fitted).collect();
            assert_eq!(fitted.len(), 3, "{:?}", held.notes);
            assert!(fitted.iter().all(|r| r.off().unwrap().abs() < 1e-6), "{fitted:?}");
        }
    }

    /// Written from the ideal braid, a table gets nothing but agreement; a hundredth of the force beyond its scatter does not.
    #[test]
    fn a_mean_with_its_scatter_gets_a_verdict() {
        let force = |p: f64, e: f64| {
            let (sin, tan) = (25_f64.to_radians().sin(), 25_f64.to_radians().tan());
            std::f64::consts::PI * 5e-3_f64.powi(2) * p * (3.0 / tan.powi(2) * (1.0 - e).powi(2) - 1.0 / sin.powi(2))
        };
        let row = |factor: f64| format!("620,5,{},0.5,5\n", factor * force(620e3, 0.05));
        let head = "# bias_deg: 25\n# diameter_mm: 10\np_act_kpa,contraction_pct,force_n,force_sd_n,n\n";
        let text = format!("{head}{}{}", row(1.0), row(1.01));
        let held = held(&data::parse_bench("a.csv", &text).unwrap().unwrap(), None, false).unwrap();
        assert_eq!(held.rows[0].verdict(), "agrees");
        assert!(held.rows[1].verdict().starts_with("off by"), "{:?}", held.rows[1]);
        // t of 4 is 2.776, s/√n = 0.2236 N.
        assert!((held.rows[0].half.unwrap() - 0.6208).abs() < 1e-3);
    }

    #[test]
    fn a_muscle_without_size_or_angle_is_refused_with_what_to_add() {
        let (bench, _) = set("mckibben-free");
        let error = held(&bench, None, false).unwrap_err().to_string();
        assert!(error.contains("--calibrate") && error.contains("bias_deg"), "{error}");
        assert_eq!(held(&bench, None, true).unwrap().rows.iter().filter(|r| r.fitted).count(), 3);
        let fpam = Scenario::parse(models::shipped("fpam-textbook").unwrap()).unwrap();
        let free = held(&bench, Some(&fpam), false).unwrap().rows[0].model.unwrap();
        assert!((free - 100.0 * (1.0 - (2.0_f64 / 3.0).sqrt())).abs() < 1e-6, "{free}");
    }
}
