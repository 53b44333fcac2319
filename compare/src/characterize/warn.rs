//! What a user should look at before the numbers are believed.

use data::{Coupon, Direction, Pulled};
use models::fabrics::specimen::{self as fit, Slip};

use super::scatter::deviating;
use super::specimen::Specimen;
use crate::policy;

/// A specimen that slipped in its grips, and rows that were left out. Rows: strain or displacement, and stress or force.
pub(super) fn slips(coupon: &Coupon, rows: &[[f64; 2]], warnings: &mut Vec<String>) {
    let who = format!("specimen {} ({}°)", coupon.specimen, coupon.direction.degrees());
    warnings.extend(coupon.told.iter().map(|told| format!("{who}: {told}")));
    if coupon.jitter > 0 {
        warnings.push(format!(
            "{who}: {} rows in which {} went back a little are left out",
            coupon.jitter, coupon.columns[0]
        ));
    }
    // A bias test without thickness comes as displacement.
    let displaced = matches!(coupon.pulled, Pulled::Force(_)) && coupon.thickness_m.is_none();
    let length_m = if displaced { coupon.length_m.unwrap_or(1.0) } else { 1.0 };
    let pct = |x: f64| 100.0 * x / length_m;
    let even = fit::thinned(rows, 2000);
    let slip = fit::drop(&even);
    let found = slip.or_else(|| coupon.direction.along_yarn().then(|| fit::plateau(&even)).flatten());
    if let Some(Slip { at, until, lost }) = found {
        let how = if lost > 0.0 {
            format!("the force drops by {:.0} %", 100.0 * lost)
        } else {
            "the force stands still".into()
        };
        warnings.push(format!(
            "{who}: {how} from {:.2} % strain on and is back at {:.2} %: it probably slipped in its grips; its modulus may be \
             right, its curve beyond is not: leave its rows out or repeat it",
            pct(at),
            pct(until)
        ));
    }
}

/// Slack that was taken off.
pub(super) fn slack(specimens: &[Specimen]) -> Option<String> {
    let told: Vec<String> = specimens
        .iter()
        .filter(|s| s.slack > 0.0)
        .map(|s| format!("{} ({}°) {:.3} %", s.name, s.direction.degrees(), 100.0 * s.slack))
        .collect();
    let text = told.join(", ");
    (!told.is_empty()).then(|| format!("slack taken off, a soft start before the specimen is taut: {text}"))
}

/// Specimens that deviate from the others of their direction; directions that look confused.
pub(super) fn deviations(specimens: &[Specimen], warnings: &mut Vec<String>) {
    for direction in directions(specimens) {
        let same: Vec<&Specimen> = specimens.iter().filter(|s| s.direction == direction).collect();
        let with: Vec<(&Specimen, f64)> = same.iter().filter_map(|s| Some((*s, s.modulus_pa?))).collect();
        let values: Vec<f64> = with.iter().map(|(_, v)| *v).collect();
        for (i, off) in deviating(&values) {
            let (name, modulus) = (&with[i].0.name, values[i] * 1e-6);
            let other = nearest_direction(specimens, direction, values[i]);
            let hint = other
                .map_or(String::new(), |d| format!("; it is like those at {}°: is its direction right?", d.degrees()));
            warnings.push(format!(
                "specimen {name} ({}°): its modulus {modulus:.4} MPa is {:+.0} % off the mean of the others{hint}",
                direction.degrees(),
                100.0 * off
            ));
        }
        let coarse = same.iter().filter(|s| s.modulus_pa.is_some() && s.modulus_strain > 0.03);
        for s in coarse {
            warnings.push(format!(
                "specimen {} ({}°): few rows at small strain: its modulus is the slope up to {:.1} %",
                s.name,
                direction.degrees(),
                100.0 * s.modulus_strain
            ));
        }
    }
}

/// Another direction whose mean is within a fifth of a value that is off in its own.
fn nearest_direction(specimens: &[Specimen], own: Direction, value: f64) -> Option<Direction> {
    let mean = |direction: Direction| {
        let values: Vec<f64> =
            specimens.iter().filter(|s| s.direction == direction).filter_map(|s| s.modulus_pa).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    let near = |d: &Direction| mean(*d).is_some_and(|m| policy::is_like_another(value, m));
    directions(specimens).into_iter().filter(|d| *d != own).find(near)
}

/// Directions that were pulled, by angle.
pub(super) fn directions(specimens: &[Specimen]) -> Vec<Direction> {
    let mut all: Vec<Direction> = specimens.iter().map(|s| s.direction).collect();
    all.sort_by(|a, b| a.degrees().total_cmp(&b.degrees()));
    all.dedup();
    all
}

/// Tests at other angles than the law was made from, each by how much the law is off at the end.
pub(super) fn checks(off: impl Iterator<Item = f64>, warnings: &mut Vec<String>) {
    let [low, high] = off.fold([0.0_f64, 0.0_f64], |[a, b], o| [a.min(o), b.max(o)]);
    if !policy::meets(low) || !policy::meets(high) {
        warnings.push(format!(
            "tests at other angles than the law was made from: it is off by {:+.0} to {:+.0} % at their ends; not asked yet: a \
             Poisson's ratio that was not measured, yarns cut at the edges of a strip as narrow as the weave is coarse",
            100.0 * low,
            100.0 * high
        ));
    }
}

/// Two shear moduli of one fabric: of the zones of a bias extension, and of three moduli.
pub(super) fn two_shear_moduli([zones, moduli]: [f64; 2], warnings: &mut Vec<String>) {
    // The two reductions differ by less on a fabric that both describe.
    if !policy::meets(zones / moduli - 1.0) {
        warnings.push(format!(
            "two shear moduli that disagree by {:.0} %: {zones:.2} MPa from the zones of the bias extension (it goes into the \
             law -linear), {moduli:.2} MPa from E0, E45 and E90: the curves bend within the strain of the modulus, or the grips, \
             a Poisson's ratio or a direction are not what was assumed; the replay below says which law returns the tests",
            100.0 * (zones / moduli - 1.0).abs()
        ));
    }
}
