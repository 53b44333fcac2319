//! Text tables.

use comfy_table::{CellAlignment, Table, presets};
pub use ibr::pages::number;

/// A table of text; columns after the first `left` ones are flush right.
pub fn table<S: AsRef<str>>(head: &[S], left: usize, rows: Vec<Vec<String>>) -> String {
    let mut table = Table::new();
    table.load_preset(presets::ASCII_MARKDOWN);
    table.set_header(head.iter().map(AsRef::as_ref).collect::<Vec<&str>>());
    for row in rows {
        table.add_row(row);
    }
    for (i, column) in table.column_iter_mut().enumerate() {
        column.set_cell_alignment(if i < left { CellAlignment::Left } else { CellAlignment::Right });
    }
    format!("{table}\n")
}
