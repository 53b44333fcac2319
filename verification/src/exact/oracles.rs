//! Numbers computed independently of this code, each with the precision it is known to, and what this code gives.
//!
//! The expected values come from separate calculations (closed forms checked by finite differences and quadrature), not
//! from this crate. They are written as text, so that the last printed digit sets the tolerance: nobody can widen it.

pub mod balloon;
pub mod beam;
pub mod coupon;
pub mod elastic_pouch;
pub mod elastica;
pub mod fold;
pub mod fpam;
pub mod hinge;
pub mod inflated_cantilever;
pub mod mckibben;
pub mod membrane;
pub mod pouch;
pub mod shell;
pub mod tube;

/// One number: what is expected, what is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OracleRow {
    /// Which exact solution, such as "pouch motor, linear".
    pub section: &'static str,
    /// Which quantity at which arguments, with its unit.
    pub quantity: &'static str,
    /// The expected number as printed.
    pub printed: &'static str,
    /// The expected number.
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

/// Every oracle, in the order of the files of this folder.
pub fn oracle_table() -> Vec<OracleRow> {
    [
        pouch::rows(),
        elastic_pouch::rows(),
        hinge::rows(),
        mckibben::rows(),
        fpam::rows(),
        tube::rows(),
        beam::rows(),
        inflated_cantilever::rows(),
        shell::rows(),
        elastica::rows(),
        fold::rows(),
        coupon::rows(),
        membrane::rows(),
        balloon::rows(),
    ]
    .concat()
}

/// Rows of one section from `(quantity, printed, computed)`.
fn section<const N: usize>(section: &'static str, rows: [(&'static str, &'static str, f64); N]) -> Vec<OracleRow> {
    rows.into_iter()
        .map(|(quantity, printed, computed)| {
            // A misprint gives NaN, which agrees with nothing.
            let expected = printed.parse().unwrap_or(f64::NAN);
            OracleRow { section, quantity, printed, expected, computed, half_unit: half_unit(printed) }
        })
        .collect()
}

/// Half a unit of the last digit of a decimal number such as "1.77e-5".
fn half_unit(printed: &str) -> f64 {
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((printed, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, fraction)| fraction.len());
    let exponent = exponent.parse().map_or(f64::NAN, |e: f64| e - decimals as f64);
    0.5 * 10_f64.powf(exponent)
}

/// Fails with every row that disagrees, not only the first.
#[cfg(test)]
pub(super) fn assert_all_agree(rows: &[OracleRow]) {
    let wrong: Vec<String> = rows
        .iter()
        .filter(|row| !row.agrees())
        .map(|row| format!("{}: {}: expected {}, computed {}", row.section, row.quantity, row.printed, row.computed))
        .collect();
    assert!(!rows.is_empty() && wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_unit_follows_the_last_printed_digit() {
        assert_eq!(half_unit("0"), 0.5);
        assert!((half_unit("148.807") - 5e-4).abs() < 1e-18);
        assert!((half_unit("1.77763346e-5") - 5e-14).abs() < 1e-26);
    }

    #[test]
    fn a_row_off_by_more_than_half_a_unit_or_not_a_number_disagrees() {
        let row = |computed| section("s", [("q", "1.25", computed)])[0];
        assert!(row(1.2549).agrees() && !row(1.2551).agrees() && !row(f64::NAN).agrees());
        assert!(!section("s", [("q", "1.2x", 1.2)])[0].agrees());
    }

    #[test]
    fn the_whole_table_agrees_and_no_row_appears_twice() {
        let table = oracle_table();
        assert_all_agree(&table);
        for (i, row) in table.iter().enumerate() {
            let twin = table[..i].iter().find(|other| (other.section, other.quantity) == (row.section, row.quantity));
            assert_eq!(twin, None);
        }
    }
}
