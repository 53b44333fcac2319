//! Numbers computed independently of this code, each with the precision it is known to, and what this code gives.
//!
//! The expected ones stand in `known.txt` as text, so that the last printed digit sets the tolerance, which no code can widen.

/// Sections of `known.txt` with what this code gives for their lines, in order.
pub(super) type KnownSections = Vec<(&'static str, Vec<f64>)>;

const PRINTED: &str = include_str!("known.txt");

/// One number: the expected and the computed value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OracleRow {
    /// Which exact solution, such as "pouch motor, linear".
    pub section: &'static str,
    /// Which quantity at which arguments, with its unit.
    pub quantity: &'static str,
    /// The expected number with the digits that `known.txt` prints.
    pub printed: &'static str,
    /// The expected number as a value.
    pub expected: f64,
    /// What this crate computes, in the same unit.
    pub computed: f64,
    /// Half a unit of the last printed digit.
    pub half_unit: f64,
}

impl OracleRow {
    /// Whether the computed number rounds to the printed one; false for NaN.
    pub fn agrees(&self) -> bool {
        (self.computed - self.expected).abs() <= self.half_unit
    }
}

/// Every oracle of some closed forms.
pub(super) fn table(forms: &[fn() -> KnownSections]) -> Vec<OracleRow> {
    let all = forms.iter().flat_map(|known| known());
    all.flat_map(|(name, computed)| section(PRINTED, name, &computed)).collect()
}

/// Rows of one section. A line without a computed number does not agree; neither does a computed number without a line.
fn section(printed: &'static str, name: &'static str, computed: &[f64]) -> Vec<OracleRow> {
    let from =
        printed.lines().skip_while(|line| line.strip_prefix('[').and_then(|l| l.strip_suffix(']')) != Some(name));
    let lines: Vec<_> = from.skip(1).take_while(|line| !line.is_empty()).filter_map(|l| l.split_once('\t')).collect();
    let row = |i: usize| {
        let (printed, quantity) = lines.get(i).copied().unwrap_or(("none", "not in known.txt"));
        OracleRow {
            section: name,
            quantity,
            printed,
            expected: printed.parse().unwrap_or(f64::NAN),
            computed: computed.get(i).copied().unwrap_or(f64::NAN),
            half_unit: half_unit(printed),
        }
    };
    (0..lines.len().max(computed.len())).map(row).collect()
}

/// Half a unit of the last digit of a decimal number such as "1.77e-5".
fn half_unit(printed: &str) -> f64 {
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((printed, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let exponent = exponent.parse().map_or(f64::NAN, |e: f64| e - decimals as f64);
    0.5 * 10_f64.powf(exponent)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::oracle_table;

    #[test]
    fn half_unit_follows_the_last_printed_digit() {
        assert_eq!(half_unit("0"), 0.5);
        assert!((half_unit("148.807") - 5e-4).abs() < 1e-18);
        assert!((half_unit("1.77763346e-5") - 5e-14).abs() < 1e-26);
    }

    #[test]
    fn a_row_off_by_more_than_half_a_unit_or_not_a_number_disagrees() {
        let row = |computed| section("[s]\n1.25\tq", "s", &[computed])[0];
        assert!(row(1.2549).agrees() && !row(1.2551).agrees() && !row(f64::NAN).agrees());
        assert!(!section("[s]\n1.2x\tq", "s", &[1.2])[0].agrees());
    }

    #[test]
    fn a_line_that_is_not_computed_and_a_number_without_a_line_disagree() {
        for computed in [&[1.25][..], &[1.25, 2.0, 3.0]] {
            let rows = section("[s]\n1.25\tq\n2\tr\n\n[t]\n3\tu", "s", computed);
            assert!(rows[0].agrees() && !rows[rows.len() - 1].agrees(), "{rows:?}");
        }
    }

    #[test]
    fn the_whole_table_agrees_and_no_row_appears_twice() {
        let table = oracle_table();
        let wrong: Vec<&OracleRow> = table.iter().filter(|row| !row.agrees()).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
        assert_eq!(table.len(), PRINTED.lines().filter(|line| line.contains('\t')).count());
        for (i, row) in table.iter().enumerate() {
            let twin = table[..i].iter().find(|other| (other.section, other.quantity) == (row.section, row.quantity));
            assert_eq!(twin, None);
        }
    }
}
