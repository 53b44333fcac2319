//! A diagnosis, as a page to read; its tables are in `diagnosis_tables.rs`.

use super::diagnosis_tables::{is_told, tables};
use crate::prelude::*;
use compare::diagnosis::words::{listed, three, with_unit};
use compare::diagnosis::{Diagnosis, Ranked, Verdict, taken_away};
use compare::witness::Witness;

/// `ibr.diagnose`: `ibr diagnose SCENARIO DATA`, and `diagnosis.json`
#[derive(Serialize)]
pub struct DiagnosisAnswer<'a> {
    /// Result of the diagnosis, as keys of this object
    #[serde(flatten)]
    pub diagnosis: &'a Diagnosis,
    /// The same robot in finite elements; null without runs
    pub finite_elements: Option<&'a Witness>,
    /// Path or name of the scenario as typed
    pub scenario_file: &'a str,
    /// SHA-256 of every table as read
    pub data_sha256: Vec<&'a str>,
}

impl<'a> DiagnosisAnswer<'a> {
    /// Of a diagnosis, with finite elements of the robot and the scenario as typed.
    pub fn of(diagnosis: &'a Diagnosis, finite_elements: Option<&'a Witness>, scenario_file: &'a str) -> Self {
        let data_sha256 = diagnosis.evidence.iter().map(|used| used.sha256.as_str()).collect();
        DiagnosisAnswer { diagnosis, finite_elements, scenario_file, data_sha256 }
    }
}

/// Explanations in the short table, and those in words.
const ROWS: usize = 5;
const TOLD: usize = 3;

/// The page that a person reads: verdict, what it could be, what to check, what to do next, what could not be seen. `all` adds the
/// tables.
pub fn text(d: &Diagnosis, witness: Option<&Witness>, all: bool) -> String {
    let model = d.foreign_bases.first().map_or(&d.scenario, |base| &base.table);
    let mut out = format!("{model} compared with {}, {} runs\n{}\n\n", d.dataset, d.runs, d.noise.sentence);
    d.slips.iter().for_each(|slip| out.push_str(&format!("Before the verdict, look at the data. {slip}\n\n")));
    out.push_str(&format!("Verdict: {}\n", verdict(d)));
    d.summary.iter().for_each(|s| out.push_str(&wrapped(&format!("  - {s}"), 4)));
    if d.pressure_slip.is_some() {
        return out;
    }
    if all {
        return out + &tables(d, witness);
    }
    out.push_str(&closest(d));
    // Where nothing that is known is enough, the story names the place to look at.
    if d.verdict != Some(Verdict::OutOfCatalog) {
        out.push_str(&to_check(d));
        if let Some(first) = witness.and_then(|w| w.sentences.first()) {
            out.push_str(&wrapped(&format!("\nThe same robot in finite elements: {first}"), 2));
        }
        out.push_str(&not_seen(d));
    }
    out + "\nEvery effect, pair and experiment: add --tables. The picture of the missing moment: in the report of --out FOLDER.\n"
}

/// The verdict in words, with its ties.
pub fn verdict(d: &Diagnosis) -> String {
    match d.verdict {
        Some(Verdict::None) => "no missing effect detectable".into(),
        Some(Verdict::Effect) => {
            let names: Vec<String> = d.indistinguishable.iter().map(|name| effect(name)).collect();
            let tie = if names.len() > 1 { "; these data do not choose between them" } else { "" };
            let is_surplus = |name: &String| name.split(" + ").any(|part| taken_away(part).is_some());
            let what = match (names.iter().any(is_surplus), names.iter().all(is_surplus)) {
                (false, _) if !d.foreign_bases.is_empty() => "the base lacks an effect",
                (false, _) => "an effect is missing",
                (true, true) => "the scenario has an effect too many",
                (true, false) => "an effect is missing, or one is too many",
            };
            let alone: Option<Vec<&str>> = names.iter().map(|name| taken_away(name)).collect();
            let listed = alone.filter(|_| !names.iter().any(|name| name.contains(" + ")));
            let listed = listed.map_or_else(|| names.join(" or "), |names| names.join(" or "));
            format!("{what}: {listed}{tie}")
        }
        Some(Verdict::OutOfCatalog) if d.is_either() => {
            "something is missing: a fault that is not in the catalogue, or effects".into()
        }
        Some(Verdict::OutOfCatalog) => "something is missing that is not in the catalogue".into(),
        None if d.pressure_slip.is_some() => "withheld until the pressures are right".into(),
        None => "none: ranking only".into(),
    }
}

fn closest(d: &Diagnosis) -> String {
    if d.is_quiet() {
        return String::new();
    }
    let stated = |r: &&Ranked| !d.pairs.is_empty() || !r.in_set;
    let pairs = d.pairs.iter().take(ROWS / 2);
    let pairs = pairs.map(|p| (p.effects.join(" + "), p.in_set, &p.parameters, p.systematic_after_mm, None));
    let (first, mut others): (Vec<&Ranked>, Vec<&Ranked>) = d.ranked.iter().partition(|r| !stated(r));
    others.retain(|r| !r.at_bound);
    others.sort_by(|a, b| a.systematic_after_mm.total_cmp(&b.systematic_after_mm));
    let singles = first.into_iter().chain(others);
    let singles = singles.map(|r| (r.effect.clone(), !stated(&r), &r.parameters, r.systematic_after_mm, r.heldout_mm));
    let before = format!("{:.2} mm beyond noise without any of them", d.base.systematic_mm);
    let rows: Vec<_> = pairs.chain(singles).take(ROWS).collect();
    if rows.is_empty() {
        return String::new();
    }
    let rows = TextTable::of(rows)
        .words("", |(_, alike, ..)| if *alike { "=" } else { "" })
        .words("with", |(name, ..)| name.clone())
        .words("value, 95 %", |(_, _, values, ..)| listed(values))
        .number("after mm", 2, |(.., after, _)| *after)
        .number("pressures left out mm", 2, |(.., left_out)| *left_out)
        .text();
    format!("\nWhat it could be ({before}; =: these data cannot rule it out):\n{rows}")
}

/// What the answer means on the robot, and where the model fails with it.
fn to_check(d: &Diagnosis) -> String {
    if d.verdict != Some(Verdict::Effect) {
        return String::new();
    }
    let told: Vec<&Ranked> = d.ranked.iter().filter(|r| is_told(d, r)).collect();
    let mut out = "\n".to_string();
    for r in told.iter().take(TOLD) {
        // Additions are stated above.
        let added = d.added.iter().any(|added| added.effect == r.effect);
        let sentence = if added { String::new() } else { format!(" {}", r.sentence) };
        out.push_str(&wrapped(&format!("{} ({}):{sentence} To check: {}", r.effect, r.group.word(), r.remedy), 2));
    }
    if told.len() > TOLD {
        let rest: Vec<&str> = told[TOLD..].iter().map(|r| r.effect.as_str()).collect();
        out.push_str(&wrapped(&format!("and {}", rest.join(", ")), 2));
    }
    if let (Some(first), Some(Verdict::Effect)) = (d.leftover.first(), d.verdict) {
        out.push_str(&wrapped(&format!("Still: {}", first.sentence), 2));
    }
    out
}

/// The effects that hide best, and what these data cannot show.
fn not_seen(d: &Diagnosis) -> String {
    let mut hidden: Vec<_> =
        d.undetectable.iter().filter_map(|u| Some((u, u.smallest_detectable?, u.times_typical?))).collect();
    hidden.sort_by(|a, b| b.2.total_cmp(&a.2));
    let sizes =
        hidden.iter().take(3).map(|(u, size, _)| format!("{} below {}", u.effect, with_unit(&three(*size), &u.unit)));
    let sizes: Vec<String> = sizes.collect();
    let mut out =
        if sizes.is_empty() { "\n".into() } else { wrapped(&format!("\nCould not be seen: {}.", sizes.join(", ")), 2) };
    d.limits.iter().for_each(|limit| out.push_str(&wrapped(&format!("note: {limit}"), 2)));
    out
}
