//! A diagnosis of bench tests.

use super::diagnosis_tables::p_text;
use crate::tables::{number, table};
use compare::diagnosis::words::listed;
use compare::diagnosis::{BenchDiagnosis, BenchRanked, Verdict};
use data::Bench;

/// For readers.
pub fn text(d: &BenchDiagnosis, bench: &Bench) -> String {
    let mut out = format!("{} held against {}, {} rows ({})\n\n", d.scenario, d.table, d.rows, bench.provenance.word());
    let verdict = match d.verdict {
        Some(Verdict::None) => "no missing effect detectable",
        Some(Verdict::TooSmall) => "more than noise, too small to name",
        Some(Verdict::Effect) => "an effect is missing",
        Some(Verdict::OutOfCatalog) => "something is missing that no single effect of the catalogue explains",
        None => "none: ranking only",
    };
    out.push_str(&format!("Verdict: {verdict}\n"));
    d.summary.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    out.push_str(&ranking(d));
    for r in d.set().filter(|_| d.verdict != Some(Verdict::None)) {
        let BenchRanked { effect, sentence, differs, remedy, .. } = r;
        let group = r.group.word();
        out.push_str(&format!("\n{effect} ({group}): {sentence}\n  shows: {differs}\n  check: {remedy}\n"));
    }
    out.push_str("\nWhere the model as it is fails:\n");
    d.where_it_fails.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    if let Some(best) = d.set().next() {
        out.push_str(&format!("\nWhere it fails with {}:\n", best.effect));
        d.leftover.iter().for_each(|s| out.push_str(&format!("  - {s}\n")));
    }
    out
}

fn ranking(d: &BenchDiagnosis) -> String {
    let percent = |share: f64| number(Some(100.0 * share).filter(|v| v.is_finite()), 1);
    let left_out = d.left_out.iter().map(|l| format!("left-out {} %", l.what));
    let head: Vec<String> = ["", "effect", "value, 95 %", "off %"]
        .map(String::from)
        .into_iter()
        .chain(left_out)
        .chain(["gain", "p corrected"].map(String::from))
        .collect();
    let row = |r: &BenchRanked| {
        let mark = if r.at_bound { "!" } else { "" };
        let mark = if r.in_set && d.verdict != Some(Verdict::None) { "=" } else { mark };
        let values = listed(&r.parameters);
        let mut cells = vec![mark.to_string(), r.effect.clone(), values, percent(r.off)];
        cells.extend(r.left_out.iter().map(|l| percent(l.off)));
        cells.extend([format!("{:.1}", r.gain), r.p_corrected.map_or("–".into(), p_text)]);
        cells
    };
    let base: Vec<String> =
        d.left_out.iter().map(|l| format!(", {} at left-out {}s", percent(l.off), l.what)).collect();
    let rows = table(&head, 3, d.ranked.iter().map(row).collect());
    let legend = "= cannot be told from the best · ! on a physical bound, rejected";
    format!("\nEach effect alone (model as it is: {} % off{}):\n{rows}{legend}\n", percent(d.off), base.concat())
}
