//! What tests of a fabric say.

use crate::prelude::*;
use compare::characterize::write::measured_toml;
use compare::characterize::{Characterized, FabricNumber, Specimen};
use data::Direction;

pub(crate) fn text(found: &Characterized) -> String {
    let count = |d: Direction| format!("{} at {}°", found.of(d).count(), d.degrees());
    let directions = found.directions().into_iter().map(count).collect::<Vec<_>>().join(", ");
    let mut text = format!("Specimens: {directions} ({})\n", found.provenance.word());
    text += &Table::of(&found.quantities)
        .words("quantity", |q| &q.name)
        .words("how known", |q| &q.known)
        .right("mean", |q| digits(Some(q.scatter.mean)))
        .right("unit", |q| q.unit)
        .right("95 % interval of the mean", |q| {
            q.scatter.interval().map_or("–".into(), |ends| ends.map(|end| digits(Some(end))).join(" – "))
        })
        .right("sd", |q| digits(q.scatter.sd))
        .right("n", |q| q.scatter.n.to_string())
        .text();
    text += &Table::of(&found.specimens)
        .words("specimen", |s| &s.name)
        .right("direction", |s| format!("{}°", s.direction.degrees()))
        .number("slack [%]", 3, |s| Some(100.0 * s.slack).filter(|slack| *slack > 0.0))
        .right("modulus [MPa]", |s| digits(s.modulus_pa.map(|e| 1e-6 * e)))
        .right("C10 [MPa]", |s| digits(s.c10_pa.map(|c| 1e-6 * c[0])))
        .number("largest strain [%]", 1, |s| largest_strain(s).map(|e| 100.0 * e))
        .number("locking [°]", 1, |s| locking_rad(s).map(f64::to_degrees))
        .text();
    if !found.replays.is_empty() {
        text +=
            "Every test by the law that was made of them: law over test, at the end and rms of the largest stress\n";
        text += &Table::of(&found.replays)
            .words("law", |r| &r.law)
            .words("specimen", |r| &found.specimens[r.specimen].name)
            .words("direction", |r| format!("{}°", found.specimens[r.specimen].direction.degrees()))
            .words("used", |r| if r.used { "for the law" } else { "check" })
            .right("at the end", |r| format!("{:+.1} %", 100.0 * r.at_end))
            .right("rms", |r| format!("{:.1} %", 100.0 * r.rms))
            .text();
    }
    text + &lines("look at: ", &found.warnings) + &lines("note: ", &found.notes)
}

fn locking_rad(s: &Specimen) -> Option<f64> {
    Some(s.strip.as_ref()?.locking?.angle)
}

fn largest_strain(s: &Specimen) -> Option<f64> {
    let stretched = || s.strip.as_ref().and_then(|strip| Some(strip.pulled.last()?[0] / strip.size.length_m));
    s.stress.last().map(|row| row[0]).or_else(stretched)
}

fn digits(x: Option<f64>) -> String {
    let decimals = |x: f64| (3 - x.abs().max(1e-3).log10().floor() as i32).clamp(0, 6) as usize;
    x.map_or("–".into(), |x| format!("{x:.0$}", decimals(x)))
}

/// `ibr.characterize`: `ibr characterize FILES`
#[derive(Serialize)]
pub(crate) struct FabricAnswer<'a> {
    /// How the tests came to be
    pub provenance: Provenance,
    /// Means over specimens
    pub quantities: Vec<FabricQuantity<'a>>,
    /// What was read of each
    pub specimens: Vec<SpecimenRead<'a>>,
    /// Curve along the warp: strain, stress
    pub warp_strain_pa: Option<&'a [[f64; 2]]>,
    /// Curve along the fill: strain, stress
    pub fill_strain_pa: Option<&'a [[f64; 2]]>,
    /// Shear curve: angle, tension
    pub shear_rad_n_per_m: Option<&'a [[f64; 2]]>,
    /// Shear curve: angle, stress
    pub shear_rad_pa: Option<&'a [[f64; 2]]>,
    /// Thickness
    pub thickness_m: Option<f64>,
    /// Tests computed with the law
    pub replays: Vec<LawOnTest<'a>>,
    /// Cautions
    pub warnings: &'a [String],
    /// Remarks
    pub notes: &'a [String],
    /// A table for cases
    pub fabric_toml: Option<&'a str>,
    /// Lines for about.toml
    pub measured_toml: Option<String>,
}

/// A mean over specimens.
#[derive(Serialize)]
pub(crate) struct FabricQuantity<'a> {
    /// The number
    #[serde(flatten)]
    pub number: &'a FabricNumber,
    /// 95 % interval of the mean
    pub interval: Option<[f64; 2]>,
}

/// What was read of a specimen.
#[derive(Serialize)]
pub(crate) struct SpecimenRead<'a> {
    /// Specimen
    pub specimen: &'a str,
    /// File
    pub file: &'a str,
    /// Direction of the pull to the warp
    pub direction_deg: f64,
    /// Modulus
    pub modulus_pa: Option<f64>,
    /// Strain up to which it was taken
    pub modulus_to_strain: f64,
    /// Strain taken off as slack
    pub slack_strain: f64,
    /// Ratio of Poisson
    pub poisson: Option<f64>,
    /// Neo-Hookean C10
    pub c10_pa: Option<f64>,
    /// Shear at which it locks
    pub locking_rad: Option<f64>,
    /// Shear and tension
    pub shear_rad_n_per_m: Option<&'a [[f64; 2]]>,
}

/// A test computed with the law.
#[derive(Serialize)]
pub(crate) struct LawOnTest<'a> {
    /// Which law
    pub law: &'a str,
    /// Specimen
    pub specimen: &'a str,
    /// The law was made of it
    pub used_for_the_law: bool,
    /// Direction of the pull to the warp
    pub direction_deg: f64,
    /// Law over test at the end, less one
    pub at_end: f64,
    /// Rms of law over test, less one
    pub rms: f64,
}

impl<'a> FabricAnswer<'a> {
    /// Of what was found, with the text of `fabric.toml` if there is one.
    pub(crate) fn of(found: &'a Characterized, fabric_toml: Option<&'a str>) -> FabricAnswer<'a> {
        let yarn = |direction| found.yarns.iter().find(|y| y.direction == direction).map(|y| &y.rows[..]);
        let quantity = |number: &'a FabricNumber| FabricQuantity { number, interval: number.scatter.interval() };
        let specimens = found.specimens.iter().map(|s| SpecimenRead {
            specimen: &s.name,
            file: &s.file,
            direction_deg: s.direction.degrees(),
            modulus_pa: s.modulus_pa,
            modulus_to_strain: s.modulus_strain,
            slack_strain: s.slack,
            poisson: s.poisson,
            c10_pa: s.c10_pa.map(|c| c[0]),
            locking_rad: locking_rad(s),
            shear_rad_n_per_m: s.strip.as_ref().map(|s| &s.shear[..]),
        });
        let replays = found.replays.iter().map(|r| LawOnTest {
            law: &r.law,
            specimen: &found.specimens[r.specimen].name,
            used_for_the_law: r.used,
            direction_deg: found.specimens[r.specimen].direction.degrees(),
            at_end: r.at_end,
            rms: r.rms,
        });
        FabricAnswer {
            provenance: found.provenance,
            quantities: found.quantities.iter().map(quantity).collect(),
            specimens: specimens.collect(),
            warp_strain_pa: yarn(Direction::Warp),
            fill_strain_pa: yarn(Direction::Fill),
            shear_rad_n_per_m: found.shear.as_ref().map(|s| &s.rows[..]),
            shear_rad_pa: found.shear.as_ref().and_then(|s| s.moment_pa.as_deref()),
            thickness_m: found.thickness_m,
            replays: replays.collect(),
            warnings: &found.warnings,
            notes: &found.notes,
            fabric_toml,
            measured_toml: measured_toml(found, &program()),
        }
    }
}
