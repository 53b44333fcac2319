//! A pulled specimen: its direction, its curve and its size.

use crate::about::Provenance;

/// Angle of the pull to the warp.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Direction {
    /// Along the warp yarns, at 0°.
    Warp,
    /// At 45° to the yarns, where the fabric shears.
    Bias,
    /// Between them \[thousandths of a degree\]; it checks the law that the others make.
    Between(u32),
    /// Along the fill yarns, at 90°.
    Fill,
}

/// The curve of a specimen; x rises from row to row, the first row is `[0, 0]`.
#[derive(Debug, Clone, PartialEq)]
pub enum Pulled {
    /// Rows nominal strain \[1\], nominal stress \[Pa\].
    Stress(Vec<[f64; 2]>),
    /// Rows displacement \[m\], force \[N\], where the section is not known.
    Force(Vec<[f64; 2]>),
}

/// One pulled specimen, with everything that its file states of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Coupon {
    /// Name of the file it was read from.
    pub file: String,
    /// Label of the specimen in its file.
    pub specimen: String,
    /// Line of its first row, from 1.
    pub line: u64,
    /// Direction of the pull to the warp.
    pub direction: Direction,
    /// Stress over strain, or force over displacement.
    pub pulled: Pulled,
    /// Width under load at every row \[m\]; empty without that column.
    pub loaded_width_m: Vec<f64>,
    /// The columns of x and y as the file names them.
    pub columns: [String; 2],
    /// Width of the unloaded specimen \[m\]; `None` if not stated.
    pub width_m: Option<f64>,
    /// Free length between the grips \[m\].
    pub length_m: Option<f64>,
    /// Thickness of the specimen \[m\]; `None` if not stated.
    pub thickness_m: Option<f64>,
    /// How its numbers came to be.
    pub provenance: Provenance,
    /// Rows left out because x went back by less than a five-hundredth of its range.
    pub jitter: usize,
    /// What reading assumed about the file, in words, with its first specimen.
    pub told: Vec<String>,
}

/// What holds where a file has no line; a file with another value is refused.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CouponDefaults {
    /// Angle of the pull to the warp \[deg\].
    pub direction_deg: Option<f64>,
    /// Width of the unloaded specimens \[m\].
    pub width_m: Option<f64>,
    /// Free length between the grips \[m\].
    pub length_m: Option<f64>,
    /// Thickness of all specimens of the file \[m\].
    pub thickness_m: Option<f64>,
    /// Names of the columns, in place of those in the header lines.
    pub columns: Vec<String>,
}

impl Direction {
    /// Angle of the pull to the warp, 0 to 90 \[deg\].
    pub fn degrees(self) -> f64 {
        match self {
            Direction::Warp => 0.0,
            Direction::Bias => 45.0,
            Direction::Between(thousandths) => 1e-3 * f64::from(thousandths),
            Direction::Fill => 90.0,
        }
    }

    /// The word of files and tables: `warp`, `bias`, `fill`, or `off-axis`.
    pub fn word(self) -> &'static str {
        match self {
            Direction::Warp => "warp",
            Direction::Bias => "bias",
            Direction::Between(_) => "off-axis",
            Direction::Fill => "fill",
        }
    }

    /// Whether the pull is along a yarn.
    pub fn along_yarn(self) -> bool {
        matches!(self, Direction::Warp | Direction::Fill)
    }

    pub(super) fn of(degrees: f64) -> Option<Direction> {
        let named = [Direction::Warp, Direction::Bias, Direction::Fill].into_iter().find(|d| d.degrees() == degrees);
        let between = || (degrees > 0.0 && degrees < 90.0).then(|| Direction::Between((1e3 * degrees).round() as u32));
        named.or_else(between)
    }
}

impl Pulled {
    /// Rows of either kind of curve, for changes.
    pub fn rows_mut(&mut self) -> &mut Vec<[f64; 2]> {
        match self {
            Pulled::Stress(rows) | Pulled::Force(rows) => rows,
        }
    }

    /// Rows of either kind of curve.
    pub fn rows(&self) -> &[[f64; 2]] {
        match self {
            Pulled::Stress(rows) | Pulled::Force(rows) => rows,
        }
    }
}
