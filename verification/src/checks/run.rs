//! `ibr verify`: closed forms and checks, as text, tables and JSON.

use super::{Against, CHECKS, Check, CheckOutcome, CheckedNumber, Figure};
use crate::exact::{OracleRow, oracle_table};
use crate::{Error, Findings, Printed};
use compare::Progress;
use fem::cost::process_seconds;
use fem::record::RecordShape;
use serde::Serialize;

/// Which checks a call of `ibr verify` runs.
#[derive(Debug, Clone, Copy)]
pub struct Choice<'a> {
    /// Also the checks that take long.
    pub slow: bool,
    /// Only these checks, by name, and no closed forms.
    pub only: &'a [String],
}

/// Figures of checks by their name.
pub type Figures = Vec<(&'static str, Figure)>;

/// Closed forms against their known numbers, then the engine against the closed forms.
///
/// # Errors
/// A check that does not exist, or whose run stops.
pub fn verify(choice: &Choice, progress: &mut Progress) -> Result<(Findings, Figures), Error> {
    let checks = chosen(choice)?;
    let rows = if choice.only.is_empty() { oracle_table() } else { Vec::new() };
    let mut parts = if rows.is_empty() { Vec::new() } else { closed_forms(&rows) };
    let (mut cells, mut figures, mut engine) = (Vec::new(), Figures::new(), Vec::new());
    let (mut lines, mut missed) = (0, 0);
    for (i, check) in checks.iter().enumerate() {
        progress(check.name, Some(i as f64 / checks.len() as f64));
        let start = process_seconds();
        let outcome = (check.run)()?;
        let cpu_s = process_seconds() - start;
        missed += outcome.lines.iter().filter(|line| !line.passes()).count();
        lines += outcome.lines.len();
        cells.extend(outcome.lines.iter().enumerate().map(|(n, line)| row(check, line, n == 0, cpu_s)));
        engine.push(engine_check(check, &outcome, cpu_s));
        figures.extend(outcome.figure.map(|figure| (check.name, figure)));
    }
    let head = &["check", "quantity", "measured", "known", "error", "", "CPU-s"];
    parts.push(Printed::table(head, 2, cells.into_iter()));
    parts.push(Printed::Text(format!("{} of {lines} engine results within their limits\n", lines - missed)));
    let left = CHECKS.iter().filter(|c| c.slow).count();
    if !choice.slow && choice.only.is_empty() && left > 0 {
        parts.push(Printed::Text(format!("{left} longer checks were left out; `ibr verify --slow` runs them too\n")));
    }
    let wrong = rows.iter().filter(|r| !r.agrees()).count();
    let list = rows.iter().map(|r| KnownNumber {
        section: r.section,
        quantity: r.quantity,
        expected: r.printed,
        computed: r.computed,
        agrees: r.agrees(),
    });
    let answer = Verified { wrong, rows: list.collect(), engine_missed: missed, engine };
    let json = RecordShape { schema: "ibr.verify", version: 1 }.stamped(&answer);
    Ok((Findings { parts, json, missed: wrong + missed > 0 }, figures))
}

fn closed_forms(rows: &[OracleRow]) -> Vec<Printed> {
    let count = rows.iter().filter(|row| row.agrees()).count();
    let wrong = rows.iter().filter(|row| !row.agrees()).map(|row| {
        format!("WRONG: {}, {}: {} expected, {:e} computed\n", row.section, row.quantity, row.printed, row.computed)
    });
    let cells = rows.chunk_by(|a, b| a.section == b.section).map(|rows| {
        let agree = rows.iter().filter(|row| row.agrees()).count();
        vec![rows[0].section.to_string(), rows.len().to_string(), agree.to_string()]
    });
    let table = Printed::table(&["section", "numbers", "reproduced"], 1, cells);
    let sum = format!("{count} of {} numbers reproduced to the last printed digit\n\n", rows.len());
    vec![table, Printed::Text(wrong.collect::<String>() + &sum)]
}

fn chosen(choice: &Choice) -> Result<Vec<&'static Check>, Error> {
    if choice.only.is_empty() {
        return Ok(CHECKS.iter().filter(|c| choice.slow || !c.slow).collect());
    }
    let find = |name: &String| {
        let known = || CHECKS.iter().map(|c| c.name).collect::<Vec<_>>().join(", ");
        let found = CHECKS.iter().find(|c| c.name == name);
        found.ok_or_else(|| Error::NoCheck { name: name.clone(), known: known() })
    };
    choice.only.iter().map(find).collect()
}

fn row(check: &Check, line: &CheckedNumber, first: bool, cpu_s: f64) -> Vec<String> {
    let known = match line.against {
        Against::Value { exact, tolerance } => format!("{} ± {} %", short(exact), short(100.0 * tolerance)),
        Against::AtMost(limit) => format!("≤ {}", short(limit)),
        Against::AtLeast(limit) => format!("≥ {}", short(limit)),
        Against::Between(low, high) => format!("{} to {}", short(low), short(high)),
    };
    vec![
        if first { check.name.to_string() } else { String::new() },
        line.quantity.clone(),
        short(line.measured),
        known,
        line.error().map_or(String::new(), |e| format!("{:+.2} %", 100.0 * e)),
        if line.passes() { "ok" } else { "MISSED" }.into(),
        if first { format!("{cpu_s:.1}") } else { String::new() },
    ]
}

/// Five digits, in powers of ten only where plain digits would be long.
fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".into()
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (4 - size.log10().floor() as i32).clamp(0, 7) as usize;
        let text = format!("{x:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
    } else {
        format!("{x:.3e}")
    }
}

fn engine_check<'a>(check: &'a Check, outcome: &CheckOutcome, cpu_s: f64) -> EngineCheck<'a> {
    let line = |line: &CheckedNumber| {
        let mut against = Target::default();
        match line.against {
            Against::Value { exact, tolerance } => (against.exact, against.tolerance) = (Some(exact), Some(tolerance)),
            Against::AtMost(limit) => against.at_most = Some(limit),
            Against::AtLeast(limit) => against.at_least = Some(limit),
            Against::Between(low, high) => against.between = Some([low, high]),
        }
        CheckLine { quantity: line.quantity.clone(), measured: line.measured, against, passes: line.passes() }
    };
    let lines = outcome.lines.iter().map(line).collect();
    EngineCheck { check: check.name, sentence: check.sentence, source: check.source, cpu_s, lines }
}

/// `ibr.verify`: `ibr verify`
#[derive(Serialize)]
struct Verified<'a> {
    /// How many computed numbers differ from the known ones.
    wrong: usize,
    /// Numbers of closed forms, each with its known one.
    rows: Vec<KnownNumber<'a>>,
    /// How many lines of finite element checks do not pass.
    engine_missed: usize,
    /// Finite element checks that were run.
    engine: Vec<EngineCheck<'a>>,
}

#[derive(Serialize)]
struct KnownNumber<'a> {
    /// Closed form that the number belongs to.
    section: &'a str,
    /// Quantity and arguments of the number, with unit.
    quantity: &'a str,
    /// Known number, as printed with all its digits.
    expected: &'a str,
    /// Number that this program computes for it.
    computed: f64,
    /// Whether the computed number rounds to the known one.
    agrees: bool,
}

#[derive(Serialize)]
struct EngineCheck<'a> {
    /// Name of the check, as `--only` takes it.
    check: &'a str,
    /// The simulation and the comparison, in one plain sentence.
    sentence: &'a str,
    /// Who or what it comes from
    source: &'a str,
    /// Processor time of the whole check.
    cpu_s: f64,
    /// Numbers of the check, each with what it is compared with.
    lines: Vec<CheckLine>,
}

/// A line of a finite element check.
#[derive(Serialize)]
struct CheckLine {
    /// Name of the compared number, with its unit.
    quantity: String,
    /// Number that the engine gave, in the same unit.
    measured: f64,
    /// Known number or bounds that it is compared with.
    against: Target,
    /// Whether the number is within the bounds.
    passes: bool,
}

/// What a line is compared with.
#[derive(Serialize, Default)]
struct Target {
    /// Known value, in the unit of the line.
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<f64>,
    /// Largest relative difference from it that passes.
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    /// Limit that the number must not exceed.
    #[serde(skip_serializing_if = "Option::is_none")]
    at_most: Option<f64>,
    /// Limit that the number must reach.
    #[serde(skip_serializing_if = "Option::is_none")]
    at_least: Option<f64>,
    /// Lower and upper limit of the number.
    #[serde(skip_serializing_if = "Option::is_none")]
    between: Option<[f64; 2]>,
}
