//! `ibr predict`

use super::inputs::{self, quantity, with_effect};
use super::tables::table;
use super::{Context, Outcome, limits};
use crate::cli::Predict;
use crate::failure::Failure;
use crate::output::{check_folder, write_files};
use ibr::pages::Files;
use models::scenario::quantity::{Quantity, parse_pressures};
use models::{Beyond, CHANNELS, Limit, Loads, Model, Prediction, RowKind, Scenario, Step, Target, TipSlope};
use report::{ShapePose, Shapes, shapes};
use serde_json::{Value, json};

/// One predicted state, ready to print.
struct State {
    loads: Loads,
    prediction: Prediction,
    slopes: [TipSlope; CHANNELS],
}

pub fn run(args: &Predict, context: &mut Context) -> Result<Outcome, Failure> {
    args.out.as_deref().map_or(Ok(()), check_folder)?;
    let named = inputs::scenario(&args.scenario)?;
    let mut scenario = if args.bare { named.scenario.bare() } else { named.scenario };
    for text in &args.effect {
        scenario = with_effect(&scenario, text)?.0;
    }
    if let Some(text) = &args.body_pressure {
        scenario.p_body_pa = quantity("--body-pressure", text, Quantity::Pressure)?;
    }
    if args.limits {
        return limits::run(&args.scenario, &scenario, &wanted(&scenario, args.pressure.as_deref())?);
    }
    let model = Model::new(&scenario);
    let states = match &args.inverse {
        Some(wanted) => vec![inverse(&model, &scenario, wanted)?],
        None => forward(&model, &scenario, args.pressure.as_deref())?,
    };
    if let Some(folder) = &args.out {
        let files = drawing(&model, &scenario, &states)?;
        write_files(folder, &files, &[named.input], context)?;
    }
    let mut outcome = Outcome::new(text(&scenario, &states), to_json(&args.scenario, &model, &scenario, &states));
    outcome.notes.extend(inputs::superseded(&scenario));
    outcome.notes.extend(above_limit(&scenario, &states));
    outcome.notes.extend(states.iter().flat_map(|s| beyond_words(&model, s)));
    Ok(outcome)
}

fn forward(model: &Model, scenario: &Scenario, pressures: Option<&str>) -> Result<Vec<State>, Failure> {
    let loads = wanted(scenario, pressures)?;
    if model.has_history() { path(model, &loads) } else { loads.into_iter().map(|loads| solve(model, loads)).collect() }
}

/// The pressures of the command line, else of the scenario; a beam has none to be asked for.
fn wanted(scenario: &Scenario, pressures: Option<&str>) -> Result<Vec<Loads>, Failure> {
    let mut pressures = match pressures {
        Some(text) => {
            parse_pressures(text).map_err(|m| Failure::usage(format!("--pressure: {m}"), "see ibr predict --help"))?
        }
        None => scenario.pressures_pa.iter().map(|p| [*p; CHANNELS]).collect(),
    };
    if !scenario.actuator.exists() {
        if pressures.iter().flatten().any(|p| *p > 0.0) {
            return Err(Failure::usage("an actuator pressure for a beam without [actuator]", "leave it out"));
        }
        pressures = vec![[0.0; CHANNELS]];
    }
    if pressures.is_empty() {
        return Err(Failure::usage(
            "no pressure given",
            "add --pressure 10kPa,20kPa or [predict] pressures_kpa to the scenario",
        ));
    }
    Ok(pressures.into_iter().map(|p| Loads { body_pa: scenario.p_body_pa, actuator_pa: p }).collect())
}

/// Time for which `ibr predict` holds each pressure of a model with history \[s\]: the hold of the usual protocol.
const HOLD_S: f64 = 5.0;

/// The pressures in their order, each held for [`HOLD_S`]; the slopes are those of the first loading.
fn path(model: &Model, loads: &[Loads]) -> Result<Vec<State>, Failure> {
    let steps: Vec<Step> =
        loads.iter().enumerate().map(|(i, loads)| Step { t_s: HOLD_S * (i + 1) as f64, loads: *loads }).collect();
    let mut predictions = Vec::new();
    model.follow(&steps, &mut model.prediction(), &mut |_, at| predictions.push(at.clone()))?;
    let mut scratch = model.prediction();
    let state = |(loads, prediction): (&Loads, Prediction)| {
        let slopes = model.jacobian(loads, &mut scratch)?;
        Ok(State { loads: *loads, prediction, slopes })
    };
    loads.iter().zip(predictions).map(state).collect()
}

fn solve(model: &Model, loads: Loads) -> Result<State, Failure> {
    let mut prediction = model.prediction();
    let slopes = model.jacobian(&loads, &mut prediction)?;
    model.predict(&loads, &mut prediction)?;
    Ok(State { loads, prediction, slopes })
}

/// A note if a pressure exceeds what the scenario says its actuator stands.
fn above_limit(scenario: &Scenario, states: &[State]) -> Option<String> {
    let highest = states.iter().flat_map(|s| s.loads.actuator_pa).fold(0.0, f64::max);
    let limit = scenario.p_max_pa;
    (highest > limit)
        .then(|| format!("warning: {} kPa is above max_pressure_kpa = {} of the scenario", highest / 1e3, limit / 1e3))
}

/// A note for every stretch of a pose that the robot would not hold.
fn beyond_words(model: &Model, state: &State) -> Vec<String> {
    let words = |beyond: Beyond| {
        let (from, to) = (beyond.start_m * 1e3, (beyond.start_m + beyond.length_m) * 1e3);
        let what = match beyond.limit {
            Limit::Collapse => "the loads carry {} times the moment at which the inflated body folds, π p_b R³",
            Limit::Fold => "κR is {}: the body is bent about its own axis",
        };
        let what = what.replace("{}", &format!("{:.2}", beyond.share));
        format!(
            "warning: {} kPa, s = {from:.0} to {to:.0} mm: {what}; do not trust this pose",
            pressure_words(&state.loads)
        )
    };
    model.beyond(&state.loads, &state.prediction).into_iter().map(words).collect()
}

fn inverse(model: &Model, scenario: &Scenario, wanted: &str) -> Result<State, Failure> {
    let help = "write tip=100mm (height) or angle=60deg (total bend)";
    let target = match wanted.split_once('=') {
        Some(("tip", value)) => Target::TipHeight(quantity("--inverse", value, Quantity::Length)?),
        Some(("angle", value)) => Target::Angle(quantity("--inverse", value, Quantity::Angle)?),
        _ => return Err(Failure::usage(format!("--inverse {wanted} is not understood"), help)),
    };
    let mut prediction = model.prediction();
    let p = model.pressure_for(target, scenario.p_body_pa, &mut prediction)?;
    solve(model, Loads::uniform(scenario.p_body_pa, p))
}

fn text(scenario: &Scenario, states: &[State]) -> String {
    let head = ["P [kPa]", "tip x [mm]", "tip y [mm]", "angle [deg]", "dy/dP [mm/kPa]"];
    let rows = states.iter().map(|s| {
        let tip = s.prediction.tip;
        vec![
            pressure_words(&s.loads),
            format!("{:.2}", tip.x_m * 1e3),
            format!("{:.2}", tip.y_m * 1e3),
            format!("{:.3}", tip.angle_rad.to_degrees()),
            slope_words(total_slope(s) * 1e6),
        ]
    });
    let mut out =
        format!("{} at body pressure {} kPa{}\n", scenario.name, scenario.p_body_pa / 1e3, wall_words(scenario));
    out.push_str(&table(&head, 0, rows.collect()));
    if !scenario.markers_m.is_empty() {
        let mut head = vec!["marker at s [mm]".to_string()];
        head.extend(states.iter().map(|s| format!("x, y [mm] at {} kPa", pressure_words(&s.loads))));
        let rows = scenario.markers_m.iter().enumerate().map(|(i, s)| {
            let place = |state: &State| {
                format!("{:.2}, {:.2}", state.prediction.markers[i][0] * 1e3, state.prediction.markers[i][1] * 1e3)
            };
            std::iter::once(format!("{:.1}", s * 1e3)).chain(states.iter().map(place)).collect()
        });
        let head: Vec<&str> = head.iter().map(String::as_str).collect();
        out.push_str(&table(&head, 0, rows.collect()));
    }
    out
}

/// A slope; none where a pouch is flat.
fn slope_words(mm_per_kpa: f64) -> String {
    if mm_per_kpa.is_nan() { "-".into() } else { format!("{mm_per_kpa:.3}") }
}

/// What the scenario says of the body's fabric.
fn wall_words(scenario: &Scenario) -> String {
    let wall = &scenario.wall;
    let part = |name: &str, value: Option<f64>| value.map(|v| format!(", {name} {v:.0} N/m"));
    let parts = [part("E t", wall.stiffness_n_per_m), part("G t", wall.shear_n_per_m)];
    let parts: String = parts.into_iter().flatten().collect();
    if parts.is_empty() { parts } else { format!("{parts} ({})", wall.basis) }
}

/// ∂y/∂P with all channels moved together \[m/Pa\].
fn total_slope(state: &State) -> f64 {
    state.slopes.iter().map(|s| s.y_per_pa).sum()
}

pub(super) fn pressure_words(loads: &Loads) -> String {
    let p = loads.actuator_pa;
    if p.iter().all(|x| *x == p[0]) {
        return format!("{:.3}", p[0] / 1e3);
    }
    p.map(|x| format!("{}", x / 1e3)).join("/")
}

fn to_json(name: &str, model: &Model, scenario: &Scenario, states: &[State]) -> Value {
    let states: Vec<Value> = states.iter().map(|s| state_json(model, scenario, s)).collect();
    let effects: Vec<&str> = scenario.effects.iter().map(|e| e.name.as_str()).collect();
    json!({
        "schema": "ibr.predict", "version": 1, "scenario": name, "name": scenario.name,
        "actuator": scenario.actuator.kind.name, "effects": effects, "states": states,
    })
}

fn state_json(model: &Model, scenario: &Scenario, s: &State) -> Value {
    let tip = s.prediction.tip;
    let seen = scenario.markers_m.iter().zip(&s.prediction.markers);
    let markers: Vec<Value> =
        seen.map(|(at, xy)| json!({"s_mm": at * 1e3, "x_mm": xy[0] * 1e3, "y_mm": xy[1] * 1e3})).collect();
    let segments: Vec<Value> = model
        .curvatures(&s.prediction)
        .map(|(segment, _)| json!({"s_mm": segment.start_m * 1e3, "length_mm": segment.length_m * 1e3}))
        .collect();
    let curvature: Vec<f64> = model.curvatures(&s.prediction).map(|(_, kappa)| kappa).collect();
    let ledger: Vec<Value> = model
        .ledger(&s.loads, &s.prediction)
        .iter()
        .map(|line| json!({"term": line.name, "kind": kind(line.kind), "energy_mj": line.energy_j * 1e3}))
        .collect();
    let channels: Vec<f64> = s.loads.actuator_pa.iter().map(|p| p / 1e3).collect();
    let slopes: Vec<Value> = s
        .slopes
        .iter()
        .map(|j| {
            let angle = j.angle_per_pa.to_degrees() * 1e3;
            json!({"x_mm_per_kpa": j.x_per_pa * 1e6, "y_mm_per_kpa": j.y_per_pa * 1e6, "angle_deg_per_kpa": angle})
        })
        .collect();
    let beyond: Vec<Value> = model.beyond(&s.loads, &s.prediction).iter().map(beyond_json).collect();
    json!({
        "p_act_kpa": channels[0], "p_act_channels_kpa": channels, "p_body_kpa": s.loads.body_pa / 1e3,
        "markers": markers,
        "tip": {"x_mm": tip.x_m * 1e3, "y_mm": tip.y_m * 1e3, "angle_deg": tip.angle_rad.to_degrees()},
        "curvature_per_m": curvature, "segments": segments, "jacobian": slopes, "ledger": ledger, "beyond": beyond,
    })
}

fn beyond_json(beyond: &Beyond) -> Value {
    let limit = match beyond.limit {
        Limit::Collapse => "collapse",
        Limit::Fold => "fold",
    };
    json!({
        "limit": limit, "s_mm": beyond.start_m * 1e3, "length_mm": beyond.length_m * 1e3, "share": beyond.share,
    })
}

fn kind(kind: RowKind) -> &'static str {
    match kind {
        RowKind::Stored => "stored",
        RowKind::Dissipated => "lost",
        RowKind::Supplied => "supplied",
    }
}

fn drawing(model: &Model, scenario: &Scenario, states: &[State]) -> Result<Files, Failure> {
    let mm = |points: &[[f64; 2]]| points.iter().map(|p| p.map(|v| v * 1e3)).collect::<Vec<_>>();
    let poses = states.iter().take(6).map(|s| ShapePose {
        label: format!("{} kPa", pressure_words(&s.loads)),
        curve_mm: mm(&model.centre_line(&s.prediction, 80)),
        predicted_mm: mm(&s.prediction.markers),
        measured: vec![],
    });
    let data = Shapes {
        title: format!("{}, predicted", scenario.name),
        rest_mm: vec![[0.0, 0.0], [scenario.length_m * 1e3, 0.0]],
        body_radius_mm: scenario.radius_m * 1e3,
        poses: poses.collect(),
    };
    let drawn = shapes(&data).map_err(|e| Failure::usage(e.to_string(), "choose other pressures"))?;
    let mut files = Files::default();
    files.files.push(("shapes.svg".into(), drawn.svg.into_bytes()));
    files.files.push(("shapes.png".into(), drawn.png));
    Ok(files)
}
