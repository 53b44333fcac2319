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
    /// Colour of its lines in an SVG, `#rrggbb`.
    pub colour: &'static str,
    /// AutoCAD colour number of nearly the same.
    pub aci: u8,
    /// Lengths of strokes and gaps \[mm\]; empty for a full line.
    pub dashes: &'static [f64],
}

/// Line through points \[mm\], open or closed, drawn by one pen.
#[derive(Debug, Clone, PartialEq)]
pub struct PenLine {
    /// Place of its pen in [`PatternSheet::layers`].
    pub layer: usize,
    /// Corners x, y in their order \[mm\], y upwards.
    pub points: Vec<[f64; 2]>,
    /// True where a last stroke leads back to the start.
    pub closed: bool,
}

/// A word at its lower left corner.
#[derive(Debug, Clone, PartialEq)]
pub struct SheetText {
    /// Lower left corner of the word \[mm\], y upwards.
    pub at: [f64; 2],
    /// Height of the capital letters of the word \[mm\].
    pub height: f64,
    /// Word or number, in one line.
    pub text: String,
}

/// A drawing \[mm\], y upwards, its lower left corner at the origin.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PatternSheet {
    /// Title of the drawing, in the file's head.
    pub title: String,
    /// Width and height of the sheet \[mm\].
    pub size: [f64; 2],
    /// Pens, the lowest first; lines name them by place.
    pub layers: Vec<Pen>,
    /// Lines of all pens, in the order of drawing.
    pub lines: Vec<PenLine>,
    /// Words, in the last of the layers.
    pub labels: Vec<SheetText>,
}

impl PatternSheet {
    /// Draws a line; a `closed` one goes back to its start.
    pub fn line(&mut self, layer: usize, points: &[[f64; 2]], closed: bool) {
        self.lines.push(PenLine { layer, points: points.to_vec(), closed });
    }

    /// Adds a word at its lower left corner, of a height \[mm\].
    pub fn word(&mut self, at: [f64; 2], height: f64, text: impl Into<String>) {
        self.labels.push(SheetText { at, height, text: text.into() });
    }
}

#[cfg(test)]
mod tests;
