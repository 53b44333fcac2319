use super::Result;
use crate::prelude::*;
use compare::characterize::Scatter;
use compare::study::predict::loads;
use compare::study::{Comparison, Timing, Variant};
use data::Phase;
use report as plots;

const MM: f64 = 1e3;
pub(super) const LINE_POINTS: usize = 80;
/// Terms of a ledger that colours can distinguish.
const MOST_TERMS: usize = 8;
/// Markers on a centre line; of more, every few from the outermost one on.
const MOST_DRAWN: usize = 24;
pub(super) const MOST_POSES: usize = 6;
/// Body pressures are the same within this fraction.
const SAME_BODY: f64 = 0.05;

/// Hold mean over samples and runs of one marker \[m\], and its standard deviation over runs; NaN along an axis that the table lacks.
pub fn measured(dataset: &Dataset, hold: usize, marker: usize) -> ([f64; 3], [f64; 3]) {
    let samples = dataset.samples_per_hold;
    let along = |axis: usize| {
        let at = |run, s| dataset.place(run, hold, s, marker).get(axis).copied().unwrap_or(f64::NAN);
        let mean = |run| (0..samples).map(|s| at(run, s)).sum::<f64>() / samples as f64;
        Scatter::of((0..dataset.runs.len()).map(mean))
    };
    let over_runs = [0, 1, 2].map(along);
    let mean = over_runs.map(|s| s.map_or(f64::NAN, |s| s.mean));
    let spread = over_runs.map(|s| s.and_then(|s| s.sd).unwrap_or(0.0));
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

pub(super) fn body(p_body_pa: f64) -> String {
    format!(", body {} kPa", compare::wording::short(p_body_pa * 1e-3))
}

/// `20`, or `20/10` where supply channels have pressures of their own.
fn act_kpa(hold: &data::Hold) -> String {
    let label = compare::residuals::label(hold);
    crate::words::kpa(label.p_act_kpa, &label.p_act_channels_kpa)
}

/// Pressurised holds reached by loading, without repeats; of more than six the highest pressures of every body pressure.
fn shown_holds(dataset: &Dataset) -> Vec<usize> {
    let bodies = bodies(dataset);
    let mut shown = Vec::new();
    for p_body in &bodies {
        let mut own: Vec<usize> = Vec::new();
        for (h, hold) in dataset.holds.iter().enumerate().filter(|(_, hold)| same_body(hold.p_body_pa, *p_body)) {
            let new = own.iter().all(|s| dataset.holds[*s].channels_pa().ne(hold.channels_pa()));
            if hold.phase != Phase::Unload && hold.sum_act_pa() > 0.0 && new {
                own.push(h);
            }
        }
        let most = if bodies.len() == 1 { MOST_POSES } else { (MOST_POSES / bodies.len()).max(1) };
        if bodies.len() > 1 {
            own.sort_by(|a, b| dataset.holds[*b].sum_act_pa().total_cmp(&dataset.holds[*a].sum_act_pa()));
        }
        own.truncate(most);
        own.sort_unstable();
        shown.extend(own);
    }
    shown.truncate(MOST_POSES);
    shown
}

/// Centre lines and markers, predicted and measured, with an axis upwards: 1 is y, 2 is z.
pub(super) fn shapes(title: &str, scenario: &Scenario, dataset: &Dataset, axis: usize) -> Result<Drawn> {
    let model = Model::new(scenario);
    let mut state = model.prediction();
    let mut poses = Vec::new();
    let several = several_bodies(dataset);
    for h in shown_holds(dataset) {
        let hold = &dataset.holds[h];
        model.predict(&loads(hold, 1.0), &mut state)?;
        let side = |place: [f64; 3]| [place[0], place[axis]];
        let drawn = (0..dataset.markers.len()).rev().step_by(dataset.markers.len().div_ceil(MOST_DRAWN).max(1));
        let predicted: Vec<[f64; 2]> = {
            let place = |m: usize| [state.markers[m][0], state.markers[m][1], state.markers_z_m[m]];
            drawn.clone().map(|m| side(place(m))).collect()
        };
        let seen = drawn.filter(|m| dataset.is_seen(h, *m));
        let measured =
            seen.map(|m| <[[f64; 3]; 2]>::from(measured(dataset, h, m)).map(|place| side(place).map(|v| v * MM)));
        poses.push(plots::ShapePose {
            label: if several {
                format!("{} kPa, body {}", act_kpa(hold), compare::wording::short(hold.p_body_pa / 1e3))
            } else {
                format!("{} kPa", act_kpa(hold))
            },
            curve_mm: mm(&model.centre_line_in_space(&state, LINE_POINTS).into_iter().map(side).collect::<Vec<_>>()),
            predicted_mm: mm(&predicted),
            measured: measured.collect(),
        });
    }
    let rest_mm = mm(&[[0.0, 0.0], [scenario.length_m, 0.0]]);
    let body_radius_mm = scenario.radius_m * MM;
    let mut shapes = plots::Shapes { title: title.into(), rest_mm, body_radius_mm, poses, ..plots::Shapes::default() };
    if dataset.has_z() {
        shapes.across = ["y, towards azimuth 0\u{b0} [mm]", "z, towards azimuth 90\u{b0} [mm]"][axis - 1].into();
    }
    Ok(plots::shapes(&shapes)?)
}

pub(super) fn mm(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    points.iter().map(|p| p.map(|v| v * MM)).collect()
}

/// Height of the outermost marker against actuator pressure: every model, and the measurement with both branches, at every
/// body pressure.
pub(super) fn pressure_curve(title: &str, study: &Comparison) -> Result<Drawn> {
    let dataset = &study.dataset;
    let bodies = bodies(dataset);
    let several = bodies.len() > 1;
    let named = |name: &str, p_body: f64| if several { format!("{name}{}", body(p_body)) } else { name.to_string() };
    let mut series = Vec::new();
    for (k, p_body) in bodies.iter().enumerate() {
        for (name, unload) in [("measured, loading", false), ("measured, unloading", true)] {
            let (points, half_width) = branch(dataset, *p_body, unload);
            if !points.is_empty() {
                let style = if k == 0 { LineStyle::Points } else { LineStyle::OpenPoints };
                let line = LineSeries::new(named(name, *p_body), style, points).with_errors(half_width);
                series.push(line.coloured(usize::from(unload)));
            }
        }
    }
    for (i, variant) in shown_variants(study, bodies.len()) {
        for (k, p_body) in bodies.iter().enumerate() {
            let style = if k == 0 { LineStyle::Line } else { LineStyle::Dashed };
            let points = model_curve(&variant.scenario, dataset, *p_body)?;
            let name = named(&super::effect(&variant.label), *p_body);
            series.push(LineSeries::new(name, style, points).coloured(i + 2));
        }
    }
    let (x, y) = ("actuator pressure [kPa]", "height of the outermost marker [mm]");
    Ok(plots::lines(&Lines::new(title, x, y, series))?)
}

/// All models, or the first and the last where several body pressures multiply their curves.
fn shown_variants(study: &Comparison, bodies: usize) -> Vec<(usize, &Variant)> {
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
fn model_curve(scenario: &Scenario, dataset: &Dataset, p_body_pa: f64) -> Result<Vec<[f64; 2]>> {
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

pub(super) fn known(known: Known) -> (&'static str, Ink) {
    let ink = match known {
        Known::Measured => Ink::Ink,
        Known::Published => Ink::Series(5),
        Known::Assumed => Ink::Series(4),
        Known::Calibrated => Ink::Series(3),
        Known::Predicted => Ink::Series(0),
    };
    (known.word(), ink)
}

/// Error beyond noise, rung by rung, with the noise floor.
pub(super) fn error_ladder(title: &str, variants: &[Variant]) -> Result<Drawn> {
    let step = |v: &Variant| {
        let all = &v.evaluation.metrics.overall;
        let value = all.systematic_mm.unwrap_or(all.rmse_mm);
        plots::LadderStep { label: super::effect(&v.label), value, range: None, known: known(v.known) }
    };
    let floor = variants.first().and_then(|v| v.evaluation.metrics.overall.noise_floor_mm);
    let steps: Vec<_> = variants.iter().map(step).collect();
    let target = floor.map(|value| ("noise of the mean".into(), value));
    Ok(plots::ladder(title, "error beyond noise, all markers and holds [mm]", &steps, target)?)
}

/// Highest actuator pressure of the data, and the title of a ledger there; `None` if the actuator is never filled.
pub(super) fn at_highest(dataset: &Dataset) -> Option<(String, Loads)> {
    let top = dataset.holds.iter().max_by(|a, b| a.sum_act_pa().total_cmp(&b.sum_act_pa()));
    let top = top.filter(|h| h.sum_act_pa() > 0.0)?;
    let body = if several_bodies(dataset) { body(top.p_body_pa) } else { String::new() };
    let at = compare::wording::channels_word(&compare::residuals::label(top));
    let title = format!("Energy ledger at the highest pressure, {at} kPa{body}");
    Some((title, loads(top, 1.0)))
}

/// Where the actuator's work goes at the highest loading hold, per model; of more terms than colours the smallest go together.
pub(super) fn ledgers(title: &str, cases: &[(String, Scenario)], loads: &Loads) -> Result<Drawn> {
    let mut columns = Vec::new();
    let mut largest: Vec<(&str, f64)> = Vec::new();
    for (label, scenario) in cases {
        let model = Model::new(scenario);
        let mut state = model.prediction();
        model.predict(loads, &mut state)?;
        let rows = model.ledger(loads, &state);
        for row in rows.iter().filter(|row| row.energy_j != 0.0) {
            match largest.iter_mut().find(|(name, _)| *name == row.name) {
                Some((_, most)) => *most = most.max(row.energy_j.abs()),
                None => largest.push((row.name, row.energy_j.abs())),
            }
        }
        columns.push((label, rows));
    }
    let mut by_size = largest.clone();
    by_size.sort_by(|a, b| b.1.total_cmp(&a.1));
    let small: Vec<&str> = match largest.len() > MOST_TERMS {
        true => by_size.split_off(MOST_TERMS - 1).into_iter().map(|(name, _)| name).collect(),
        false => Vec::new(),
    };
    let large: Vec<&str> = largest.iter().map(|(name, _)| *name).filter(|name| !small.contains(name)).collect();
    let case = |(label, rows): (&String, Vec<models::Row>)| {
        let energy = |name: &&str| rows.iter().find(|row| row.name == *name).map_or(0.0, |row| row.energy_j * 1e3);
        let others = (!small.is_empty()).then(|| small.iter().map(energy).sum());
        (effect(label), large.iter().map(energy).chain(others).collect())
    };
    let others = (!small.is_empty()).then(|| "others".to_string());
    let terms: Vec<String> = large.iter().map(|name| super::effect(name)).chain(others).collect();
    let cases: Vec<_> = columns.into_iter().map(case).collect();
    Ok(plots::ledger(title, "potential energy at equilibrium [mJ]", &terms, &cases)?)
}

/// Run time against error, with a staircase through the points that no other beats in both. Calibrated reduced models have none.
pub(crate) fn tradeoff(timings: &[Timing]) -> Result<Drawn> {
    let is_reduced = |t: &&Timing| t.engine == "reduced";
    let shown: Vec<&Timing> =
        timings.iter().filter(|t| !is_reduced(t) || t.known != Known::Calibrated.word()).collect();
    let mut groups: Vec<&str> = Vec::new();
    shown.iter().for_each(|t| {
        if !groups.contains(&t.actuator.as_str()) {
            groups.push(&t.actuator)
        }
    });
    let at = |t: &Timing| [t.prediction_us * 1e-6, t.error_pct.abs()];
    let point = |(k, t): (usize, &&Timing)| {
        // The rungs of a ladder lie close together: the first and the last are named.
        let alike = |other: Option<&&Timing>| other.is_some_and(|o| is_reduced(o) && o.actuator == t.actuator);
        let between = is_reduced(t) && k > 0 && alike(shown.get(k - 1)) && alike(shown.get(k + 1));
        let group = groups.iter().position(|name| *name == t.actuator).unwrap_or(0);
        let label = if between { String::new() } else { super::effect(&t.model) };
        let (at, ink, symbol) = (at(t), Ink::Series(group), Symbol::of(group));
        Mark::Point(Point { at, ink, symbol, label, ..Point::default() })
    };
    let mut marks = vec![front(shown.iter().map(|t| at(t)).collect())];
    marks.extend(shown.iter().enumerate().map(point));
    let key = |(i, name): (usize, &&str)| LegendEntry::new(KeyLook::Symbol(Symbol::of(i), false), Ink::Series(i), name);
    let (x, y) = ("run time of one prediction", "error of the published displacement [%]");
    let keys = groups.iter().enumerate().map(key).collect();
    let mut chart = Chart::new("Run time against error", x, y);
    (chart.space, chart.marks, chart.keys) = (Space::Log, marks, keys);
    Ok(chart.draw("trade-off")?)
}

/// Staircase through the points that are the most accurate at their run time or less.
fn front(mut points: Vec<[f64; 2]>) -> Mark {
    points.retain(|p| p[0] > 0.0 && p[1] > 0.0);
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut path: Vec<[f64; 2]> = Vec::new();
    for point in &points {
        let above = path.last().copied();
        if above.is_none_or(|last| point[1] < last[1]) {
            path.extend(above.map(|last| [point[0], last[1]]));
            path.push(*point);
        }
    }
    path.extend(path.last().zip(points.last()).map(|(last, end)| [end[0], last[1]]));
    Mark::Dashed(path, Ink::Axis)
}
