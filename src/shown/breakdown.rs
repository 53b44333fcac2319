//! Where the engines part, in words.

use crate::prelude::*;
use compare::study::breakdown::Parting;
use compare::study::columns::{TextColumn, TextTable};
use compare::study::engines::SHAPE;

/// `ibr.breakdown`: `ibr breakdown`
#[derive(Serialize)]
pub(crate) struct Breakdown<'a> {
    /// One robot at one pressure
    pub cells: &'a [Parting],
}

const COLUMNS: [TextColumn<Parting>; 11] = [
    ("robot", |row| row.robot.clone()),
    ("mesh mm", |row| row.mesh_mm.to_string()),
    ("body kPa", |row| row.body_kpa.to_string()),
    ("pouch mm", |row| row.pouch_mm.to_string()),
    ("actuator kPa", |row| format!("{:.0}", row.actuator_kpa)),
    ("FE tip mm", |row| format!("{:.1}", row.fe_tip_mm)),
    ("bare tip mm", |row| format!("{:.1}", row.bare_tip_mm)),
    ("difference %", |row| percent(row.bare_difference)),
    ("reduced tip mm", |row| format!("{:.1}", row.reduced_tip_mm)),
    ("difference %", |row| percent(row.difference)),
    ("carried by", |row| {
        let words = row.carried_by.map(|c| format!("{} ({:+.0} % without)", c.term, 100.0 * c.difference_without));
        words.unwrap_or("–".into())
    }),
];

fn percent(share: Option<f64>) -> String {
    share.map_or("–".into(), |d| format!("{:+.0}", 100.0 * d))
}

/// Every run at every pressure; then arm, width, height and volumes of both engines, where a run kept them.
pub(crate) fn text(rows: &[Parting]) -> String {
    let all = TextTable::of("", 1, &COLUMNS, rows);
    let shape = |row: &Parting| {
        let shape = row.shape.as_ref()?;
        let both = shape.reduced.iter().zip(shape.fe);
        let both = both.map(|(own, fe)| format!("{own:.1} / {fe:.1} ({:+.1})", 100.0 * (own / fe - 1.0)));
        let place = [0, 2, 3, 4].map(|column| COLUMNS[column].1(row));
        Some(place.into_iter().chain(both).collect())
    };
    let shapes: Vec<Vec<String>> = rows.iter().filter_map(shape).collect();
    if shapes.is_empty() {
        return printed(&all);
    }
    let names = SHAPE.iter().enumerate().map(|(k, name)| format!("{name} {}", if k < 3 { "mm" } else { "cm³" }));
    let heads: Vec<String> = [0, 2, 3, 4].map(|column| COLUMNS[column].0.into()).into_iter().chain(names).collect();
    let caption = "Inflated pouches and body: reduced model / finite elements (difference in %)";
    format!("{}\n{caption}\n{}", printed(&all), Table::finished(&heads, 1, shapes).text())
}
