//! Axis scales: data range to pixels, round ticks and their labels.

use crate::ReportError;

/// Largest magnitude an axis accepts: beyond it, differences of plotted numbers lose their meaning.
const LARGEST: f64 = 1e15;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ChartAxis {
    /// Data range, lower end first (log10 of it on a logarithmic axis).
    pub(crate) range: [f64; 2],
    pub(crate) pixels: [f64; 2],
    pub(crate) log: bool,
    /// Labels such as `10 µs`, for values in seconds.
    pub(crate) seconds: bool,
}

impl ChartAxis {
    /// A linear axis over all finite values with a margin; it starts at zero when zero is near.
    pub(crate) fn linear(values: impl Iterator<Item = f64>, chart: &'static str) -> Result<Self, ReportError> {
        let [low, high] = extent(values, chart)?;
        let span = if high > low { high - low } else { high.abs().max(1.0) * 0.2 };
        let zero_near = |end: f64, other: f64| end * other >= 0.0 && end.abs() < 0.35 * other.abs();
        let lower = if low == 0.0 || (low > 0.0 && zero_near(low, high)) { 0.0 } else { low - 0.06 * span };
        let upper = if high == 0.0 || (high < 0.0 && zero_near(high, low)) { 0.0 } else { high + 0.06 * span };
        Ok(ChartAxis::exact(if lower < upper { [lower, upper] } else { [lower, lower + 1.0] }))
    }

    pub(crate) fn exact(range: [f64; 2]) -> Self {
        ChartAxis { range, pixels: [0.0, 1.0], log: false, seconds: false }
    }

    /// A linear axis over all finite values with a small rim.
    pub(crate) fn padded(values: impl Iterator<Item = f64>, chart: &'static str) -> Result<Self, ReportError> {
        let [low, high] = extent(values, chart)?;
        let pad = if high > low { 0.04 * (high - low) } else { 0.1 * high.abs().max(1.0) };
        Ok(ChartAxis::exact([low - pad, high + pad]))
    }

    /// A logarithmic axis over all positive finite values, at least one decade wide, with a margin.
    pub(crate) fn log(values: impl Iterator<Item = f64>, chart: &'static str) -> Result<Self, ReportError> {
        let [low, high] = extent(values.filter(|v| *v > 0.0).map(f64::log10), chart)?;
        let pad = (0.06 * (high - low)).max(0.5 * (1.0 - (high - low)).max(0.0)).max(0.1);
        Ok(ChartAxis { log: true, ..ChartAxis::exact([low - pad, high + pad]) })
    }

    pub(crate) fn at(&self, value: f64) -> f64 {
        let value = if self.log { value.log10() } else { value };
        let t = (value - self.range[0]) / (self.range[1] - self.range[0]);
        self.pixels[0] + t * (self.pixels[1] - self.pixels[0])
    }

    /// Tick values and labels, about `target` of them.
    pub(crate) fn ticks(&self, target: usize) -> Vec<(f64, String)> {
        if self.log { self.log_ticks(target) } else { self.linear_ticks(target) }
    }

    fn linear_ticks(&self, target: usize) -> Vec<(f64, String)> {
        let step = round_step((self.range[1] - self.range[0]) / target.max(1) as f64);
        let decimals = step_decimals(step);
        let slack = 1e-9 * (self.range[1] - self.range[0]);
        let first = ((self.range[0] - slack) / step).ceil();
        (0..=4 * target.max(1))
            .map(|i| (first + i as f64) * step)
            .take_while(|value| *value <= self.range[1] + slack)
            .map(|value| (value, number(value, decimals)))
            .collect()
    }

    fn log_ticks(&self, target: usize) -> Vec<(f64, String)> {
        let decades = self.range[1] - self.range[0];
        let inside = |exponent: f64| exponent >= self.range[0] - 1e-9 && exponent <= self.range[1] + 1e-9;
        let every = (decades / target.max(1) as f64).ceil().max(1.0) as i64;
        let factors: &[f64] = if decades > 2.6 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let powers = self.range[0].floor() as i64..=self.range[1].ceil() as i64;
        powers
            .filter(|power| power.rem_euclid(every) == 0)
            .flat_map(|power| factors.iter().map(move |factor| factor * 10f64.powi(power as i32)))
            .filter(|value| inside(value.log10()))
            .map(|value| (value, if self.seconds { duration(value) } else { power_label(value) }))
            .collect()
    }
}

pub(crate) fn extent(values: impl Iterator<Item = f64>, chart: &'static str) -> Result<[f64; 2], ReportError> {
    let found = values
        .filter(|v| v.is_finite())
        .fold(None, |range: Option<[f64; 2]>, v| Some(range.map_or([v, v], |[low, high]| [low.min(v), high.max(v)])));
    let [low, high] = found.ok_or(ReportError::NothingToDraw { chart })?;
    match low.abs().max(high.abs()) {
        largest if largest > LARGEST => Err(ReportError::TooLarge { chart, value: largest }),
        _ => Ok([low, high]),
    }
}

/// The smallest of 1, 2, 2.5, 5 times a power of ten that is not below `rough`.
fn round_step(rough: f64) -> f64 {
    let rough = rough.max(1e-12);
    let power = 10f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 2.5, 5.0].into_iter().find(|f| f * power >= rough * (1.0 - 1e-9)).unwrap_or(10.0);
    factor * power
}

fn step_decimals(step: f64) -> usize {
    (0..12).find(|d| ((step * 10f64.powi(*d)).round() / 10f64.powi(*d) - step).abs() < 1e-6 * step).unwrap_or(12)
        as usize
}

/// A number with fixed decimals, a true minus sign and thin-spaced thousands from 10 000 on.
///
/// ```
/// assert_eq!([report::number(-1.25, 1), report::number(f64::NAN, 1)], ["−1.2", "–"]);
/// ```
pub fn number(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    let digits = format!("{:.decimals$}", value.abs());
    let (whole, fraction) = digits.split_once('.').unwrap_or((&digits, ""));
    let zero = digits.chars().all(|c| c == '0' || c == '.');
    let sign = if value < 0.0 && !zero { "−" } else { "" };
    let point = if fraction.is_empty() { "" } else { "." };
    format!("{sign}{}{point}{fraction}", grouped(whole))
}

/// Decimals at which numbers of this magnitude show four digits or fewer, for columns that must agree.
pub(crate) fn common_decimals(largest: f64) -> usize {
    match largest.abs() {
        v if v < 0.0995 => 4,
        v if v < 9.995 => 2,
        v if v < 999.95 => 1,
        _ => 0,
    }
}

/// A number with about three significant digits.
pub fn short_number(value: f64) -> String {
    match value.abs() {
        v if v >= 99.95 || v == 0.0 => number(value, 0),
        v if v >= 9.995 => number(value, 1),
        v if v >= 0.0995 => number(value, 2),
        v if v >= 0.000_995 => number(value, 4),
        _ => power_label(value),
    }
}

/// A run time with its unit, e.g. `20 µs`.
pub(crate) fn duration(seconds: f64) -> String {
    let (scale, unit) = match seconds {
        s if s < 0.9995e-6 => (1e9, "ns"),
        s if s < 0.9995e-3 => (1e6, "µs"),
        s if s < 0.9995 => (1e3, "ms"),
        _ => (1.0, "s"),
    };
    let value = seconds * scale;
    let near_whole = (value - value.round()).abs() < 0.005 * value;
    let shown = if near_whole { number(value, 0) } else { short_number(value) };
    format!("{shown} {unit}")
}

fn grouped(whole: &str) -> String {
    if whole.len() < 5 {
        return whole.to_owned();
    }
    let lead = whole.len() % 3;
    let mut out = whole[..lead].to_owned();
    for start in (lead..whole.len()).step_by(3) {
        if !out.is_empty() {
            out.push('\u{2009}');
        }
        out.push_str(&whole[start..start + 3]);
    }
    out
}

/// `0.01`, `500`, or with a power of ten outside 0.001 to 10 000.
fn power_label(value: f64) -> String {
    let power = value.abs().log10().floor() as i32;
    if (-3..=4).contains(&power) {
        return number(value, (-power).max(0) as usize);
    }
    let factor = value / 10f64.powi(power);
    let tens = format!("10{}", superscript(power));
    if (factor - 1.0).abs() < 1e-9 {
        tens
    } else {
        format!("{}×{tens}", number(factor, usize::from(factor.fract() != 0.0)))
    }
}

fn superscript(power: i32) -> String {
    let digit =
        |c: char| c.to_digit(10).map_or('⁻', |d| ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][d as usize]);
    power.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &ChartAxis, target: usize) -> Vec<String> {
        axis.ticks(target).into_iter().map(|tick| tick.1).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_inside() {
        let axis = ChartAxis::linear([0.0, 161.6].into_iter(), "test").unwrap();
        assert_eq!(labels(&axis, 4), ["0", "50", "100", "150"]);
        let axis = ChartAxis::exact([-0.03, 0.03]);
        assert_eq!(labels(&axis, 5), ["−0.02", "0.00", "0.02"]);
    }

    #[test]
    fn logarithmic_ticks_name_decades() {
        let axis = ChartAxis::log([1e-6, 1e3].into_iter(), "test").unwrap();
        assert_eq!(labels(&axis, 5), ["10⁻⁶", "0.001", "1", "1000"]);
    }

    #[test]
    fn equal_values_still_give_a_range() {
        for value in [0.0, 5.0, -5.0, 1e-300] {
            let axis = ChartAxis::linear([value; 3].into_iter(), "test").unwrap();
            assert!(axis.range[0] <= value && value <= axis.range[1] && axis.range[0] < axis.range[1], "{axis:?}");
        }
    }

    #[test]
    fn no_finite_value_and_absurd_values_are_errors() {
        let none = ChartAxis::linear([f64::NAN, f64::INFINITY].into_iter(), "test");
        assert!(matches!(none, Err(ReportError::NothingToDraw { chart: "test" })));
        assert!(matches!(ChartAxis::linear([0.0, 1e300].into_iter(), "test"), Err(ReportError::TooLarge { .. })));
        assert!(matches!(ChartAxis::log([-1.0, 0.0].into_iter(), "test"), Err(ReportError::NothingToDraw { .. })));
    }

    #[test]
    fn numbers_read_as_in_print() {
        assert_eq!(number(-0.04, 1), "0.0");
        assert_eq!(number(-12.34, 1), "−12.3");
        assert_eq!(number(1_234_567.0, 0), "1\u{2009}234\u{2009}567");
        assert_eq!(short_number(0.0123), "0.0123");
        assert_eq!(power_label(2e-6), "2×10⁻⁶");
        assert_eq!([duration(8.3e-7), duration(2e-5), duration(340.0)], ["830 ns", "20 µs", "340 s"]);
    }
}
