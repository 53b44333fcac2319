//! A diagnosis in words and tables: every candidate, and what those that matter mean.

use super::tables::{column, number, words};
use compare::diagnosis::{Answer, Combination, Diagnosis, ParameterValue, Ranked, Standing, Verdict};
use compare::wording::p_value;
use report::page::{Block, Callout, Table};

/// Explanations told in plain words; the tables have all.
const MOST_TOLD: usize = 6;

/// Every effect alone, refitted with B.
pub(super) fn ranking_table(d: &Diagnosis) -> Block {
    let row = |r: &Ranked| {
        let stated = |name: &String| name.split(" + ").any(|part| part == r.effect);
        let mark = match () {
            () if d.indistinguishable.contains(&r.effect) => "cannot be told apart",
            () if d.indistinguishable.iter().any(stated) => "in a pair that cannot be told apart",
            () if d.attempt.iter().any(|a| a.effect == r.effect) => d.attempt_words(),
            () if r.at_bound => "on a bound: rejected",
            () => "",
        };
        vec![
            r.effect.clone(),
            r.group.word().into(),
            listed(&r.parameters),
            number(Some(r.systematic_after_mm), 2),
            number(r.heldout_mm, 2),
            number(r.heldout_run_mm, 2),
            format!("{:.0}", r.gain),
            bare_p(r.p_corrected),
            mark.into(),
        ]
    };
    Block::Table(Table {
        caption: format!(
            "Every effect alone, refitted with B (without any: {:.2} mm). Values are calibrated on these data",
            d.base.systematic_mm
        ),
        columns: vec![
            words("effect"),
            words("group"),
            words("value, 95 % interval"),
            column("after", "mm"),
            column("pressures left out", "mm"),
            column("runs left out", "mm"),
            column("gain", ""),
            column("p corrected", ""),
            words("note"),
        ],
        rows: d.ranked.iter().map(row).collect(),
        how_column: None,
    })
}

fn bare_p(p: Option<f64>) -> String {
    p.map_or("–".into(), |p| p_value(p).trim_start_matches("p = ").replace("p < ", "< "))
}

/// Pairs, where a single effect is not enough.
pub(super) fn pairs_table(d: &Diagnosis) -> Option<Block> {
    let row = |p: &Combination| {
        let note = match (p.in_set && d.verdict == Some(Verdict::Effect), p.cancels) {
            (true, true) => "cannot be told apart; the two cancel each other",
            (true, false) => "cannot be told apart",
            (false, true) => "the two cancel each other",
            (false, false) => "",
        };
        vec![
            p.effects.join(" + "),
            listed(&p.parameters),
            number(Some(p.systematic_after_mm), 2),
            format!("{:.0}", p.gain),
            bare_p(p.p_corrected),
            note.into(),
        ]
    };
    (!d.pairs.is_empty()).then(|| {
        Block::Table(Table {
            caption: "Pairs, refitted with B; p of the gain over the best single effect".into(),
            columns: vec![
                words("pair"),
                words("values, 95 % interval"),
                column("after", "mm"),
                column("gain", ""),
                column("p corrected", ""),
                words("note"),
            ],
            rows: d.pairs.iter().map(row).collect(),
            how_column: None,
        })
    })
}

/// What the stated explanations mean, or the attempt: values of their own fit, then every effect in them once.
pub(super) fn candidate_blocks(d: &Diagnosis) -> Vec<Block> {
    if d.verdict == Some(Verdict::None) {
        return vec![Block::Paragraph("None is needed.".into())];
    }
    let mut blocks = Vec::new();
    if !d.rule_out_first.is_empty() {
        let text = format!("Rule out before physics is blamed: {}.", d.rule_out_first.join(", "));
        blocks.push(Block::Callout { kind: Callout::Warning, text });
    }
    let answers = d.answers();
    let told: Vec<&Answer> =
        answers.iter().filter(|a| matches!(a.standing, Standing::Stated | Standing::Attempt)).collect();
    let mut explained: Vec<&str> = Vec::new();
    for answer in told.iter().take(MOST_TOLD) {
        blocks.push(Block::Paragraph(fitted(d, answer)));
        for (r, _) in &answer.effects {
            if !explained.contains(&r.effect.as_str()) {
                explained.push(&r.effect);
                blocks.push(Block::List(meaning(r, answer.effects.len() == 1)));
            }
        }
    }
    if told.len() > MOST_TOLD {
        let rest: Vec<String> = told[MOST_TOLD..].iter().map(|a| a.name()).collect();
        blocks.push(Block::Paragraph(format!("Not told apart either: {}.", rest.join(", "))));
    }
    blocks
}

/// An answer with the values of its fit and what it brings.
fn fitted(d: &Diagnosis, answer: &Answer) -> String {
    let values: Vec<String> = answer.effects.iter().map(|(r, values)| of_effect(r, values, answer)).collect();
    let cancels = d.pairs.iter().any(|p| p.cancels && p.effects.join(" + ") == answer.name());
    let (before, after) = (d.base.systematic_mm, answer.after_mm);
    format!(
        "**{}**{}: {}; {before:.2} → {after:.2} mm{}.",
        answer.name(),
        if answer.standing == Standing::Attempt { format!(", {}", d.attempt_words()) } else { String::new() },
        values.join("; "),
        if cancels { "; the two cancel each other" } else { "" }
    )
}

fn of_effect(r: &Ranked, values: &[ParameterValue], answer: &Answer) -> String {
    if answer.effects.len() == 1 { listed(values) } else { format!("{}, {}", r.effect, listed(values)) }
}

/// What an effect is, shows and asks for. Notes of its own fit are no notes of a pair's.
fn meaning(r: &Ranked, alone: bool) -> Vec<String> {
    let mut lines = vec![
        format!("{} ({}): {}", r.effect, r.group.word(), r.sentence),
        format!("Seen in data: {}", r.differs),
        format!("Check: {}", r.remedy),
    ];
    lines.extend(r.notes.iter().filter(|_| alone).map(|n| format!("Note: {n}")));
    lines
}

fn with_interval(p: &ParameterValue) -> String {
    let short = compare::wording::short;
    let digits = |v: f64| if v.abs() >= 100.0 { short(v) } else { three(v) };
    let unit = if p.unit == "-" { String::new() } else { format!(" {}", p.unit) };
    match (p.lo, p.hi) {
        (Some(lo), Some(hi)) => format!("{} = {} ({} to {}){unit}", p.symbol, digits(p.value), digits(lo), digits(hi)),
        _ => format!("{} = {}{unit}{}", p.symbol, digits(p.value), p.held_mark()),
    }
}

/// Three significant digits.
pub(super) fn three(v: f64) -> String {
    match v.abs() {
        0.0 => "0".into(),
        s if s < 1e-3 => format!("{v:.1e}"),
        s => format!("{v:.*}", (2 - s.log10().floor() as i32).max(0) as usize),
    }
}

fn listed(values: &[ParameterValue]) -> String {
    values.iter().map(with_interval).collect::<Vec<_>>().join(", ")
}
