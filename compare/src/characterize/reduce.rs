//! Over specimens: the numbers with their scatter, the mean curves, the shear curve.

use data::{Coupon, DataError, Direction, Fault, Provenance};
use models::fabrics::{Curve, Fabric, Woven, Yarn, shear_modulus, specimen as fit};

use super::scatter::{FabricNumber, Scatter};
use super::specimen::{self, BiasStrip, Specimen};
use super::{PAPER_LIMIT_RAD, Reduction, Replay, replay, warn};
use crate::CompareError;

/// Rows of a mean curve: a law's table, fine enough for any bend of a fabric.
const STEPS: usize = 24;

/// All that the specimens of one fabric say.
#[derive(Debug, Clone, PartialEq)]
pub struct Characterized {
    /// One by one, in the order given.
    pub specimens: Vec<Specimen>,
    /// Numbers of the fabric.
    pub quantities: Vec<FabricNumber>,
    /// Mean curves along warp and fill.
    pub yarns: Vec<MeanCurve>,
    /// Shear curve, from bias extension.
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
    /// Warp or fill.
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

/// Reduces all specimens of one fabric.
///
/// # Errors
/// No specimen, a specimen given twice, and whatever [`specimen`] refuses.
pub fn characterize(coupons: &[Coupon], settings: &Reduction) -> Result<Characterized, CompareError> {
    different(coupons)?;
    let mut warnings = Vec::new();
    let (taut, slacks): (Vec<Coupon>, Vec<f64>) = coupons.iter().map(|c| specimen::taut(c, settings)).unzip();
    let reduced: Result<Vec<Specimen>, DataError> =
        taut.iter().map(|coupon| specimen::reduce(coupon, settings, &mut warnings)).collect();
    let mut specimens = reduced?;
    specimens.iter_mut().zip(slacks).for_each(|(s, slack)| s.slack = slack);
    warn::deviations(&specimens, &mut warnings);
    let thickness_m = thickness(&specimens, &mut warnings);
    let provenance = coupons.iter().map(|c| c.provenance).find(|p| *p != Provenance::Measured);
    let mut found = Characterized {
        yarns: [Direction::Warp, Direction::Fill].into_iter().filter_map(|d| mean_curve(&specimens, d)).collect(),
        shear: None,
        replays: Vec::new(),
        quantities: Vec::new(),
        provenance: provenance.unwrap_or(Provenance::Measured),
        notes: Vec::new(),
        specimens,
        thickness_m,
        warnings,
    };
    moduli(&mut found);
    poisson(&mut found);
    rubber(&mut found);
    strips(&mut found, &taut, settings)?;
    shear(&mut found);
    reach(&mut found);
    found.notes.extend(warn::slack(&found.specimens));
    found.replays = replay::replays(&found, settings);
    let law = found.replays.iter().filter(|r| r.law == settings.name && !r.used).map(|r| r.at_end);
    warn::checks(law, &mut found.warnings);
    Ok(found)
}

/// The shear of the bias tests, the yarns' stretch taken out where both yarns were pulled.
fn strips(found: &mut Characterized, taut: &[Coupon], settings: &Reduction) -> Result<(), DataError> {
    let yarns = found.yarns_alone();
    let yarns = yarns.as_ref().map(|y| y as &dyn Fabric);
    for (i, coupon) in taut.iter().enumerate() {
        found.specimens[i].strip = specimen::strip(coupon, yarns, settings, &mut found.warnings)?;
    }
    if yarns.is_none() && found.strips().next().is_some() {
        found.notes.push(
            "the shear curve takes yarns that do not stretch, as nothing says how they do: give specimens of 0° and 90° and \
             the thickness"
                .into(),
        );
    }
    found.shear = shear_curve(&found.specimens, found.thickness_m);
    Ok(())
}

impl Characterized {
    /// Adds bending lengths c \[m\] of specimens with weights per area w \[N/m²\]: c, and D = w c³.
    pub fn bend(&mut self, lengths: &[[f64; 2]], word: &str) {
        let c = Scatter::of(&lengths.iter().map(|[c, _]| 1e3 * c).collect::<Vec<_>>());
        let d = Scatter::of(&lengths.iter().map(|[c, w]| 1e6 * w * c.powi(3)).collect::<Vec<_>>());
        self.add("bending_length", "bending length c", "mm", c, format!("{word}: cantilever test, Peirce"));
        self.add("bending_stiffness", "bending stiffness D, per width", "µN·m", d, format!("{word}: D = w c³"));
    }

    /// Specimens of a direction.
    pub fn of(&self, direction: Direction) -> impl Iterator<Item = &Specimen> {
        self.specimens.iter().filter(move |s| s.direction == direction)
    }

    /// Bias-extension tests.
    pub fn strips(&self) -> impl Iterator<Item = (&Specimen, &BiasStrip)> {
        self.specimens.iter().filter_map(|s| Some((s, s.strip.as_ref()?)))
    }

    /// A number by its key.
    pub fn quantity(&self, key: &str) -> Option<&FabricNumber> {
        self.quantities.iter().find(|q| q.key == key)
    }

    /// Directions that were pulled, by angle.
    pub fn directions(&self) -> Vec<Direction> {
        warn::directions(&self.specimens)
    }

    /// ν₁₂: measured, else 0.
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

    fn add(&mut self, key: &str, name: &str, unit: &'static str, scatter: Option<Scatter>, known: String) {
        let quantity = |scatter| FabricNumber { key: key.to_string(), name: name.to_string(), unit, scatter, known };
        self.quantities.extend(scatter.map(quantity));
    }

    fn modulus(&self, direction: Direction) -> Option<Scatter> {
        Scatter::of(&self.of(direction).filter_map(|s| s.modulus_pa).collect::<Vec<f64>>())
    }
}

fn different(coupons: &[Coupon]) -> Result<(), DataError> {
    let key = |c: &Coupon| (c.direction, c.specimen.clone());
    for (i, c) in coupons.iter().enumerate() {
        if let Some(first) = coupons[..i].iter().find(|other| key(other) == key(c)) {
            let message = format!(
                "specimen {} ({}°) is there twice, here and in {}:{}",
                c.specimen,
                c.direction.degrees(),
                first.file,
                first.line
            );
            let help = "give each specimen once, or another label in the column specimen";
            return Err(DataError::Runs(Box::new(Fault::of_file(&c.file, message, help).at_line(c.line))));
        }
    }
    if coupons.is_empty() {
        let fault = Fault::of_file("characterize", "there is no specimen", "give at least one file");
        return Err(DataError::Runs(Box::new(fault)));
    }
    Ok(())
}

fn thickness(specimens: &[Specimen], warnings: &mut Vec<String>) -> Option<f64> {
    let all: Vec<f64> = specimens.iter().filter_map(|s| s.thickness_m).collect();
    let [low, high] = all.iter().fold([f64::INFINITY, 0.0], |[a, b], t| [f64::min(a, *t), f64::max(b, *t)]);
    if high > 1.1 * low {
        warnings.push(format!(
            "the thickness is {:.4} to {:.4} mm, the mean is used: are all specimens of one fabric?",
            1e3 * low,
            1e3 * high
        ));
    }
    Scatter::of(&all).map(|s| s.mean)
}

/// Rows of a mean, and the standard deviation at each.
type MeanRows = (Vec<[f64; 2]>, Vec<Option<f64>>);

/// Means over specimens on common places up to where the shortest ends.
fn mean(curves: &[&[[f64; 2]]]) -> Option<MeanRows> {
    let end = curves.iter().filter_map(|rows| rows.last()).map(|row| row[0]).fold(f64::INFINITY, f64::min);
    if curves.is_empty() || !(end > 0.0 && end.is_finite()) {
        return None;
    }
    let place = |i: usize| end * i as f64 / STEPS as f64;
    let at = |x: f64| Scatter::of(&curves.iter().map(|rows| fit::at(rows, x)).collect::<Vec<f64>>());
    let rows = (0..=STEPS).filter_map(|i| Some((place(i), at(place(i))?)));
    Some(rows.map(|(x, s)| ([x, s.mean], s.sd)).unzip())
}

fn mean_curve(specimens: &[Specimen], direction: Direction) -> Option<MeanCurve> {
    let same = specimens.iter().filter(|s| s.direction == direction && s.stress.len() > 1);
    let (mean, sd) = mean(&same.map(|s| s.stress.as_slice()).collect::<Vec<_>>())?;
    let rows = fit::rising(&mean);
    let spread: Vec<[f64; 2]> = mean.iter().zip(&sd).map(|(row, sd)| [row[0], sd.unwrap_or(f64::NAN)]).collect();
    let sd_pa = rows.iter().map(|row| Some(fit::at(&spread, row[0])).filter(|sd| sd.is_finite())).collect();
    (rows.len() > 1).then_some(MeanCurve { direction, rows, sd_pa })
}

fn shear_curve(specimens: &[Specimen], thickness_m: Option<f64>) -> Option<ShearCurve> {
    let strips = specimens.iter().filter_map(|s| s.strip.as_ref()).filter(|strip| strip.shear.len() > 1);
    let (rows, sd_n_per_m) = mean(&strips.map(|strip| strip.shear.as_slice()).collect::<Vec<_>>())?;
    let moment = |t: f64| fit::rising(&rows.iter().map(|[x, f]| [*x, f * x.cos() / t]).collect::<Vec<_>>());
    let moment_pa = thickness_m.map(moment).filter(|rows| rows.len() > 1);
    Some(ShearCurve { rows, sd_n_per_m, moment_pa })
}

fn moduli(found: &mut Characterized) {
    let word = found.provenance.word();
    for direction in found.directions() {
        let degrees = direction.degrees();
        let how = match direction {
            Direction::Warp | Direction::Fill => format!("along {}", direction.word()),
            Direction::Bias | Direction::Between(_) => format!("at {degrees}°"),
        };
        let to = found.of(direction).map(|s| s.modulus_strain).fold(0.0, f64::max);
        let known = format!("{word}: slope to {:.1} % strain", 100.0 * to);
        let scatter = found.modulus(direction).map(|s| s.scaled(1e-6));
        found.add(&format!("e{degrees}"), &format!("modulus E{degrees}, pulled {how}"), "MPa", scatter, known);
    }
}

/// ν₁₂ from the width under load: of warp, else of fill by ν₁₂ = ν₂₁ E0/E90.
fn poisson(found: &mut Characterized) {
    let word = found.provenance.word();
    let of = |found: &Characterized, direction| {
        Scatter::of(&found.of(direction).filter_map(|s| s.poisson).collect::<Vec<f64>>())
    };
    let (warp, fill) = (of(found, Direction::Warp), of(found, Direction::Fill));
    let ratio = found.modulus(Direction::Warp).zip(found.modulus(Direction::Fill)).map(|(a, b)| a.mean / b.mean);
    let turned = fill.zip(ratio).map(|(nu21, ratio)| nu21.scaled(ratio));
    if let (Some(a), Some(b)) = (warp, turned)
        && (a.mean - b.mean).abs() > 0.1
    {
        found.warnings.push(format!(
            "nu12 is {:.3} pulled along warp and {:.3} along fill (nu21 E0/E90): they should agree; the first is used",
            a.mean, b.mean
        ));
    }
    let known = match warp {
        Some(_) => format!("{word}: width under load, pulled along warp"),
        None => format!("{word}: width under load, pulled along fill, times E0/E90"),
    };
    found.add("nu12", "Poisson's ratio nu12", "–", warp.or(turned), known);
}

/// C₁₀ of warp and fill together: the mean of the two directions' means.
fn rubber(found: &mut Characterized) {
    for (k, key, name, known) in [
        (0, "c10", "C10, warp and fill together", "calibrated: whole curves, weight by stress"),
        (1, "c10_by_share", "C10, another weight", "calibrated: whole curves, weight by share of stress"),
    ] {
        let part =
            |direction| Scatter::of(&found.of(direction).filter_map(|s| Some(s.c10_pa?[k])).collect::<Vec<f64>>());
        let parts: Vec<Scatter> = [Direction::Warp, Direction::Fill].into_iter().filter_map(part).collect();
        let share = 1.0 / parts.len().max(1) as f64;
        let total = match &parts[..] {
            [] => None,
            [only] => Some(*only),
            all => {
                let mean = all.iter().map(|s| share * s.mean).sum();
                Some(Scatter::carried(mean, &all.iter().map(|s| (*s, share)).collect::<Vec<_>>()))
            }
        };
        found.add(key, name, "MPa", total.map(|s| s.scaled(1e-6)), known.into());
    }
    let Some(c10_pa) = found.quantity("c10").map(|q| 1e6 * q.scatter.mean) else { return };
    for direction in [Direction::Warp, Direction::Fill] {
        let misses: Vec<f64> = found
            .of(direction)
            .filter(|s| !s.stress.is_empty())
            .map(|s| 100.0 * fit::misfit(&s.stress, |e| fit::neo_hookean_pa(c10_pa, e)))
            .collect();
        let (key, name) = match direction {
            Direction::Warp => ("c10_misfit_warp", "what that C10 misses along warp, rms"),
            _ => ("c10_misfit_fill", "what that C10 misses along fill, rms"),
        };
        found.add(key, name, "%", Scatter::of(&misses), "calibrated: share of the largest stress".into());
    }
    found
        .notes
        .push(format!("6 C10 = {:.1} MPa would be the modulus if the curves had the law's shape", 6e-6 * c10_pa));
}

fn shear(found: &mut Characterized) {
    let strips: Vec<BiasStrip> = found.strips().map(|(_, strip)| strip.clone()).collect();
    let slopes: Vec<f64> = strips.iter().filter_map(|s| s.slope_n_per_m).collect();
    let slope = Scatter::of(&slopes);
    found.add("gt", "shear stiffness at small angle, G12 t", "N/m", slope, "calibrated: bias extension, zones".into());
    let g12 = found.thickness_m.and_then(|t| Some(slope?.scaled(1e-6 / t)));
    found.add("g12", "shear modulus G12", "MPa", g12, "calibrated: bias extension, zones".into());
    link(found);
    let locked: Vec<f64> = strips.iter().filter_map(|s| Some(s.locking?.angle.to_degrees())).collect();
    let known = format!("calibrated: two lines, {} of {} specimens lock", locked.len(), strips.len());
    found.add("locking", "locking angle", "°", Scatter::of(&locked), known);
    let limits: Vec<f64> =
        strips.iter().map(|s| 100.0 * s.size.displacement_m(PAPER_LIMIT_RAD) / s.size.length_m).collect();
    let known = format!("published: its strain at {:.1}°, in a strip of this size", PAPER_LIMIT_RAD.to_degrees());
    // A number of the strip's size, not of its fabric: it has no interval.
    let limit = Scatter::of(&limits).map(|s| Scatter { sd: None, half: None, ..s });
    found.add("limit_strain", "validity limit of the reduction", "%", limit, known);
    for strip in strips.iter().take(1) {
        let factor = fit::bias_grip_factor(&strip.size);
        found.notes.push(format!(
            "grips stiffen a strip of H/W = {:.1} at 45°: its E45 is {:.2} times that of a free one",
            strip.size.length_m / strip.size.width_m,
            factor
        ));
    }
}

/// G₁₂ from the three moduli, 1/G = 4/E45 − 1/E0 − 1/E90, with the errors of all three.
fn link(found: &mut Characterized) {
    let all = [Direction::Bias, Direction::Warp, Direction::Fill].map(|d| found.modulus(d));
    let [Some(e45), Some(e0), Some(e90)] = all else { return };
    let nu12 = found.nu12();
    let Ok(g) = shear_modulus(e0.mean, e90.mean, e45.mean, nu12) else {
        found.warnings.push(format!(
            "E45 = {:.4} MPa is too large for E0 = {:.4} and E90 = {:.4} MPa (at most {:.4}): no shear modulus follows; are \
             the directions right?",
            1e-6 * e45.mean,
            1e-6 * e0.mean,
            1e-6 * e90.mean,
            4e-6 / (1.0 / e0.mean + 1.0 / e90.mean)
        ));
        return;
    };
    let slope = |e: Scatter, factor: f64| (e, factor * (g / e.mean).powi(2));
    let scatter = Scatter::carried(g, &[slope(e45, 4.0), slope(e0, -1.0), slope(e90, -1.0)]);
    let known = match found.quantity("nu12") {
        Some(_) => "calibrated: 1/G = 4/E45 − 1/E0 − 1/E90 + 2 nu12/E0".to_string(),
        None => "calibrated: 1/G = 4/E45 − 1/E0 − 1/E90; nu12 = 0 assumed".to_string(),
    };
    if let Some(zones) = found.quantity("g12").map(|q| q.scatter.mean) {
        warn::two_shear_moduli([zones, 1e-6 * g], &mut found.warnings);
    }
    found.add("g12_link", "G12 from the moduli, free edges", "MPa", Some(scatter.scaled(1e-6)), known);
}

/// How far the curves go.
fn reach(found: &mut Characterized) {
    for direction in [Direction::Warp, Direction::Fill] {
        let ends: Vec<f64> = found.of(direction).filter_map(|s| s.stress.last()).map(|row| 100.0 * row[0]).collect();
        let (key, name) = match direction {
            Direction::Warp => ("reach_warp", "strain at the largest stress, warp"),
            _ => ("reach_fill", "strain at the largest stress, fill"),
        };
        let word = found.provenance.word().to_string();
        found.add(key, name, "%", Scatter::of(&ends), word);
    }
    let alone = found.directions().into_iter().filter(|d| found.of(*d).count() == 1);
    let single: Vec<String> = alone.map(|d| format!("{}°", d.degrees())).collect();
    if !single.is_empty() {
        found.notes.push(format!("one specimen only at {}: no interval can be given", single.join(", ")));
    }
}
