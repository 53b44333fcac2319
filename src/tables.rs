//! Tables: a list of columns over rows, for the terminal and for pages.

use crate::words::number;
use serde::Serialize;

/// Rows, and columns that each have a head and what they say of a row.
pub(crate) struct TextTable<R> {
    rows: Vec<R>,
    columns: Vec<PrintedColumn>,
}

struct PrintedColumn {
    head: String,
    flush_right: bool,
    cells: Vec<String>,
}

impl<R> TextTable<R> {
    /// A table of these rows that has no column yet.
    pub(crate) fn of(rows: impl IntoIterator<Item = R>) -> TextTable<R> {
        TextTable { rows: rows.into_iter().collect(), columns: Vec::new() }
    }

    fn column<S: Into<String>>(mut self, head: impl Into<String>, flush_right: bool, cell: impl Fn(&R) -> S) -> Self {
        let cells = self.rows.iter().map(|row| cell(row).into()).collect();
        self.columns.push(PrintedColumn { head: head.into(), flush_right, cells });
        self
    }

    pub(crate) fn words<S: Into<String>>(self, head: impl Into<String>, cell: impl Fn(&R) -> S) -> Self {
        self.column(head, false, cell)
    }

    pub(crate) fn right<S: Into<String>>(self, head: impl Into<String>, cell: impl Fn(&R) -> S) -> Self {
        self.column(head, true, cell)
    }

    /// A column of numbers with so many decimals; a dash where there is none.
    pub(crate) fn number<V: Into<Option<f64>>>(
        self,
        head: impl Into<String>,
        digits: usize,
        cell: impl Fn(&R) -> V,
    ) -> Self {
        self.column(head, true, |row| number(cell(row).into(), digits))
    }

    pub(crate) fn signed<V: Into<Option<f64>>>(
        self,
        head: impl Into<String>,
        digits: usize,
        cell: impl Fn(&R) -> V,
    ) -> Self {
        self.column(head, true, |row| cell(row).into().map_or("–".into(), |v| format!("{v:+.digits$}")))
    }

    pub(crate) fn when(self, wanted: bool, more: impl FnOnce(Self) -> Self) -> Self {
        if wanted { more(self) } else { self }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// As Markdown draws it, with columns of one width.
    pub(crate) fn text(self) -> String {
        let width =
            |c: &PrintedColumn| c.cells.iter().chain([&c.head]).map(|cell| cell.chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = self.columns.iter().map(width).collect();
        let line = |cell: &dyn Fn(&PrintedColumn) -> String| {
            let padded = |(column, width): (&PrintedColumn, &usize)| match column.flush_right {
                true => format!("| {:>width$} ", cell(column)),
                false => format!("| {:<width$} ", cell(column)),
            };
            self.columns.iter().zip(&widths).map(padded).collect::<String>() + "|\n"
        };
        let rule: String = widths.iter().map(|width| format!("|{}", "-".repeat(width + 2))).collect();
        let rows: String = (0..self.rows.len()).map(|r| line(&|column| column.cells[r].clone())).collect();
        line(&|column| column.head.clone()) + &rule + "|\n" + &rows
    }

    /// For the macro `shown` of a page: a column is of words if a cell begins with a letter.
    pub(crate) fn page(self, caption: &str) -> PageTable {
        let is_words =
            |c: &PrintedColumn| !c.flush_right || c.cells.iter().any(|cell| cell.starts_with(char::is_alphabetic));
        let heads =
            self.columns.iter().map(|c| [c.head.clone(), String::new(), if is_words(c) { "l" } else { "" }.into()]);
        let minus =
            |c: &PrintedColumn, r: usize| if is_words(c) { c.cells[r].clone() } else { c.cells[r].replace('-', "−") };
        let rows = (0..self.rows.len()).map(|r| self.columns.iter().map(|c| minus(c, r)).collect());
        PageTable { caption: caption.into(), heads: heads.collect(), rows: rows.collect() }
    }

    /// As text below a title; empty without rows.
    pub(crate) fn under(self, title: &str) -> String {
        if self.rows.is_empty() { String::new() } else { format!("\n{title}\n{}", self.text()) }
    }
}

#[derive(Debug, Clone, Serialize)]
pub(crate) struct PageTable {
    caption: String,
    heads: Vec<[String; 3]>,
    rows: Vec<Vec<String>>,
}

impl TextTable<Vec<String>> {
    /// Finished cells; columns after the first `left` ones are flush right.
    pub(crate) fn finished<S: AsRef<str>>(heads: &[S], left: usize, rows: Vec<Vec<String>>) -> Self {
        heads.iter().enumerate().fold(TextTable::of(rows), |table, (k, head)| {
            table.column(head.as_ref(), k >= left, |row| row.get(k).cloned().unwrap_or_default())
        })
    }
}

pub(crate) fn lines<S: AsRef<str>>(prefix: &str, texts: impl IntoIterator<Item = S>) -> String {
    texts.into_iter().map(|text| format!("{prefix}{}\n", text.as_ref())).collect()
}

pub(crate) const COLUMNS: usize = 116;

/// Text in lines of at most [`COLUMNS`], broken between words; further lines are indented.
pub(crate) fn wrapped(text: &str, indent: usize) -> String {
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
    fn columns_are_as_wide_as_their_widest_cell_and_numbers_are_flush_right() {
        let rows = [("µ", Some(1.25)), ("name", None)];
        let text = TextTable::of(rows).words("a", |r| r.0).number("mm", 1, |r| r.1).text();
        assert_eq!(text, "| a    |  mm |\n|------|-----|\n| µ    | 1.2 |\n| name |   – |\n");
    }

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
