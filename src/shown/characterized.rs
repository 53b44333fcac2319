//! What tests of a fabric say.

use crate::output::program;
use crate::tables::{number, table};
use compare::characterize::write::measured_toml;
use compare::characterize::{Characterized, FabricNumber as Number, Replay, Specimen};
use data::Direction;
use serde_json::{Value, json};

/// For readers.
pub fn text(found: &Characterized) -> String {
    let count = |d: Direction| format!("{} at {}°", found.of(d).count(), d.degrees());
    let directions = found.directions().into_iter().map(count).collect::<Vec<_>>().join(", ");
    let mut text = format!("Specimens: {directions} ({})\n", found.provenance.word());
    let row = |q: &Number| {
        let interval =
            q.scatter.interval().map_or("–".into(), |[low, high]| format!("{} – {}", digits(low), digits(high)));
        let sd = q.scatter.sd.map_or("–".into(), digits);
        vec![
            q.name.clone(),
            q.known.clone(),
            digits(q.scatter.mean),
            q.unit.into(),
            interval,
            sd,
            q.scatter.n.to_string(),
        ]
    };
    let head = ["quantity", "how known", "mean", "unit", "95 % interval of the mean", "sd", "n"];
    text.push_str(&table(&head, 2, found.quantities.iter().map(row).collect()));
    text.push_str(&table(
        &["specimen", "direction", "slack [%]", "modulus [MPa]", "C10 [MPa]", "largest strain [%]", "locking [°]"],
        1,
        found.specimens.iter().map(specimen_row).collect(),
    ));
    if !found.replays.is_empty() {
        text.push_str(
            "Every test by the law that was made of them: law over test, at the end and rms of the largest stress\n",
        );
        text.push_str(&table(&["law", "specimen", "direction", "used", "at the end", "rms"], 4, replay_rows(found)));
    }
    found.warnings.iter().for_each(|w| text.push_str(&format!("look at: {w}\n")));
    found.notes.iter().for_each(|n| text.push_str(&format!("note: {n}\n")));
    text
}

fn replay_rows(found: &Characterized) -> Vec<Vec<String>> {
    let row = |r: &Replay| {
        let s = &found.specimens[r.specimen];
        vec![
            r.law.clone(),
            s.name.clone(),
            format!("{}°", s.direction.degrees()),
            if r.used { "for the law" } else { "check" }.into(),
            format!("{:+.1} %", 100.0 * r.at_end),
            format!("{:.1} %", 100.0 * r.rms),
        ]
    };
    found.replays.iter().map(row).collect()
}

fn specimen_row(s: &Specimen) -> Vec<String> {
    let strip = s.strip.as_ref();
    let locking = strip.and_then(|strip| strip.locking).map(|l| l.angle.to_degrees());
    let stretched = strip.and_then(|strip| Some(strip.pulled.last()?[0] / strip.size.length_m));
    let strain = s.stress.last().map(|row| row[0]).or(stretched);
    vec![
        s.name.clone(),
        format!("{}°", s.direction.degrees()),
        if s.slack > 0.0 { format!("{:.3}", 100.0 * s.slack) } else { "–".into() },
        s.modulus_pa.map_or("–".into(), |e| digits(1e-6 * e)),
        s.c10_pa.map_or("–".into(), |c| digits(1e-6 * c[0])),
        number(strain.map(|e| 100.0 * e), 1),
        number(locking, 1),
    ]
}

/// Four digits.
fn digits(x: f64) -> String {
    let decimals = (3 - x.abs().max(1e-3).log10().floor() as i32).clamp(0, 6) as usize;
    format!("{x:.decimals$}")
}

/// `ibr.characterize`
pub fn to_json(found: &Characterized, fabric: Option<&str>) -> Value {
    let quantity = |q: &Number| {
        json!({
            "key": q.key, "name": q.name, "unit": q.unit, "mean": q.scatter.mean, "sd": q.scatter.sd,
            "interval": q.scatter.interval(), "specimens": q.scatter.n, "how_known": q.known,
        })
    };
    let specimen = |s: &Specimen| {
        let strip = s.strip.as_ref();
        json!({
            "specimen": s.name, "file": s.file, "direction_deg": s.direction.degrees(), "modulus_pa": s.modulus_pa,
            "modulus_to_strain": s.modulus_strain, "slack_strain": s.slack, "poisson": s.poisson, "c10_pa": s.c10_pa.map(|c| c[0]),
            "locking_rad": strip.and_then(|s| s.locking).map(|l| l.angle),
            "shear_rad_n_per_m": strip.map(|s| &s.shear),
        })
    };
    let replay = |r: &Replay| {
        json!({
            "law": r.law, "specimen": found.specimens[r.specimen].name, "used_for_the_law": r.used,
            "direction_deg": found.specimens[r.specimen].direction.degrees(), "at_end": r.at_end, "rms": r.rms,
        })
    };
    let yarn = |direction| found.yarns.iter().find(|y| y.direction == direction).map(|y| &y.rows);
    json!({
        "schema": "ibr.characterize",
        "version": 1,
        "provenance": found.provenance.word(),
        "quantities": found.quantities.iter().map(quantity).collect::<Vec<_>>(),
        "specimens": found.specimens.iter().map(specimen).collect::<Vec<_>>(),
        "warp_strain_pa": yarn(Direction::Warp),
        "fill_strain_pa": yarn(Direction::Fill),
        "shear_rad_n_per_m": found.shear.as_ref().map(|s| &s.rows),
        "shear_rad_pa": found.shear.as_ref().and_then(|s| s.moment_pa.as_ref()),
        "thickness_m": found.thickness_m,
        "replays": found.replays.iter().map(replay).collect::<Vec<_>>(),
        "warnings": found.warnings,
        "notes": found.notes,
        "fabric_toml": fabric,
        "measured_toml": measured_toml(found, &program()),
    })
}
