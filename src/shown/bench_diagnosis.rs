//! A diagnosis of bench tests.

use super::diagnosis_tables::p_text;
use crate::prelude::*;
use compare::diagnosis::words::listed;
use compare::diagnosis::{BenchDiagnosis, BenchRanked, Verdict};
use data::Bench;

/// `ibr.diagnose.bench`: `ibr diagnose TABLE`, a table of bench tests
#[derive(Serialize)]
pub(crate) struct BenchDiagnosisAnswer<'a> {
    /// What was found
    #[serde(flatten)]
    pub found: &'a BenchDiagnosis,
    /// How its numbers came to be
    pub provenance: Provenance,
}

pub(crate) fn text(d: &BenchDiagnosis, bench: &Bench) -> String {
    let verdict = match d.verdict {
        Some(Verdict::None) => "no missing effect detectable",
        Some(Verdict::TooSmall) => "more than noise, too small to name",
        Some(Verdict::Effect) => "an effect is missing",
        Some(Verdict::OutOfCatalog) => "something is missing that no single effect of the catalogue explains",
        None => "none: ranking only",
    };
    let head = format!("{} held against {}, {} rows ({})", d.scenario, d.table, d.rows, bench.provenance.word());
    let mut out = format!("{head}\n\nVerdict: {verdict}\n{}{}", lines("  - ", &d.summary), ranking(d));
    for r in d.set().filter(|_| d.verdict != Some(Verdict::None)) {
        let BenchRanked { effect, sentence, differs, remedy, .. } = r;
        let group = r.group.word();
        out += &format!("\n{effect} ({group}): {sentence}\n  shows: {differs}\n  check: {remedy}\n");
    }
    out += &format!("\nWhere the model as it is fails:\n{}", lines("  - ", &d.where_it_fails));
    if let Some(best) = d.set().next() {
        out += &format!("\nWhere it fails with {}:\n{}", best.effect, lines("  - ", &d.leftover));
    }
    out
}

fn ranking(d: &BenchDiagnosis) -> String {
    let mark = |r: &&BenchRanked| match (r.in_set && d.verdict != Some(Verdict::None), r.at_bound) {
        (true, _) => "=",
        (false, true) => "!",
        (false, false) => "",
    };
    let mut rows = Table::of(&d.ranked)
        .words("", mark)
        .words("effect", |r| &r.effect)
        .words("value, 95 %", |r| listed(&r.parameters))
        .number("off %", 1, |r| 100.0 * r.off);
    for (k, left) in d.left_out.iter().enumerate() {
        rows = rows.number(format!("left-out {} %", left.what), 1, |r| r.left_out.get(k).map(|l| 100.0 * l.off));
    }
    let rows =
        rows.number("gain", 1, |r| r.gain).right("p corrected", |r| r.p_corrected.map_or("–".into(), p_text)).text();
    let percent = |share: f64| number(Some(100.0 * share), 1);
    let base: String = d.left_out.iter().map(|l| format!(", {} at left-out {}s", percent(l.off), l.what)).collect();
    let legend = "= cannot be told from the best · ! on a physical bound, rejected";
    format!("\nEach effect alone (model as it is: {} % off{base}):\n{rows}{legend}\n", percent(d.off))
}
