//! Both engines in words.

use crate::failure::Failure;
use crate::tables::table;
use compare::study::engines::{
    BRANCHES, EngineLine, Engines, HEADS, SUMMARY, TERMS, VOLUMES, VOLUMES_CAPTION, branch_cells, cells, summary,
    volume_cells,
};

/// Tables of a comparison of both engines.
pub fn text(lines: &[EngineLine], engines: &Engines) -> Result<String, Failure> {
    let mut out = String::new();
    let short: Vec<Vec<String>> = engines.robots.iter().map(summary).collect::<Result<Vec<_>, _>>()?.concat();
    if !short.is_empty() {
        out.push_str(
            "Outermost marker at 30 kPa; finite elements: median and 80 % interval over all numbers that nobody measured; as recommended: mean ± standard deviation over seeds\n",
        );
        out.push_str(&table(&SUMMARY, 1, short));
        out.push('\n');
    }
    out.push_str("All pressures that the paper prints\n");
    out.push_str(&table(&HEADS, 1, lines.iter().map(cells).collect()));
    Ok(out + &branches(engines) + &ledgers(engines) + &volumes(engines))
}

fn branches(engines: &Engines) -> String {
    let rows = branch_cells(&engines.robots);
    if rows.is_empty() {
        return String::new();
    }
    format!(
        "\nFinite elements on the way up and down again, mean ± standard deviation over seeds\n{}",
        table(&BRANCHES, 1, rows)
    )
}

fn ledgers(engines: &Engines) -> String {
    let (mut out, mut rows) = (String::new(), Vec::new());
    for robot in &engines.robots {
        let Some(pair) = robot.pairs.last() else { continue };
        for (engine, energies) in [
            ("reduced", Some(pair.reduced_mj)),
            ("finite elements", Some(pair.fe_mj)),
            ("excess at the same bend", pair.excess_mj),
        ] {
            let Some(energies) = energies else { continue };
            let mut row = vec![robot.scenario.actuator.kind.name.to_string(), engine.to_string()];
            row.extend(energies.map(|e| format!("{e:.0}")));
            row.push(if engine == "finite elements" { format!("{:.0}", pair.lost_mj) } else { "–".into() });
            rows.push(row);
        }
        if let Some(carrier) = pair.carrier {
            let without = 100.0 * carrier.difference_without;
            let mut row = vec![String::new(), format!("carried by: {} ({without:+.0} % without)", carrier.term)];
            row.resize(TERMS.len() + 3, String::new());
            rows.push(row);
        }
    }
    if !rows.is_empty() {
        out.push_str("\nLedgers at the highest pressure [mJ]: gas −P ΔV, what is stored, what was lost\n");
        let mut head = vec!["robot", "engine"];
        head.extend(TERMS);
        head.push("lost");
        out.push_str(&table(&head, 2, rows));
    }
    out
}

fn volumes(engines: &Engines) -> String {
    let rows = volume_cells(&engines.robots);
    if rows.is_empty() { String::new() } else { format!("\n{VOLUMES_CAPTION}\n{}", table(&VOLUMES, 1, rows)) }
}
