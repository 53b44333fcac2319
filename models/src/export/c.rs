//! A table as C99: a source file and its header, for any compiler and without an allocation.

use super::table::Table;
use std::fmt::Write;

/// What the files say about where they come from.
#[derive(Debug, Clone)]
pub struct Origin<'a> {
    /// Name of the files without ending; every name in them begins with it, in letters that C allows.
    pub prefix: &'a str,
    /// Name of the robot, for the comment at the head of each file.
    pub robot: &'a str,
    /// Command line that wrote the files, for the comment at their head.
    pub command: &'a str,
    /// Effects with history, of which the table has the first loading only.
    pub history: &'a [&'a str],
}

/// What the functions do; `NAME` is the prefix, `@…@` are filled in.
const HEADER: &str = include_str!("table.h");
const SOURCE: &str = include_str!("table.c");

impl Origin<'_> {
    /// The prefix as C allows it: letters, digits and underscores, no digit first.
    /// Public names and the unit for co-simulation begin with it.
    pub fn name(&self) -> String {
        let kept = self.prefix.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' });
        let name: String = kept.collect();
        if name.starts_with(|c: char| c.is_ascii_digit()) || name.is_empty() { format!("robot_{name}") } else { name }
    }

    fn history_words(&self) -> String {
        match self.history {
            [] => "The robot has no history: its answer is the same on every path.".into(),
            names => format!("FIRST LOADING FROM REST, AT ONCE: {} would make later states differ.", names.join(", ")),
        }
    }
}

impl Table {
    /// The header file and the source file. Coefficients are in single precision, as they were when the bounds were found.
    pub fn c_files(&self, origin: &Origin) -> [String; 2] {
        [HEADER, SOURCE].map(|text| self.fill(text, origin))
    }

    pub(super) fn fill(&self, text: &str, origin: &Origin) -> String {
        let name = origin.name();
        let (bound, share) = (&self.bound, |m: f64| sure(m / self.length_m));
        let markers = match self.markers() {
            0 => "none in this table".to_string(),
            _ => format!("{} mm ({} of the length)", decimals(bound.marker_m * 1e3), share(bound.marker_m)),
        };
        let heights = self.heights_m();
        let rising = heights.map_or(format!("nowhere: {name}_pressure always returns 1"), |[low, high]| {
            format!("from {:.3} to {:.3} mm", low * 1e3, high * 1e3)
        });
        let kpa = |pa: f64| format!("{}", round(pa / 1e3));
        let filled = [
            ("@FILE@", plain(origin.prefix)),
            ("@ROBOT@", plain(origin.robot)),
            ("@COMMAND@", plain(origin.command)),
            ("@HISTORY@", origin.history_words()),
            ("@BODY@", kpa(self.body_pa)),
            ("@LOW_KPA@", kpa(self.range_pa[0])),
            ("@HIGH_KPA@", kpa(self.range_pa[1])),
            ("@OPEN_KPA@", kpa(self.open_pa)),
            ("@LENGTH@", format!("{}", round(self.length_m * 1e3))),
            ("@PRESSURES@", bound.pressures.to_string()),
            ("@TIP@", decimals(bound.tip_m * 1e3)),
            ("@TIP_SHARE@", share(bound.tip_m)),
            ("@ANGLE@", decimals(bound.angle_rad.to_degrees())),
            ("@MARKER_BOUND@", markers),
            ("@SLOPE@", decimals(bound.slope_m_per_pa * 1e6)),
            ("@SLOPE_FROM@", kpa(bound.slope_from_pa)),
            ("@RISING@", rising),
            ("@BYTES@", self.bytes().to_string()),
            ("@MARKERS@", self.markers().to_string()),
            ("@PIECES@", self.pieces().to_string()),
            ("@DEGREE@", self.degree.to_string()),
            ("@OUTPUTS@", self.outputs.to_string()),
            ("@LOW@", format!("{:?}", self.range_pa[0])),
            ("@HIGH@", format!("{:?}", self.range_pa[1])),
            ("@OPEN@", format!("{:?}", self.open_pa)),
            ("@FIRST@", self.rising[0].to_string()),
            ("@LAST@", self.rising[1].to_string()),
            ("@EDGES@", floats(&self.edges)),
            ("@COEFFICIENTS@", floats(&self.coefficients)),
        ];
        // Names first: the filled-in values may contain anything.
        let text = text.replace("NAME", &name).replace("UPPER", &name.to_ascii_uppercase());
        filled.iter().fold(text, |text, (key, value)| text.replace(key, value))
    }
}

/// Rounded up to two digits, so that a bound stays one.
fn up(value: f64) -> f64 {
    let step = 10f64.powf(value.log10().floor() - 1.0);
    if value > 0.0 { (value / step).ceil() * step } else { 0.0 }
}

/// A bound with its power of ten.
fn sure(value: f64) -> String {
    format!("{:.1e}", up(value))
}

/// Writes a bound rounded up to two significant digits, without an exponent.
fn decimals(value: f64) -> String {
    let places = if value > 0.0 { (1.0 - value.log10().floor()).clamp(0.0, 12.0) as usize } else { 0 };
    format!("{:.places$}", up(value))
}

/// Six digits of a number for people.
fn round(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

fn plain(text: &str) -> String {
    text.replace("*/", "* /").chars().filter(|c| !c.is_control() && *c != '\\').collect()
}

/// Numbers of single precision, eight a line, each the shortest that reads back the same.
fn floats(values: &[f32]) -> String {
    let mut text = String::new();
    for (i, value) in values.iter().enumerate() {
        let end = if (i + 1) % 8 == 0 || i + 1 == values.len() { "\n" } else { " " };
        let start = if i % 8 == 0 { "    " } else { "" };
        // Writing to a string does not fail.
        let _ = write!(text, "{start}{value:e}f,{end}");
    }
    text
}
