//! Where the engines part, in words.

use crate::tables::Table;
use compare::study::breakdown::{Parting, PartingCell};
use compare::study::engines::{EnginePair, SHAPE};
use serde::Serialize;

/// `ibr.breakdown`: `ibr breakdown`
#[derive(Serialize)]
pub struct Breakdown<'a> {
    /// One robot at one pressure
    pub cells: Vec<PartingCell<'a>>,
}

/// Every run at every pressure.
pub fn text(rows: &[Parting]) -> String {
    let percent = |pair: &EnginePair| pair.difference().map(|d| 100.0 * d);
    let carrier = |r: &&Parting| {
        let carrier = r.own.carrier.as_ref();
        carrier.map_or("–".into(), |c| format!("{} ({:+.0} % without)", c.term, 100.0 * c.difference_without))
    };
    let table = Table::of(rows).words("robot", |r| &r.run.actuator).right("mesh mm", |r| r.run.mesh_mm[1].to_string());
    let table = at(table)
        .number("FE tip mm", 1, |r| r.own.fe_mm[1])
        .number("bare tip mm", 1, |r| r.bare.reduced_mm[1])
        .signed("difference %", 0, |r| percent(&r.bare))
        .number("reduced tip mm", 1, |r| r.own.reduced_mm[1])
        .signed("difference %", 0, |r| percent(&r.own))
        .right("carried by", carrier);
    table.text() + &shapes(rows)
}

/// Where the run is.
fn at(table: Table<&Parting>) -> Table<&Parting> {
    table.right("body kPa", |r| r.run.body_kpa.to_string()).right("pouch mm", |r| r.run.pouch_mm.to_string()).number(
        "actuator kPa",
        0,
        |r| r.own.actuator_kpa,
    )
}

/// Arm, width, height and volumes of both, where a run kept them.
fn shapes(rows: &[Parting]) -> String {
    let found = rows.iter().filter(|r| r.own.shape.is_some());
    let mut table = at(Table::of(found).words("robot", |r| &r.run.actuator));
    for (k, name) in SHAPE.iter().enumerate() {
        table = table.right(format!("{name} {}", if k < 3 { "mm" } else { "cm³" }), |r| {
            let [own, fe] = r.own.shape.map_or([f64::NAN; 2], |[own, fe]| [own[k], fe[k]]);
            format!("{own:.1} / {fe:.1} ({:+.1})", 100.0 * (own / fe - 1.0))
        });
    }
    table.under("Inflated pouches and body: reduced model / finite elements (difference in %)")
}
