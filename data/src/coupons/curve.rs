//! Rows become the curves of specimens, each checked as a whole.

use super::columns::{DIRECTION, Facts, LENGTH, LOADED_WIDTH, QUANTITIES, SPECIMEN, STRAIN, THICKNESS, WIDTH};
use super::coupon::{Coupon, CouponDefaults, Direction, Pulled};
use crate::cells::stem;
use crate::columns::{Field, TableRow};
use crate::error::DataError;
use crate::policy;
use std::fmt::Display;

/// All specimens of a file, as far as it has been read.
pub(super) struct Specimens<'a> {
    pub file: &'a str,
    /// x and y of the curve.
    pub curve: [usize; 2],
    /// Their columns as the file names them.
    pub columns: [String; 2],
    pub facts: Facts,
    /// What was assumed about the file.
    pub told: Vec<String>,
    pub found: Vec<RawCoupon>,
}

/// Rows of a curve, the widths of these rows, and how many rows were left out.
type KeptRows = (Vec<[f64; 2]>, Vec<f64>, usize);

#[derive(Default)]
pub(super) struct RawCoupon {
    name: String,
    rows: Vec<([f64; 2], u64)>,
    /// One for every row, or none at all.
    widths_m: Vec<f64>,
    /// By quantity: direction, width, length, thickness.
    numbers: [Option<f64>; QUANTITIES.len()],
}

impl Specimens<'_> {
    /// Adds a row to its specimen.
    pub(super) fn add(&mut self, cells: &TableRow) -> Result<(), DataError> {
        let [x, y] = self.curve;
        let row = [cells.number(x)?.unwrap_or_default(), cells.number(y)?.unwrap_or_default()];
        let name = cells.text(SPECIMEN);
        if name.is_empty() && cells.sheet.has(SPECIMEN) {
            let help = "write the specimen in every row, or leave the column out";
            return Err(cells.fault(SPECIMEN, "the cell is empty", help));
        }
        let raw = self.push(name, row, cells.line.number);
        for quantity in [DIRECTION, WIDTH, LENGTH, THICKNESS] {
            let Some(value) = cells.number(quantity)? else { continue };
            let first = *raw.numbers[quantity].get_or_insert(value);
            if first != value {
                let what = QUANTITIES[quantity].base;
                let message =
                    format!("the {what} of a specimen changes within its rows, here to {}", cells.text(quantity));
                let help = "a specimen has one direction and one size: give the rows of another specimen another label";
                return Err(cells.fault(quantity, message, help));
            }
        }
        raw.widths_m.extend(cells.number(LOADED_WIDTH)?);
        Ok(())
    }

    /// A row of a specimen, new or known, in a line of the file.
    pub(super) fn push(&mut self, name: &str, row: [f64; 2], line: u64) -> &mut RawCoupon {
        let index = self.found.iter().rposition(|raw| raw.name == name).unwrap_or_else(|| {
            self.found.push(RawCoupon { name: name.to_string(), ..RawCoupon::default() });
            self.found.len() - 1
        });
        self.found[index].rows.push((row, line));
        &mut self.found[index]
    }

    /// The specimens, complete and checked; the first has what was assumed about the file.
    pub(super) fn finish(mut self, defaults: &CouponDefaults) -> Result<Vec<Coupon>, DataError> {
        if self.found.is_empty() {
            let message = "the file has a header and no rows";
            return Err(DataError::of(self.file, message, "add the rows of a specimen"));
        }
        for raw in self.found.iter_mut().filter(|raw| raw.name.is_empty()) {
            raw.name = self.facts.specimen.clone().unwrap_or_else(|| stem(self.file));
        }
        let coupons = self.found.iter().map(|raw| self.coupon(raw, defaults));
        let mut coupons = coupons.collect::<Result<Vec<_>, _>>()?;
        coupons[0].told.splice(0..0, self.told);
        Ok(coupons)
    }

    fn coupon(&self, raw: &RawCoupon, defaults: &CouponDefaults) -> Result<Coupon, DataError> {
        let said = |quantity: usize, typed: Option<f64>| self.number(raw, quantity, typed);
        let direction = self.direction(said(DIRECTION, defaults.direction_deg)?, raw)?;
        let mut told = Vec::new();
        let (rows, loaded_width_m, jitter) = self.rows(raw, &mut told)?;
        let pulled = if self.curve[0] == STRAIN { Pulled::Stress(rows) } else { Pulled::Force(rows) };
        Ok(Coupon {
            file: self.file.to_string(),
            specimen: raw.name.clone(),
            line: raw.rows[0].1,
            direction,
            pulled,
            columns: self.columns.clone(),
            loaded_width_m,
            width_m: said(WIDTH, defaults.width_m)?,
            length_m: said(LENGTH, defaults.length_m)?,
            thickness_m: said(THICKNESS, defaults.thickness_m)?,
            provenance: self.facts.provenance,
            jitter,
            told,
        })
    }

    /// What the rows, the comments or the caller say; they must not contradict each other.
    fn number(&self, raw: &RawCoupon, quantity: usize, typed: Option<f64>) -> Result<Option<f64>, DataError> {
        let Field { base, expected, .. } = &QUANTITIES[quantity];
        let written = raw.numbers[quantity].or(self.facts.numbers[quantity]);
        let (unit, per_si) = if quantity == DIRECTION { ("deg", 1.0) } else { ("mm", 1e3) };
        let other = written.zip(typed).filter(|(written, typed)| !agree(*written, *typed));
        if let Some((written, typed)) = other {
            let [written, typed] = [written, typed].map(|value| value * per_si);
            let message = format!("the file gives {expected} = {written:.6}, --{base} gives {typed:.6}");
            let help = format!("leave --{base} out, or correct the file");
            return Err(self.fault(raw, message, help));
        }
        let value = written.or(typed);
        let is_size = |v: &f64| quantity == DIRECTION || *v > 0.0 && *v <= policy::largest_m(base) || v.is_nan();
        if let Some(wrong) = value.filter(|v| !is_size(v)) {
            let message = format!("the {base} is {} {unit}", wrong * per_si);
            let help = format!("write a positive {base} of a specimen, as in {expected}");
            return Err(self.fault(raw, message, help));
        }
        Ok(value)
    }

    fn direction(&self, degrees: Option<f64>, raw: &RawCoupon) -> Result<Direction, DataError> {
        let help = "write 0 (pulled along the warp), 45 (bias), 90 (along the fill) or an angle between (60 for 120, the weave \
                    is the same): as a column direction_deg, as a comment # direction_deg: 0 above the header, or as \
                    --direction 0 for all files without one";
        let Some(degrees) = degrees else {
            return Err(self.fault(raw, "the direction of the pull is not known", help));
        };
        let wrong = || self.fault(raw, format!("it is pulled at {degrees} degrees"), help);
        Direction::of(degrees).ok_or_else(wrong)
    }

    /// The first loading, zeroed on the first row: rows that rise above all before. Steps back that are noise are left out and counted.
    fn rows(&self, raw: &RawCoupon, told: &mut Vec<String>) -> Result<KeptRows, DataError> {
        let ([x, _], column, first) = (self.curve, &self.columns[0], raw.rows[0].0);
        let range = raw.rows.iter().map(|(row, _)| (row[0] - first[0]).abs()).fold(0.0, f64::max);
        let (length, unit) = match x {
            STRAIN => (1.0, "name the column strain_pct if it is in per cent"),
            _ => (self.facts.numbers[LENGTH].unwrap_or(f64::INFINITY), "check the units of displacement and length"),
        };
        if range / length > policy::LARGEST_STRAIN {
            let percent = 100.0 * (range / length);
            let message = format!("{column} reaches a strain of {percent:.4} %");
            return Err(self.fault(raw, message, unit));
        }
        let signs = self.signs(raw, told);
        let mut rows = vec![[0.0, 0.0]];
        let mut widths: Vec<f64> = raw.widths_m.first().copied().into_iter().collect();
        let (mut jitter, mut unloading, mut before) = (0, 0, 0.0);
        for (i, (row, line)) in raw.rows.iter().enumerate().skip(1) {
            let moved = [0, 1].map(|k| signs[k] * (row[k] - first[k]));
            let last = rows[rows.len() - 1][0];
            // A later cycle may pass the highest row by the noise of the machine.
            let noise = if unloading > 0 { policy::JITTER * range } else { 0.0 };
            let back = before - moved[0];
            before = moved[0];
            if moved[0] > last + noise {
                rows.push(moved);
                widths.extend(raw.widths_m.get(i));
            } else if unloading == 0 && last - moved[0] <= policy::JITTER * range {
                jitter += 1;
            } else if back <= policy::LARGEST_STEP * range {
                unloading += 1;
            } else {
                let message = format!("{column} goes back in one step, after having been larger above");
                let help = "keep the rows of loading only (delete what follows the turn), in the order they were taken";
                return Err(self.fault(raw, message, help).at_line(*line).in_column(column, None));
            }
        }
        if unloading > 0 {
            let left_out = format!("without {unloading} rows below earlier ones");
            told.push(format!("{column} comes back: the first loading is used, {left_out}"));
        }
        let (count, fewest) = (rows.len(), policy::FEWEST_ROWS);
        if count < fewest {
            let message = format!("it has {count} rows that rise in {column}");
            let help = format!("give at least {fewest}, from the start of the pull");
            return Err(self.fault(raw, message, help));
        }
        Ok((rows, widths, jitter))
    }

    /// Signs that turn displacement and force of a pull into positive ones. A pull is known by its force, which grows from the first
    /// row to the farthest one; a force is negative if it falls below the first row by more than twice what it rises above it.
    fn signs(&self, raw: &RawCoupon, told: &mut Vec<String>) -> [f64; 2] {
        let first = raw.rows[0].0;
        let of = |k: usize| raw.rows.iter().map(move |(row, _)| row[k] - first[k]);
        let largest = |k: usize, sign: f64| of(k).map(|v| sign * v).fold(0.0, f64::max);
        let away = |row: &[f64; 2]| (row[0] - first[0]).abs();
        let rows = raw.rows.iter().map(|(row, _)| *row);
        let farthest = rows.max_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(first);
        if farthest[1].abs() <= first[1].abs() {
            return [1.0; 2];
        }
        let turned = [farthest[0] < first[0], largest(1, -1.0) > 2.0 * largest(1, 1.0)];
        for (column, _) in self.columns.iter().zip(turned).filter(|(_, turned)| *turned) {
            told.push(format!("{column} falls as the specimen is pulled: its sign is turned"));
        }
        turned.map(|turned| if turned { -1.0 } else { 1.0 })
    }

    fn fault(&self, raw: &RawCoupon, message: impl Display, help: impl Into<String>) -> DataError {
        let message = format!("specimen {}: {message}", raw.name);
        DataError::of(self.file, message, help).at_line(raw.rows[0].1)
    }
}

/// Equal but for rounding; NaN agrees with nothing.
fn agree(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}
