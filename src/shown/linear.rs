//! The linear form of a robot.

use crate::tables::table;
use ibr::pages::pressure_words;
use models::Scenario;
use models::export::{Joint, Linear};
use serde_json::{Value, json};

/// For readers.
pub fn text(scenario: &Scenario, chain: &Linear) -> String {
    let channels = channels(chain);
    let mut head: Vec<String> =
        ["joint", "start [mm]", "length [mm]", "q [deg]", "K [N m/rad]", "C [N m s/rad]", "b [N m]"]
            .map(String::from)
            .to_vec();
    head.extend(channels.iter().map(|channel| format!("B{channel} [N m/kPa]")));
    let rows = chain.joints.iter().enumerate().map(|(i, joint)| {
        let mut row = vec![
            (i + 1).to_string(),
            format!("{:.1}", joint.start_m * 1e3),
            format!("{:.1}", joint.length_m * 1e3),
            format!("{:.2}", joint.angle_rad.to_degrees()),
            number(joint.stiffness_nm),
            joint.damping_nms.map_or("-".into(), number),
            number(joint.offset_nm),
        ];
        row.extend(channels.iter().map(|channel| number(joint.per_pa[*channel] * 1e3)));
        row
    });
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    format!(
        "{} at {} kPa, body pressure {} kPa\n{}Moment that bends a joint: b + B P - K q - C q\u{27}. Predicted.\n",
        scenario.name,
        pressure_words(&chain.loads),
        chain.loads.body_pa / 1e3,
        table(&head, 0, rows.collect())
    )
}

/// A number; none where an actuator is flat.
fn number(value: f64) -> String {
    if value.is_nan() { "-".into() } else { format!("{value:.5}") }
}

/// Channels that drive a joint; at least the first.
fn channels(chain: &Linear) -> Vec<usize> {
    let drives = |channel: &usize| *channel == 0 || chain.joints.iter().any(|joint| joint.per_pa[*channel] != 0.0);
    (0..models::CHANNELS).filter(drives).collect()
}

/// As JSON.
pub fn as_json(name: &str, scenario: &Scenario, chain: &Linear) -> Value {
    let joint = |joint: &Joint| {
        json!({
            "s_mm": joint.start_m * 1e3, "length_mm": joint.length_m * 1e3, "angle_rad": joint.angle_rad,
            "k_nm_per_rad": joint.stiffness_nm, "c_nms_per_rad": joint.damping_nms, "b_nm": joint.offset_nm,
            "b_nm_per_kpa": joint.per_pa.map(|per_pa| per_pa * 1e3),
        })
    };
    json!({
        "schema": "ibr.export.linear", "version": 1, "scenario": name, "name": scenario.name,
        "p_body_kpa": chain.loads.body_pa / 1e3, "p_act_channels_kpa": chain.loads.actuator_pa.map(|p| p / 1e3),
        "joints": chain.joints.iter().map(joint).collect::<Vec<Value>>(),
    })
}
