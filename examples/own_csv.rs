//! From a CSV of marker positions to a verdict.
//!
//! The camera sees x along the straight robot and y towards the pouches, at every hold of pressure and in several runs. Noise of the
//! mean comes from differences between runs; what the model misses beyond it is its error. The diagnosis fits the body's bending
//! stiffness B first, then each candidate effect.
//!
//! ```text
//! error beyond noise: 24.6 mm
//! after fitting B: 3.2 mm
//! missing: end_constraint or self_contact or pressure_loss
//! ```

use ibr::data::read::{ReadOptions, parse_markers};
use ibr::{DiagnosisOptions, Evidence, ScenarioFile, compare, diagnose};

/// Header and rows; replace them with your file, or use `Evidence::read("my/markers.csv")`.
const MARKERS: &str = include_str!("../data/sets/synthetic-epam/markers.csv");

pub(crate) fn example() -> Result<String, ibr::Error> {
    let robot = ScenarioFile::read("epam-textbook")?;
    let markers = parse_markers("my.csv", &mut MARKERS.as_bytes(), ReadOptions::default(), &mut |_, _| ())?;
    let data = [Evidence::of(markers, None)];
    let mut lines = format!("error beyond noise: {:.1} mm\n", compare(&robot, &data[0])?.error_mm());
    let found = diagnose(&robot, &data, &DiagnosisOptions::default(), &mut |_, _| ())?;
    lines += &format!("after fitting B: {:.1} mm\n", found.base.systematic_mm);
    lines += &format!("missing: {}\n", found.indistinguishable.join(" or "));
    Ok(lines)
}

fn main() -> Result<(), ibr::Error> {
    print!("{}", example()?);
    Ok(())
}
