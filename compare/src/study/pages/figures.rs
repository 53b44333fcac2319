//! Results → plots.

use super::compare_page::{Study, Variant};
use super::drawing;
use crate::error::CompareError;
use crate::evaluate::Evaluation;
use crate::plots::{self, Drawn, Known};
use crate::study::published::PublishedLadder;
use data::{Dataset, Phase};
use models::{Loads, Model, Scenario};

const MM: f64 = 1e3;
/// Points of a drawn centre line.
const LINE_POINTS: usize = 80;
/// Residuals are drawn to this many times the noise; more is more of the same colour.
const MAP_LIMIT: f64 = 10.0;

/// Hold mean over samples and runs of one marker \[m\], and its standard deviation over runs.
pub(super) fn measured(dataset: &Dataset, hold: usize, marker: usize) -> ([f64; 2], [f64; 2]) {
    let run_means: Vec<[f64; 2]> = (0..dataset.runs.len())
        .map(|run| {
            let samples = dataset.samples_per_hold;
            let sum = (0..samples)
                .map(|s| dataset.xy(run, hold, s, marker))
                .fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
            sum.map(|v| v / samples as f64)
        })
        .collect();
    let n = run_means.len() as f64;
    let mean = [0, 1].map(|k| run_means.iter().map(|m| m[k]).sum::<f64>() / n);
    let spread = [0, 1].map(|k| {
        let sum: f64 = run_means.iter().map(|m| (m[k] - mean[k]).powi(2)).sum();
        if n > 1.0 { (sum / (n - 1.0)).sqrt() } else { 0.0 }
    });
    (mean, spread)
}

/// Pressurised holds reached by loading, at most six, without repeats of a pressure.
fn shown_holds(dataset: &Dataset) -> Vec<usize> {
    let mut shown: Vec<usize> = Vec::new();
    for (h, hold) in dataset.holds.iter().enumerate() {
        let new = shown.iter().all(|s| dataset.holds[*s].p_act_pa != hold.p_act_pa);
        if hold.phase != Phase::Unload && hold.p_act_pa > 0.0 && new && shown.len() < 6 {
            shown.push(h);
        }
    }
    shown
}

/// Centre lines and markers, predicted and measured.
pub(super) fn shapes(title: &str, scenario: &Scenario, dataset: &Dataset) -> Result<Drawn, CompareError> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    let mut poses = Vec::new();
    for h in shown_holds(dataset) {
        let hold = &dataset.holds[h];
        model.predict(&Loads::uniform(hold.p_body_pa, hold.p_act_pa), &mut state)?;
        let measured = (0..dataset.markers.len()).map(|m| {
            let (mean, spread) = measured(dataset, h, m);
            plots::MeasuredPoint { at_mm: mean.map(|v| v * MM), half_width_mm: spread.map(|v| v * MM) }
        });
        poses.push(plots::ShapePose {
            label: format!("{:.0} kPa", hold.p_act_pa / 1e3),
            curve_mm: mm(&model.centre_line(&state, LINE_POINTS)),
            predicted_mm: mm(&state.markers),
            measured: measured.collect(),
        });
    }
    let rest_mm = vec![[0.0, 0.0], [scenario.length_m * MM, 0.0]];
    let shapes = plots::Shapes { title: title.into(), rest_mm, body_radius_mm: scenario.radius_m * MM, poses };
    plots::shapes(&shapes).map_err(|e| drawing("the shapes", e))
}

fn mm(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|p| p.map(|v| v * MM)).collect()
}

/// Signed y residuals marker × hold in units of noise (in mm when the noise is unknown).
pub(super) fn residual_map(title: &str, evaluation: &Evaluation, dataset: &Dataset) -> Result<Drawn, CompareError> {
    map(title, &evaluation.residual_map, dataset)
}

/// The same for residuals at hand.
pub(super) fn map(title: &str, map: &crate::residuals::ResidualMap, dataset: &Dataset) -> Result<Drawn, CompareError> {
    let in_noise = map.cells.iter().flatten().all(|c| c.y.in_noise.is_some());
    let value =
        |cell: &crate::residuals::ResidualCell| if in_noise { cell.y.in_noise.unwrap_or(f64::NAN) } else { cell.y.mm };
    let data = plots::ResidualMap {
        title: title.into(),
        value_label: if in_noise { "model − measured, y [times the noise]" } else { "model − measured, y [mm]" }.into(),
        holds: map
            .holds
            .iter()
            .map(|h| plots::MapHold { p_act_kpa: h.p_act_kpa, phase: h.phase.to_string() })
            .collect(),
        stations_mm: dataset
            .markers
            .iter()
            .enumerate()
            .map(|(i, m)| m.station_m.map_or(i as f64 + 1.0, |s| s * MM))
            .collect(),
        values: map.cells.iter().map(|row| row.iter().map(value).collect()).collect(),
        limit: MAP_LIMIT,
    };
    plots::residual_map(&data).map_err(|e| drawing("the residual map", e))
}

/// Height of the outermost marker against actuator pressure: every model, and the measurement with both branches.
pub(super) fn pressure_curve(title: &str, study: &Study) -> Result<Drawn, CompareError> {
    let dataset = &study.dataset;
    let tip = dataset.markers.len() - 1;
    let branch = |unload: bool| -> (Vec<[f64; 2]>, Vec<f64>) {
        let holds = dataset.holds.iter().enumerate().filter(|(_, h)| (h.phase == Phase::Unload) == unload);
        holds
            .map(|(i, h)| {
                let (mean, spread) = measured(dataset, i, tip);
                ([h.p_act_pa / 1e3, mean[1] * MM], spread[1] * MM)
            })
            .unzip()
    };
    let mut series = Vec::new();
    for (name, unload) in [("measured, loading", false), ("measured, unloading", true)] {
        let (points, half_width) = branch(unload);
        if !points.is_empty() {
            series.push(plots::LineSeries {
                name: name.into(),
                points,
                half_width,
                style: plots::LineStyle::Points,
                colour: Some(usize::from(unload)),
            });
        }
    }
    for (i, variant) in study.variants.iter().enumerate() {
        series.push(model_curve(&variant.label, &variant.scenario, dataset, i + 2)?);
    }
    let lines = plots::Lines {
        title: title.into(),
        x_label: "actuator pressure [kPa]".into(),
        y_label: "height of the outermost marker [mm]".into(),
        series,
    };
    plots::lines(&lines).map_err(|e| drawing("the pressure curve", e))
}

fn model_curve(
    name: &str,
    scenario: &Scenario,
    dataset: &Dataset,
    colour: usize,
) -> Result<plots::LineSeries, CompareError> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    let top = dataset.holds.iter().map(|h| h.p_act_pa).fold(0.0, f64::max);
    let p_body = dataset.holds.first().map_or(scenario.p_body_pa, |h| h.p_body_pa);
    let mut points = Vec::new();
    for i in 0..=60 {
        let p = top * (f64::from(i) / 60.0).powi(2);
        model.predict(&Loads::uniform(p_body, p), &mut state)?;
        points.push([p / 1e3, state.markers.last().map_or(f64::NAN, |xy| xy[1] * MM)]);
    }
    Ok(plots::LineSeries {
        name: name.into(),
        points,
        half_width: vec![],
        style: plots::LineStyle::Line,
        colour: Some(colour),
    })
}

/// Predicted against published displacement, rung by rung.
pub(super) fn published_ladder(ladder: &PublishedLadder) -> Result<Drawn, CompareError> {
    let step = |rung: &crate::study::published::Rung| plots::LadderStep {
        label: rung.label.clone(),
        value: rung.y_m * MM,
        range: rung.range_m.map(|r| r.map(|v| v * MM)),
        known: rung.known,
    };
    let data = plots::Ladder {
        title: format!("{}: displacement at 30 kPa", ladder.published.printed_name),
        value_label: "displacement of the outermost marker [mm]".into(),
        steps: ladder.rungs.iter().map(step).collect(),
        target: Some(plots::LadderTarget {
            label: "measured (published)".into(),
            value: ladder.published.d_max_m * MM,
            half_width: 0.0,
        }),
    };
    plots::ladder(&data).map_err(|e| drawing("the ladder", e))
}

/// Error beyond noise, rung by rung, with the noise floor.
pub(super) fn error_ladder(title: &str, variants: &[Variant]) -> Result<Drawn, CompareError> {
    let error =
        |v: &Variant| v.evaluation.metrics.overall.systematic_mm.unwrap_or(v.evaluation.metrics.overall.rmse_mm);
    let floor = variants.first().and_then(|v| v.evaluation.metrics.overall.noise_floor_mm);
    let steps = variants.iter().map(|v| plots::LadderStep {
        label: v.label.clone(),
        value: error(v),
        range: None,
        known: v.known,
    });
    let data = plots::Ladder {
        title: title.into(),
        value_label: "error beyond noise, all markers and holds [mm]".into(),
        steps: steps.collect(),
        target: floor.map(|value| plots::LadderTarget { label: "noise of the mean".into(), value, half_width: 0.0 }),
    };
    plots::ladder(&data).map_err(|e| drawing("the error ladder", e))
}

/// Where the actuator's work goes at the highest loading hold, per model.
pub(super) fn ledgers(title: &str, cases: &[(String, Scenario)], loads: &Loads) -> Result<Drawn, CompareError> {
    let mut terms: Vec<String> = Vec::new();
    let mut columns = Vec::new();
    for (label, scenario) in cases {
        let model = Model::new(scenario);
        let mut state = model.prediction();
        model.predict(loads, &mut state)?;
        let lines = model.ledger(loads, &state);
        for line in &lines {
            if line.energy_j != 0.0 && !terms.iter().any(|t| t == line.name) {
                terms.push(line.name.to_string());
            }
        }
        columns.push((label.clone(), lines));
    }
    let energies = |lines: &[models::LedgerLine]| {
        terms.iter().map(|t| lines.iter().find(|l| l.name == t).map_or(0.0, |l| l.energy_j * 1e3)).collect()
    };
    let cases =
        columns.iter().map(|(label, lines)| plots::LedgerCase { label: label.clone(), energies_mj: energies(lines) });
    let data = plots::Ledger {
        title: title.into(),
        value_label: "potential energy at equilibrium [mJ]".into(),
        cases: cases.collect(),
        terms: terms.clone(),
    };
    plots::ledger(&data).map_err(|e| drawing("the ledger", e))
}

/// Bare, last uncalibrated and published displacement of the four actuators.
pub(super) fn published_bars(ladders: &[PublishedLadder]) -> Result<Drawn, CompareError> {
    let last =
        |l: &PublishedLadder| l.rungs.iter().rfind(|r| r.known != Known::Calibrated).map_or(f64::NAN, |r| r.y_m * MM);
    let series = |name: &str, values: Vec<f64>, reference| plots::BarSeries {
        name: name.into(),
        values,
        half_width: vec![],
        reference,
    };
    let data = plots::Bars {
        title: "Displacement at 30 kPa: models and measurement".into(),
        value_label: "displacement of the outermost marker [mm]".into(),
        groups: ladders.iter().map(|l| l.published.printed_name.clone()).collect(),
        series: vec![
            series("bare model", ladders.iter().map(|l| l.rungs[0].y_m * MM).collect(), false),
            series("with effects, nothing fitted", ladders.iter().map(last).collect(), false),
            series("measured (published)", ladders.iter().map(|l| l.published.d_max_m * MM).collect(), true),
        ],
        target: None,
    };
    plots::bars(&data).map_err(|e| drawing("the displacements", e))
}

/// Run time against error.
pub fn tradeoff(timings: &[crate::study::Timing]) -> Result<Drawn, CompareError> {
    let shown: Vec<_> =
        timings.iter().filter(|t| t.engine != "reduced" || t.known != Known::Calibrated.word()).collect();
    let point = |(k, t): (usize, &&crate::study::Timing)| {
        // The rungs of a ladder lie close together: the first and the last are named.
        let alike = |other: Option<&&crate::study::Timing>| {
            other.is_some_and(|o| o.engine == "reduced" && o.actuator == t.actuator)
        };
        let between = t.engine == "reduced" && k > 0 && alike(shown.get(k - 1)) && alike(shown.get(k + 1));
        plots::TradeoffPoint {
            label: if between { String::new() } else { t.model.clone() },
            group: t.actuator.clone(),
            run_time_s: t.prediction_us * 1e-6,
            error: t.error_pct.abs(),
        }
    };
    let data = plots::Tradeoff {
        title: "Run time against error".into(),
        error_label: "error of the published displacement [%]".into(),
        points: shown.iter().enumerate().map(point).collect(),
    };
    plots::tradeoff(&data).map_err(|e| drawing("the trade-off", e))
}
