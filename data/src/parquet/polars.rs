//! Parquet files through polars; the only file that knows it. Columns are decoded by their types in the file, so categories and enums are texts
//! and decimals are numbers, whatever program wrote them.

use std::fs::File;
use std::io::Cursor;
use std::path::Path;

use polars_buffer::Buffer;
use polars_core::prelude::{ArrowDataType, ArrowField, DataFrame, NamedFrom, PolarsResult, Series};
use polars_core::utils::arrow::array::{Array, BinaryViewArray, BooleanArray, PrimitiveArray, Utf8ViewArray};
use polars_io::parquet::write::KeyValueMetadata;
use polars_io::prelude::{ParquetCompression, ParquetWriter};
use polars_parquet::parquet::page::CompressedPage;
use polars_parquet::read::schema::parquet_to_arrow_schema;
use polars_parquet::read::{
    BasicDecompressor, ColumnChunkMetadata, FileMetadata, PageReader, RowGroupMetadata, column_iter_to_arrays,
    get_page_iterator, read_metadata,
};

use crate::atomic::write_atomically;
use crate::error::{DataError, Result};
use crate::policy::MOST_TABLE_BYTES;
use crate::table::{Column, PARQUET_READER, Table};
use spelling::units::{ANGLES, UNITS};

/// A number and a short text in memory \[bytes\].
const CELL_BYTES: [usize; 2] = [8, 48];

/// Snappy: every Parquet reader has it. Empty cells are null. The metadata have the notes and the unit of every column that names one.
pub(super) fn write(table: &Table, path: &Path, notes: &[(String, String)]) -> Result<()> {
    let unit = |(name, _): &(String, Column)| {
        let (_, last) = name.rsplit_once('_')?;
        let known = UNITS.iter().chain(ANGLES).find(|unit| unit.symbol.eq_ignore_ascii_case(last))?;
        Some((format!("unit.{name}"), known.symbol.to_string()))
    };
    let units = table.columns.iter().filter_map(unit);
    let notes = KeyValueMetadata::from_static(notes.iter().cloned().chain(units).collect());
    let mut bytes = Cursor::new(Vec::new());
    let written = frame(table).and_then(|mut frame| {
        let writer = ParquetWriter::new(&mut bytes).with_compression(ParquetCompression::Snappy);
        writer.with_key_value_metadata(Some(notes)).finish(&mut frame)
    });
    let refused = |cause| fault(path, format!("cannot make a Parquet file: {cause}"), "report this table");
    written.map_err(refused)?;
    write_atomically(path, bytes.get_ref())
}

fn frame(table: &Table) -> PolarsResult<DataFrame> {
    let series = |(name, column): &(String, Column)| {
        let name = name.as_str().into();
        match column {
            Column::F64(values) => {
                let known = values.iter().map(|v| Some(*v).filter(|v| !v.is_nan()));
                Series::new(name, known.collect::<Vec<Option<f64>>>())
            }
            Column::Str(values) => Series::new(name, values.as_slice()),
            Column::I64(values) => Series::new(name, values.as_slice()),
            Column::Bool(values) => Series::new(name, values.as_slice()),
        }
    };
    let columns = table.columns.iter().map(|column| series(column).into());
    DataFrame::new(table.rows(), columns.collect())
}

pub(super) fn read(path: &Path) -> Result<Table> {
    let unread = |cause: std::io::Error| fault(path, format!("cannot open the file: {cause}"), "check the path");
    let mut file = File::open(path).map_err(unread)?;
    // A size that does not fit is refused before anything but the end of the file is read.
    let said = on_reader(move || read_metadata(&mut file).map_err(words));
    let said = said.map_err(|cause| unreadable(path, &cause))?;
    let needed = size(&said);
    if needed > MOST_TABLE_BYTES {
        let [needed, most] = [needed, MOST_TABLE_BYTES].map(|bytes| bytes as f64 / 1e9);
        let (rows, columns) = (said.num_rows, said.schema().fields().len());
        let message = format!(
            "cannot read the table: {rows} rows of {columns} columns take {needed:.2} GB (allowed 0 to {most:.2} GB)"
        );
        let help = "Try: one file for every run, fewer frames, or CSV, which is read row by row";
        return Err(fault(path, message, help));
    }
    let bytes = std::fs::read(path).map_err(unread)?;
    on_reader(move || table(&said, bytes)).map_err(|cause| unreadable(path, &cause))
}

fn unreadable(path: &Path, cause: &str) -> DataError {
    let help = "save the table again, or give it as CSV";
    fault(path, format!("not a readable Parquet file: {cause}"), help)
}

fn words(cause: impl ToString) -> String {
    cause.to_string()
}

fn fault(path: &Path, message: String, help: &str) -> DataError {
    DataError::file(&path.display().to_string(), message, help)
}

/// On a separate thread, because the library panics on some damaged files.
fn on_reader<T: Send + 'static>(read: impl FnOnce() -> Read<T> + Send + 'static) -> Read<T> {
    let thread = std::thread::Builder::new().name(PARQUET_READER.into()).spawn(read);
    thread.map_err(words)?.join().unwrap_or_else(|panic| {
        let said = panic.downcast_ref::<String>().map(String::as_str);
        let said = said.or(panic.downcast_ref::<&str>().copied());
        let said = said.map(|words| format!(" ({words})")).unwrap_or_default();
        Err(format!("it is damaged{said}"))
    })
}

type Read<T> = std::result::Result<T, String>;

/// Bytes that the whole table takes in memory, by the row count and types that the file states.
fn size(said: &FileMetadata) -> usize {
    use ArrowDataType::{BinaryView, Utf8View};
    let in_groups = said.row_groups.iter().map(RowGroupMetadata::num_rows);
    let is_text = |field: &ArrowField| matches!(field.dtype, Utf8View | BinaryView);
    let schema = parquet_to_arrow_schema(said.schema().fields());
    let row = schema.iter_values().map(|field| CELL_BYTES[usize::from(is_text(field))]);
    in_groups.fold(said.num_rows, usize::max).saturating_mul(row.sum::<usize>())
}

/// The library makes room for as many rows as the file and its pages state before it looks for them, and for texts in the
/// heads of pages as long as these state. So pages are counted first, and none may be longer than the file.
fn table(said: &FileMetadata, bytes: Vec<u8>) -> Read<Table> {
    let bytes = Buffer::from_vec(bytes);
    let mut columns = Vec::new();
    for field in parquet_to_arrow_schema(said.schema().fields()).iter_values() {
        let (mut cells, unit) = empty(field)?;
        for group in &said.row_groups {
            let mut parts = group.columns_under_root_iter(&field.name).into_iter().flatten();
            let (Some(part), None) = (parts.next(), parts.next()) else { return Err(other(field)) };
            is_whole(part, &bytes, group.num_rows())?;
            for array in arrays(part, &bytes, field).map_err(words)? {
                take(&mut cells, unit, &*array).ok_or_else(|| other(field))?;
            }
        }
        columns.push((field.name.to_string(), cells));
    }
    Ok(Table { columns })
}

fn other(field: &ArrowField) -> String {
    let ArrowField { name, dtype, .. } = field;
    format!("column {name} has the type {dtype:?}, and numbers, texts and true or false are read")
}

fn pages(part: &ColumnChunkMetadata, bytes: &Buffer<u8>) -> PolarsResult<PageReader> {
    get_page_iterator(part, Cursor::new(bytes.clone()), Vec::new(), bytes.len())
}

fn is_whole(part: &ColumnChunkMetadata, bytes: &Buffer<u8>, rows: usize) -> Read<()> {
    let mut in_pages = 0_usize;
    for page in pages(part, bytes).map_err(words)? {
        if let CompressedPage::Data(page) = page.map_err(words)? {
            in_pages = in_pages.saturating_add(page.num_values());
        }
    }
    if in_pages == rows {
        return Ok(());
    }
    let name = part.descriptor().path_in_schema.join(".");
    Err(format!("column {name} has {in_pages} values in {rows} rows"))
}

fn arrays(part: &ColumnChunkMetadata, bytes: &Buffer<u8>, field: &ArrowField) -> PolarsResult<Vec<Box<dyn Array>>> {
    let pages = BasicDecompressor::new(pages(part, bytes)?, Vec::new());
    let kind = &part.descriptor().descriptor.primitive_type;
    Ok(column_iter_to_arrays(vec![pages], vec![kind], field.clone(), None)?.0)
}

/// Values of the first of these types that an array has, as another type.
macro_rules! values {
    ($array:expr, $as:ty, $($type:ty),*) => {{
        let mut found: Option<Vec<Option<$as>>> = None;
        $(if let Some(some) = $array.as_any().downcast_ref::<PrimitiveArray<$type>>() {
            found = Some(some.iter().map(|value| value.map(|value| *value as $as)).collect());
        })*
        found
    }};
}

/// A column without rows, and the factor of a decimal's last digit.
fn empty(field: &ArrowField) -> Read<(Column, f64)> {
    use ArrowDataType as Type;
    Ok(match &field.dtype {
        Type::Int8 | Type::Int16 | Type::Int32 | Type::Int64 => (Column::I64(Vec::new()), 1.0),
        Type::UInt8 | Type::UInt16 | Type::UInt32 => (Column::I64(Vec::new()), 1.0),
        Type::UInt64 | Type::Float16 | Type::Float32 | Type::Float64 | Type::Null => (Column::F64(Vec::new()), 1.0),
        Type::Decimal(_, scale) => (Column::F64(Vec::new()), 10_f64.powi(*scale as i32)),
        Type::Utf8View | Type::BinaryView => (Column::Str(Vec::new()), 1.0),
        Type::Boolean => (Column::Bool(Vec::new()), 1.0),
        _ => return Err(other(field)),
    })
}

/// Appends an array; `None` if it has another type. A column of whole numbers with an empty cell becomes one of numbers.
fn take(cells: &mut Column, unit: f64, array: &dyn Array) -> Option<()> {
    match cells {
        Column::I64(all) if array.null_count() == 0 => {
            let found = values!(array, i64, i8, i16, i32, i64, u8, u16, u32)?;
            all.extend(found.into_iter().flatten());
        }
        Column::I64(all) => {
            *cells = Column::F64(all.iter().map(|value| *value as f64).collect());
            take(cells, unit, array)?;
        }
        Column::F64(all) if array.null_count() == array.len() => all.resize(all.len() + array.len(), f64::NAN),
        Column::F64(all) => {
            let found = values!(array, f64, i8, i16, i32, i64, u8, u16, u32, u64, i128, f32, f64)?;
            all.extend(found.into_iter().map(|value| value.map_or(f64::NAN, |value| value / unit)));
        }
        Column::Str(all) => {
            if let Some(texts) = array.as_any().downcast_ref::<Utf8ViewArray>() {
                all.extend(texts.iter().map(|text| text.unwrap_or_default().to_string()));
            } else {
                let texts = array.as_any().downcast_ref::<BinaryViewArray>()?;
                let text = |bytes: Option<&[u8]>| Some(std::str::from_utf8(bytes.unwrap_or_default()).ok()?.into());
                all.extend(texts.iter().map(text).collect::<Option<Vec<String>>>()?);
            }
        }
        Column::Bool(all) => all.extend(array.as_any().downcast_ref::<BooleanArray>()?.iter()),
    }
    Some(())
}
