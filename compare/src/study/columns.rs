//! Comma-separated values: a column is its head and the cell of a row.

/// Head, and the cell of a row.
pub type TextColumn<R> = (&'static str, fn(&R) -> String);

/// Rows as comma-separated values below their heads.
pub fn csv<R>(columns: &[TextColumn<R>], rows: &[R]) -> String {
    let heads = columns.iter().map(|column| column.0.to_string()).collect();
    let cells = rows.iter().map(|row| columns.iter().map(|column| column.1(row)).collect());
    std::iter::once(heads).chain(cells).map(|cells: Vec<String>| cells.join(",") + "\n").collect()
}
