//! Tables of text: a column is its head and the cell of a row.

/// Head, and the cell of a row.
pub type TextColumn<R> = (&'static str, fn(&R) -> String);

/// A table to print.
#[derive(Debug, Clone, PartialEq)]
pub struct TextTable {
    /// Title; empty if the page has its own.
    pub caption: &'static str,
    /// Heads of the columns.
    pub heads: Vec<&'static str>,
    /// The first columns that hold words.
    pub left: usize,
    /// Cells.
    pub rows: Vec<Vec<String>>,
}

impl TextTable {
    /// A table with these columns, of which the first `left` hold words.
    pub fn of<R>(caption: &'static str, left: usize, columns: &[TextColumn<R>], rows: &[R]) -> TextTable {
        let heads = columns.iter().map(|column| column.0).collect();
        TextTable { caption, heads, left, rows: cells(columns, rows) }
    }
}

/// The same as comma-separated values.
pub fn csv<R>(columns: &[TextColumn<R>], rows: &[R]) -> String {
    let heads = columns.iter().map(|column| column.0.to_string()).collect();
    let line = |cells: Vec<String>| cells.join(",") + "\n";
    std::iter::once(heads).chain(cells(columns, rows)).map(line).collect()
}

fn cells<R>(columns: &[TextColumn<R>], rows: &[R]) -> Vec<Vec<String>> {
    rows.iter().map(|row| columns.iter().map(|column| column.1(row)).collect()).collect()
}

/// `12.3 ± 0.4`, or the mean alone.
pub fn plus_minus((mean, deviation): (f64, Option<f64>), decimals: usize) -> String {
    let deviation = deviation.map_or(String::new(), |sd| format!(" ± {sd:.decimals$}"));
    format!("{mean:.decimals$}{deviation}")
}

/// A number, or a dash where there is none.
pub fn or_dash(value: Option<f64>, decimals: usize) -> String {
    value.map_or("–".into(), |v| format!("{v:.decimals$}"))
}
