//! Where the engines part, in words.

use crate::tables::table;
use compare::study::breakdown::Parting;
use compare::study::engines::{EnginePair, SHAPE};

fn percent(pair: &EnginePair) -> String {
    pair.difference().map_or("–".into(), |d| format!("{:+.0}", 100.0 * d))
}

/// Every run at every pressure.
pub fn text(rows: &[Parting]) -> String {
    let head = [
        "robot",
        "mesh mm",
        "body kPa",
        "pouch mm",
        "actuator kPa",
        "FE tip mm",
        "bare tip mm",
        "difference %",
        "reduced tip mm",
        "difference %",
        "carried by",
    ];
    let row = |Parting { run, bare, own: p }: &Parting| {
        vec![
            run.actuator.clone(),
            run.mesh_mm[1].to_string(),
            run.body_kpa.to_string(),
            run.pouch_mm.to_string(),
            format!("{:.0}", p.actuator_kpa),
            format!("{:.1}", p.fe_mm[1]),
            format!("{:.1}", bare.reduced_mm[1]),
            percent(bare),
            format!("{:.1}", p.reduced_mm[1]),
            percent(p),
            p.carrier.map_or("–".into(), |c| format!("{} ({:+.0} % without)", c.term, 100.0 * c.difference_without)),
        ]
    };
    let shapes = shapes(rows);
    table(&head, 1, rows.iter().map(row).collect()) + &shapes
}

/// Arm, width, height and volumes of both, where a run kept them.
fn shapes(rows: &[Parting]) -> String {
    let row = |cell: &Parting| {
        let [own, fe] = cell.own.shape?;
        let Parting { run, own: p, .. } = cell;
        let place =
            [&run.actuator, &run.body_kpa.to_string(), &run.pouch_mm.to_string(), &format!("{:.0}", p.actuator_kpa)];
        let both = own.iter().zip(fe).map(|(own, fe)| format!("{own:.1} / {fe:.1} ({:+.1})", 100.0 * (own / fe - 1.0)));
        Some(place.into_iter().cloned().chain(both).collect::<Vec<_>>())
    };
    let found: Vec<_> = rows.iter().filter_map(row).collect();
    if found.is_empty() {
        return String::new();
    }
    let of = |name: &str, unit: &str| format!("{name} {unit}");
    let names = SHAPE.iter().enumerate().map(|(k, name)| of(name, if k < 3 { "mm" } else { "cm³" }));
    let head: Vec<String> =
        ["robot", "body kPa", "pouch mm", "actuator kPa"].map(String::from).into_iter().chain(names).collect();
    format!(
        "\nInflated pouches and body: reduced model / finite elements (difference in %)\n{}",
        table(&head, 1, found)
    )
}
