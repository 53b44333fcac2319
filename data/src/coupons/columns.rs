//! Comments and header line of a tensile test: which column holds what, in which unit.

use super::coupon::CouponDefaults;
use crate::about::Provenance;
use crate::columns::{self, Field, Head, Note, TableSheet, field, meaning, plain};
use crate::error::{DataError, Result};
use crate::lines::LineReader;
use crate::units::MeasuredQuantity::{Angle, Force, Length, Pressure, Ratio};

pub(super) const STRAIN: usize = 0;
pub(super) const STRESS: usize = 1;
pub(super) const DISPLACEMENT: usize = 2;
pub(super) const FORCE: usize = 3;
pub(super) const SPECIMEN: usize = 4;
pub(super) const DIRECTION: usize = 5;
pub(super) const WIDTH: usize = 6;
pub(super) const LENGTH: usize = 7;
pub(super) const THICKNESS: usize = 8;
pub(super) const LOADED_WIDTH: usize = 9;

pub(super) const QUANTITIES: &[Field] = &[
    field("strain", "strain_pct", Ratio, false),
    field("stress", "stress_mpa", Pressure, false),
    field("displacement", "displacement_mm", Length, false),
    field("force", "force_n", Force, false),
    plain("specimen", false),
    field("direction", "direction_deg", Angle, false),
    field("width", "width_mm", Length, false),
    field("length", "length_mm", Length, false),
    field("thickness", "thickness_mm", Length, false),
    field("loaded_width", "loaded_width_mm", Length, false),
];

const EXPECTED: &str = "strain_pct,stress_mpa or displacement_mm,force_n, and if you like specimen, direction_deg, \
                      width_mm, length_mm, thickness_mm, loaded_width_mm";

/// What the comments above the header give, in SI units.
#[derive(Debug, Clone, Default)]
pub(super) struct Facts {
    pub numbers: [Option<f64>; QUANTITIES.len()],
    pub specimen: Option<String>,
    pub provenance: Provenance,
}

pub(super) fn read(lines: &mut LineReader, defaults: &CouponDefaults) -> Result<(Facts, TableSheet)> {
    let (notes, head) = Head::read(lines)?;
    let facts = facts(&notes)?;
    let Some(mut head) = head else {
        let help = format!("the first line must name the columns: {EXPECTED}");
        return Err(DataError::of(lines.file(), "the file is empty", help));
    };
    let (written, replaced) = (head.names.len(), defaults.columns.len());
    if ![0, written].contains(&replaced) {
        let message = format!("the header has {written} columns, --columns names {replaced}");
        let help = "name every column, for example displacement_mm,force_n";
        return Err(head.line.line().fault(message, help));
    }
    if replaced > 0 {
        head.names.clone_from(&defaults.columns);
    }
    let sheet = head.sheet(QUANTITIES)?;
    complete(&sheet)?;
    Ok((facts, sheet))
}

fn facts(notes: &[Note]) -> Result<Facts> {
    let (own, numbers) = QUANTITIES.split_at(DIRECTION);
    notes.iter().try_for_each(|note| misspelt(note, numbers))?;
    let mut facts = Facts { provenance: columns::provenance(notes)?, ..Facts::default() };
    facts.numbers[own.len()..].copy_from_slice(&columns::shared(numbers, notes)?);
    let named = notes.iter().rev().find(|note| note.key == "specimen").map(|note| note.text.clone());
    facts.specimen = named.filter(|name| !name.is_empty());
    Ok(facts)
}

/// A comment that is nearly a key would be lost without a word.
fn misspelt(note: &Note, numbers: &[Field]) -> Result<()> {
    let Note { key, text, .. } = note;
    let keys = numbers.iter().map(|field| field.expected).chain(["specimen", "provenance"]);
    let is_key = meaning(key, numbers).is_some();
    let near = spelling::nearest(key, keys).filter(|_| !is_key && key.contains('_') && !key.contains(' '));
    let Some(near) = near else { return Ok(()) };
    let help = format!("did you mean # {near}: {text}? any other comment is fine without `_` before the colon");
    Err(note.wrong(format!("`{key}` is not known"), help))
}

/// Exactly one whole curve must be there.
fn complete(sheet: &TableSheet) -> Result<()> {
    let (line, has) = (sheet.head.line.line(), [STRAIN, STRESS, DISPLACEMENT, FORCE].map(|field| sheet.has(field)));
    match has {
        [true, true, false, false] | [false, false, true, true] => return Ok(()),
        [true, true, ..] | [.., true, true] => {
            let help = "keep strain and stress, or displacement and force; rename the others, for example raw_force";
            return Err(line.fault("the columns give more than one curve", help));
        }
        _ => {}
    }
    let named = sheet.head.without_unit(QUANTITIES, |_| Some(true));
    let more = ". Without touching the file: --columns displacement_mm,force_n names all columns";
    named.map_err(|error| error.with_help(more))?;
    let missing = match has {
        [true, ..] => STRESS,
        [_, true, ..] => STRAIN,
        [.., true] => DISPLACEMENT,
        _ => FORCE,
    };
    let expected = QUANTITIES[missing].expected;
    let near = spelling::nearest(expected, sheet.head.names.iter().map(String::as_str)).filter(|near| !near.is_empty());
    let help =
        near.map_or(format!("the columns are {EXPECTED}"), |near| format!("did you mean {expected} for {near}?"));
    let message = format!("column {expected} is missing; found {}", sheet.head.names.join(", "));
    Err(line.fault(message, help))
}
