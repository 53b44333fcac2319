//! Every table of a diagnosis.

use super::diagnosis::is_told;
use crate::tables::{number, table};
use compare::diagnosis::words::{listed, three, with_unit};
use compare::diagnosis::{Combination, Diagnosis, Experiment, Group, Ranked};
use compare::study::engines::TERMS;
use compare::witness::{HEIGHTS, Witness};

/// All of them.
pub fn tables(d: &Diagnosis, witness: Option<&Witness>) -> String {
    let finite_elements = witness.map(finite_elements).unwrap_or_default();
    [ranking(d), pairs(d), details(d), finite_elements, unseen(d), experiments(d)].concat()
}

fn ranking(d: &Diagnosis) -> String {
    let blocks = [("Supply and measurement, to be ruled out first", true), ("Physics and loads", false)];
    let mut out = String::new();
    for (title, nuisance) in blocks {
        let chosen = d.ranked.iter().filter(|r| r.group.is_nuisance() == nuisance);
        let rows: Vec<Vec<String>> = chosen.map(|r| row(d, r)).collect();
        if !rows.is_empty() {
            out.push_str(&format!("\n{title} (base: {:.2} mm beyond noise):\n", d.base.systematic_mm));
            out.push_str(&table(&HEAD, 3, rows));
        }
    }
    out.push_str("= cannot be told from the best · ! on a physical bound, rejected\n");
    out
}

const HEAD: [&str; 8] =
    ["", "effect", "value, 95 %", "after mm", "held-out pressure mm", "held-out run mm", "gain", "p corrected"];

fn row(d: &Diagnosis, r: &Ranked) -> Vec<String> {
    // Where pairs are stated, no single effect is.
    let alike = r.in_set && !d.is_quiet() && d.pairs.is_empty();
    let mark = match (alike, r.at_bound) {
        (_, true) => "!",
        (true, _) => "=",
        _ => "",
    };
    vec![
        mark.into(),
        r.effect.clone(),
        listed(&r.parameters),
        format!("{:.2}", r.systematic_after_mm),
        number(r.heldout_mm, 2),
        number(r.heldout_run_mm, 2),
        format!("{:.0}", r.gain),
        r.p_corrected.map_or("–".into(), p_text),
    ]
}

/// A p-value.
pub fn p_text(p: f64) -> String {
    match p {
        p if p <= 1e-6 => "< 1e-6".into(),
        p if p < 1e-3 => format!("{p:.0e}"),
        p => format!("{p:.3}"),
    }
}

fn pairs(d: &Diagnosis) -> String {
    if d.pairs.is_empty() {
        return String::new();
    }
    let row = |p: &Combination| {
        vec![
            if p.in_set { "=" } else { "" }.to_string(),
            p.effects.join(" + "),
            listed(&p.parameters),
            format!("{:.2}", p.systematic_after_mm),
            format!("{:.0}", p.gain),
            p.p_corrected.map_or("–".into(), p_text),
            if p.cancels { "the two cancel" } else { "" }.to_string(),
        ]
    };
    let head = ["", "pair", "values, 95 %", "after mm", "gain", "p over one", ""];
    format!("\nPairs:\n{}", table(&head, 3, d.pairs.iter().map(row).collect()))
}

/// Sentences, remedies and cautions of the set, and where the final model still fails.
fn details(d: &Diagnosis) -> String {
    let mut out = String::new();
    if d.is_quiet() {
        return out;
    }
    let told = |r: &Ranked| is_told(d, r);
    // Notes of an effect's own fit are no notes of a pair's.
    let notes = |r: &Ranked| if d.pairs.is_empty() { r.notes.clone() } else { Vec::new() };
    for r in d.ranked.iter().filter(|r| told(r)) {
        out.push_str(&format!(
            "\n{} ({}): {}\n  shows: {}\n  check: {}\n",
            r.effect,
            r.group.word(),
            r.sentence,
            r.differs,
            r.remedy
        ));
        notes(r).iter().for_each(|n| out.push_str(&format!("  note: {n}\n")));
    }
    for r in d.ranked.iter().filter(|r| r.at_bound && !told(r) && r.group != Group::Load) {
        out.push_str(&format!("\n{}: {}\n", r.effect, r.notes.first().cloned().unwrap_or_default()));
    }
    out.push_str("\nWhere the final model still fails:\n");
    d.leftover.iter().for_each(|s| out.push_str(&format!("  - {}\n", s.sentence)));
    out
}

fn finite_elements(w: &Witness) -> String {
    let mut out = "\nThe same robot in finite elements:\n".to_string();
    w.sentences.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    out.push_str(&table(&HEIGHTS, 1, w.height_rows()));
    if w.fe_mj.is_some() {
        let mut head = vec!["energies mJ"];
        head.extend(TERMS);
        head.push("apart");
        out.push_str(&table(&head, 1, w.ledger_rows()));
    }
    out
}

fn unseen(d: &Diagnosis) -> String {
    let rows = d.undetectable.iter().map(|u| {
        let size = u
            .smallest_detectable
            .map_or(if d.noise.camera_mm.is_some() { "not within its bounds" } else { "not known" }.into(), |s| {
                with_unit(&three(s), &u.unit)
            });
        vec![u.effect.clone(), size, number(u.times_typical, 2)]
    });
    let mut out = "\nEffects not found; smallest size that would have been seen (90 %):\n".to_string();
    out.push_str(&table(&["effect", "size", "times typical"], 1, rows.collect()));
    d.limits.iter().for_each(|l| out.push_str(&format!("note: {l}\n")));
    out
}

fn experiments(d: &Diagnosis) -> String {
    let Some(next) = d.next_experiment.as_ref().filter(|next| !next.tried.is_empty()) else { return String::new() };
    let lambda = |e: &Experiment| -> Vec<String> { e.separations.iter().map(|s| format!("{:.1}", s.lambda)).collect() };
    let now = next.now.iter().map(|s| format!("{:.1}", s.lambda));
    let at_hand = ["data at hand".to_string(), "–".to_string(), format!("{:.0}", next.needed_now)];
    let mut rows = vec![at_hand.into_iter().chain(now).collect::<Vec<_>>()];
    rows.extend(next.tried.iter().map(|e| {
        [e.name.clone(), e.shown_protocol().to_string(), format!("{:.0}", e.needed)]
            .into_iter()
            .chain(lambda(e))
            .collect::<Vec<_>>()
    }));
    let mut head = vec!["experiment".to_string(), "protocol [kPa]".to_string(), "suffices".to_string()];
    head.extend(next.now.iter().map(|s| s.rival.clone()));
    format!("\nExpected separation λ of {} from:\n{}", next.best, table(&head, 2, rows))
}
