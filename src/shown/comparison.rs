//! A comparison.

use crate::tables::{number, table};
use compare::study::comparison::{Comparison, Variant};
use compare::validation::Validation;
use serde_json::{Value, json};

/// A comparison with what goes with it.
pub struct CompareAnswer<'a> {
    /// The scenario, as typed.
    pub scenario: &'a str,
    /// What was found.
    pub found: &'a Comparison,
    /// Effects that were added to the scenario, and what they bring here.
    pub added: Option<&'a (Vec<String>, Validation)>,
}

impl CompareAnswer<'_> {
    /// `ibr.compare`
    pub fn json(&self) -> Value {
        let CompareAnswer { scenario, found, added } = self;
        let variant = |v: &Variant| {
            json!({
                "label": v.label, "how_known": v.known.word(), "why": v.why,
                "bending_nm2": v.scenario.bending_stiffness,
                "effects": v.scenario.effects.iter().map(|e| e.name.clone()).collect::<Vec<_>>(),
                "holds": v.evaluation.metrics.holds, "overall": v.evaluation.metrics.overall,
                "residual_map": v.evaluation.residual_map, "where_it_fails": v.evaluation.where_it_fails,
            })
        };
        let added = added.map(|(effects, v)| {
            json!({"effects": effects, "before": v.before, "after": v.after, "fitted_to_these": v.fitted_to_these})
        });
        let first = &found.variants[0].evaluation;
        json!({
            "schema": "ibr.compare", "version": 1, "scenario": scenario, "data": found.dataset.name,
            "actuator": found.dataset.actuator, "runs": found.dataset.runs.len(),
            "provenance": found.about.as_ref().map(|a| a.provenance.word()),
            "noise": first.noise, "holds": first.metrics.holds, "overall": first.metrics.overall,
            "pairing": first.metrics.pairing, "residual_map": first.residual_map,
            "where_it_fails": first.where_it_fails, "scaling": first.scaling,
            "models": found.variants.iter().map(variant).collect::<Vec<_>>(),
            "added": added, "warnings": found.warnings,
        })
    }
}

/// For readers.
pub fn text(answer: &CompareAnswer) -> String {
    let CompareAnswer { found, added, .. } = answer;
    let first = &found.variants[0];
    let mut out = format!("{} held against {}\n", first.scenario.name, found.dataset.name);
    out.push_str(&format!("{}\n", first.evaluation.noise.sentence));
    for variant in &found.variants {
        out.push_str(&format!("\n{} ({}): {}\n", variant.label, variant.known.word(), variant.why));
        out.push_str(&holds(variant));
    }
    if let Some((effects, v)) = added {
        out.push_str(&format!("\nError beyond noise without → with {}: {}.\n", effects.join(", "), v.sentence));
    }
    out.push_str("\nWhere the scenario's model fails:\n");
    for statement in &first.evaluation.where_it_fails {
        out.push_str(&format!("  - {}\n", statement.sentence));
    }
    out.push_str(&format!("\nP/p scaling: {}\n", first.evaluation.scaling.sentence));
    out
}

fn holds(variant: &Variant) -> String {
    let head = [
        "hold",
        "paper accuracy %",
        "noise ceiling %",
        "rms rel. %",
        "RMSE mm",
        "noise floor mm",
        "beyond noise mm",
        "tip error mm",
        "χ²/dof",
    ];
    let percent = |v: Option<f64>| number(v.map(|a| 100.0 * a), 1);
    let rows = variant.evaluation.metrics.holds.iter().map(|h| {
        vec![
            format!("{:.0} kPa {} (body {:.0})", h.p_act_kpa, h.phase, h.p_body_kpa),
            percent(h.paper_accuracy),
            percent(h.noise_ceiling),
            number(h.rms_relative_pct, 1),
            number(Some(h.rmse_mm), 2),
            number(h.noise_floor_mm, 2),
            number(h.systematic_mm, 2),
            format!("{:+.2}", h.tip_error_mm),
            number(h.reduced_chi2, 1),
        ]
    });
    table(&head, 1, rows.collect())
}
