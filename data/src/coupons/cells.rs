//! One line of a tensile table, cell by cell.

use super::columns::{CouponHeader, QUANTITIES};
use crate::cells::with_comma;
use crate::error::{DataError, Fault};
use crate::lines::Line;

/// The cells of a line.
pub(super) struct Cells<'a> {
    header: &'a CouponHeader,
    pub line: Line<'a>,
}

impl<'a> Cells<'a> {
    /// Checks the number of cells.
    pub fn new(header: &'a CouponHeader, line: Line<'a>) -> Result<Cells<'a>, DataError> {
        let (found, wanted) = (line.text.split(header.delimiter).count(), header.names.len());
        if found == wanted {
            return Ok(Cells { header, line });
        }
        let message = format!("the row has {found} cells, the header {wanted}");
        let help = if header.delimiter == ',' && found > wanted {
            "write decimals with a point, or separate the columns with semicolons"
        } else {
            "complete or delete the row"
        };
        Err(DataError::Layout(line.fault(message, help)))
    }

    /// The text of a quantity; empty if it has no column.
    pub fn text(&self, quantity: usize) -> &str {
        self.header.columns[quantity].map_or("", |column| self.span(column.index).0.trim().trim_matches('"').trim())
    }

    /// The number of a quantity in SI units; `None` if it has no column.
    pub fn number(&self, quantity: usize) -> Result<Option<f64>, DataError> {
        let Some(column) = self.header.columns[quantity] else { return Ok(None) };
        let text = self.text(quantity);
        let comma = || self.header.comma.then(|| with_comma(text)).flatten();
        let si = text.parse::<f64>().ok().or_else(comma).and_then(|v| column.unit.map(|unit| unit.to_si(v)));
        match si.filter(|v| v.is_finite()) {
            Some(value) => Ok(Some(value)),
            None => Err(self.not_a_number(quantity, text)),
        }
    }

    /// A fault of one cell.
    pub fn fault(&self, quantity: usize, message: String, help: String) -> Box<Fault> {
        let mut fault = self.line.fault(message, help);
        let Some(column) = self.header.columns[quantity] else { return fault };
        let (cell, before) = self.span(column.index);
        fault.location.column_name = self.header.names.get(column.index).cloned();
        fault.location.cell = Some(cell.trim().to_string());
        let start = self.line.start + before;
        fault.span = Some((start, start + cell.len()));
        fault
    }

    fn not_a_number(&self, quantity: usize, text: &str) -> DataError {
        let message = match text.parse::<f64>() {
            _ if text.is_empty() => "expected a number, the cell is empty".to_string(),
            Ok(_) => format!("expected a finite number, found \"{text}\""),
            Err(_) => format!("expected a number, found \"{text}\""),
        };
        let help = if text.replace(',', ".").parse::<f64>().is_ok_and(f64::is_finite) {
            format!("write decimals with a point: {}", text.replace(',', "."))
        } else {
            format!(
                "type a plain number (the unit is in the name, as in {}), or delete the row",
                QUANTITIES[quantity].expected
            )
        };
        DataError::Cell(self.fault(quantity, message, help))
    }

    /// A cell and the bytes before it.
    fn span(&self, index: usize) -> (&str, usize) {
        let before: usize = self.line.text.split(self.header.delimiter).take(index).map(|cell| cell.len() + 1).sum();
        (self.line.text.split(self.header.delimiter).nth(index).unwrap_or_default(), before)
    }
}
