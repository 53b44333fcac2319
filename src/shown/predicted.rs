//! Predicted states.

use crate::tables::table;
use ::sweep::PRESSURE;
use data::{Column, Table};
use ibr::AtPressure;
use ibr::pages::pressure_words;
use models::space::SectionState;
use models::{Beyond, CHANNELS, Limit, Model, RowKind, Scenario};
use serde_json::{Value, json};

/// For readers.
pub fn text(scenario: &Scenario, states: &[AtPressure]) -> String {
    let is_spatial = scenario.is_spatial();
    let mut head = vec!["P [kPa]", "tip x [mm]", "tip y [mm]", "angle [deg]", "dy/dP [mm/kPa]"];
    if is_spatial {
        head.insert(3, "tip z [mm]");
    }
    let rows = states.iter().map(|s| {
        let tip = s.prediction.tip;
        let mut row = vec![
            pressure_words(&s.loads),
            format!("{:.2}", tip.x_m * 1e3),
            format!("{:.2}", tip.y_m * 1e3),
            format!("{:.3}", tip.angle_rad.to_degrees()),
            slope_words(total_slope(s) * 1e6),
        ];
        if is_spatial {
            row.insert(3, format!("{:.2}", tip.z_m * 1e3));
        }
        row
    });
    let mut out =
        format!("{} at body pressure {} kPa{}\n", scenario.name, scenario.p_body_pa / 1e3, wall_words(scenario));
    out.push_str(&table(&head, 0, rows.collect()));
    if !scenario.markers_m.is_empty() {
        let axes = if is_spatial { "x, y, z" } else { "x, y" };
        let mut head = vec!["marker at s [mm]".to_string()];
        head.extend(states.iter().map(|s| format!("{} [mm] at {} kPa", axes, pressure_words(&s.loads))));
        let rows = scenario.markers_m.iter().enumerate().map(|(i, s)| {
            let place = |state: &AtPressure| {
                let [x, y] = state.prediction.markers[i].map(|v| v * 1e3);
                let z = state.prediction.markers_z_m[i] * 1e3;
                if is_spatial { format!("{x:.2}, {y:.2}, {z:.2}") } else { format!("{x:.2}, {y:.2}") }
            };
            std::iter::once(format!("{:.1}", s * 1e3)).chain(states.iter().map(place)).collect()
        });
        out.push_str(&table(&head, 0, rows.collect()));
    }
    out
}

/// For other programs: a row per pressure, with columns named as those of a sweep.
pub fn columns(scenario: &Scenario, states: &[AtPressure]) -> Table {
    let axes = if scenario.is_spatial() { &["x", "y", "z"][..] } else { &["x", "y"] };
    let of = |value: &dyn Fn(&AtPressure) -> f64| Column::F64(states.iter().map(value).collect());
    let mut columns = Vec::new();
    let all_alike = states.iter().all(|s| s.loads.actuator_pa.iter().all(|pa| *pa == s.loads.actuator_pa[0]));
    match all_alike {
        true => columns.push((PRESSURE.to_string(), of(&|s| s.loads.actuator_pa[0] / 1e3))),
        false => {
            columns.extend((0..CHANNELS).map(|c| (format!("{PRESSURE}.{c}"), of(&|s| s.loads.actuator_pa[c] / 1e3))))
        }
    }
    for (k, axis) in axes.iter().enumerate() {
        let tip = |s: &AtPressure| [s.prediction.tip.x_m, s.prediction.tip.y_m, s.prediction.tip.z_m][k] * 1e3;
        columns.push((format!("tip_{axis}_mm"), of(&tip)));
    }
    columns.push(("tip_angle_deg".into(), of(&|s| s.prediction.tip.angle_rad.to_degrees())));
    for m in 0..scenario.markers_m.len() {
        for (k, axis) in axes.iter().enumerate() {
            let place = |s: &AtPressure| s.prediction.markers[m].get(k).unwrap_or(&s.prediction.markers_z_m[m]) * 1e3;
            columns.push((format!("marker_{}_{axis}_mm", m + 1), of(&place)));
        }
    }
    Table { columns }
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
fn total_slope(state: &AtPressure) -> f64 {
    state.slopes.iter().map(|s| s.y_per_pa).sum()
}

/// One state of `ibr.predict`.
pub fn state_json(model: &Model, scenario: &Scenario, s: &AtPressure) -> Value {
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
    let (mut tip_json, mut markers) =
        (json!({"x_mm": tip.x_m * 1e3, "y_mm": tip.y_m * 1e3, "angle_deg": tip.angle_rad.to_degrees()}), markers);
    if model.is_spatial() {
        tip_json["z_mm"] = json!(tip.z_m * 1e3);
        for (marker, z) in markers.iter_mut().zip(&s.prediction.markers_z_m) {
            marker["z_mm"] = json!(z * 1e3);
        }
    }
    let beyond: Vec<Value> = model.beyond(&s.loads, &s.prediction).iter().map(beyond_json).collect();
    let mut told = json!({
        "p_act_kpa": channels[0], "p_act_channels_kpa": channels, "p_body_kpa": s.loads.body_pa / 1e3,
        "markers": markers,
        "tip": tip_json,
        "curvature_per_m": curvature, "segments": segments, "jacobian": slopes, "ledger": ledger, "beyond": beyond,
    });
    if model.is_spatial() {
        let sections: Vec<Value> = model.sections(&s.prediction).map(|section| section_json(&section)).collect();
        told["sections"] = json!(sections);
    }
    told
}

/// A section of a robot with strips round the body.
fn section_json(section: &SectionState) -> Value {
    let tensions: Vec<f64> = section.strips.iter().map(|strip| strip.tension).collect();
    json!({
        "s_mm": section.segment.start_m * 1e3, "length_mm": section.segment.length_m * 1e3,
        "curvature_yz_per_m": section.kappa, "contraction": section.contraction, "tension_n": tensions,
    })
}

/// A stretch of a pose that the robot would not hold.
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

/// A note for every stretch of a pose that the robot would not hold.
pub fn beyond_words(model: &Model, state: &AtPressure) -> Vec<String> {
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

/// A note if a pressure exceeds what the scenario says its actuator stands.
pub fn above_limit(scenario: &Scenario, states: &[AtPressure]) -> Option<String> {
    let highest = states.iter().flat_map(|s| s.loads.actuator_pa).fold(0.0, f64::max);
    let limit = scenario.p_max_pa;
    (highest > limit)
        .then(|| format!("warning: {} kPa is above max_pressure_kpa = {} of the scenario", highest / 1e3, limit / 1e3))
}
