//! Over specimens: the numbers with their scatter, the mean curves, the shear curve.

use super::result::{BiasStrip, Characterized, MeanCurve, ShearCurve, Specimen, directions};
use super::scatter::Scatter;
use super::{PAPER_LIMIT_RAD, Reduction, replay, specimen, warn};
use crate::CompareError;
use data::{Coupon, DataError, Direction, Provenance};
use models::fabrics::{Fabric, shear_modulus, specimen as fit};

const YARNS: [Direction; 2] = [Direction::Warp, Direction::Fill];
/// Rows of a mean curve: a law's table, fine enough for any bend of a fabric.
const STEPS: usize = 24;

/// Reduces all specimens of one fabric.
///
/// # Errors
/// A specimen given twice, and whatever [`specimen`] refuses.
pub fn characterize(coupons: &[Coupon], settings: &Reduction) -> Result<Characterized, CompareError> {
    different(coupons)?;
    let mut warnings = Vec::new();
    let (taut, slacks): (Vec<Coupon>, Vec<f64>) = coupons.iter().map(|c| specimen::taut(c, settings)).unzip();
    let mut specimens = Vec::new();
    for (coupon, slack) in taut.iter().zip(slacks) {
        specimens.push(specimen::reduce(coupon, slack, settings, &mut warnings)?);
    }
    warn::deviations(&specimens, &mut warnings);
    let thickness_m = thickness(&specimens, &mut warnings);
    let mut provenances = coupons.iter().map(|coupon| coupon.provenance);
    let provenance = provenances.find(|provenance| *provenance != Provenance::Measured);
    let mut found = Characterized {
        yarns: YARNS.into_iter().filter_map(|d| mean_curve(&specimens, d)).collect(),
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
    warn::checks(&found.replays, &settings.name, &mut found.warnings);
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
        let note = "the shear curve assumes that yarns do not stretch: to measure their stretch, give specimens of 0° and 90° and \
                    the thickness";
        found.notes.push(note.into());
    }
    found.shear = shear_curve(&found.specimens, found.thickness_m);
    Ok(())
}

fn different(coupons: &[Coupon]) -> Result<(), DataError> {
    for (i, c) in coupons.iter().enumerate() {
        let same = |other: &&Coupon| (other.direction, &other.specimen) == (c.direction, &c.specimen);
        if let Some(Coupon { file, line, .. }) = coupons[..i].iter().find(same) {
            let message = format!("it is there twice, here and in {file}:{line}");
            let help = "give each specimen once, or another label in the column specimen";
            return Err(specimen::fault(c, message, help));
        }
    }
    Ok(())
}

fn thickness(specimens: &[Specimen], warnings: &mut Vec<String>) -> Option<f64> {
    let all = || specimens.iter().filter_map(|s| s.thickness_m);
    let all_mm = || all().map(|t| 1e3 * t);
    let (low, high) = (all_mm().reduce(f64::min)?, all_mm().reduce(f64::max)?);
    if high > 1.1 * low {
        warnings.push(format!(
            "the thickness is {low:.4} to {high:.4} mm, the mean is used: are all specimens of one fabric?"
        ));
    }
    Some(Scatter::of(all())?.mean)
}

/// Rows of a mean, and the standard deviation at each.
type MeanRows = (Vec<[f64; 2]>, Vec<Option<f64>>);

/// Means over specimens on common places up to where the shortest ends.
fn mean<'a>(curves: impl Iterator<Item = &'a Vec<[f64; 2]>>) -> Option<MeanRows> {
    let curves: Vec<_> = curves.filter(|rows| rows.len() > 1).collect();
    let ends = curves.iter().filter_map(|rows| Some(rows.last()?[0]));
    let end = ends.reduce(f64::min).filter(|end| *end > 0.0 && end.is_finite())?;
    let row = |i: usize| {
        let x = end * i as f64 / STEPS as f64;
        let s = Scatter::of(curves.iter().map(|rows| fit::at(rows, x)))?;
        Some(([x, s.mean], s.sd))
    };
    Some((0..=STEPS).filter_map(row).unzip())
}

fn mean_curve(specimens: &[Specimen], direction: Direction) -> Option<MeanCurve> {
    let same = specimens.iter().filter(|s| s.direction == direction);
    let (mean, sd) = mean(same.map(|s| &s.stress))?;
    let rows = fit::rising(&mean);
    let row = |(row, sd): (&[f64; 2], &Option<f64>)| [row[0], sd.unwrap_or(f64::NAN)];
    let spread: Vec<[f64; 2]> = mean.iter().zip(&sd).map(row).collect();
    let sd_at = |row: &[f64; 2]| Some(fit::at(&spread, row[0])).filter(|sd| sd.is_finite());
    let sd_pa = rows.iter().map(sd_at).collect();
    (rows.len() > 1).then_some(MeanCurve { direction, rows, sd_pa })
}

fn shear_curve(specimens: &[Specimen], thickness_m: Option<f64>) -> Option<ShearCurve> {
    let strips = specimens.iter().filter_map(|s| s.strip.as_ref());
    let (rows, sd_n_per_m) = mean(strips.map(|strip| &strip.shear))?;
    let moment = |t: f64| -> Vec<[f64; 2]> { rows.iter().map(|[x, f]| [*x, f * x.cos() / t]).collect() };
    let moment_pa = thickness_m.map(|t| fit::rising(&moment(t))).filter(|rows| rows.len() > 1);
    Some(ShearCurve { rows, sd_n_per_m, moment_pa })
}

fn moduli(found: &mut Characterized) {
    for direction in directions(&found.specimens) {
        let degrees = direction.degrees();
        let how = match direction.along_yarn() {
            true => format!("along {}", direction.word()),
            false => format!("at {degrees}°"),
        };
        let strains = found.of(direction).map(|s| 100.0 * s.modulus_strain);
        let to = strains.fold(0.0, f64::max);
        let known = format!("{}: slope to {to:.1} % strain", found.provenance.word());
        let scatter = found.modulus(direction).map(|s| s.scaled(1e-6));
        let names = [format!("e{degrees}"), format!("modulus E{degrees}, pulled {how}")];
        found.add(names, "MPa", scatter, known);
    }
}

/// ν₁₂ from the width under load: of warp, else of fill by ν₁₂ = ν₂₁ E0/E90.
fn poisson(found: &mut Characterized) {
    let [warp, fill] = YARNS.map(|direction| found.over(direction, |s| s.poisson));
    let [e0, e90] = YARNS.map(|direction| found.modulus(direction));
    let ratio = e0.zip(e90).map(|(a, b)| a.mean / b.mean);
    let turned = fill.zip(ratio).map(|(nu21, ratio)| nu21.scaled(ratio));
    let both = warp.zip(turned).map(|(a, b)| (a.mean, b.mean));
    if let Some((a, b)) = both.filter(|(a, b)| (a - b).abs() > 0.1) {
        found.warnings.push(format!(
            "nu12 is {a:.3} pulled along warp and {b:.3} along fill (nu21 E0/E90): they should agree; the first is used"
        ));
    }
    let (word, along) = (found.provenance.word(), if warp.is_some() { "warp" } else { "fill, times E0/E90" });
    let known = format!("{word}: width under load, pulled along {along}");
    let nu12 = warp.or(turned);
    found.add(["nu12", "Poisson's ratio nu12"], "–", nu12, known);
}

/// C₁₀ of warp and fill together: the mean of the two directions' means.
fn rubber(found: &mut Characterized) {
    let numbers = [
        ("stress", ["c10", "C10, warp and fill together"]),
        ("share of stress", ["c10_by_share", "C10, another weight"]),
    ];
    for (k, (weight, number)) in numbers.into_iter().enumerate() {
        let parts = YARNS.map(|direction| found.over(direction, |s| Some(s.c10_pa?[k])));
        let total = match parts {
            [Some(warp), Some(fill)] => {
                let mean = 0.5 * warp.mean + 0.5 * fill.mean;
                Some(Scatter::carried(mean, &[(warp, 0.5), (fill, 0.5)]))
            }
            [only, other] => only.or(other),
        };
        let known = format!("calibrated: whole curves, weight by {weight}");
        found.add(number, "MPa", total.map(|s| s.scaled(1e-6)), known);
    }
    let Some(c10_pa) = found.quantity("c10").map(|q| 1e6 * q.scatter.mean) else { return };
    for direction in YARNS {
        let word = direction.word();
        let miss = |s: &Specimen| 100.0 * fit::misfit(&s.stress, |e| fit::neo_hookean_pa(c10_pa, e));
        let misses = found.over(direction, |s| (!s.stress.is_empty()).then(|| miss(s)));
        let name = format!("what that C10 misses along {word}, rms");
        let known = "calibrated: share of the largest stress";
        found.add([format!("c10_misfit_{word}"), name], "%", misses, known);
    }
    let modulus_mpa = 6e-6 * c10_pa;
    found.notes.push(format!("6 C10 = {modulus_mpa:.1} MPa would be the modulus if the curves had the law's shape"));
}

fn shear(found: &mut Characterized) {
    let zones = "calibrated: bias extension, zones";
    let slope = found.over_strips(|s| s.slope_n_per_m);
    let names = ["gt", "shear stiffness at small angle, G12 t"];
    found.add(names, "N/m", slope, zones);
    let g12 = found.thickness_m.and_then(|t| Some(slope?.scaled(1e-6 / t)));
    found.add(["g12", "shear modulus G12"], "MPa", g12, zones);
    link(found);
    let locked = found.over_strips(|s| Some(s.locking?.angle.to_degrees()));
    let (lock, all) = (locked.map_or(0, |s| s.n), found.strips().count());
    let known = format!("calibrated: two lines, {lock} of {all} specimens lock");
    found.add(["locking", "locking angle"], "°", locked, known);
    let limit = |s: &BiasStrip| 100.0 * s.size.displacement_m(PAPER_LIMIT_RAD) / s.size.length_m;
    let limit = found.over_strips(|s| Some(limit(s)));
    let angle = PAPER_LIMIT_RAD.to_degrees();
    let known = format!("published: its strain at {angle:.1}°, in a strip of this size");
    // A number of the strip's size, not of its fabric: it has no interval.
    let limit = limit.map(Scatter::without_interval);
    let names = ["limit_strain", "validity limit of the reduction"];
    found.add(names, "%", limit, known);
    let first = found.strips().next().map(|(_, strip)| strip.size);
    if let Some(size) = first {
        let (ratio, factor) = (size.length_m / size.width_m, fit::bias_grip_factor(&size));
        found.notes.push(format!(
            "grips stiffen a strip of H/W = {ratio:.1} at 45°: its E45 is {factor:.2} times the E45 of a free strip"
        ));
    }
}

/// G₁₂ from the three moduli, 1/G = 4/E45 − 1/E0 − 1/E90, with the errors of all three.
fn link(found: &mut Characterized) {
    let all = [Direction::Bias, Direction::Warp, Direction::Fill].map(|d| found.modulus(d));
    let [Some(e45), Some(e0), Some(e90)] = all else { return };
    let Ok(g) = shear_modulus(e0.mean, e90.mean, e45.mean, found.nu12()) else {
        let [a, b, c] = [e45, e0, e90].map(|e| 1e-6 * e.mean);
        let most = 4e-6 / (1.0 / e0.mean + 1.0 / e90.mean);
        found.warnings.push(format!(
            "E45 = {a:.4} MPa is too large for E0 = {b:.4} and E90 = {c:.4} MPa (at most {most:.4}): no shear modulus follows; \
             are the directions right?"
        ));
        return;
    };
    let slope = |e: Scatter, factor: f64| (e, factor * (g / e.mean).powi(2));
    let scatter = Scatter::carried(g, &[slope(e45, 4.0), slope(e0, -1.0), slope(e90, -1.0)]);
    let nu12 = found.quantity("nu12").map_or("; nu12 = 0 assumed", |_| " + 2 nu12/E0");
    if let Some(zones) = found.quantity("g12").map(|q| q.scatter.mean) {
        warn::two_shear_moduli([zones, 1e-6 * g], &mut found.warnings);
    }
    let known = format!("calibrated: 1/G = 4/E45 − 1/E0 − 1/E90{nu12}");
    let names = ["g12_link", "G12 from the moduli, free edges"];
    found.add(names, "MPa", Some(scatter.scaled(1e-6)), known);
}

fn reach(found: &mut Characterized) {
    for direction in YARNS {
        let (word, known) = (direction.word(), found.provenance.word());
        let ends = found.over(direction, |s| Some(100.0 * s.stress.last()?[0]));
        let name = format!("strain at the largest stress, {word}");
        found.add([format!("reach_{word}"), name], "%", ends, known);
    }
    let all = directions(&found.specimens).into_iter();
    let alone = all.filter(|direction| found.of(*direction).count() == 1);
    let single: Vec<String> = alone.map(|d| format!("{}°", d.degrees())).collect();
    if !single.is_empty() {
        let single = single.join(", ");
        found.notes.push(format!("one specimen only at {single}: no interval can be given"));
    }
}
