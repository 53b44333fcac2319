//! A pulled specimen.

use crate::about::Provenance;

/// Angle of the pull to the warp.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Direction {
    /// 0°.
    Warp,
    /// 45°.
    Bias,
    /// Between them \[thousandths of a degree\]; it checks the law that the others make.
    Between(u32),
    /// 90°.
    Fill,
}

/// The curve of a specimen; x rises from row to row, the first row is `[0, 0]`.
#[derive(Debug, Clone, PartialEq)]
pub enum Pulled {
    /// Rows nominal strain \[1\], nominal stress \[Pa\].
    Stress(Vec<[f64; 2]>),
    /// Rows displacement \[m\], force \[N\].
    Force(Vec<[f64; 2]>),
}

/// One pulled specimen.
#[derive(Debug, Clone, PartialEq)]
pub struct Coupon {
    /// File it was read from.
    pub file: String,
    /// Its label.
    pub specimen: String,
    /// Line of its first row, from 1.
    pub line: u64,
    /// Direction of the pull.
    pub direction: Direction,
    /// Its curve.
    pub pulled: Pulled,
    /// Width under load at every row \[m\]; empty without that column.
    pub loaded_width_m: Vec<f64>,
    /// The columns of x and y as the file names them.
    pub columns: [String; 2],
    /// Width \[m\].
    pub width_m: Option<f64>,
    /// Free length between the grips \[m\].
    pub length_m: Option<f64>,
    /// Thickness \[m\].
    pub thickness_m: Option<f64>,
    /// How its numbers came to be.
    pub provenance: Provenance,
    /// Rows left out because x went back by less than a five-hundredth of its range.
    pub jitter: usize,
    /// What reading assumed about the file, in words, with its first specimen.
    pub told: Vec<String>,
}

/// What holds where a file says nothing; a file that says something else is refused.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct CouponDefaults {
    /// Direction \[deg\].
    pub direction_deg: Option<f64>,
    /// Width \[m\].
    pub width_m: Option<f64>,
    /// Free length \[m\].
    pub length_m: Option<f64>,
    /// Thickness \[m\].
    pub thickness_m: Option<f64>,
    /// Names of the columns, in place of those in the header lines.
    pub columns: Vec<String>,
}

impl Direction {
    /// Angle to the warp \[deg\].
    pub fn degrees(self) -> f64 {
        match self {
            Direction::Warp => 0.0,
            Direction::Bias => 45.0,
            Direction::Between(thousandths) => 1e-3 * f64::from(thousandths),
            Direction::Fill => 90.0,
        }
    }

    /// `warp`, `bias`, `fill`, or `off-axis`.
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
    /// The rows, to be changed.
    pub fn rows_mut(&mut self) -> &mut Vec<[f64; 2]> {
        match self {
            Pulled::Stress(rows) | Pulled::Force(rows) => rows,
        }
    }

    /// The rows.
    pub fn rows(&self) -> &[[f64; 2]] {
        match self {
            Pulled::Stress(rows) | Pulled::Force(rows) => rows,
        }
    }
}
