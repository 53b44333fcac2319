//! Drawings true to size, in mm: as SVG, cut into pages, and as DXF. For plotters, cutters and scissors.

mod dxf;
mod svg;

pub use dxf::dxf;
pub use svg::{PAPERS, pages, svg};

/// A pen: lines of one meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Pen {
    /// Name in a DXF file: capital letters, digits and `_`.
    pub name: &'static str,
    /// What its lines mean, shown in the legend with the colour in words.
    pub meaning: &'static str,
    /// Colour in an SVG, `#rrggbb`.
    pub colour: &'static str,
    /// AutoCAD colour number of nearly the same.
    pub aci: u8,
    /// Lengths of strokes and gaps \[mm\]; empty for a full line.
    pub dashes: &'static [f64],
}

/// A line through points \[mm\].
#[derive(Debug, Clone, PartialEq)]
pub struct PenLine {
    /// Place of its pen in [`PatternSheet::layers`].
    pub layer: usize,
    /// Corners, y upwards.
    pub points: Vec<[f64; 2]>,
    /// Back to the start.
    pub closed: bool,
}

/// A word at its lower left corner.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetText {
    /// Where \[mm\].
    pub at: [f64; 2],
    /// Height of capital letters \[mm\].
    pub height: f64,
    /// What it says.
    pub text: String,
}

/// A drawing \[mm\], y upwards, its lower left corner at the origin.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PatternSheet {
    /// Title of the file.
    pub title: String,
    /// Width and height \[mm\].
    pub size: [f64; 2],
    /// Pens, the lowest first; lines name them by place.
    pub layers: Vec<Pen>,
    /// Lines.
    pub lines: Vec<PenLine>,
    /// Words, in the last of the layers.
    pub labels: Vec<SheetText>,
}

impl PatternSheet {
    /// Draws a line; a `closed` one goes back to its start.
    pub fn line(&mut self, layer: usize, points: &[[f64; 2]], closed: bool) {
        self.lines.push(PenLine { layer, points: points.to_vec(), closed });
    }

    /// Writes words of a height.
    pub fn word(&mut self, at: [f64; 2], height: f64, text: impl Into<String>) {
        self.labels.push(SheetText { at, height, text: text.into() });
    }
}

#[cfg(test)]
mod tests;
