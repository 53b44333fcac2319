//! Bench tests held against a model: a beam under a load, a muscle in a testing machine.
//!
//! The model of a beam is that of a scenario: `[body]`, loaded at its tip. The model of a muscle is the ideal braid (Chou and
//! Hannaford 1996) where the table tells its diameter and its yarns' angle, else the stroke law of the scenario's actuator.
//! A mean with its standard deviation and n gets a verdict: is the model within the 95 % interval of the mean?

use data::Bench;
use data::bench::Row;
use models::exact::mckibben::{max_contraction, rest_angle_from_max_contraction, tondu_lopez_force_n};
use models::{Loads, Model, Scenario};

use crate::CompareError;
use crate::plots::Known;
use crate::stats::t_975;

/// A table beside its model.
#[derive(Debug, Clone, PartialEq)]
pub struct Held {
    /// What was held against what.
    pub title: String,
    /// Name of the measured quantity, with its unit.
    pub quantity: String,
    /// How the model's numbers are known.
    pub known: Known,
    /// Rows in the table's order.
    pub rows: Vec<HeldRow>,
    /// What else to know.
    pub notes: Vec<String>,
}

/// One measured number beside the model's.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldRow {
    /// At which pressure, size and load.
    pub at: String,
    /// As measured, in the unit of the title.
    pub measured: f64,
    /// By the model; none where it finds no equilibrium.
    pub model: Option<f64>,
    /// Half-width of the 95 % interval of the mean, t s/√n, where scatter and number are known.
    pub half: Option<f64>,
    /// Whether the model was fitted to this row.
    pub fitted: bool,
}

impl HeldRow {
    /// Model over measurement, less one.
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

impl Held {
    /// Root mean square of the shares by which the model is off, of rows it was not fitted to.
    pub fn rms(&self) -> Option<f64> {
        let all: Vec<f64> = self.rows.iter().filter(|r| !r.fitted).filter_map(HeldRow::off).collect();
        (!all.is_empty()).then(|| (all.iter().map(|o| o * o).sum::<f64>() / all.len() as f64).sqrt())
    }
}

/// Makes a model of a table and holds them together.
type Compare = fn(&Bench, Option<&Scenario>, bool) -> Result<Held, CompareError>;

/// The list: kind of table and what it is held against.
const COMPARISONS: &[(&str, Compare)] = &[("load_deflection", beams), ("force_contraction", muscles)];

/// Holds a table against a model; `calibrate` fits the one number that is usually not known (E t of a beam, the braid angle of
/// a muscle) to one row, which is then marked.
///
/// # Errors
/// A kind without a model, or a scenario that is missing.
pub fn held(bench: &Bench, scenario: Option<&Scenario>, calibrate: bool) -> Result<Held, CompareError> {
    match COMPARISONS.iter().find(|(kind, _)| *kind == bench.kind.name) {
        Some((_, compare)) => compare(bench, scenario, calibrate),
        None => refuse(bench, "no model is held against it", "ibr characterize reads it"),
    }
}

fn refuse<T>(bench: &Bench, problem: &str, help: &str) -> Result<T, CompareError> {
    Err(CompareError::Bench { file: bench.file.clone(), problem: problem.into(), help: help.into() })
}

fn half(row: &Row, sd: &str, unit: f64) -> Option<f64> {
    let (sd, n) = (row.get(sd)?, row.get("n")?);
    Some(unit * t_975(n as usize - 1) * sd / n.sqrt())
}

fn beams(bench: &Bench, scenario: Option<&Scenario>, calibrate: bool) -> Result<Held, CompareError> {
    let Some(scenario) = scenario else {
        return refuse(bench, "a beam needs a scenario", "put scenario.toml beside the table, or name one before it");
    };
    let mut rows = Vec::new();
    let mut notes = Vec::new();
    let same = |a: &Row, b: &Row| a.get("p_body") == b.get("p_body") && a.get("radius") == b.get("radius");
    for group in bench.rows.chunk_by(same) {
        let mut beam = Scenario { p_body_pa: group[0].value("p_body"), ..scenario.clone() };
        beam.radius_m = group[0].get("radius").unwrap_or(beam.radius_m);
        let loaded = group.iter().filter(|r| r.value("load") > 0.0 && r.value("deflection") > 0.0);
        let first = loaded.min_by(|a, b| a.value("load").total_cmp(&b.value("load"))).filter(|_| calibrate);
        if let Some(row) = first {
            let wall = wall_n_per_m(&beam, row.value("load"), row.value("deflection"));
            beam.wall.stiffness_n_per_m = wall;
            let at = format!("{:.0} kPa, {:.0} mm", 1e-3 * beam.p_body_pa, 1e3 * beam.radius_m);
            notes.push(match wall {
                Some(e) => format!("{at}: E t = {:.0} kN/m, calibrated on the first load", 1e-3 * e),
                None => format!("{at}: no E t between 1 kN/m and 100 MN/m gives the first load's deflection"),
            });
        }
        rows.extend(group.iter().map(|row| HeldRow {
            at: format!("{:.0} mm, {:.0} kPa, {:.2} N", 1e3 * beam.radius_m, 1e-3 * beam.p_body_pa, row.value("load")),
            measured: 1e3 * row.value("deflection"),
            model: deflection_m(&beam, row.value("load")).map(|v| 1e3 * v),
            half: half(row, "deflection_sd", 1e3),
            fitted: first.is_some_and(|f| f.line == row.line),
        }));
    }
    let known = if calibrate { Known::Calibrated } else { Known::Predicted };
    let title = format!("Inflated beam, {} against {}", scenario.name, bench.file);
    Ok(Held { title, quantity: "deflection mm".into(), known, rows, notes })
}

/// Tip deflection under a force across the tip; none beyond collapse.
fn deflection_m(beam: &Scenario, force_n: f64) -> Option<f64> {
    let model = Model::new(&beam.with_effect("tip_load", &[0.0, -force_n]));
    let mut out = model.prediction();
    model.predict(&Loads::uniform(beam.p_body_pa, 0.0), &mut out).ok()?;
    (out.tip.x_m > 0.0).then_some(-out.tip.y_m)
}

/// E t that gives a deflection under a load \[N/m\]; it falls with E t.
fn wall_n_per_m(beam: &Scenario, force_n: f64, wanted_m: f64) -> Option<f64> {
    let off = |e: f64| {
        let mut beam = beam.clone();
        beam.wall.stiffness_n_per_m = Some(e);
        deflection_m(&beam, force_n).map_or(f64::INFINITY, |v| v - wanted_m)
    };
    let (mut soft, mut stiff) = (1e3_f64, 1e8_f64);
    if !(off(soft) > 0.0 && off(stiff) < 0.0) {
        return None;
    }
    for _ in 0..50 {
        let middle = (soft * stiff).sqrt();
        *(if off(middle) > 0.0 { &mut soft } else { &mut stiff }) = middle;
    }
    Some((soft * stiff).sqrt())
}

fn muscles(bench: &Bench, scenario: Option<&Scenario>, calibrate: bool) -> Result<Held, CompareError> {
    let mut rows = Vec::new();
    let mut notes = Vec::new();
    for group in bench.rows.chunk_by(|a, b| a.get("muscle") == b.get("muscle")) {
        let most = group.iter().max_by(|a, b| a.value("contraction").total_cmp(&b.value("contraction")));
        let fitted = most.filter(|row| calibrate && row.value("force") == 0.0 && row.get("bias").is_none());
        let bias = fitted.map(|row| rest_angle_from_max_contraction(row.value("contraction")));
        notes.extend(bias.map(|b| format!("yarns at {:.1}°, calibrated on the largest contraction", b.to_degrees())));
        for row in group {
            let bias = row.get("bias").map(f64::to_radians).or(bias);
            let Some(model) = muscle(row, bias, scenario) else {
                let help = "add bias_deg and diameter_mm, name a scenario before the table, or add --calibrate";
                return refuse(bench, "a muscle needs its size and its yarns' angle", help);
            };
            let told = |key, word| row.get(key).map_or(String::new(), |v| format!("{:.0} mm {word}, ", 1e3 * v));
            let size = told("diameter", "thick") + &told("length", "long");
            let p = 1e-3 * row.value("p_act");
            let fitted = fitted.is_some_and(|f| f.line == row.line);
            rows.push(if row.value("force") == 0.0 {
                let at = format!("{size}{p:.0} kPa, free: contraction %");
                HeldRow {
                    at,
                    measured: 100.0 * row.value("contraction"),
                    model: Some(100.0 * model),
                    half: None,
                    fitted,
                }
            } else {
                let at = format!("{size}{p:.0} kPa, {:.1} %: force N", 100.0 * row.value("contraction"));
                let half = half(row, "force_sd", 1.0);
                HeldRow { at, measured: row.value("force"), model: Some(model), half, fitted }
            });
        }
    }
    let law = scenario.map_or("ideal braid", |s| s.name.as_str());
    let known = if notes.is_empty() { Known::Assumed } else { Known::Calibrated };
    let title = format!("Muscle, {law} against {}", bench.file);
    Ok(Held { title, quantity: "value".into(), known, rows, notes })
}

/// Force \[N\] at a contraction, or the free contraction where the force is 0.
fn muscle(row: &Row, bias: Option<f64>, scenario: Option<&Scenario>) -> Option<f64> {
    let free = row.value("force") == 0.0;
    match (bias, row.get("diameter"), scenario) {
        (Some(bias), _, _) if free => Some(max_contraction(bias)),
        (Some(bias), Some(d), _) => {
            Some(tondu_lopez_force_n(0.5 * d, bias, row.value("contraction"), row.value("p_act"), 1.0))
        }
        (_, _, Some(scenario)) => stroke(scenario, if free { None } else { Some(row) }),
        _ => None,
    }
}

/// Of the stroke law F = P dV/dε/L₀ alone: the force at a row's contraction, or the contraction without force.
fn stroke(scenario: &Scenario, row: Option<&Row>) -> Option<f64> {
    let choice = &scenario.actuator;
    let law = |a: f64| (choice.kind.stroke)(&choice.shape, a);
    let (mut low, mut high) = choice.kind.range;
    let beyond = |a: f64| match row {
        Some(row) => law(a).contraction > row.value("contraction"),
        None => law(a).d_volume < 0.0,
    };
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        *(if beyond(middle) { &mut high } else { &mut low }) = middle;
    }
    let at = law(0.5 * (low + high));
    Some(row.map_or(at.contraction, |row| row.value("p_act") * at.d_volume / at.d_contraction))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(name: &str) -> (Bench, Option<Scenario>) {
        let bench = data::bench::bench(name).unwrap().unwrap();
        let scenario = bench.scenario.as_deref().map(|text| Scenario::parse(text).unwrap());
        (bench, scenario)
    }

    #[test]
    fn a_beam_fitted_to_its_first_load_meets_it_and_no_other_row_is_fitted() {
        let (bench, scenario) = set("breukels-2011-beams");
        let held = held(&bench, scenario.as_ref(), true).unwrap();
        let fitted: Vec<_> = held.rows.iter().filter(|r| r.fitted).collect();
        assert_eq!((fitted.len(), held.rows.len()), (6, 36));
        assert!(fitted.iter().all(|r| r.off().unwrap().abs() < 1e-6), "{fitted:?}");
        held.rows.iter().for_each(|r| println!("{} {:.2} {:?} {:?}", r.at, r.measured, r.model, r.off()));
        println!("{:?} {:?}", held.rms(), held.notes);
    }

    /// Written from the ideal braid, a table gets nothing but agreement; a hundredth of the force beyond its scatter does not.
    #[test]
    fn a_mean_with_its_scatter_gets_a_verdict() {
        let force = |p: f64, e: f64| tondu_lopez_force_n(5e-3, 25_f64.to_radians(), e, p, 1.0);
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
        let fpam = Scenario::parse(models::shipped("fpam").unwrap()).unwrap();
        let free = held(&bench, Some(&fpam), false).unwrap().rows[0].model.unwrap();
        assert!((free - 100.0 * (1.0 - (2.0_f64 / 3.0).sqrt())).abs() < 1e-6, "{free}");
    }
}
