//! A comparison in x, y and z.

use crate::tables::{number, table};
use compare::study::in_space::{InSpace, SpaceHold, SpaceVariant};
use serde_json::{Value, json};

/// What is built for planar robots alone.
const LEFT_OUT: &str =
    "Diagnosis, calibration, the paper's accuracy and P/p scaling are of planar robots and were left out.";

/// Values along the axes with their signs: `+0.1, -2.3, +0.0`.
pub(crate) fn along(values: &[f64]) -> String {
    values.iter().map(|v| format!("{v:+.2}")).collect::<Vec<_>>().join(", ")
}

/// `20/10 kPa load (body 2)`.
pub(crate) fn hold_name(hold: &SpaceHold) -> String {
    let channels: Vec<String> = hold.p_act_channels_kpa.iter().map(|p| format!("{p:.0}")).collect();
    let again = if hold.occurrence > 0 { format!(" ({})", hold.occurrence + 1) } else { String::new() };
    format!("{} kPa {}{again} (body {:.0})", channels.join("/"), hold.phase, hold.p_body_kpa)
}

/// Where a model misses most, in sentences.
pub(crate) fn misses(variant: &SpaceVariant) -> Vec<String> {
    let names = ["x", "y", "z"];
    let tip = variant.worst().map(|hold| {
        format!(
            "The outermost marker is off most at {}: {:.2} mm, model minus measurement along the axes {} mm.",
            hold_name(hold),
            hold.tip_distance_mm,
            along(&hold.tip_error_mm)
        )
    });
    let within =
        variant.overall.systematic_mm.zip(variant.overall.noise_floor_mm).filter(|(beyond, noise)| beyond < noise);
    let within =
        within.map(|(beyond, noise)| format!("Over all holds {beyond:.2} mm are beyond a noise of {noise:.2} mm."));
    let total: f64 = variant.overall.rmse_axes_mm.iter().map(|v| v * v).sum();
    let share = |(name, v): (&&str, &f64)| format!("{name} {:.0} %", 100.0 * v * v / total);
    let shares: Vec<String> = names.iter().zip(&variant.overall.rmse_axes_mm).map(share).collect();
    let shares = (total > 0.0).then(|| format!("Of the mean square error: {}.", shares.join(", ")));
    within.into_iter().chain(tip).chain(shares).collect()
}

/// `ibr.compare.space`
pub fn as_json(scenario: &str, found: &InSpace) -> Value {
    let variant = |v: &SpaceVariant| {
        json!({
            "label": v.label, "how_known": v.known.word(), "why": v.why,
            "effects": v.scenario.effects.iter().map(|e| e.name.clone()).collect::<Vec<_>>(),
            "holds": v.holds, "overall": v.overall, "markers": v.markers,
        })
    };
    json!({
        "schema": "ibr.compare.space", "version": 1, "scenario": scenario, "data": found.dataset.name,
        "actuator": found.dataset.actuator, "runs": found.dataset.runs.len(), "axes": found.axes, "d_max_mm": found.d_max_mm,
        "provenance": found.about.as_ref().map(|a| a.provenance.word()),
        "models": found.variants.iter().map(variant).collect::<Vec<_>>(),
        "overall": found.variants[0].overall, "where_it_fails": misses(&found.variants[0]), "warnings": found.warnings,
    })
}

/// For readers.
pub fn text(found: &InSpace) -> String {
    let first = &found.variants[0];
    let noise = match first.overall.noise_floor_mm {
        Some(mm) => format!("noise of one coordinate of the mean {mm:.2} mm"),
        None => "one run: the noise is unknown".into(),
    };
    let mut out = format!(
        "{} held against {} in {}\n{} runs, {noise}; markers up to {:.1} mm from the straight body\n{LEFT_OUT}\n",
        first.scenario.name,
        found.dataset.name,
        if found.axes == 3 { "x, y and z" } else { "x and y" },
        found.dataset.runs.len(),
        found.d_max_mm
    );
    for variant in &found.variants {
        out.push_str(&format!("\n{} ({}): {}\n", variant.label, variant.known.word(), variant.why));
        out.push_str(&holds(variant, found.axes));
    }
    out.push_str("\nWhere the scenario's model fails:\n");
    misses(first).iter().for_each(|sentence| out.push_str(&format!("  - {sentence}\n")));
    out
}

fn holds(variant: &SpaceVariant, axes: usize) -> String {
    let axes = ["x, y", "x, y, z"][axes - 2];
    let head = ["hold", "RMSE mm", "noise floor mm", "beyond noise mm", "distance mm"].map(String::from);
    let more = ["bias", "tip error"].map(|what| format!("{what} {axes} mm"));
    let head: Vec<String> = head.into_iter().chain(more).chain(["tip distance mm".to_string()]).collect();
    let row = |name: String, errors: &compare::study::in_space::SpaceErrors, tip: [String; 2]| {
        let numbers = [Some(errors.rmse_mm), errors.noise_floor_mm, errors.systematic_mm, Some(errors.rms_distance_mm)];
        let numbers = numbers.map(|v| number(v, 2));
        std::iter::once(name).chain(numbers).chain([along(&errors.bias_mm)]).chain(tip).collect()
    };
    let of_hold =
        |h: &SpaceHold| row(hold_name(h), &h.errors, [along(&h.tip_error_mm), format!("{:.2}", h.tip_distance_mm)]);
    let all = row("all".into(), &variant.overall, [String::new(), String::new()]);
    table(&head, 1, variant.holds.iter().map(of_hold).chain([all]).collect())
}
