//! A design as text and JSON.

use crate::pages::pressure_words;
use crate::tables::table;
use ::sweep::design::{Checked, End, Held, Miss, Round, Rounds, Wish};
use serde_json::{Value, json};
use std::path::Path;

fn shown(values: &[f64]) -> String {
    match values {
        [rad] => format!("{:.1}°", rad.to_degrees()),
        [x, y] => format!("{:.1}, {:.1}", 1e3 * x, 1e3 * y),
        _ => String::new(),
    }
}

/// What came of a wish.
pub fn design_text(wish: &Wish, rounds: &Rounds) -> String {
    let best = &rounds.all[rounds.best()];
    let Round { design: found, checked, .. } = best;
    let tolerance_mm = 1e3 * wish.tolerance * found.file.length_m;
    let (by, worst_m) = match rounds.corrections {
        0 => ("", found.worst_m()),
        _ if checked.is_err() => ("by the model ", found.worst_m()),
        _ => ("by finite elements ", best.worst_m()),
    };
    let within = format!("{:.1} mm (tolerance {tolerance_mm:.1} mm)", 1e3 * worst_m);
    let name = &found.file.scenario.name;
    let mut text = match (rounds.reached(wish), rounds.corrections) {
        (true, _) => format!("{name}: {by}a design has the wish to {within}\n\n"),
        (false, 0) => {
            format!("{name}: no design within these ranges has the wish; the nearest misses it by {within}\n\n")
        }
        (false, _) => {
            format!("{name}: {by}no design that was tried has the wish; the nearest misses it by {within}\n\n")
        }
    };
    text += &table(&["chosen", "value"], 1, found.chosen.iter().map(|(k, v)| vec![k.clone(), v.clone()]).collect());
    text += &format!(
        "Pressure {} kPa, body {} kPa.\n\n",
        pressure_words(&found.loads),
        compare::wording::short(1e-3 * found.loads.body_pa)
    );
    let all = found.loads.actuator_pa;
    if all.iter().any(|pa| *pa != all[0]) {
        let typed = all.map(|pa| format!("{}kPa", fem::session::rounded(1e-3 * pa))).join("/");
        text += &format!(
            "Pressures of single channels are not in design.toml: ibr predict design.toml --pressure {typed}\n\n"
        );
    }
    let row = |miss: &Miss| {
        let mut row =
            vec![miss.what.clone(), shown(&miss.wanted), shown(&miss.found), format!("{:.1}", 1e3 * miss.miss_m)];
        if checked.is_ok() {
            let other = best.by_elements(&miss.what);
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
    text += &rounds_text(wish, rounds);
    if let (Some(spread), Some(_)) = (&found.spread, &best.corrected) {
        text += &format!(
            "Over the assumed numbers the model, corrected by finite elements, misses the wish by up to {:.1} mm.\n",
            1e3 * spread.worst_m
        );
    } else if let Some(spread) = &found.spread {
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
    if searched_m(best) > wish.tolerance * found.file.length_m && found.held.is_empty() {
        text += "No end of a range holds it back. Longer lists, other free keys or a smaller wish may help.\n";
    }
    text
}

/// Largest miss of the model that the design was searched with: the corrected one where there is one \[m\].
fn searched_m(round: &Round) -> f64 {
    round.corrected.as_ref().unwrap_or(&round.design.misses).iter().map(|miss| miss.miss_m).fold(0.0, f64::max)
}

/// Design by design what was searched and what finite elements said, where corrections were asked for.
fn rounds_text(wish: &Wish, rounds: &Rounds) -> String {
    let best = rounds.best();
    let (Some(end), Some(first), 1..) = (rounds.end(wish), rounds.all.first(), rounds.corrections) else {
        return String::new();
    };
    let mm = |m: f64| format!("{:.1}", 1e3 * m);
    let row = |(k, round): (usize, &Round)| {
        let values = round.design.chosen.iter().map(|(_, value)| value.clone());
        let elements = round.checked.as_ref().map_or("none".into(), |_| mm(round.worst_m()));
        let corrected = round.corrected.as_ref().map_or("none".into(), |_| mm(searched_m(round)));
        let misses = [mm(round.design.worst_m()), corrected, elements];
        std::iter::once((k + 1).to_string()).chain(values).chain(misses).collect()
    };
    let keys = first.design.chosen.iter().map(|(key, _)| key.as_str());
    let head: Vec<&str> =
        std::iter::once("design").chain(keys).chain(["model", "corrected", "finite elements"]).collect();
    let mut text = "\nDesigns and their largest miss [mm]: by the model, by the model corrected by finite elements, and by finite elements.\n".to_string();
    text += &table(&head, 0, rounds.all.iter().enumerate().map(row).collect());
    let part = |(k, round): (usize, &Round)| -> Vec<Vec<String>> {
        let corrected = |at: usize| round.corrected.as_ref().map_or("none".into(), |all| shown(&all[at].found));
        let elements = |what: &str| round.by_elements(what).map_or("not read".into(), |other| shown(&other.found));
        let of = |(at, miss): (usize, &Miss)| {
            vec![(k + 1).to_string(), miss.what.clone(), shown(&miss.found), corrected(at), elements(&miss.what)]
        };
        round.design.misses.iter().enumerate().map(of).collect()
    };
    let head = ["design", "wish [mm]", "model, predicted", "corrected by finite elements", "finite elements"];
    text += "\n";
    text += &table(&head, 2, rounds.all.iter().enumerate().flat_map(part).collect());
    text += &match (best, rounds.all.len()) {
        (_, 1) => "The first design is written.".to_string(),
        (0, _) => {
            "The corrections did not help: the first design misses least by finite elements, and is written.".into()
        }
        (best, _) => format!(
            "The corrections took the miss by finite elements from {} to {} mm: design {} is written.",
            mm(first.worst_m()),
            mm(rounds.all[best].worst_m()),
            best + 1
        ),
    };
    text += &match (end, rounds.all.last().map(|last| &last.checked)) {
        (End::Reached, _) => " It has the wish within the tolerance.\n".to_string(),
        (End::Spent, _) => " No further design was tried: more need a larger --correct.\n".into(),
        (End::Same, _) => {
            " The search came back to a design that was checked: more corrections would change nothing.\n".into()
        }
        (End::Unchecked, Some(Err(why))) if rounds.all.len() > 1 => {
            format!(
                " Design {} has no finite element run ({why}), so the model is not corrected further.\n",
                rounds.all.len()
            )
        }
        (End::Unchecked, _) => " Without a finite element run nothing corrects the model.\n".into(),
    };
    text
}

/// For programs.
pub fn design_json(file: &Path, wish: &Wish, rounds: &Rounds) -> Value {
    let best = rounds.best();
    let Round { design: found, checked, .. } = &rounds.all[best];
    let chosen = |round: &Round| -> Vec<Value> {
        round.design.chosen.iter().map(|(key, value)| json!({"key": key, "value": value})).collect()
    };
    let elements = |checked: &Result<Checked, String>| {
        checked.as_ref().ok().map(|c| json!({"misses": misses_json(&c.misses), "warnings": c.warnings}))
    };
    let mm = |ends: [f64; 2]| ends.map(|m| 1e3 * m);
    let interval =
        found.spread.map(|s| json!({"tip_x_mm": mm(s.x_m), "tip_y_mm": mm(s.y_m), "worst_mm": 1e3 * s.worst_m}));
    let held = |h: &Held| json!({"key": h.key, "end": h.value, "gain_mm": 1e3 * h.gain_m});
    let mut told = json!({
        "schema": "ibr.design", "version": 1, "wish": file.display().to_string(), "scenario": wish.base.name,
        "reached": rounds.reached(wish), "tolerance_mm": 1e3 * wish.tolerance * found.file.length_m,
        "chosen": chosen(&rounds.all[best]),
        "p_act_channels_kpa": found.loads.actuator_pa.map(|pa| 1e-3 * pa), "p_body_kpa": 1e-3 * found.loads.body_pa,
        "misses": misses_json(&found.misses), "interval": interval, "held": found.held.iter().map(held).collect::<Vec<_>>(),
        "starts": found.starts[0], "starts_that_agree": found.starts[1],
        "finite_elements": elements(checked), "unchecked": checked.as_ref().err(),
    });
    if rounds.corrections > 0 {
        let one = |(k, round): (usize, &Round)| {
            json!({
                "chosen": chosen(round), "misses": misses_json(&round.design.misses), "worst_mm": 1e3 * round.worst_m(),
                "corrected_by_finite_elements": round.corrected.as_ref().map(|misses| misses_json(misses)),
                "finite_elements": elements(&round.checked), "unchecked": round.checked.as_ref().err(), "written": k == best,
            })
        };
        told["designs"] = rounds.all.iter().enumerate().map(one).collect();
        told["ended"] = json!(rounds.end(wish).map(|end| match end {
            End::Reached => "reached",
            End::Spent => "spent",
            End::Same => "same",
            End::Unchecked => "unchecked",
        }));
    }
    told
}

fn misses_json(misses: &[Miss]) -> Vec<Value> {
    let shown = |values: &[f64]| match values {
        [rad] => vec![rad.to_degrees()],
        more => more.iter().map(|m| 1e3 * m).collect(),
    };
    let one = |m: &Miss| json!({"what": m.what, "wanted": shown(&m.wanted), "found": shown(&m.found), "miss_mm": 1e3 * m.miss_m});
    misses.iter().map(one).collect()
}
