//! Results → plots.

use super::PageError;
use compare::known::Known;
use compare::study::published::PublishedLadder;
use compare::study::{Study, Variant};
use data::{Dataset, Phase};
use models::{Loads, Model, Scenario};
use report::{self as plots, Drawn};

const MM: f64 = 1e3;
/// Points of a drawn centre line.
const LINE_POINTS: usize = 80;
/// Terms of a ledger that colours tell apart.
const MOST_TERMS: usize = 8;
/// Markers on a centre line; of more, every few from the outermost one on.
const MOST_DRAWN: usize = 24;
/// Centre lines in one plot.
const MOST_POSES: usize = 6;
/// Body pressures are the same within this fraction.
const SAME_BODY: f64 = 0.05;

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

/// Body pressures of a protocol, in its order \[Pa\].
fn bodies(dataset: &Dataset) -> Vec<f64> {
    let mut bodies: Vec<f64> = Vec::new();
    for hold in &dataset.holds {
        if bodies.iter().all(|p| !same_body(*p, hold.p_body_pa)) {
            bodies.push(hold.p_body_pa);
        }
    }
    bodies
}

fn same_body(a_pa: f64, b_pa: f64) -> bool {
    (a_pa - b_pa).abs() <= SAME_BODY * a_pa.abs().max(b_pa.abs())
}

/// Whether a plot has to say which body pressure it means.
pub(super) fn several_bodies(dataset: &Dataset) -> bool {
    bodies(dataset).len() > 1
}

/// `, body 2 kPa`.
pub(super) fn body(p_body_pa: f64) -> String {
    format!(", body {} kPa", compare::wording::short(p_body_pa * 1e-3))
}

/// Pressurised holds reached by loading, without repeats; of more than six the highest pressures of every body pressure.
fn shown_holds(dataset: &Dataset) -> Vec<usize> {
    let bodies = bodies(dataset);
    let mut shown = Vec::new();
    for p_body in &bodies {
        let mut own: Vec<usize> = Vec::new();
        for (h, hold) in dataset.holds.iter().enumerate().filter(|(_, hold)| same_body(hold.p_body_pa, *p_body)) {
            let new = own.iter().all(|s| dataset.holds[*s].p_act_pa != hold.p_act_pa);
            if hold.phase != Phase::Unload && hold.p_act_pa > 0.0 && new {
                own.push(h);
            }
        }
        let most = if bodies.len() == 1 { MOST_POSES } else { (MOST_POSES / bodies.len()).max(1) };
        if bodies.len() > 1 {
            own.sort_by(|a, b| dataset.holds[*b].p_act_pa.total_cmp(&dataset.holds[*a].p_act_pa));
        }
        own.truncate(most);
        own.sort_unstable();
        shown.extend(own);
    }
    shown.truncate(MOST_POSES);
    shown
}

/// Centre lines and markers, predicted and measured.
pub(super) fn shapes(title: &str, scenario: &Scenario, dataset: &Dataset) -> Result<Drawn, PageError> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    let mut poses = Vec::new();
    let several = several_bodies(dataset);
    for h in shown_holds(dataset) {
        let hold = &dataset.holds[h];
        model.predict(&Loads::uniform(hold.p_body_pa, hold.p_act_pa), &mut state)?;
        let drawn = (0..dataset.markers.len()).rev().step_by(dataset.markers.len().div_ceil(MOST_DRAWN).max(1));
        let predicted: Vec<[f64; 2]> = drawn.clone().map(|m| state.markers[m]).collect();
        let seen = drawn.filter(|m| dataset.is_seen(h, *m));
        let measured = seen.map(|m| {
            let (mean, spread) = measured(dataset, h, m);
            plots::MeasuredPoint { at_mm: mean.map(|v| v * MM), half_width_mm: spread.map(|v| v * MM) }
        });
        poses.push(plots::ShapePose {
            label: if several {
                format!("{:.0} kPa, body {}", hold.p_act_pa / 1e3, compare::wording::short(hold.p_body_pa / 1e3))
            } else {
                format!("{:.0} kPa", hold.p_act_pa / 1e3)
            },
            curve_mm: mm(&model.centre_line(&state, LINE_POINTS)),
            predicted_mm: mm(&predicted),
            measured: measured.collect(),
        });
    }
    let rest_mm = vec![[0.0, 0.0], [scenario.length_m * MM, 0.0]];
    let shapes = plots::Shapes { title: title.into(), rest_mm, body_radius_mm: scenario.radius_m * MM, poses };
    plots::shapes(&shapes).map_err(PageError::from)
}

fn mm(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|p| p.map(|v| v * MM)).collect()
}

/// Height of the outermost marker against actuator pressure: every model, and the measurement with both branches, at every
/// body pressure.
pub(super) fn pressure_curve(title: &str, study: &Study) -> Result<Drawn, PageError> {
    let dataset = &study.dataset;
    let bodies = bodies(dataset);
    let several = bodies.len() > 1;
    let named = |name: &str, p_body: f64| if several { format!("{name}{}", body(p_body)) } else { name.to_string() };
    let mut series = Vec::new();
    for (k, p_body) in bodies.iter().enumerate() {
        for (name, unload) in [("measured, loading", false), ("measured, unloading", true)] {
            let (points, half_width) = branch(dataset, *p_body, unload);
            if !points.is_empty() {
                series.push(plots::LineSeries {
                    name: named(name, *p_body),
                    points,
                    half_width,
                    style: if k == 0 { plots::LineStyle::Points } else { plots::LineStyle::OpenPoints },
                    colour: Some(usize::from(unload)),
                });
            }
        }
    }
    for (i, variant) in shown_variants(study, bodies.len()) {
        for (k, p_body) in bodies.iter().enumerate() {
            let style = if k == 0 { plots::LineStyle::Line } else { plots::LineStyle::Dashed };
            let points = model_curve(&variant.scenario, dataset, *p_body)?;
            let name = named(&variant.label, *p_body);
            series.push(plots::LineSeries { name, points, half_width: vec![], style, colour: Some(i + 2) });
        }
    }
    let lines = plots::Lines {
        title: title.into(),
        x_label: "actuator pressure [kPa]".into(),
        y_label: "height of the outermost marker [mm]".into(),
        series,
    };
    plots::lines(&lines).map_err(PageError::from)
}

/// All models, or the first and the last where several body pressures multiply their curves.
fn shown_variants(study: &Study, bodies: usize) -> Vec<(usize, &Variant)> {
    let all: Vec<(usize, &Variant)> = study.variants.iter().enumerate().collect();
    match &all[..] {
        [first, .., last] if bodies > 1 => vec![*first, *last],
        _ => all,
    }
}

/// Hold means of the outermost marker at a body pressure, over actuator pressure \[kPa, mm\], and their scatter over runs \[mm\].
fn branch(dataset: &Dataset, p_body_pa: f64, unload: bool) -> (Vec<[f64; 2]>, Vec<f64>) {
    let tip = dataset.markers.len() - 1;
    let holds = dataset.holds.iter().enumerate().filter(|(i, _)| dataset.is_seen(*i, tip));
    let own = holds.filter(|(_, h)| (h.phase == Phase::Unload) == unload && same_body(h.p_body_pa, p_body_pa));
    let point = |(i, h): (usize, &data::Hold)| {
        let (mean, spread) = measured(dataset, i, tip);
        ([h.p_act_pa / 1e3, mean[1] * MM], spread[1] * MM)
    };
    own.map(point).unzip()
}

/// Height of the outermost marker up to the highest pressure of the data at a body pressure \[kPa, mm\].
fn model_curve(scenario: &Scenario, dataset: &Dataset, p_body_pa: f64) -> Result<Vec<[f64; 2]>, PageError> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    let own = dataset.holds.iter().filter(|h| same_body(h.p_body_pa, p_body_pa));
    let top = own.map(|h| h.p_act_pa).fold(0.0, f64::max);
    let mut points = Vec::new();
    for i in 0..=60 {
        let p = top * (f64::from(i) / 60.0).powi(2);
        model.predict(&Loads::uniform(p_body_pa, p), &mut state)?;
        points.push([p / 1e3, state.markers.last().map_or(f64::NAN, |xy| xy[1] * MM)]);
    }
    Ok(points)
}

/// Predicted against published displacement, rung by rung.
pub(super) fn published_ladder(ladder: &PublishedLadder) -> Result<Drawn, PageError> {
    let step = |rung: &compare::study::published::Rung| plots::LadderStep {
        label: rung.label.clone(),
        value: rung.y_m * MM,
        range: rung.range_m.map(|r| r.map(|v| v * MM)),
        known: rung.known.word(),
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
    plots::ladder(&data).map_err(PageError::from)
}

/// Error beyond noise, rung by rung, with the noise floor.
pub(super) fn error_ladder(title: &str, variants: &[Variant]) -> Result<Drawn, PageError> {
    let error =
        |v: &Variant| v.evaluation.metrics.overall.systematic_mm.unwrap_or(v.evaluation.metrics.overall.rmse_mm);
    let floor = variants.first().and_then(|v| v.evaluation.metrics.overall.noise_floor_mm);
    let steps = variants.iter().map(|v| plots::LadderStep {
        label: v.label.clone(),
        value: error(v),
        range: None,
        known: v.known.word(),
    });
    let data = plots::Ladder {
        title: title.into(),
        value_label: "error beyond noise, all markers and holds [mm]".into(),
        steps: steps.collect(),
        target: floor.map(|value| plots::LadderTarget { label: "noise of the mean".into(), value, half_width: 0.0 }),
    };
    plots::ladder(&data).map_err(PageError::from)
}

/// Highest actuator pressure of the data, and the title of a ledger there; `None` if the actuator is never filled.
pub(super) fn at_highest(dataset: &Dataset) -> Option<(String, Loads)> {
    let top = dataset.holds.iter().max_by(|a, b| a.p_act_pa.total_cmp(&b.p_act_pa)).filter(|h| h.p_act_pa > 0.0)?;
    let body = if several_bodies(dataset) { body(top.p_body_pa) } else { String::new() };
    let at = compare::wording::short(top.p_act_pa * 1e-3);
    let title = format!("Energy ledger at the highest pressure, {at} kPa{body}");
    Some((title, Loads::uniform(top.p_body_pa, top.p_act_pa)))
}

/// Where the actuator's work goes at the highest loading hold, per model.
pub(super) fn ledgers(title: &str, cases: &[(String, Scenario)], loads: &Loads) -> Result<Drawn, PageError> {
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
    let energy =
        |lines: &[models::Row], t: &String| lines.iter().find(|l| l.name == *t).map_or(0.0, |l| l.energy_j * 1e3);
    // More terms than colours: the smallest go together.
    let mut joined = Vec::new();
    if terms.len() > MOST_TERMS {
        let largest = |t: &String| columns.iter().map(|(_, lines)| energy(lines, t).abs()).fold(0.0, f64::max);
        let mut by_size = terms.clone();
        by_size.sort_by(|a, b| largest(b).total_cmp(&largest(a)));
        joined = by_size.split_off(MOST_TERMS - 1);
        terms.retain(|t| !joined.contains(t));
    }
    let energies = |lines: &[models::Row]| -> Vec<f64> {
        let rest = (!joined.is_empty()).then(|| joined.iter().map(|t| energy(lines, t)).sum());
        terms.iter().map(|t| energy(lines, t)).chain(rest).collect()
    };
    let cases =
        columns.iter().map(|(label, lines)| plots::LedgerCase { label: label.clone(), energies_mj: energies(lines) });
    let data = plots::Ledger {
        title: title.into(),
        value_label: "potential energy at equilibrium [mJ]".into(),
        cases: cases.collect(),
        terms: terms.iter().cloned().chain((!joined.is_empty()).then(|| "others".into())).collect(),
    };
    plots::ledger(&data).map_err(PageError::from)
}

/// Bare, last uncalibrated and published displacement of the four actuators.
pub(super) fn published_bars(ladders: &[PublishedLadder]) -> Result<Drawn, PageError> {
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
    plots::bars(&data).map_err(PageError::from)
}

/// Run time against error.
pub fn tradeoff(timings: &[compare::study::Timing]) -> Result<Drawn, PageError> {
    let shown: Vec<_> =
        timings.iter().filter(|t| t.engine != "reduced" || t.known != Known::Calibrated.word()).collect();
    let point = |(k, t): (usize, &&compare::study::Timing)| {
        // The rungs of a ladder lie close together: the first and the last are named.
        let alike = |other: Option<&&compare::study::Timing>| {
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
    plots::tradeoff(&data).map_err(PageError::from)
}
