//! A kind of bench test, and its tables.

use crate::about::Provenance;
use crate::columns::Field;

/// A kind of bench table, with its columns and what a row must fulfil.
#[derive(Debug, Clone, Copy)]
pub struct BenchKind {
    /// Name, also of the file in a folder of data: `load_deflection` is `load_deflection.csv`.
    pub name: &'static str,
    /// What such a table contains, in one plain sentence.
    pub sentence: &'static str,
    /// Columns that a table of this kind has or may have.
    pub columns: &'static [Field],
    /// What a row must fulfil beyond its columns: message and what to write.
    pub(super) check: fn(&BenchRow) -> Result<(), [String; 2]>,
}

/// One row in SI units (ratios as 1, angles in degrees), by the columns of its kind.
#[derive(Debug, Clone)]
pub struct BenchRow {
    pub(super) kind: &'static BenchKind,
    pub(super) values: Vec<Option<f64>>,
    /// Line in the file, from 1.
    pub line: u64,
}

impl BenchRow {
    /// The value of a column; none where the table has none.
    pub fn get(&self, base: &str) -> Option<f64> {
        self.kind.columns.iter().position(|f| f.base == base).and_then(|i| self.values[i])
    }

    /// The value of a column that the kind needs.
    pub fn value(&self, base: &str) -> f64 {
        self.get(base).unwrap_or(f64::NAN)
    }
}

/// A table of bench tests, with the robot that it belongs to.
#[derive(Debug, Clone)]
pub struct Bench {
    /// Kind of the table, an entry of the list.
    pub kind: &'static BenchKind,
    /// File or embedded set that it was read from.
    pub file: String,
    /// How its numbers came to be.
    pub provenance: Provenance,
    /// Its rows, in the order of the file.
    pub rows: Vec<BenchRow>,
    /// The robot of the folder or set it came from: place and text of its scenario.
    pub scenario: Option<(String, String)>,
}

/// A mean with its scatter makes sense with both numbers only.
pub(super) fn scatter(row: &BenchRow, sd: &str) -> Result<(), [String; 2]> {
    let wrong = |message: String| Err([message, format!("write {sd} above 0 and n of 2 or more, or leave both out")]);
    match (row.get(sd), row.get("n")) {
        (Some(sd), Some(n)) if sd > 0.0 && n >= 2.0 && n.fract() == 0.0 => Ok(()),
        (None, None) => Ok(()),
        (None, Some(_)) | (Some(_), None) => wrong("a standard deviation and a number of tests belong together".into()),
        (Some(value), Some(n)) => wrong(format!("a standard deviation of {value} of {n} tests")),
    }
}
