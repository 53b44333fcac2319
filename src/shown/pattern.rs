//! Cutting plans.

use crate::tables::table;
use models::cutting::{CuttingPlan, Making, PatternPiece};
use serde_json::{Value, json};

/// For readers.
pub fn words(plan: &CuttingPlan, told: &[String], names: &[String]) -> String {
    let rows = plan.pieces.iter().map(|p| {
        let size = [p.x_m, p.y_m].map(|[a, b]| format!("{:.1}", 1e3 * (b - a)));
        let [x, y] = size;
        vec![p.name.clone(), p.copies.to_string(), p.fabric.into(), format!("{:.0}", p.warp_rad.to_degrees()), x, y]
    });
    let head = ["piece", "copies", "fabric", "warp [deg]", "along [mm]", "across [mm]"];
    let mut out = table(&head, 1, rows.collect());
    told.iter().for_each(|line| out.push_str(&format!("{line}\n")));
    out.push_str(&format!("\n1:1, written: {}\n", names.join(", ")));
    out
}

/// For programs.
pub fn to_json(scenario: &str, plan: &CuttingPlan, making: &Making, told: &[String], names: &[String]) -> Value {
    let mm = |v: [f64; 2]| v.map(|m| 1e3 * m);
    let piece = |p: &PatternPiece| {
        let marks: Vec<Value> = p
            .marks
            .iter()
            .map(|m| json!({"kind": format!("{:?}", m.kind).to_lowercase(), "x_mm": mm(m.x_m), "y_mm": mm(m.y_m)}))
            .collect();
        json!({
            "name": p.name, "copies": p.copies, "fabric": p.fabric, "warp_deg": p.warp_rad.to_degrees(),
            "x_mm": mm(p.x_m), "y_mm": mm(p.y_m), "marks": marks,
        })
    };
    json!({
        "schema": "ibr.pattern", "version": 1, "scenario": scenario,
        "weld_mm": 1e3 * making.weld_m, "allowance_mm": 1e3 * making.allowance_m,
        "pieces": plan.pieces.iter().map(piece).collect::<Vec<_>>(), "notes": told, "written": names,
    })
}
