//! The numbers printed in the reference paper, and nothing else.
//!
//! C. du Pasquier, S. Jeong, A. M. Okamura, *Finite Element Modeling of Pneumatic Bending Actuators for Inflated-Beam
//! Robots*, IEEE RA-L 2023, doi 10.1109/LRA.2023.3320010. The file `data/sets/du-pasquier-2023/published.toml` names the
//! table or section of every number; marker coordinates, pouch count, weld width, tape and densities are **not printed**.

use serde::{Deserialize, Deserializer};

use crate::about::parse_toml;
use crate::error::{DataError, Result};
use crate::sets::{set_file, shown};

/// Name of the embedded set with the paper's numbers.
pub const PAPER: &str = "du-pasquier-2023";

/// The paper's numbers in SI units; provenance: *published*.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Published {
    /// Pressures and markers of the tests.
    pub protocol: PublishedProtocol,
    /// The four actuators (Tables II and III).
    #[serde(rename = "actuator")]
    pub actuators: Vec<PublishedActuator>,
    /// The two fabrics (Table I), nylon with coats of TPU and of silicone.
    #[serde(rename = "fabric")]
    pub fabrics: Vec<PublishedFabric>,
    /// Sentences of the text and the captions that runs or patterns can check.
    #[serde(rename = "fact")]
    pub facts: Vec<PublishedFact>,
}

/// The tests of the paper (Section III-D).
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PublishedProtocol {
    /// Body gauge pressure of all tests \[Pa\].
    #[serde(rename = "body_pressure_kpa", deserialize_with = "kpa")]
    pub body_pa: f64,
    /// Actuator gauge pressures, one after the other \[Pa\].
    #[serde(rename = "actuator_pressures_kpa", deserialize_with = "kpa_list")]
    pub actuator_pa: Vec<f64>,
    /// Number of markers; their places are not printed.
    pub markers: usize,
}

/// A sentence with something to check.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PublishedFact {
    /// Name of the fact, unique in the list.
    pub id: String,
    /// Section, table or figure of the paper.
    pub place: String,
    /// The sentence as the paper prints it, shortened.
    pub says: String,
    /// Its numbers in the printed units (kPa, mm, %).
    pub numbers: Vec<f64>,
}

/// Name of an actuator kind as the paper writes one of them.
pub fn printed(kind: &str) -> &str {
    match kind {
        "spam" => "sPAM",
        "cpam" => "cPAM",
        "epam" => "ePAM",
        "fpam" => "fPAM",
        other => other,
    }
}

/// One column of Table II and one row of Table III.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PublishedActuator {
    /// Actuator kind: `spam`, `cpam`, `epam` or `fpam`.
    pub kind: String,
    /// Name as the paper prints it, for example `sPAMs/PMs`.
    pub printed_name: String,
    /// Name of the fabric of the actuator, as in [`Published::fabrics`].
    pub fabric: String,
    /// Length of the body, L_IBR \[m\] (Table II).
    #[serde(rename = "body_length_mm", deserialize_with = "mm")]
    pub body_length_m: f64,
    /// L_actuator \[m\] (Table II): one pouch, or the whole muscle of the fPAM.
    #[serde(rename = "actuator_length_mm", deserialize_with = "mm")]
    pub actuator_length_m: f64,
    /// Width of the flat actuator, W \[m\] (Table II).
    #[serde(rename = "width_mm", deserialize_with = "mm")]
    pub width_m: f64,
    /// f \[m\] (Table II), printed for the cPAM only.
    #[serde(rename = "fold_mm", deserialize_with = "mm_if_printed", default)]
    pub fold_m: Option<f64>,
    /// (actuator pressure \[Pa\], accuracy a of the authors' finite element model \[1\]) (Table III).
    #[serde(rename = "accuracy_pct", deserialize_with = "accuracies")]
    pub accuracy: Vec<(f64, f64)>,
    /// d_max \[m\] (Table III): largest measured vertical displacement, at [`PublishedActuator::d_max_pressure_pa`].
    #[serde(rename = "d_max_mm", deserialize_with = "mm")]
    pub d_max_m: f64,
    /// 30 kPa (Section IV-A: "maximum displacements (at 30 kPa)") \[Pa\].
    #[serde(skip)]
    pub d_max_pressure_pa: f64,
}

/// One fabric, a row of Table I.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct PublishedFabric {
    /// Name of the fabric, as actuators refer to it.
    pub name: String,
    /// Elastic modulus along the warp \[Pa\].
    #[serde(rename = "e0_mpa", deserialize_with = "mpa")]
    pub e0_pa: f64,
    /// Elastic modulus at 45° \[Pa\], printed for the silicone-coated fabric only.
    #[serde(rename = "e45_mpa", deserialize_with = "mpa_if_printed", default)]
    pub e45_pa: Option<f64>,
    /// Elastic modulus along the fill \[Pa\].
    #[serde(rename = "e90_mpa", deserialize_with = "mpa")]
    pub e90_pa: f64,
    /// Thickness of the shell model \[m\] (Section III-A).
    #[serde(rename = "thickness_mm", deserialize_with = "mm")]
    pub thickness_m: f64,
    /// Neo-Hookean C10 as printed (Section III-B), **without a unit**; MPa if the authors worked in mm and N.
    pub c10_printed: Option<f64>,
}

impl Published {
    /// The actuator of this kind (`spam`, `cpam`, `epam`, `fpam`).
    pub fn actuator(&self, kind: &str) -> Option<&PublishedActuator> {
        self.actuators.iter().find(|actuator| actuator.kind.eq_ignore_ascii_case(kind))
    }
}

/// The numbers printed in the paper.
///
/// ```
/// let paper = data::published().unwrap();
/// assert_eq!(paper.protocol.actuator_pa, [10e3, 20e3, 30e3]);
/// assert!(paper.actuator("EPAM").is_some());
/// ```
///
/// # Errors
/// The embedded file is wrong (a test of this crate sees to it that it is not).
pub fn published() -> Result<Published> {
    parse_published(&shown(PAPER, "published.toml"), set_file(PAPER, "published.toml")?)
}

fn parse_published(file: &str, text: &str) -> Result<Published> {
    let mut paper: Published = parse_toml(file, text)?;
    let pressures_pa = &paper.protocol.actuator_pa;
    let highest_pa = pressures_pa.iter().copied().fold(0.0, f64::max);
    for own in &mut paper.actuators {
        if own.accuracy.len() != pressures_pa.len() {
            let message = format!("{} has not one accuracy per pressure", own.kind);
            return Err(DataError::of(file, message, "give one accuracy_pct per pressure"));
        }
        own.accuracy.iter_mut().zip(pressures_pa).for_each(|(pair, pressure_pa)| pair.0 = *pressure_pa);
        own.d_max_pressure_pa = highest_pa;
    }
    Ok(paper)
}

fn mm<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    f64::deserialize(from).map(|value| value / 1e3)
}

fn mm_if_printed<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    mm(from).map(Some)
}

fn kpa<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    f64::deserialize(from).map(|value| value * 1e3)
}

fn kpa_list<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    Vec::<f64>::deserialize(from).map(|all| all.into_iter().map(|value| value * 1e3).collect())
}

fn mpa<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    f64::deserialize(from).map(|value| value * 1e6)
}

fn mpa_if_printed<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    mpa(from).map(Some)
}

/// Accuracies, each still without its pressure.
fn accuracies<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<(f64, f64)>, D::Error> {
    Vec::<f64>::deserialize(from).map(|all| all.into_iter().map(|pct| (f64::NAN, pct / 100.0)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tables_of_the_paper_are_there_in_si_units() {
        let paper = published().unwrap();
        let d_max: Vec<_> = paper.actuators.iter().map(|a| (a.kind.as_str(), format!("{:.4}", a.d_max_m))).collect();
        let expected = [("spam", "0.0675"), ("cpam", "0.1597"), ("epam", "0.1194"), ("fpam", "0.0672")];
        assert_eq!(d_max, expected.map(|(kind, d)| (kind, d.to_string())));
        assert_eq!(paper.actuators.iter().map(|a| a.accuracy.len()).sum::<usize>(), 12);
        assert_eq!(paper.actuator("cPAM").unwrap().accuracy[0], (10_000.0, 0.871));
        assert!((paper.actuator("epam").unwrap().accuracy[1].1 - 0.921).abs() < 1e-15);
        assert_eq!((paper.protocol.body_pa, paper.protocol.markers), (2_000.0, 6));
        assert_eq!(paper.fabrics[0].c10_printed, Some(50.3));
        assert_eq!((paper.fabrics[0].thickness_m, paper.fabrics[1].thickness_m), (0.0002, 0.00005));
        assert_eq!(paper.fabrics[1].e45_pa, Some(4.05e6));
    }

    #[test]
    fn the_tables_agree_with_the_ratios_printed_in_the_text() {
        let paper = published().unwrap();
        let d = |kind: &str| paper.actuator(kind).unwrap().d_max_m;
        assert_eq!(format!("{:.2}", d("cpam") / d("epam")), "1.34", "Section IV-B");
        assert_eq!(format!("{:.2}", d("cpam") / d("spam")), "2.37", "Section IV-B");
        let all = paper.actuators.iter().flat_map(|a| a.accuracy.iter().map(|(_, a)| *a));
        assert_eq!(all.fold(1.0, f64::min), 0.807, "abstract: 80.7 % at lower pressures");
        let fpam = paper.actuator("fpam").unwrap();
        assert!(fpam.accuracy.iter().all(|(_, a)| *a >= 0.967), "abstract: at least 96.7 %");
    }

    #[test]
    fn every_fact_has_a_name_of_its_own_a_place_and_a_sentence() {
        let facts = published().unwrap().facts;
        assert!(facts.len() > 15);
        for (k, fact) in facts.iter().enumerate() {
            assert!(facts[..k].iter().all(|other| other.id != fact.id), "{}", fact.id);
            let known = ["Abstract", "Section", "Fig.", "Table"].iter().any(|word| fact.place.contains(word));
            assert!(known && !fact.says.is_empty(), "{}", fact.id);
        }
    }

    #[test]
    fn every_actuator_names_a_fabric_of_the_paper() {
        let paper = published().unwrap();
        assert!(paper.actuators.iter().all(|a| paper.fabrics.iter().any(|fabric| fabric.name == a.fabric)));
    }
}
