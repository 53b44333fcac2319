//! What the tests of a fabric give.

use super::scatter::{FabricNumber, Scatter};
use data::{Direction, Provenance};
use models::fabrics::{BiasExtension, Curve, Woven, Yarn, specimen as fit};
use serde::Serialize;

/// All that the specimens of one fabric say.
#[derive(Debug, Clone, PartialEq)]
pub struct Characterized {
    /// One by one, in the order given.
    pub specimens: Vec<Specimen>,
    /// Numbers of the fabric, with their scatter over specimens.
    pub quantities: Vec<FabricNumber>,
    /// Mean curves along warp and fill.
    pub yarns: Vec<MeanCurve>,
    /// Shear curve from bias extension; `None` without such tests.
    pub shear: Option<ShearCurve>,
    /// Mean thickness \[m\], if any specimen has one.
    pub thickness_m: Option<f64>,
    /// Every test by every law that these tests make.
    pub replays: Vec<Replay>,
    /// How the curves came to be.
    pub provenance: Provenance,
    /// What to look at before the numbers are believed.
    pub warnings: Vec<String>,
    /// What the numbers rest on, for the curious.
    pub notes: Vec<String>,
}

/// Mean stress over strain of one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct MeanCurve {
    /// Direction of the pull: along warp or along fill.
    pub direction: Direction,
    /// Rows nominal strain, mean nominal stress \[Pa\]; strictly rising from `[0, 0]`.
    pub rows: Vec<[f64; 2]>,
    /// Standard deviation between specimens at every row \[Pa\], of two or more.
    pub sd_pa: Vec<Option<f64>>,
}

/// Mean shear force over shear angle.
#[derive(Debug, Clone, PartialEq)]
pub struct ShearCurve {
    /// Rows shear angle \[rad\], mean shear force per length \[N/m\].
    pub rows: Vec<[f64; 2]>,
    /// Standard deviation between specimens at every row \[N/m\], of two or more.
    pub sd_n_per_m: Vec<Option<f64>>,
    /// Rows shear angle \[rad\], moment per volume T₁₂ = F_sh cos γ/t \[Pa\], strictly rising: the woven law's input.
    pub moment_pa: Option<Vec<[f64; 2]>>,
}

/// What one specimen's test gives: curve, modulus and contraction.
#[derive(Debug, Clone, PartialEq)]
pub struct Specimen {
    /// Label of the specimen as in its file.
    pub name: String,
    /// Name of the file with the specimen.
    pub file: String,
    /// Direction of the pull to the yarns.
    pub direction: Direction,
    /// Rows nominal strain, nominal stress \[Pa\] up to the largest; empty if the cross-section is not known.
    pub stress: Vec<[f64; 2]>,
    /// Modulus of this direction \[Pa\], where there are stresses.
    pub modulus_pa: Option<f64>,
    /// Strain up to which the modulus was taken.
    pub modulus_strain: f64,
    /// Strain before the specimen was taut, subtracted.
    pub slack: f64,
    /// Contraction across per stretch along, where the width under load is known.
    pub poisson: Option<f64>,
    /// C₁₀ by stress and by share \[Pa\], along yarns.
    pub c10_pa: Option<[f64; 2]>,
    /// Bias extension, where width and length are known.
    pub strip: Option<BiasStrip>,
    /// Thickness of the specimen \[m\]; `None` if not stated.
    pub thickness_m: Option<f64>,
}

/// A bias-extension test and what came of it.
#[derive(Debug, Clone, PartialEq)]
pub struct BiasStrip {
    /// Its size; the thickness is 1 m where it is not known.
    pub size: BiasExtension,
    /// Rows displacement \[m\], force \[N\] that were used.
    pub pulled: Vec<[f64; 2]>,
    /// Rows shear angle \[rad\], shear force per length \[N/m\], the yarns' stretch taken out where it is known.
    pub shear: Vec<[f64; 2]>,
    /// Slope of the shear force at small angles \[N/m\].
    pub slope_n_per_m: Option<f64>,
    /// Shear angle at which shear stiffens for good, if there is one.
    pub locking: Option<fit::Locking>,
}

/// A test computed with a law.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Replay {
    /// Name of the law that was computed.
    pub law: String,
    /// Label of the specimen it is compared with.
    pub specimen: String,
    /// The law was made of tests of this direction; else it is a check
    #[serde(rename = "used_for_the_law")]
    pub used: bool,
    /// Direction of the pull to the warp
    pub direction_deg: f64,
    /// Law over test at the end, less one: up to 36° of shear in a bias extension
    pub at_end: f64,
    /// Rms of the difference over the test's largest stress
    pub rms: f64,
    /// Rows nominal strain, nominal stress by the law \[Pa\].
    #[serde(skip)]
    pub rows: Vec<[f64; 2]>,
}

impl Characterized {
    /// Adds bending lengths c \[m\] of specimens with weights per area w \[N/m²\]: c, and D = w c³.
    pub fn bend(&mut self, lengths: &[[f64; 2]], word: &str) {
        let c = Scatter::of(lengths.iter().map(|[c, _]| 1e3 * c));
        let d = Scatter::of(lengths.iter().map(|[c, w]| 1e6 * w * c.powi(3)));
        let [length, stiffness] = ["cantilever test, Peirce", "D = w c³"].map(|how| format!("{word}: {how}"));
        self.add(["bending_length", "bending length c"], "mm", c, length);
        self.add(["bending_stiffness", "bending stiffness D, per width"], "µN·m", d, stiffness);
    }

    /// Specimens that were pulled in this direction.
    pub fn of(&self, direction: Direction) -> impl Iterator<Item = &Specimen> {
        self.specimens.iter().filter(move |s| s.direction == direction)
    }

    /// Specimens of bias extension that have a size, with their strips.
    pub fn strips(&self) -> impl Iterator<Item = (&Specimen, &BiasStrip)> {
        self.specimens.iter().filter_map(|s| Some((s, s.strip.as_ref()?)))
    }

    /// The number with this key, such as `nu12`; `None` if no test gives it.
    pub fn quantity(&self, key: &str) -> Option<&FabricNumber> {
        self.quantities.iter().find(|q| q.key == key)
    }

    /// Poisson's ratio ν₁₂ as measured, not below 0; 0 if not measured.
    pub fn nu12(&self) -> f64 {
        self.quantity("nu12").map_or(0.0, |q| q.scatter.mean.max(0.0))
    }

    /// The yarns as a fabric, with a shear that does not matter; none unless both were pulled.
    pub fn yarns_alone(&self) -> Option<Woven> {
        let yarn = |direction| {
            let rows = &self.yarns.iter().find(|y| y.direction == direction)?.rows;
            Yarn::new(Curve::table(rows).ok()?, None).ok()
        };
        let yarns = [yarn(Direction::Warp)?, yarn(Direction::Fill)?];
        Woven::new(yarns, Curve::linear(1e6), self.nu12(), self.thickness_m?).ok()
    }

    /// Adds a number by its key and name, if there is one.
    pub(super) fn add<S: Into<String>>(
        &mut self,
        names: [S; 2],
        unit: &'static str,
        scatter: Option<Scatter>,
        known: impl Into<String>,
    ) {
        let Some(scatter) = scatter else { return };
        let ([key, name], known) = (names.map(Into::into), known.into());
        self.quantities.push(FabricNumber { key, name, unit, scatter, known });
    }

    /// A number over the specimens of a direction that have it.
    pub(super) fn over(&self, direction: Direction, number: impl Fn(&Specimen) -> Option<f64>) -> Option<Scatter> {
        Scatter::of(self.of(direction).filter_map(number))
    }

    pub(super) fn modulus(&self, direction: Direction) -> Option<Scatter> {
        self.over(direction, |s| s.modulus_pa)
    }

    pub(super) fn over_strips(&self, number: impl Fn(&BiasStrip) -> Option<f64>) -> Option<Scatter> {
        Scatter::of(self.strips().filter_map(|(_, strip)| number(strip)))
    }
}

/// Directions that were pulled, by angle.
pub fn directions(specimens: &[Specimen]) -> Vec<Direction> {
    let mut all: Vec<Direction> = specimens.iter().map(|s| s.direction).collect();
    all.sort_by(|a, b| a.degrees().total_cmp(&b.degrees()));
    all.dedup();
    all
}
