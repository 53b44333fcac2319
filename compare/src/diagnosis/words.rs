//! The story in sentences.

/// A number with three significant digits, without needless zeros.
pub fn value(v: f64) -> String {
    if v == 0.0 || !v.is_finite() {
        return "0".into();
    }
    let size = v.abs();
    if !(1e-3..1e5).contains(&size) {
        return format!("{v:.2e}");
    }
    let digits = (2 - size.log10().floor() as i32).max(0) as usize;
    let text = format!("{v:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

/// `1.5 N/m`, or the number alone if it has no unit.
pub fn quantity(v: f64, unit: &str) -> String {
    if unit == "-" { value(v) } else { format!("{} {unit}", value(v)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_three_digits() {
        let shown = [0.0, 0.4463, 12.0, 123.4, 8.1e-5, 0.5, -1.2345].map(value);
        assert_eq!(shown, ["0", "0.446", "12", "123", "8.10e-5", "0.5", "-1.23"]);
    }
}
