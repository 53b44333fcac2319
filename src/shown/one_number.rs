//! What one displacement can tell.

use crate::tables::{number, table};
use compare::diagnosis::words::{three, with_unit};
use compare::study::one_number::{Explanation, OneNumber};
use data::published::printed;

/// For readers.
pub fn text(one: &OneNumber) -> String {
    let top = one.p_act_kpa.len() - 1;
    let mut out = format!(
        "{}: the model without stiffness says {:.1} mm at {:.0} kPa, the paper {:.1} mm (published). One number, met by one effect alone at:\n",
        printed(&one.actuator),
        one.bare_mm[top],
        one.p_act_kpa[top],
        one.measured_mm
    );
    let mut head = vec!["effect".to_string(), "value".into(), "times typical".into()];
    head.extend(one.p_act_kpa.iter().map(|p| format!("mm at {p:.0} kPa")));
    let row = |e: &Explanation| {
        let mut cells = vec![
            e.effect.clone(),
            format!("{} = {}", e.key, with_unit(&three(e.value), &e.unit)),
            number(e.times_typical, 2),
        ];
        cells.extend(e.y_mm.iter().map(|y| format!("{y:.1}")));
        cells
    };
    out.push_str(&table(&head, 2, one.met_by.iter().map(row).collect()));
    out.push_str("Each value is calibrated on that one number: meeting it is evidence for none of them.\n");
    out.push_str(&told(one));
    if !one.not_met_by.is_empty() {
        out.push_str(&format!("At no value within its bounds: {}.\n", one.not_met_by.join(", ")));
    }
    if let Some(term) = &one.fe_carrier {
        out.push_str(&format!(
            "The finite elements differ from the model as shipped by: {term}. Without it in both, the difference is less than half.\n"
        ));
    }
    out
}

/// What a second pressure would decide.
fn told(one: &OneNumber) -> String {
    let mut out = String::new();
    for k in 0..one.p_act_kpa.len() - 1 {
        if let Some([low, high]) = one.spread_mm(k) {
            out.push_str(&format!(
                "At {:.0} kPa they differ: {low:.1} to {high:.1} mm. Marker positions there would tell most of them apart.\n",
                one.p_act_kpa[k]
            ));
        }
    }
    out
}
