//! A small table of named columns: CSV always, Parquet through polars with the crate feature `parquet`.
//!
//! [`Table`] keeps polars out of every signature.

use std::fmt::Write as _;
use std::io::{Read, Write};

use crate::atomic::cannot_write;
use crate::cells::quoted;
use crate::error::Result;

/// The values of one column, all of one type.
#[derive(Debug, Clone, PartialEq)]
pub enum Column {
    /// Floating point numbers; NaN for an empty cell.
    F64(Vec<f64>),
    /// Texts, one per row of the table.
    Str(Vec<String>),
    /// Whole numbers, one per row of the table.
    I64(Vec<i64>),
    /// True or false; `None` for an empty cell.
    Bool(Vec<Option<bool>>),
}

impl Column {
    /// Number of rows, empty cells included.
    pub fn len(&self) -> usize {
        match self {
            Column::F64(values) => values.len(),
            Column::Str(values) => values.len(),
            Column::I64(values) => values.len(),
            Column::Bool(values) => values.len(),
        }
    }

    /// Whether it has no row at all.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The text of a cell in a CSV file.
    pub(crate) fn cell(&self, row: usize) -> String {
        match self {
            Column::F64(values) if values[row].is_nan() => String::new(),
            Column::F64(values) => values[row].to_string(),
            Column::Str(values) => quoted(&values[row]),
            Column::I64(values) => values[row].to_string(),
            Column::Bool(values) => values[row].map_or_else(String::new, |value| value.to_string()),
        }
    }
}

/// Named columns of equal length, in order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Name and values of every column, in the order of the table.
    pub columns: Vec<(String, Column)>,
}

impl Table {
    /// Number of rows (of the shortest column, should they differ).
    pub fn rows(&self) -> usize {
        self.columns.iter().map(|(_, column)| column.len()).min().unwrap_or(0)
    }

    /// Writes the table as CSV; numbers in the shortest form that reads back exactly.
    ///
    /// ```
    /// use data::table::{Column, Table};
    /// let table = Table { columns: vec![("kpa".into(), Column::F64(vec![1.5, 2.0]))] };
    /// let mut csv = Vec::new();
    /// table.to_csv(&mut csv).unwrap();
    /// assert_eq!(csv, b"kpa\n1.5\n2\n");
    /// ```
    pub fn to_csv(&self, out: &mut dyn Write) -> Result<()> {
        std::io::copy(&mut TableReader::new(self), out).map_err(|cause| cannot_write("table.csv", &cause))?;
        Ok(())
    }
}

/// Name of the thread that reads a Parquet file. The library for it panics on some damaged ones: a panic of this thread is the
/// error that [`crate::read_parquet`] returns.
pub const PARQUET_READER: &str = "parquet";

/// A table as the bytes of its CSV, rendered row by row: so Parquet goes through the same checks as CSV.
pub(crate) struct TableReader<'a> {
    table: &'a Table,
    next_row: Option<usize>,
    text: String,
    taken: usize,
}

impl<'a> TableReader<'a> {
    pub(crate) fn new(table: &'a Table) -> TableReader<'a> {
        TableReader { table, next_row: None, text: String::new(), taken: 0 }
    }

    fn render(&mut self) {
        self.text.clear();
        self.taken = 0;
        let columns = &self.table.columns;
        let (cells, next): (Vec<String>, _) = match self.next_row {
            None => (columns.iter().map(|(name, _)| quoted(name)).collect(), 0),
            Some(row) if row < self.table.rows() => {
                (columns.iter().map(|(_, column)| column.cell(row)).collect(), row + 1)
            }
            Some(_) => return,
        };
        self.next_row = Some(next);
        // Writing into a String cannot fail.
        let _ = writeln!(self.text, "{}", cells.join(","));
    }
}

impl Read for TableReader<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        if self.taken == self.text.len() {
            self.render();
        }
        let count = (self.text.len() - self.taken).min(buffer.len());
        buffer[..count].copy_from_slice(&self.text.as_bytes()[self.taken..self.taken + count]);
        self.taken += count;
        Ok(count)
    }
}
