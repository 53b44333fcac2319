//! Tables as Parquet files, where the crate was built with the feature `parquet`.

#[cfg(feature = "parquet")]
mod polars;

use std::path::Path;

use crate::error::Result;
use crate::table::Table;
#[cfg(feature = "parquet")]
use polars as files;

impl Table {
    /// Writes the table as Parquet, whole or not at all. Empty cells are null; the metadata have the unit of every column whose name
    /// ends with one (`unit.tip_x_mm`), and `notes`, pairs of name and text.
    ///
    /// # Errors
    /// Columns of different length; the folder is not writable; the crate was built without the feature `parquet`.
    pub fn to_parquet(&self, path: &Path, notes: &[(String, String)]) -> Result<()> {
        files::write(self, path, notes)
    }
}

/// Reads a Parquet file: numbers and decimals as `F64` or `I64`, texts, categories and enums as `Str`, booleans as `Bool`; an empty cell
/// becomes NaN, "" or `None`.
///
/// # Errors
/// Not a Parquet file; a column of another type; a table that takes more than 0.6 GB, which is refused before it is read; the crate was
/// built without the feature `parquet`.
pub fn read_parquet(path: &Path) -> Result<Table> {
    files::read(path)
}

#[cfg(not(feature = "parquet"))]
mod files {
    use super::{Path, Result, Table};
    use crate::error::DataError;

    pub(super) fn write(_table: &Table, path: &Path, _notes: &[(String, String)]) -> Result<()> {
        Err(absent(path))
    }

    pub(super) fn read(path: &Path) -> Result<Table> {
        Err(absent(path))
    }

    fn absent(path: &Path) -> DataError {
        let help = "use CSV, or build with the crate feature: cargo build --features parquet";
        let message = "this build has no Parquet support";
        DataError::of(&path.display().to_string(), message, help)
    }
}
