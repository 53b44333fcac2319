//! Fabric in the cantilever test: a strip over an edge droops under its own weight (Peirce 1930; ISO 9073-7, ASTM D1388).
//!
//! ```text
//! c = l [cos(θ/2)/(8 tan θ)]^⅓     D = w c³          without θ: c = l/2, the standards' convention for 41.5°
//! ```
//!
//! l overhang, θ angle below the horizontal of the line from edge to tip, c bending length \[m\], w weight per area \[N/m²\], D
//! bending stiffness per width \[N·m\]. At 41.5° the formula has 0.509, so the convention makes D 5 % smaller.

use super::kind::{Bench, BenchKind, BenchRow};
use crate::columns::{Field, field, plain};
use crate::units::MeasuredQuantity::{Angle, Length};

pub(super) const ENTRY: BenchKind = BenchKind {
    name: "bending_length",
    sentence: "droop of a strip of fabric under its own weight, one specimen a row",
    columns: COLUMNS,
    check,
};

const COLUMNS: &[Field] = &[
    field("bending_length", "bending_length_mm", Length, false),
    field("overhang", "overhang_mm", Length, false),
    field("droop", "droop_deg", Angle, false),
    plain("areal_mass_g_m2", true),
];

fn check(row: &BenchRow) -> Result<(), [String; 2]> {
    let mass = row.value("areal_mass_g_m2");
    if !(mass > 0.1 && mass < 1e5) {
        let help = "write grams per square metre, for example # areal_mass_g_m2: 155".into();
        return Err([format!("the fabric weighs {mass} g/m2"), help]);
    }
    if let Some(droop) = row.get("droop")
        && !(droop > 0.0 && droop < 90.0)
    {
        let help =
            "write the angle below the horizontal of the line from edge to tip, 41.5 in a standard tester".into();
        return Err([format!("the strip droops by {droop} degrees"), help]);
    }
    match bending_length_m(row) {
        Some(c) if c > 0.0 && c < 1.0 => Ok(()),
        _ => Err(["the row has no length".into(), "write overhang_mm with droop_deg, or bending_length_mm".into()]),
    }
}

fn bending_length_m(row: &BenchRow) -> Option<f64> {
    let share = row.get("droop").map(f64::to_radians).map_or(0.5, |a| ((0.5 * a).cos() / (8.0 * a.tan())).cbrt());
    let peirce = |l: f64| l * share;
    row.get("bending_length").or_else(|| row.get("overhang").map(peirce))
}

/// Bending lengths c \[m\] of a table of this kind and weights per area w \[N/m²\], row by row.
pub fn bending_lengths_m(bench: &Bench) -> Vec<[f64; 2]> {
    const G: f64 = 9.806_65;
    let row = |row: &BenchRow| Some([bending_length_m(row)?, 1e-3 * G * row.get("areal_mass_g_m2")?]);
    bench.rows.iter().filter_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::super::parse_bench;
    use super::*;

    /// The standards' angle makes the bending length half the overhang within 2 %, and a nearly flat strip is a beam under its own weight:
    /// tip drop w l⁴/(8 D), which is θ = w l³/(8 D).
    #[test]
    fn bending_length_is_half_the_overhang_without_an_angle_and_a_beams_when_nearly_flat() {
        let text = "# areal_mass_g_m2: 155\noverhang_mm,droop_deg\n60,\n60,41.5\n10,0.01\n";
        let found = bending_lengths_m(&parse_bench("a.csv", text).unwrap().unwrap());
        assert!((found[0][0] - 0.03).abs() < 1e-15 && (found[1][0] / 0.03 - 1.0186).abs() < 1e-3, "{found:?}");
        let [c, w] = found[2];
        let drop = w * 0.01_f64.powi(3) / (8.0 * w * c.powi(3));
        assert!((drop / 0.01_f64.to_radians() - 1.0).abs() < 1e-6 && (w - 1.52003).abs() < 1e-4, "{drop} {w}");
    }
}
