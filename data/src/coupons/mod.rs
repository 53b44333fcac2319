//! Tensile tests of fabric: stress over strain, or force over displacement, of pulled specimens.
//!
//! | column | meaning |
//! |---|---|
//! | `strain_pct` and `stress_mpa` | nominal strain and stress (force over first cross-section), or |
//! | `displacement_mm` and `force_n` | of the grip |
//! | `specimen` | label; the name of the file if this column is missing |
//! | `direction_deg` | of the pull to the warp: 0 warp, 45 bias, 90 fill, or any angle between |
//! | `width_mm`, `thickness_mm` | of the specimen |
//! | `length_mm` | free length between the grips (gauge length) |
//! | `loaded_width_mm` | width under load in its middle, row by row: for Poisson's ratio |
//!
//! Other units by suffix: `strain_ratio`; kPa, Pa, MPa, psi, bar; mm, cm, m; N, kN, lbf. Everything but the two curves may
//! instead stand in a comment above the header, `# width_mm: 20`, or come from the caller. `# provenance: digitised` states
//! the origin of the numbers: measured (default), digitised, synthetic or published.
//! Curves start at their first row: its strain, stress, displacement and force are subtracted.
//! Exports of tensile machines are read too: rows about the test, names and units in rows, specimens side by side.

mod columns;
mod coupon;
mod curve;
mod export;
#[cfg(test)]
mod tests;

use std::io::Read;
use std::path::Path;

use crate::columns::TableSheet;
use crate::error::DataError;
use crate::import::sheet::CellText;
use crate::lines::LineReader;
use columns::{DISPLACEMENT, FORCE, STRAIN, STRESS};
pub use coupon::{Coupon, CouponDefaults, Direction, Pulled};
use curve::Specimens;
use spelling::files::read_whole;

/// Largest file that is read \[bytes\], 256 MiB.
const MOST_BYTES: u64 = 256 << 20;

/// Reads all specimens of a file; `progress(bytes_done, bytes_total)` is called about every MiB and at the end.
///
/// # Errors
/// Every fault of the file as one [`DataError`] with line and column.
pub fn read_coupons(
    path: &Path,
    defaults: &CouponDefaults,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Vec<Coupon>, DataError> {
    let shown = path.display().to_string();
    let bytes = read_whole(path, MOST_BYTES).map_err(|cause| {
        let help =
            "check the path; docs/characterize.md has the format, `ibr characterize --example FOLDER` makes files";
        DataError::file(&shown, format!("cannot open the file: {cause}"), help)
    })?;
    parse_coupons(&shown, &mut bytes.as_slice(), bytes.len() as u64, defaults, progress)
}

/// Reads all specimens from `reader`; `file` names it in errors.
///
/// ```
/// let rows: String = (0..20).map(|k| format!("{},{}\n", 0.1 * f64::from(k), 0.2 * f64::from(k))).collect();
/// let csv = format!("# direction_deg: 0\n# width_mm: 20\n# length_mm: 250\ndisplacement_mm,force_n\n{rows}");
/// let size = csv.len() as u64;
/// let pulled = data::parse_coupons("warp.csv", &mut csv.as_bytes(), size, &Default::default(), &mut |_, _| ()).unwrap();
/// assert_eq!((pulled.len(), pulled[0].direction), (1, data::Direction::Warp));
/// ```
pub fn parse_coupons(
    file: &str,
    reader: &mut dyn Read,
    bytes_total: u64,
    defaults: &CouponDefaults,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Vec<Coupon>, DataError> {
    let mut bytes = Vec::new();
    reader.take(MOST_BYTES).read_to_end(&mut bytes).map_err(|cause| {
        DataError::file(file, format!("cannot read the file: {cause}"), "check the disk and try again")
    })?;
    if bytes.len() as u64 == MOST_BYTES {
        let help = "give fewer rows, or fewer specimens in a file";
        let message = "the file is larger than any tensile test: 256 MiB";
        return Err(DataError::of(file, message, help));
    }
    let sheet = std::str::from_utf8(&bytes).ok().map(|text| CellText::new(file, text)).transpose()?;
    let comma = sheet.as_ref().is_some_and(|sheet| sheet.comma);
    let mut own = bytes.as_slice();
    let mut lines = LineReader::new(file, &mut own, bytes_total, progress);
    let (facts, header) = match columns::read(&mut lines, defaults) {
        Ok((facts, header)) => (facts, TableSheet { comma, ..header }),
        Err(refused) => {
            let export = sheet.as_ref().filter(|_| defaults.columns.is_empty());
            let export = export.map(|sheet| export::read(sheet, defaults)).transpose()?.flatten();
            return export.ok_or(refused)?.finish(defaults);
        }
    };
    let curve = if header.has(STRAIN) { [STRAIN, STRESS] } else { [DISPLACEMENT, FORCE] };
    let columns = curve.map(|quantity| header.name(quantity).to_string());
    let told = if comma { vec!["decimals are written with a comma".to_string()] } else { Vec::new() };
    let mut found = Specimens { file, curve, columns, facts, told, found: Vec::new() };
    header.each_row(&mut lines, |row| found.add(row))?;
    found.finish(defaults)
}
