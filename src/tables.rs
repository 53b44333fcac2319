//! Text tables.

use comfy_table::{CellAlignment, Table, presets};
use compare::study::columns::TextTable;
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

/// The same under its caption.
pub fn printed(TextTable { caption, heads, left, rows }: &TextTable) -> String {
    let caption = if caption.is_empty() { String::new() } else { format!("{caption}\n") };
    caption + &table(heads, *left, rows.clone())
}

/// Columns of text to read.
pub const COLUMNS: usize = 116;

/// Text in lines of at most [`COLUMNS`], broken between words; further lines are indented.
pub fn wrapped(text: &str, indent: usize) -> String {
    let mut out = String::new();
    let mut column = 0;
    for (i, word) in text.split(' ').enumerate() {
        let width = word.chars().count();
        if column > indent && column + 1 + width > COLUMNS {
            out.push_str(&format!("\n{:indent$}", ""));
            column = indent;
        } else if i > 0 {
            out.push(' ');
            column += 1;
        }
        out.push_str(word);
        column += width;
    }
    out + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_kept_and_lines_are_short() {
        let text = format!("{} κ", "pressure at the actuator ".repeat(20).trim_end());
        let lines = wrapped(&text, 4);
        assert!(lines.lines().all(|line| line.chars().count() <= COLUMNS), "{lines}");
        assert!(
            lines
                .lines()
                .skip(1)
                .all(|line| line.starts_with("    p") || line.starts_with("    a") || line.starts_with("    t"))
        );
        assert_eq!(lines.split_whitespace().collect::<Vec<_>>(), text.split_whitespace().collect::<Vec<_>>());
        assert_eq!(wrapped(&"x".repeat(200), 2).lines().count(), 1);
        assert_eq!(wrapped("  - a b", 4), "  - a b\n");
    }
}
