//! `ibr verify`: the closed forms against their known numbers, then the engine against the closed forms.

use super::tables::table;
use super::{Context, Outcome, verify_fem};
use crate::cli::VerifyArgs;
use crate::failure::{Failure, MISSED};
use serde_json::json;
use verification::exact::{OracleRow, oracle_table};

pub fn run(args: &VerifyArgs, context: &mut Context) -> Result<Outcome, Failure> {
    let rows = if args.only.is_empty() { oracle_table() } else { Vec::new() };
    let wrong: Vec<&OracleRow> = rows.iter().filter(|r| !r.agrees()).collect();
    let mut text = String::new();
    if !rows.is_empty() {
        text.push_str(&if args.all { every(&rows) } else { sections(&rows) });
        for row in &wrong {
            text.push_str(&format!(
                "WRONG: {}, {}: {} expected, {:e} computed\n",
                row.section, row.quantity, row.printed, row.computed
            ));
        }
        text.push_str(&format!(
            "{} of {} numbers reproduced to the last printed digit\n\n",
            rows.len() - wrong.len(),
            rows.len()
        ));
    }
    let engine = verify_fem::run(args, context)?;
    text.push_str(&engine.text);
    let list: Vec<_> = rows
        .iter()
        .map(|r| json!({"section": r.section, "quantity": r.quantity, "expected": r.printed, "computed": r.computed, "agrees": r.agrees()}))
        .collect();
    let code = if wrong.is_empty() && engine.missed == 0 { 0 } else { MISSED };
    let json = json!({
        "schema": "ibr.verify", "version": 1, "wrong": wrong.len(), "rows": list,
        "engine_missed": engine.missed, "engine": engine.json,
    });
    Ok(Outcome { code, notes: engine.notes, ..Outcome::new(text, json) })
}

fn every(rows: &[OracleRow]) -> String {
    let cells = rows.iter().map(|r| {
        let mark = if r.agrees() { "ok" } else { "WRONG" };
        vec![
            r.section.to_string(),
            r.quantity.to_string(),
            r.printed.to_string(),
            format!("{:.10e}", r.computed),
            mark.into(),
        ]
    });
    table(&["section", "quantity", "expected", "computed", ""], 2, cells.collect())
}

fn sections(rows: &[OracleRow]) -> String {
    let mut counts: Vec<(&str, usize, usize)> = Vec::new();
    for row in rows {
        let index = match counts.iter().position(|c| c.0 == row.section) {
            Some(index) => index,
            None => {
                counts.push((row.section, 0, 0));
                counts.len() - 1
            }
        };
        counts[index].1 += 1;
        counts[index].2 += usize::from(row.agrees());
    }
    let cells = counts.iter().map(|c| vec![c.0.to_string(), c.1.to_string(), c.2.to_string()]);
    table(&["section", "numbers", "reproduced"], 1, cells.collect())
}
