//! A design as text and JSON.

use crate::prelude::*;
use ::sweep::design::{Checked, End, Held, Miss, Round, Rounds, Spread, Wish};

fn shown(values: &[f64]) -> String {
    match values {
        [rad] => format!("{:.1}°", rad.to_degrees()),
        [x, y] => format!("{:.1}, {:.1}", 1e3 * x, 1e3 * y),
        _ => String::new(),
    }
}

pub(crate) fn design_text(wish: &Wish, rounds: &Rounds) -> String {
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
    text += &Table::of(&found.chosen).words("chosen", |(key, _)| key).right("value", |(_, value)| value).text();
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
    let other = |miss: &&Miss| best.by_elements(&miss.what);
    text += &Table::of(&found.misses)
        .words("wish [mm]", |miss| &miss.what)
        .right("wanted", |miss| shown(&miss.wanted))
        .right("model, predicted", |miss| shown(&miss.found))
        .number("miss [mm]", 1, |miss| 1e3 * miss.miss_m)
        .when(checked.is_ok(), |table| {
            table
                .right("finite elements", |miss| other(miss).map_or("not read".into(), |other| shown(&other.found)))
                .right("miss [mm]", |miss| other(miss).map_or(String::new(), |o| format!("{:.1}", 1e3 * o.miss_m)))
        })
        .text();
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
    text += &Table::finished(&head, 0, rounds.all.iter().enumerate().map(row).collect()).text();
    let parts =
        rounds.all.iter().enumerate().flat_map(|(k, round)| {
            round.design.misses.iter().enumerate().map(move |(at, miss)| (k + 1, round, at, miss))
        });
    text += "\n";
    text += &Table::of(parts)
        .words("design", |(number, ..)| number.to_string())
        .words("wish [mm]", |(.., miss)| &miss.what)
        .right("model, predicted", |(.., miss)| shown(&miss.found))
        .right("corrected by finite elements", |(_, round, at, _)| {
            round.corrected.as_ref().map_or("none".into(), |all| shown(&all[*at].found))
        })
        .right("finite elements", |(_, round, _, miss)| {
            round.by_elements(&miss.what).map_or("not read".into(), |other| shown(&other.found))
        })
        .text();
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

/// `ibr.design`: `ibr design WISH`
#[derive(Serialize)]
pub(crate) struct DesignAnswer<'a> {
    /// The wish as typed
    pub wish: String,
    /// The robot that it began with
    pub scenario: &'a str,
    /// Every part of the wish is within the tolerance by the model; with `--correct` by finite elements
    pub reached: bool,
    /// Share of the length by which a wish may be missed
    pub tolerance_mm: f64,
    /// What is written
    #[serde(flatten)]
    pub best: TriedDesign<'a>,
    /// Actuator pressure of every channel
    pub p_act_channels_kpa: Vec<f64>,
    /// Body pressure
    pub p_body_kpa: f64,
    /// Over the assumed numbers, where some are named
    pub interval: Option<Spread>,
    /// Ends of ranges that hold the design back, the most first
    pub held: &'a [Held],
    /// Starts of the search
    pub starts: usize,
    /// Starts that ended at this design or an equal one
    pub starts_that_agree: usize,
    /// With `--correct`: all that were checked, in their order
    #[serde(skip_serializing_if = "Option::is_none")]
    pub designs: Option<Vec<CheckedDesign<'a>>>,
    /// With `--correct`, reason why no further round ran
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ended: Option<Option<End>>,
}

/// A value of a design.
#[derive(Serialize)]
pub(crate) struct ChosenValue<'a> {
    /// Key of the scenario
    pub key: &'a str,
    /// Value as written there
    pub value: &'a str,
}

/// A design with its wish and its check.
#[derive(Serialize)]
pub(crate) struct TriedDesign<'a> {
    /// Values of the free keys
    pub chosen: Vec<ChosenValue<'a>>,
    /// The wish by the model as it is, part by part
    pub misses: &'a [Miss],
    /// Result of one run of the design
    pub finite_elements: Option<&'a Checked>,
    /// Reason why finite elements did not run
    pub unchecked: Option<&'a str>,
}

impl<'a> TriedDesign<'a> {
    fn of(Round { design, checked, .. }: &'a Round) -> TriedDesign<'a> {
        let chosen = design.chosen.iter().map(|(key, value)| ChosenValue { key, value }).collect();
        let (finite_elements, unchecked) = (checked.as_ref().ok(), checked.as_ref().err().map(String::as_str));
        TriedDesign { chosen, misses: &design.misses, finite_elements, unchecked }
    }
}

/// A design that was checked.
#[derive(Serialize)]
pub(crate) struct CheckedDesign<'a> {
    /// The design
    #[serde(flatten)]
    pub design: TriedDesign<'a>,
    /// Largest miss by finite elements, and by the model of parts that they do not read
    pub worst_mm: f64,
    /// The wish by the model with what finite elements differed at the design before; null for the first
    pub corrected_by_finite_elements: Option<&'a [Miss]>,
    /// Whether this is the one that is written
    pub written: bool,
}

impl<'a> DesignAnswer<'a> {
    /// What came of a wish, as typed.
    pub(crate) fn of(typed: String, wish: &'a Wish, rounds: &'a Rounds) -> DesignAnswer<'a> {
        let best = rounds.best();
        let found = &rounds.all[best].design;
        let one = |(k, round): (usize, &'a Round)| CheckedDesign {
            design: TriedDesign::of(round),
            worst_mm: 1e3 * round.worst_m(),
            corrected_by_finite_elements: round.corrected.as_deref(),
            written: k == best,
        };
        let corrected = rounds.corrections > 0;
        DesignAnswer {
            wish: typed,
            scenario: &wish.base.name,
            reached: rounds.reached(wish),
            tolerance_mm: 1e3 * wish.tolerance * found.file.length_m,
            best: TriedDesign::of(&rounds.all[best]),
            p_act_channels_kpa: found.loads.actuator_pa.iter().map(|pa| 1e-3 * pa).collect(),
            p_body_kpa: 1e-3 * found.loads.body_pa,
            interval: found.spread,
            held: &found.held,
            starts: found.starts[0],
            starts_that_agree: found.starts[1],
            designs: corrected.then(|| rounds.all.iter().enumerate().map(one).collect()),
            ended: corrected.then(|| rounds.end(wish)),
        }
    }
}
