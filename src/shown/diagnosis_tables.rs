//! Every table of a diagnosis.

use super::diagnosis::is_told;
use crate::prelude::*;
use compare::diagnosis::words::{listed, three, with_unit};
use compare::diagnosis::{Diagnosis, Group, Ranked};
use compare::study::engines::TERMS;
use compare::witness::{HEIGHTS, Witness};

pub(super) fn tables(d: &Diagnosis, witness: Option<&Witness>) -> String {
    let finite_elements = witness.map(finite_elements).unwrap_or_default();
    [ranking(d), pairs(d), details(d), finite_elements, unseen(d), experiments(d)].concat()
}

fn ranking(d: &Diagnosis) -> String {
    let blocks = [("Supply and measurement, to be ruled out first", true), ("Physics and loads", false)];
    let mut out = String::new();
    for (title, nuisance) in blocks {
        let chosen = d.ranked.iter().filter(|r| r.group.is_nuisance() == nuisance);
        let base = format!("{title} (base: {:.2} mm beyond noise):", d.base.systematic_mm);
        out += &Table::of(chosen)
            .words("", |r| mark(d, r))
            .words("effect", |r| &r.effect)
            .words("value, 95 %", |r| listed(&r.parameters))
            .number("after mm", 2, |r| r.systematic_after_mm)
            .number("held-out pressure mm", 2, |r| r.heldout_mm)
            .number("held-out run mm", 2, |r| r.heldout_run_mm)
            .number("gain", 0, |r| r.gain)
            .right("p corrected", |r| p_cell(r.p_corrected))
            .under(&base);
    }
    out.push_str("= cannot be told from the best · ! on a physical bound, rejected\n");
    out
}

fn mark(d: &Diagnosis, r: &Ranked) -> &'static str {
    // Where pairs are stated, no single effect is.
    let alike = r.in_set && !d.is_quiet() && d.pairs.is_empty();
    match (alike, r.at_bound) {
        (_, true) => "!",
        (true, _) => "=",
        _ => "",
    }
}

fn p_cell(p: Option<f64>) -> String {
    p.map_or("–".into(), p_text)
}

pub(super) fn p_text(p: f64) -> String {
    match p {
        p if p <= 1e-6 => "< 1e-6".into(),
        p if p < 1e-3 => format!("{p:.0e}"),
        p => format!("{p:.3}"),
    }
}

fn pairs(d: &Diagnosis) -> String {
    Table::of(&d.pairs)
        .words("", |p| if p.in_set { "=" } else { "" })
        .words("pair", |p| p.effects.join(" + "))
        .words("values, 95 %", |p| listed(&p.parameters))
        .number("after mm", 2, |p| p.systematic_after_mm)
        .number("gain", 0, |p| p.gain)
        .right("p over one", |p| p_cell(p.p_corrected))
        .right("", |p| if p.cancels { "the two cancel" } else { "" })
        .under("Pairs:")
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
        let Ranked { effect, sentence, differs, remedy, .. } = r;
        let group = r.group.word();
        out += &format!("\n{effect} ({group}): {sentence}\n  shows: {differs}\n  check: {remedy}\n");
        out += &lines("  note: ", notes(r));
    }
    for r in d.ranked.iter().filter(|r| r.at_bound && !told(r) && r.group != Group::Load) {
        out.push_str(&format!("\n{}: {}\n", r.effect, r.notes.first().cloned().unwrap_or_default()));
    }
    let fails = lines("  - ", d.leftover.iter().map(|s| &s.sentence));
    out + &format!("\nWhere the final model still fails:\n{fails}")
}

fn finite_elements(w: &Witness) -> String {
    let sentences = lines("  - ", &w.sentences);
    let mut out = format!("\nThe same robot in finite elements:\n{sentences}{}", table(&HEIGHTS, 1, w.height_rows()));
    if w.fe_mj.is_some() {
        out += &table(&[&["energies mJ"], &TERMS[..], &["apart"]].concat(), 1, w.ledger_rows());
    }
    out
}

fn unseen(d: &Diagnosis) -> String {
    let unknown = if d.noise.camera_mm.is_some() { "not within its bounds" } else { "not known" };
    let sizes = Table::of(&d.undetectable)
        .words("effect", |u| &u.effect)
        .right("size", |u| u.smallest_detectable.map_or(unknown.into(), |s| with_unit(&three(s), &u.unit)))
        .number("times typical", 2, |u| u.times_typical);
    let title = "Effects not found; smallest size that would have been seen (90 %):";
    format!("\n{title}\n{}{}", sizes.text(), lines("note: ", &d.limits))
}

fn experiments(d: &Diagnosis) -> String {
    let Some(next) = d.next_experiment.as_ref().filter(|next| !next.tried.is_empty()) else { return String::new() };
    let tried = next.tried.iter().map(|e| (e.name.as_str(), e.shown_protocol(), e.needed, &e.separations));
    let mut rows = Table::of(std::iter::once(("data at hand", "–", next.needed_now, &next.now)).chain(tried))
        .words("experiment", |(name, ..)| *name)
        .words("protocol [kPa]", |(_, protocol, ..)| *protocol)
        .number("suffices", 0, |(_, _, needed, _)| *needed);
    for (k, rival) in next.now.iter().enumerate() {
        rows = rows.number(&rival.rival, 1, |(.., found)| found.get(k).map(|s| s.lambda));
    }
    format!("\nExpected separation λ of {} from:\n{}", next.best, rows.text())
}
