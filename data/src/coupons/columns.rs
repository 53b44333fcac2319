//! Comments and header line: which column holds what, in which unit.

use super::CouponDefaults;
use crate::about::Provenance;
use crate::error::{DataError, Fault};
use crate::lines::{Line, Lines};
use crate::units::Measured;
use spelling::units::Unit;

/// A quantity of a tensile test.
pub(super) struct CouponQuantity {
    pub base: &'static str,
    pub expected: &'static str,
    pub dimension: Option<Measured>,
}

const fn number(base: &'static str, expected: &'static str, dimension: Measured) -> CouponQuantity {
    CouponQuantity { base, expected, dimension: Some(dimension) }
}

/// Positions in [`QUANTITIES`].
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

pub(super) const QUANTITIES: [CouponQuantity; 10] = [
    number("strain", "strain_pct", Measured::Ratio),
    number("stress", "stress_mpa", Measured::Pressure),
    number("displacement", "displacement_mm", Measured::Length),
    number("force", "force_n", Measured::Force),
    CouponQuantity { base: "specimen", expected: "specimen", dimension: None },
    number("direction", "direction_deg", Measured::Angle),
    number("width", "width_mm", Measured::Length),
    number("length", "length_mm", Measured::Length),
    number("thickness", "thickness_mm", Measured::Length),
    number("loaded_width", "loaded_width_mm", Measured::Length),
];

const WANTED: &str = "strain_pct,stress_mpa or displacement_mm,force_n, and if you like specimen, direction_deg, \
                      width_mm, length_mm, thickness_mm, loaded_width_mm";

/// A column that holds a quantity.
#[derive(Debug, Clone, Copy)]
pub(super) struct CouponColumn {
    pub index: usize,
    pub unit: Option<Unit>,
}

/// The header line, understood.
#[derive(Debug, Clone)]
pub(super) struct CouponHeader {
    pub names: Vec<String>,
    pub columns: [Option<CouponColumn>; QUANTITIES.len()],
    pub delimiter: char,
    /// Decimals are written with a comma.
    pub comma: bool,
}

/// What the comments above the header say, in SI units.
#[derive(Debug, Clone, Default)]
pub(super) struct Notes {
    pub numbers: [Option<f64>; QUANTITIES.len()],
    pub specimen: Option<String>,
    pub provenance: Option<Provenance>,
}

impl CouponHeader {
    /// x and y of the curve.
    pub fn curve(&self) -> [usize; 2] {
        if self.columns[STRAIN].is_some() { [STRAIN, STRESS] } else { [DISPLACEMENT, FORCE] }
    }

    /// The column of a quantity as the file names it.
    pub fn name(&self, quantity: usize) -> String {
        let named = self.columns[quantity].and_then(|column| self.names.get(column.index));
        named.map_or(QUANTITIES[quantity].expected, String::as_str).to_string()
    }
}

/// Reads comments and header.
pub(super) fn read(lines: &mut Lines, defaults: &CouponDefaults) -> Result<(Notes, CouponHeader), DataError> {
    let mut notes = Notes::default();
    loop {
        let file = lines.file().to_string();
        let Some(line) = lines.next_filled()? else {
            let help = format!("the first line must name the columns: {WANTED}");
            return Err(DataError::Layout(Box::new(Fault::of_file(&file, "the file is empty", help))));
        };
        match line.text.trim_start().strip_prefix('#') {
            Some(comment) => note(&mut notes, comment, &line)?,
            None => return Ok((notes, header(&line, &defaults.columns)?)),
        }
    }
}

/// `key: value` or `key = value`; anything else is a comment.
fn note(notes: &mut Notes, comment: &str, line: &Line) -> Result<(), DataError> {
    let Some((key, value)) = comment.split_once([':', '=']) else { return Ok(()) };
    let (key, value) = (key.trim().to_lowercase(), value.trim());
    if key == "specimen" {
        notes.specimen = Some(value.to_string()).filter(|name| !name.is_empty());
        return Ok(());
    }
    if key == "provenance" {
        notes.provenance = Some(provenance(value, line)?);
        return Ok(());
    }
    match meaning(&key) {
        CouponMeaning::Known(quantity, Some(unit)) if quantity > SPECIMEN => {
            let said = value.parse::<f64>().ok().map(|v| unit.to_si(v)).filter(|v| v.is_finite());
            let wrong =
                || line.fault(format!("{key} must be a number, found \"{value}\""), format!("write # {key}: 20"));
            let said = said.ok_or_else(|| DataError::Cell(wrong()))?;
            if notes.numbers[quantity].replace(said).is_some_and(|before| before != said) {
                let message = format!("{key} is said twice, here as {value}");
                return Err(DataError::Cell(line.fault(message, "keep one of the comments")));
            }
            Ok(())
        }
        CouponMeaning::NoUnit(quantity) if quantity > SPECIMEN => {
            let help = format!("write # {}: {value}", QUANTITIES[quantity].expected);
            Err(DataError::Column(line.fault(format!("{key} has no unit in its name"), help)))
        }
        _ => misspelt(&key, value, line),
    }
}

/// A comment that is nearly a key would be lost without a word.
fn misspelt(key: &str, value: &str, line: &Line) -> Result<(), DataError> {
    let keys = QUANTITIES[SPECIMEN..].iter().map(|q| q.expected).chain(["provenance"]);
    match spelling::nearest(key, keys).filter(|_| key.contains('_') && !key.contains(' ')) {
        Some(near) => {
            let help =
                format!("did you mean # {near}: {value}? any other comment is fine without `_` before the colon");
            Err(DataError::Column(line.fault(format!("`{key}` is not known"), help)))
        }
        None => Ok(()),
    }
}

fn provenance(value: &str, line: &Line) -> Result<Provenance, DataError> {
    let all = [Provenance::Measured, Provenance::Digitised, Provenance::Synthetic, Provenance::Published];
    let found = all.into_iter().find(|p| p.word() == value.to_lowercase());
    let help = "write measured, digitised, synthetic or published";
    found.ok_or_else(|| DataError::Column(line.fault(format!("unknown provenance \"{value}\""), help)))
}

pub(super) fn header(line: &Line, replaced: &[String]) -> Result<CouponHeader, DataError> {
    let delimiter = [b'\t', b';', b',']
        .into_iter()
        .max_by_key(|&d| line.text.bytes().filter(|&byte| byte == d).count())
        .map_or(',', char::from);
    let written: Vec<String> =
        line.text.split(delimiter).map(|name| name.trim().trim_matches('"').trim().to_string()).collect();
    if !replaced.is_empty() && replaced.len() != written.len() {
        let message = format!("the header has {} columns, --columns names {}", written.len(), replaced.len());
        return Err(DataError::Column(line.fault(message, "name every column, for example displacement_mm,force_n")));
    }
    let names = if replaced.is_empty() { written } else { replaced.to_vec() };
    let mut columns = [None; QUANTITIES.len()];
    for (index, name) in names.iter().enumerate() {
        let CouponMeaning::Known(quantity, unit) = meaning(&name.to_lowercase()) else { continue };
        if columns[quantity].replace(CouponColumn { index, unit }).is_some() {
            let help = format!("keep one of them, for example {}", QUANTITIES[quantity].expected);
            let message = format!("two columns hold the {}", QUANTITIES[quantity].base);
            return Err(DataError::Column(line.fault(message, help)));
        }
    }
    let header = CouponHeader { names, columns, delimiter, comma: false };
    complete(&header, line)?;
    Ok(header)
}

/// Exactly one whole curve must be there.
fn complete(header: &CouponHeader, line: &Line) -> Result<(), DataError> {
    let has = |quantity: usize| header.columns[quantity].is_some();
    match ([has(STRAIN), has(STRESS)], [has(DISPLACEMENT), has(FORCE)]) {
        ([true, true], [false, false]) | ([false, false], [true, true]) => return Ok(()),
        ([true, true], _) | (_, [true, true]) => {
            let help = "keep strain and stress, or displacement and force; rename the others, for example raw_force";
            return Err(DataError::Column(line.fault("the columns give more than one curve", help)));
        }
        _ => {}
    }
    let missing = if has(STRAIN) || has(STRESS) {
        if has(STRAIN) { STRESS } else { STRAIN }
    } else if has(FORCE) {
        DISPLACEMENT
    } else {
        FORCE
    };
    let found = header.names.join(", ");
    for name in &header.names {
        let (trouble, quantity) = match meaning(&name.to_lowercase()) {
            CouponMeaning::NoUnit(quantity) => ("has no unit in its name", quantity),
            CouponMeaning::OtherUnit(quantity) => ("has an unknown unit", quantity),
            _ => continue,
        };
        let units = QUANTITIES[quantity].dimension.map(Measured::sentence).unwrap_or_default();
        let help = format!(
            "name it {}; {units}. Without touching the file: --columns displacement_mm,force_n names all columns",
            QUANTITIES[quantity].expected
        );
        return Err(DataError::Column(line.fault(format!("column {name} {trouble}"), help)));
    }
    let expected = QUANTITIES[missing].expected;
    let near = spelling::nearest(expected, header.names.iter().map(String::as_str)).filter(|near| !near.is_empty());
    let help = near.map_or(format!("the columns are {WANTED}"), |near| format!("did you mean {expected} for {near}?"));
    Err(DataError::Column(line.fault(format!("column {expected} is missing; found {found}"), help)))
}

enum CouponMeaning {
    Known(usize, Option<Unit>),
    NoUnit(usize),
    OtherUnit(usize),
    Extra,
}

fn meaning(name: &str) -> CouponMeaning {
    let by_base = |base: &str| QUANTITIES.iter().position(|q| q.base == base);
    if let Some(quantity) = by_base(name) {
        let plain = QUANTITIES[quantity].dimension.is_none();
        return if plain { CouponMeaning::Known(quantity, None) } else { CouponMeaning::NoUnit(quantity) };
    }
    let Some((base, suffix)) = name.rsplit_once('_') else { return CouponMeaning::Extra };
    let Some(quantity) = by_base(base) else { return CouponMeaning::Extra };
    match QUANTITIES[quantity].dimension.and_then(|dimension| dimension.unit(suffix)) {
        Some(unit) => CouponMeaning::Known(quantity, Some(unit)),
        None => CouponMeaning::OtherUnit(quantity),
    }
}
