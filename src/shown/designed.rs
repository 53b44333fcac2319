//! A design as text and JSON.

use crate::pages::pressure_words;
use crate::tables::table;
use ::sweep::design::{Design, Held, Miss, Wish};
use serde_json::{Value, json};
use std::path::Path;

/// What one finite element run says of a design.
#[derive(Debug, Clone)]
pub struct Checked {
    /// Where the stations are, the last is the tip \[m\].
    pub places_m: Vec<[f64; 2]>,
    /// The parts of the wish that it can read.
    pub misses: Vec<Miss>,
    /// What makes the run doubtful.
    pub warnings: Vec<String>,
    /// Its pictures by name.
    pub pictures: Vec<(String, Vec<u8>)>,
}

fn shown(values: &[f64]) -> String {
    match values {
        [rad] => format!("{:.1}°", rad.to_degrees()),
        [x, y] => format!("{:.1}, {:.1}", 1e3 * x, 1e3 * y),
        _ => String::new(),
    }
}

/// What came of a wish.
pub fn design_text(wish: &Wish, found: &Design, checked: &Result<Checked, String>) -> String {
    let tolerance_mm = 1e3 * wish.tolerance * found.file.length_m;
    let worst_mm = 1e3 * found.worst_m();
    let mut text = match found.reached(wish) {
        true => format!(
            "{}: a design has the wish to {worst_mm:.1} mm (tolerance {tolerance_mm:.1} mm)\n\n",
            found.file.scenario.name
        ),
        false => format!(
            "{}: no design within these ranges has the wish; the nearest misses it by {worst_mm:.1} mm (tolerance {tolerance_mm:.1} mm)\n\n",
            found.file.scenario.name
        ),
    };
    text += &table(&["chosen", "value"], 1, found.chosen.iter().map(|(k, v)| vec![k.clone(), v.clone()]).collect());
    text += &format!(
        "Pressure {} kPa, body {} kPa.\n\n",
        pressure_words(&found.loads),
        compare::wording::short(1e-3 * found.loads.body_pa)
    );
    let all = found.loads.actuator_pa;
    if all.iter().any(|pa| *pa != all[0]) {
        let typed = all.map(|pa| format!("{}kPa", compare::wording::short(1e-3 * pa))).join("/");
        text += &format!(
            "Pressures of single channels are not in design.toml: ibr predict design.toml --pressure {typed}\n\n"
        );
    }
    let by_other = |what: &str| checked.as_ref().ok()?.misses.iter().find(|miss| miss.what == what);
    let row = |miss: &Miss| {
        let mut row =
            vec![miss.what.clone(), shown(&miss.wanted), shown(&miss.found), format!("{:.1}", 1e3 * miss.miss_m)];
        if checked.is_ok() {
            let other = by_other(&miss.what);
            row.push(other.map_or("not read".into(), |other| shown(&other.found)));
            row.push(other.map_or(String::new(), |other| format!("{:.1}", 1e3 * other.miss_m)));
        }
        row
    };
    let mut head = vec!["wish [mm]", "wanted", "model, predicted", "miss [mm]"];
    if checked.is_ok() {
        head.extend(["finite elements", "miss [mm]"]);
    }
    text += &table(&head, 1, found.misses.iter().map(row).collect());
    if let Err(why) = checked {
        text += &format!("No finite element run: {why}.\n");
    }
    if let Some(spread) = &found.spread {
        let of = |[low, high]: [f64; 2]| format!("{:.1} to {:.1}", 1e3 * low, 1e3 * high);
        text += &format!(
            "Over the assumed numbers the tip is at x = {} mm and y = {} mm, and the wish is missed by up to {:.1} mm.\n",
            of(spread.x_m),
            of(spread.y_m),
            1e3 * spread.worst_m
        );
    } else {
        text += "No number is named as assumed, so there is no interval: add [[assumed]] with key, from and to.\n";
    }
    for held in &found.held {
        text += &format!(
            "Held back by {} at its end {}: one unit beyond it would take {:.2} mm off the miss.\n",
            held.key,
            compare::wording::short(held.value),
            1e3 * held.gain_m
        );
    }
    if !found.reached(wish) && found.held.is_empty() {
        text += "No end of a range holds it back. Longer lists, other free keys or a smaller wish may help.\n";
    }
    text
}

/// For programs.
pub fn design_json(file: &Path, wish: &Wish, found: &Design, checked: &Result<Checked, String>) -> Value {
    let of = |misses: &[Miss]| -> Vec<Value> {
        let shown = |values: &[f64]| match values {
            [rad] => vec![rad.to_degrees()],
            more => more.iter().map(|m| 1e3 * m).collect(),
        };
        let one = |m: &Miss| json!({"what": m.what, "wanted": shown(&m.wanted), "found": shown(&m.found), "miss_mm": 1e3 * m.miss_m});
        misses.iter().map(one).collect()
    };
    let mm = |ends: [f64; 2]| ends.map(|m| 1e3 * m);
    let chosen: Vec<Value> = found.chosen.iter().map(|(key, value)| json!({"key": key, "value": value})).collect();
    let interval =
        found.spread.map(|s| json!({"tip_x_mm": mm(s.x_m), "tip_y_mm": mm(s.y_m), "worst_mm": 1e3 * s.worst_m}));
    let held = |h: &Held| json!({"key": h.key, "end": h.value, "gain_mm": 1e3 * h.gain_m});
    json!({
        "schema": "ibr.design", "version": 1, "wish": file.display().to_string(), "scenario": wish.base.name,
        "reached": found.reached(wish), "tolerance_mm": 1e3 * wish.tolerance * found.file.length_m, "chosen": chosen,
        "p_act_channels_kpa": found.loads.actuator_pa.map(|pa| 1e-3 * pa), "p_body_kpa": 1e-3 * found.loads.body_pa,
        "misses": of(&found.misses), "interval": interval, "held": found.held.iter().map(held).collect::<Vec<_>>(),
        "starts": found.starts[0], "starts_that_agree": found.starts[1],
        "finite_elements": checked.as_ref().ok().map(|c| json!({"misses": of(&c.misses), "warnings": c.warnings})),
        "unchecked": checked.as_ref().err(),
    })
}
