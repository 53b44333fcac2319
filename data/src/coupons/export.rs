//! What tensile machines export: rows about the test, a row of names, a row of units, several specimens side by side.

use super::columns::{DISPLACEMENT, FORCE, Facts, LENGTH, QUANTITIES, STRAIN, STRESS, THICKNESS, WIDTH};
use super::coupon::CouponDefaults;
use super::curve::Specimens;
use crate::cells::is_nothing;
use crate::error::DataError;
use crate::import::sheet::CellText;
use crate::units::MeasuredQuantity;
use spelling::units::Unit;

/// Words of machines for what they measure; times are known so that they begin a specimen.
const WORDS: [(usize, &str); 5] = [
    (DISPLACEMENT, "extension displacement elongation stroke crosshead standardweg weg traversenweg verlängerung"),
    (STRAIN, "strain dehnung"),
    (FORCE, "load force kraft standardkraft zugkraft"),
    (STRESS, "stress spannung"),
    (TIME, "time zeit prüfzeit"),
];
const TIME: usize = QUANTITIES.len();
const SIZES: [(usize, &[&str]); 3] = [
    (WIDTH, &["width", "breite", "probenbreite"]),
    (THICKNESS, &["thickness", "dicke", "probendicke"]),
    (LENGTH, &["length", "gauge length", "grip separation", "einspannlänge", "messlänge"]),
];
/// Rows looked at for the names of columns.
const LOOKED_AT: usize = 200;

/// A column of one specimen: its index and unit.
type SpecimenColumns = [Option<(usize, Option<Unit>)>; TIME + 1];

/// The specimens of an export, under this program's names; `None` if no row names a curve.
pub(super) fn read<'a>(sheet: &CellText<'a>, defaults: &CouponDefaults) -> Result<Option<Specimens<'a>>, DataError> {
    let lines: Vec<(u64, Vec<&str>)> = sheet.lines().map(|(number, line)| (number, sheet.split(line))).collect();
    let is_curve = |cells: &Vec<&str>| {
        let found: Vec<usize> = cells.iter().filter_map(|cell| quantity(cell)).collect();
        let has = |any: [usize; 2]| any.iter().any(|q| found.contains(q));
        has([DISPLACEMENT, STRAIN]) && has([FORCE, STRESS])
    };
    let Some(at) = lines.iter().take(LOOKED_AT).position(|(_, cells)| is_curve(cells)) else { return Ok(None) };
    let mut facts = sizes(sheet, &lines[..at])?;
    let is_unit = |cells: &[&str]| cells.iter().all(|cell| sheet.number(cell).is_none() || is_nothing(cell));
    let units = lines.get(at + 1).map(|(_, cells)| cells).filter(|cells| is_unit(cells));
    // A first line of names without any unit is this program's own header with a slip, which its reader explains.
    if at == 0 && units.is_none() && lines[at].1.iter().all(|cell| parts(cell).1.is_none()) {
        return Ok(None);
    }
    let blocks = blocks(sheet, &lines[at], units)?;
    facts.numbers[LENGTH] = facts.numbers[LENGTH].or(defaults.length_m);
    let [x, y] = curve(sheet, lines[at].0, &blocks[0], &facts)?;
    // A strain over a force is stretched to a displacement.
    let length_m = facts.numbers[LENGTH].filter(|_| [x, y] == [STRAIN, FORCE]);
    let curve = [if length_m.is_some() { DISPLACEMENT } else { x }, y];
    let columns = curve.map(|quantity| QUANTITIES[quantity].expected.to_string());
    let names = lines[at].1.join(", ");
    let mut told =
        vec![format!("line {} names the columns {names}; used are {} and {}", lines[at].0, columns[0], columns[1])];
    told.extend((blocks.len() > 1).then(|| format!("{} specimens stand side by side", blocks.len())));
    told.extend(sheet.comma.then(|| "decimals are written with a comma".to_string()));
    let labels = labels(lines[..at].last().map(|(_, cells)| cells), &blocks);
    let mut specimens = Specimens { file: sheet.file, curve, columns, facts, told, found: Vec::new() };
    for (block, label) in blocks.iter().zip(&labels) {
        for (number, cells) in &lines[at + 1 + usize::from(units.is_some())..] {
            if let Some([a, b]) = row(sheet, *number, cells, block, [x, y])? {
                let a = length_m.map_or(a, |length_m| a * length_m);
                specimens.push(label, [through_usual(curve[0], a), through_usual(y, b)], *number);
            }
        }
    }
    Ok(Some(specimens))
}

/// A number in SI by way of the usual unit of its quantity, whose digits stored results rest on.
fn through_usual(quantity: usize, value: f64) -> f64 {
    let (usual, shown) = match quantity {
        STRAIN => ("pct", value * 1e2),
        STRESS => ("mpa", value * 1e-6),
        DISPLACEMENT => ("mm", value * 1e3),
        _ => return value,
    };
    QUANTITIES[quantity].unit(usual).map_or(value, |unit| unit.to_si(shown))
}

/// A name without its unit, and the unit: `Load (kN)`, `Dehnung %`, `"Extension"`.
fn parts(text: &str) -> (String, Option<String>) {
    let lower = text.trim().to_lowercase();
    if let (Some(at), true) = (lower.find(['(', '[']), lower.ends_with([')', ']'])) {
        return (lower[..at].trim().to_string(), Some(lower[at + 1..lower.len() - 1].trim().to_string()));
    }
    let is_unit = |word: &str| (0..TIME).any(|q| unit(q, word).is_some());
    match lower.rsplit_once(' ').filter(|(_, last)| is_unit(last)) {
        Some((name, last)) => (name.trim().to_string(), Some(last.to_string())),
        None => (lower.trim_end_matches(':').to_string(), None),
    }
}

fn quantity(text: &str) -> Option<usize> {
    let (name, _) = parts(text);
    let words: Vec<&str> = name.split_whitespace().collect();
    let has = |known: &str| known.split(' ').any(|known| words.contains(&known));
    WORDS.iter().find(|(_, known)| words.len() <= 3 && has(known)).map(|(quantity, _)| *quantity)
}

fn unit(quantity: usize, word: &str) -> Option<Unit> {
    let word = match word.trim_matches(['(', ')', '[', ']', ' ']) {
        "%" => "pct",
        "mm/mm" | "m/m" | "-" => "ratio",
        word => word,
    };
    QUANTITIES.get(quantity)?.unit(&word.to_lowercase())
}

/// Sizes in rows like `Width, 25.00, mm` or `Width (mm), 25`.
fn sizes(sheet: &CellText, rows: &[(u64, Vec<&str>)]) -> Result<Facts, DataError> {
    let mut facts = Facts::default();
    for (number, cells) in rows {
        let (name, own) = parts(cells[0]);
        let Some((size, _)) = SIZES.iter().find(|(_, words)| words.contains(&name.as_str())) else { continue };
        let value = cells.get(1).and_then(|cell| sheet.number(cell));
        let Some(value) = value.filter(|v| v.is_finite()) else { continue };
        let behind = cells.get(2).map(|cell| cell.to_lowercase()).filter(|cell| !cell.is_empty());
        let word = behind.or(own).unwrap_or_default();
        let unit = unit(*size, &word).ok_or_else(|| no_unit(sheet, *number, &name, &word))?;
        facts.numbers[*size] = Some(unit.to_si(value));
    }
    Ok(facts)
}

fn no_unit(sheet: &CellText, number: u64, name: &str, word: &str) -> DataError {
    let message = match word {
        "" => format!("{name} has no unit"),
        word => format!("{name} has the unit {word}, which is not known"),
    };
    let units = MeasuredQuantity::Length.sentence();
    let help = format!("write it behind the name, for example {name} (mm); {units}");
    sheet.fault(number, message, help)
}

/// The columns of every specimen: a new one begins where a quantity comes again.
fn blocks(
    sheet: &CellText,
    (number, names): &(u64, Vec<&str>),
    units: Option<&Vec<&str>>,
) -> Result<Vec<SpecimenColumns>, DataError> {
    let mut blocks: Vec<SpecimenColumns> = Vec::new();
    for (index, text) in names.iter().enumerate() {
        let Some(quantity) = quantity(text) else { continue };
        if blocks.last().is_none_or(|block| block[quantity].is_some()) {
            blocks.push(Default::default());
        }
        let own = parts(text).1.or_else(|| units.and_then(|row| row.get(index)).map(|cell| cell.to_lowercase()));
        let found = own.as_deref().and_then(|word| unit(quantity, word));
        if found.is_none() && quantity != TIME {
            return Err(no_unit(sheet, *number, text, own.as_deref().unwrap_or_default()));
        }
        if let Some(block) = blocks.last_mut() {
            block[quantity] = Some((index, found));
        }
    }
    Ok(blocks)
}

/// Displacement and force where the length between the grips is known, else strain and stress, else strain over force.
fn curve(sheet: &CellText, number: u64, block: &SpecimenColumns, facts: &Facts) -> Result<[usize; 2], DataError> {
    let has = |curve: &[usize; 2]| curve.iter().all(|quantity| block[*quantity].is_some());
    let [whole, strained, mixed] = [[DISPLACEMENT, FORCE], [STRAIN, STRESS], [STRAIN, FORCE]];
    if facts.numbers[LENGTH].is_some() {
        if let Some(found) = [whole, strained, mixed].into_iter().find(has) {
            return Ok(found);
        }
    } else if let Some(found) = [strained, whole].into_iter().find(has) {
        return Ok(found);
    } else if has(&mixed) {
        let message = "the curve is a strain and a force, and the length of the specimen is not known";
        let help = "give the free length between the grips: --length 150mm";
        return Err(sheet.fault(number, message, help));
    }
    let message = "the columns are no displacement with force and no strain with stress";
    Err(sheet.fault(number, message, "export one of these pairs"))
}

/// The label of every specimen: the cell above its names, where each has one, else its number; none for a single one.
fn labels(above: Option<&Vec<&str>>, blocks: &[SpecimenColumns]) -> Vec<String> {
    if blocks.len() == 1 {
        return vec![String::new()];
    }
    let label = |block: &SpecimenColumns| {
        let begin = block.iter().flatten().map(|(index, _)| *index).min()?;
        let label = above?.get(begin)?.replace(',', " ");
        (!label.is_empty()).then_some(label)
    };
    let found: Option<Vec<String>> = blocks.iter().map(label).collect();
    found.unwrap_or_else(|| (1..=blocks.len()).map(|k| k.to_string()).collect())
}

/// A row of a specimen in SI units; `None` where this specimen has ended.
fn row(
    sheet: &CellText,
    number: u64,
    cells: &[&str],
    block: &SpecimenColumns,
    curve: [usize; 2],
) -> Result<Option<[f64; 2]>, DataError> {
    let cell = |quantity: usize| block[quantity].map_or("", |(index, _)| cells.get(index).copied().unwrap_or_default());
    if curve.iter().all(|quantity| is_nothing(cell(*quantity))) {
        return Ok(None);
    }
    let si = |quantity: usize| -> Result<f64, DataError> {
        let value = sheet.number(cell(quantity)).filter(|value| value.is_finite());
        let value = value.ok_or_else(|| sheet.no_number(cell(quantity), number, QUANTITIES[quantity].base))?;
        Ok(block[quantity].and_then(|(_, unit)| unit).map_or(value, |unit| unit.to_si(value)))
    };
    Ok(Some([si(curve[0])?, si(curve[1])?]))
}
