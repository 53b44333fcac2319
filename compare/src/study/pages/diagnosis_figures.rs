//! A diagnosis → plots.

use super::drawing;
use super::figures::measured;
use crate::diagnosis::{Diagnosis, Ranked, Verdict};
use crate::error::CompareError;
use crate::plots::{self, Drawn, LineSeries, LineStyle, RankClass};
use crate::study::engines::TERMS;
use crate::study::predict::predict_dataset;
use crate::study::witness::Witness;
use data::{Dataset, Phase};
use models::{Loads, Model, Scenario};

const MM: f64 = 1e3;
/// Points of a curve over pressure.
const POINTS: u32 = 48;
/// Curves go this much beyond the highest measured pressure, where candidates part.
const BEYOND: f64 = 1.3;
/// Candidates drawn as curves.
const MOST_CURVES: usize = 5;
/// Ledgers drawn beside that of finite elements: the base and the nearest.
const MOST_LEDGERS: usize = 4;
/// Candidates drawn where the set has a single member, so that there is something to compare with.
const FEWEST_CURVES: usize = 3;

/// Errors of one model on the way from bare to extended \[mm\].
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorRung {
    /// In words.
    pub label: String,
    /// On the data of the fit.
    pub training_mm: f64,
    /// At pressures left out of the fit.
    pub heldout_pressure_mm: Option<f64>,
    /// For runs left out of the fit.
    pub heldout_run_mm: Option<f64>,
}

/// As given, calibrated, and with what the verdict adds.
pub(super) fn rungs_of(d: &Diagnosis) -> Vec<ErrorRung> {
    let base = &d.base;
    let rung = |label: String, training_mm, heldout_pressure_mm, heldout_run_mm| ErrorRung {
        label,
        training_mm,
        heldout_pressure_mm,
        heldout_run_mm,
    };
    let mut rungs = vec![rung("scenario as given".into(), base.systematic_nominal_mm, None, None)];
    let calibrated = if base.bending.is_empty() { "B as given" } else { "B calibrated" };
    rungs.push(rung(calibrated.into(), base.systematic_mm, base.heldout_mm, base.heldout_run_mm));
    if !d.added.is_empty() {
        let names: Vec<String> = d.added.iter().map(|a| format!("+ {}", a.effect)).collect();
        rungs.push(rung(
            format!("{} (calibrated)", names.join(" ")),
            base.systematic_with_added_mm,
            base.heldout_with_added_mm,
            base.heldout_run_with_added_mm,
        ));
    }
    rungs
}

/// Error of every model, training and left-out data, with the noise of the mean.
pub(super) fn waterfall(title: &str, rungs: &[ErrorRung], floor_mm: Option<f64>) -> Result<Drawn, CompareError> {
    let series = |name: &str, of: fn(&ErrorRung) -> f64| plots::BarSeries {
        name: name.into(),
        values: rungs.iter().map(of).collect(),
        half_width: Vec::new(),
        reference: false,
    };
    let data = plots::Bars {
        title: title.into(),
        value_label: "error beyond noise [mm]".into(),
        groups: rungs.iter().map(|r| r.label.clone()).collect(),
        series: vec![
            series("data of the fit", |r| r.training_mm),
            series("pressures left out", |r| r.heldout_pressure_mm.unwrap_or(f64::NAN)),
            series("runs left out", |r| r.heldout_run_mm.unwrap_or(f64::NAN)),
        ],
        target: floor_mm.map(|value| plots::LadderTarget { label: "noise of the mean".into(), value, half_width: 0.0 }),
    };
    plots::bars(&data).map_err(|e| drawing("the waterfall", e))
}

/// Gain of every candidate over that of the best one.
pub(super) fn ranking(d: &Diagnosis) -> Result<Option<Drawn>, CompareError> {
    let class = |r: &Ranked| match (r.at_bound, r.in_set && d.verdict != Some(Verdict::None)) {
        (true, _) => RankClass::Rejected,
        (_, true) => RankClass::Alike,
        _ => RankClass::Worse,
    };
    let best = d.ranked.iter().filter(|r| !r.at_bound).map(|r| r.gain).fold(0.0, f64::max);
    if best <= 0.0 {
        return Ok(None);
    }
    let row = |r: &Ranked| plots::RankingRow { label: r.effect.clone(), value: 100.0 * r.gain / best, class: class(r) };
    let data = plots::Ranking {
        title: "Misfit that one effect takes away".into(),
        value_label: "gain, in % of the best".into(),
        rows: d.ranked.iter().map(row).collect(),
    };
    plots::ranking(&data).map(Some).map_err(|e| drawing("the ranking", e))
}

/// Which fitted B belongs to the first hold.
pub(super) fn first_level(d: &Diagnosis, dataset: &Dataset) -> usize {
    d.level(dataset.holds.first().map_or(0.0, |h| h.p_body_pa * 1e-3))
}

/// Candidates worth a curve.
pub(super) fn shown(d: &Diagnosis) -> Vec<&Ranked> {
    let kept: Vec<&Ranked> = d.ranked.iter().filter(|r| !r.at_bound && r.gain > 1.0).collect();
    let alike = kept.iter().filter(|r| r.in_set).count();
    kept.into_iter().take(alike.clamp(FEWEST_CURVES, MOST_CURVES)).collect()
}

/// What the candidates predict over pressure, as the difference from the calibrated base: height of the outermost marker
/// on first loading.
pub(super) fn candidate_curves(
    d: &Diagnosis,
    scenario: &Scenario,
    dataset: &Dataset,
) -> Result<Option<Drawn>, CompareError> {
    let level = first_level(d, dataset);
    let Some(first) = dataset.holds.first() else { return Ok(None) };
    let top_pa = BEYOND * dataset.holds.iter().map(|h| h.p_act_pa).fold(0.0, f64::max);
    let candidates = shown(d);
    if candidates.is_empty() || top_pa <= 0.0 {
        return Ok(None);
    }
    let heights = |scenario: &Scenario| -> Vec<f64> {
        let model = Model::new(scenario);
        let mut state = model.prediction();
        let mut height = |i: u32| {
            let p = top_pa * (f64::from(i) / f64::from(POINTS)).powi(2);
            let found = model.predict(&Loads::uniform(first.p_body_pa, p), &mut state);
            found.ok().and_then(|()| state.markers.last().map(|m| m[1] * MM)).unwrap_or(f64::NAN)
        };
        (0..=POINTS).map(&mut height).collect()
    };
    let base = d.calibrated(scenario, level);
    let zero = heights(&base);
    let mut series = vec![deviations(&base, dataset)?];
    for (i, r) in candidates.iter().enumerate() {
        let own = heights(&r.on(scenario, level));
        let point = |k: usize| [1e-3 * top_pa * (k as f64 / f64::from(POINTS)).powi(2), own[k] - zero[k]];
        series.push(LineSeries {
            name: format!("+ {}", r.effect),
            points: (0..own.len()).map(point).collect(),
            half_width: Vec::new(),
            style: if r.in_set { LineStyle::Line } else { LineStyle::Dashed },
            colour: Some(i),
        });
    }
    let data = plots::Lines {
        title: "What the candidates predict differently".into(),
        x_label: "actuator pressure [kPa]".into(),
        y_label: "tip marker, above the base [mm]".into(),
        series,
    };
    plots::lines(&data).map(Some).map_err(|e| drawing("the candidates' curves", e))
}

/// Ledgers of base, the nearest candidates and finite elements at the same bends.
pub(super) fn witness_ledger(w: &Witness) -> Result<Drawn, CompareError> {
    let case = |name: &str, e: &[f64; 6]| plots::LedgerCase {
        label: name.trim_start_matches("+ ").into(),
        energies_mj: e.to_vec(),
    };
    let mut cases: Vec<_> = w.models.iter().take(MOST_LEDGERS).map(|m| case(&m.name, &m.energies_mj)).collect();
    cases.extend(w.fe_mj.iter().map(|fe| case("finite elements", fe)));
    let data = plots::Ledger {
        title: format!("Where the energy goes, to {:.0} kPa", w.actuator_kpa),
        value_label: "energy taken up since the first bend [mJ]".into(),
        terms: TERMS.map(String::from).to_vec(),
        cases,
    };
    plots::ledger(&data).map_err(|e| drawing("the ledger beside finite elements", e))
}

/// Measured minus calibrated base at the loading holds of the first body pressure.
fn deviations(base: &Scenario, dataset: &Dataset) -> Result<LineSeries, CompareError> {
    let predicted = predict_dataset(base, dataset)?.xy_m;
    let tip = dataset.markers.len() - 1;
    let body = dataset.holds[0].p_body_pa;
    let (mut points, mut half_width) = (Vec::new(), Vec::new());
    for (h, hold) in dataset.holds.iter().enumerate() {
        if hold.phase == Phase::Unload || (hold.p_body_pa - body).abs() > 0.05 * body {
            continue;
        }
        let (mean, spread) = measured(dataset, h, tip);
        let model: f64 = (0..dataset.samples_per_hold).map(|s| predicted[dataset.offset(h, s, tip) + 1]).sum();
        points.push([hold.p_act_pa * 1e-3, MM * (mean[1] - model / dataset.samples_per_hold as f64)]);
        half_width.push(spread[1] * MM / (dataset.runs.len() as f64).sqrt());
    }
    let name = "measured (± standard error)".into();
    Ok(LineSeries { name, points, half_width, style: LineStyle::Points, colour: Some(5) })
}
