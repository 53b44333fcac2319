//! A small table of named columns: CSV always, Parquet through polars with the crate feature `parquet`.
//!
//! This is the only file that knows polars; [`Table`] keeps it out of every signature.

use std::fmt::Write as _;
use std::io::{Read, Write};
use std::path::Path;

use crate::atomic::cannot_write;
use crate::cells::quoted;
use crate::error::{DataError, Result};

/// One column.
#[derive(Debug, Clone, PartialEq)]
pub enum Column {
    /// Floating point numbers; NaN for an empty cell.
    F64(Vec<f64>),
    /// Texts.
    Str(Vec<String>),
    /// Whole numbers.
    I64(Vec<i64>),
}

impl Column {
    /// Number of rows.
    pub fn len(&self) -> usize {
        match self {
            Column::F64(values) => values.len(),
            Column::Str(values) => values.len(),
            Column::I64(values) => values.len(),
        }
    }

    /// Whether it has no row.
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
        }
    }
}

/// Named columns of equal length.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Names and values, in order.
    pub columns: Vec<(String, Column)>,
}

impl Table {
    /// Number of rows (of the shortest column, should they differ).
    pub fn rows(&self) -> usize {
        self.columns.iter().map(|(_, column)| column.len()).min().unwrap_or(0)
    }

    /// Writes the table as CSV; numbers in the shortest form that reads back exactly.
    ///
    /// # Errors
    /// The writer fails.
    pub fn to_csv(&self, out: &mut dyn Write) -> Result<()> {
        std::io::copy(&mut TableReader::new(self), out).map_err(|cause| cannot_write("table.csv", &cause))?;
        Ok(())
    }

    /// Writes the table as Parquet, whole or not at all.
    ///
    /// # Errors
    /// Columns of different length; the folder is not writable; the crate was built without the feature `parquet`.
    pub fn to_parquet(&self, path: &Path) -> Result<()> {
        parquet::write(self, path)
    }
}

/// Name of the thread that reads a Parquet file. The library for it panics on some damaged ones: a panic of this thread is the
/// error that [`read_parquet`] returns.
pub const PARQUET_READER: &str = "parquet";

/// Reads a Parquet file: numbers as `F64` or `I64`, everything else as text; an empty cell becomes NaN or "".
///
/// # Errors
/// Not a Parquet file; a column that is neither number nor text; the crate was built without the feature `parquet`.
pub fn read_parquet(path: &Path) -> Result<Table> {
    parquet::read(path)
}

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

#[cfg(feature = "parquet")]
mod parquet {
    use std::io::Cursor;

    use polars_buffer::Buffer;
    use polars_core::prelude::{
        Column as PolarsColumn, DataFrame, DataType, NamedFrom, PolarsError, PolarsResult, Series,
    };
    use polars_io::SerReader;
    use polars_io::prelude::{ParquetCompression, ParquetReader, ParquetWriter};
    use polars_parquet::parquet::page::CompressedPage;
    use polars_parquet::parquet::read::get_page_iterator;

    use super::{Column, DataError, PARQUET_READER, Path, Result, Table};
    use crate::atomic::write_atomically;

    /// Largest number of rows; a table of that many is larger than the memory.
    const MOST_ROWS: usize = 1 << 30;

    /// Snappy: every Parquet reader has it.
    pub(super) fn write(table: &Table, path: &Path) -> Result<()> {
        let mut bytes = Cursor::new(Vec::new());
        let written = frame(table).and_then(|mut frame| {
            ParquetWriter::new(&mut bytes).with_compression(ParquetCompression::Snappy).finish(&mut frame)
        });
        written
            .map_err(|cause| file_error(path, format!("cannot make a Parquet file: {cause}"), "report this table"))?;
        write_atomically(path, bytes.get_ref())
    }

    pub(super) fn read(path: &Path) -> Result<Table> {
        let bytes = std::fs::read(path)
            .map_err(|cause| file_error(path, format!("cannot open the file: {cause}"), "check the path"))?;
        let reading = std::thread::Builder::new().name(PARQUET_READER.into()).spawn(move || table(bytes));
        let cause = match reading.map(std::thread::JoinHandle::join) {
            Ok(Ok(Ok(table))) => return Ok(table),
            Ok(Ok(Err(cause))) => cause.to_string(),
            Ok(Err(_)) => "it is damaged".into(),
            Err(cause) => cause.to_string(),
        };
        let help = "save the table again, or give it as CSV";
        Err(file_error(path, format!("not a readable Parquet file: {cause}"), help))
    }

    /// The library makes room for as many rows as the file and its pages say before it looks for them, and for texts in the
    /// heads of pages as long as these say. So pages are counted first, and none may be longer than the file.
    fn table(bytes: Vec<u8>) -> PolarsResult<Table> {
        let bytes = Buffer::from_vec(bytes);
        let mut reader = ParquetReader::new(Cursor::new(bytes.clone()));
        let said = reader.get_metadata()?;
        let rows = said.row_groups.iter().map(|group| group.num_rows()).fold(said.num_rows, usize::max);
        if rows > MOST_ROWS {
            return Err(PolarsError::ComputeError(format!("it says that it has {rows} rows").into()));
        }
        for group in &said.row_groups {
            for column in group.parquet_columns() {
                let mut in_pages = 0_usize;
                for page in get_page_iterator(column, Cursor::new(bytes.clone()), Vec::new(), bytes.len())? {
                    if let CompressedPage::Data(page) = page? {
                        in_pages = in_pages.saturating_add(page.num_values());
                    }
                }
                if in_pages != group.num_rows() {
                    let name = column.descriptor().path_in_schema.join(".");
                    let message = format!("column {name} has {in_pages} values in {} rows", group.num_rows());
                    return Err(PolarsError::ComputeError(message.into()));
                }
            }
        }
        let frame = reader.finish()?;
        let column = |column: &PolarsColumn| Ok((column.name().to_string(), from_polars(column)?));
        let columns: PolarsResult<Vec<_>> = frame.columns().iter().map(column).collect();
        Ok(Table { columns: columns? })
    }

    fn file_error(path: &Path, message: String, help: &str) -> DataError {
        DataError::file(&path.display().to_string(), message, help)
    }

    fn frame(table: &Table) -> PolarsResult<DataFrame> {
        let series = |(name, column): &(String, Column)| match column {
            Column::F64(values) => Series::new(name.as_str().into(), values.as_slice()),
            Column::Str(values) => Series::new(name.as_str().into(), values.as_slice()),
            Column::I64(values) => Series::new(name.as_str().into(), values.as_slice()),
        };
        DataFrame::new(table.rows(), table.columns.iter().map(|column| series(column).into()).collect())
    }

    fn from_polars(column: &PolarsColumn) -> PolarsResult<Column> {
        if column.dtype().is_integer() && column.null_count() == 0 {
            let cast = column.cast(&DataType::Int64)?;
            return Ok(Column::I64(cast.i64()?.iter().flatten().collect()));
        }
        if column.dtype().is_primitive_numeric() {
            let cast = column.cast(&DataType::Float64)?;
            return Ok(Column::F64(cast.f64()?.iter().map(|value| value.unwrap_or(f64::NAN)).collect()));
        }
        let cast = column.cast(&DataType::String)?;
        Ok(Column::Str(cast.str()?.iter().map(|value| value.unwrap_or_default().to_string()).collect()))
    }
}

#[cfg(not(feature = "parquet"))]
mod parquet {
    use super::{DataError, Path, Result, Table};
    use crate::error::Fault;

    pub(super) fn write(_table: &Table, path: &Path) -> Result<()> {
        Err(absent(path))
    }

    pub(super) fn read(path: &Path) -> Result<Table> {
        Err(absent(path))
    }

    fn absent(path: &Path) -> DataError {
        let help = "use CSV, or build with the crate feature: cargo build --features parquet";
        let message = "this build has no Parquet support";
        DataError::Feature(Box::new(Fault::of_file(&path.display().to_string(), message, help)))
    }
}
