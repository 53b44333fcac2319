//! All tables of a diagnosis, as text and as rows.

use super::engines::over_seeds;
use crate::prelude::*;
use compare::diagnosis::words::{listed, three, with_unit};
use compare::diagnosis::{Combination, Diagnosis, Group, Ranked, Separation, Undetectable};
use compare::study::engines::{Energies, TERMS};
use compare::witness::{Height, Witness};
use compare::wording::short;

pub(crate) fn tables(d: &Diagnosis, witness: Option<&Witness>) -> String {
    let base = format!("(base: {:.2} mm beyond noise):", d.base.systematic_mm);
    let ranking: String = ranking(d).into_iter().map(|(title, rows)| rows.under(&format!("{title} {base}"))).collect();
    let finite_elements = witness.map_or(String::new(), |w| {
        let tables = witness_heights(w).text() + &witness_ledgers(w).map_or(String::new(), TextTable::text);
        format!("\nThe same robot in finite elements:\n{}{tables}", lines("  - ", &w.sentences))
    });
    let unseen = format!("\n{UNSEEN}:\n{}{}", unseen(d).text(), lines("note: ", &d.limits));
    let experiments = experiments(d).map_or(String::new(), |(title, rows)| format!("\n{title}:\n{}", rows.text()));
    [ranking, MARKS.into(), pairs(d).under("Pairs:"), details(d), finite_elements, unseen, experiments].concat()
}

/// What the first column of effects and pairs means.
pub(crate) const MARKS: &str = "= fits as well as the best · ! on a physical bound, rejected\n";

pub(crate) const UNSEEN: &str = "Effects not found; smallest size that would have been seen (90 %)";

/// It is stated in words: of the answer, or of the set where no pair is stated.
pub(crate) fn is_told(d: &Diagnosis, r: &Ranked) -> bool {
    d.speaks_of(&r.effect) || r.in_set && d.pairs.is_empty()
}

pub(crate) fn ranking(d: &Diagnosis) -> [(&'static str, TextTable<&Ranked>); 2] {
    [("Supply and measurement, to be ruled out first", true), ("Physics and loads", false)].map(|(title, nuisance)| {
        let rows = TextTable::of(d.ranked.iter().filter(|r| r.group.is_nuisance() == nuisance))
            .words("", |r| mark(d, r))
            .words("effect", |r| &r.effect)
            .words("value, 95 %", |r| listed(&r.parameters))
            .number("after mm", 2, |r| r.systematic_after_mm)
            .number("held-out pressure mm", 2, |r| r.heldout_mm)
            .number("held-out run mm", 2, |r| r.heldout_run_mm)
            .number("gain", 0, |r| r.gain)
            .right("p corrected", |r| p_cell(r.p_corrected));
        (title, rows)
    })
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

pub(crate) fn p_text(p: f64) -> String {
    match p {
        p if p <= 1e-6 => "< 1e-6".into(),
        p if p < 1e-3 => format!("{p:.0e}"),
        p => format!("{p:.3}"),
    }
}

pub(crate) fn pairs(d: &Diagnosis) -> TextTable<&Combination> {
    TextTable::of(&d.pairs)
        .words("", |p| if p.in_set { "=" } else { "" })
        .words("pair", |p| p.effects.join(" + "))
        .words("values, 95 %", |p| listed(&p.parameters))
        .number("after mm", 2, |p| p.systematic_after_mm)
        .number("gain", 0, |p| p.gain)
        .right("p over one", |p| p_cell(p.p_corrected))
        .right("", |p| if p.cancels { "the two cancel" } else { "" })
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

pub(crate) fn witness_heights(w: &Witness) -> TextTable<&Height> {
    TextTable::of(&w.heights)
        .words("actuator kPa", |h| short(h.actuator_kpa))
        .number("measured", 1, |h| h.measured_mm)
        .number("calibrated B", 1, |h| h.base_mm)
        .number("final model", 1, |h| h.best_mm)
        .right("finite elements", |h| over_seeds(Some((h.fe_mm, h.fe_sd_mm)), 1))
}

/// Ledgers of the models, then of the finite elements; none without the latter.
pub(crate) fn witness_ledgers(w: &Witness) -> Option<TextTable<(&str, &Energies, Option<f64>)>> {
    let fe = w.fe_mj.as_ref().map(|fe| ("finite elements", fe, None))?;
    let models = w.models.iter().map(|m| (m.name.as_str(), &m.energies_mj, Some(m.apart_mj)));
    let mut ledgers = TextTable::of(models.chain([fe])).words("energies mJ", |(name, ..)| *name);
    for (k, term) in TERMS.into_iter().enumerate() {
        ledgers = ledgers.number(term, 0, |(_, energies_mj, _)| energies_mj[k]);
    }
    Some(ledgers.number("apart", 0, |(.., apart_mj)| *apart_mj))
}

pub(crate) fn unseen(d: &Diagnosis) -> TextTable<&Undetectable> {
    let unknown = if d.noise.camera_mm.is_some() { "not within its bounds" } else { "not known" };
    TextTable::of(&d.undetectable)
        .words("effect", |u| &u.effect)
        .right("size", |u| u.smallest_detectable.map_or(unknown.into(), |s| with_unit(&three(s), &u.unit)))
        .number("times typical", 2, |u| u.times_typical)
}

/// Experiments that were thought through, with a title; none without them.
pub(crate) fn experiments(d: &Diagnosis) -> Option<(String, TextTable<TriedProtocol<'_>>)> {
    let next = d.next_experiment.as_ref().filter(|next| !next.tried.is_empty())?;
    let tried = next.tried.iter().map(|e| (e.name.as_str(), e.shown_protocol(), e.needed, &e.separations[..]));
    let mut rows = TextTable::of(std::iter::once(("data at hand", "–", next.needed_now, &next.now[..])).chain(tried))
        .words("experiment", |(name, ..)| *name)
        .words("protocol [kPa]", |(_, protocol, ..)| *protocol)
        .number("suffices", 0, |(_, _, needed, _)| *needed);
    for (k, rival) in next.now.iter().enumerate() {
        rows = rows.number(&rival.rival, 1, |(.., found)| found.get(k).map(|s| s.lambda));
    }
    Some((format!("Expected separation λ of {} from", next.best), rows))
}

/// Name, protocol, runs that suffice, separations from the rivals.
pub(crate) type TriedProtocol<'a> = (&'a str, &'a str, f64, &'a [Separation]);
