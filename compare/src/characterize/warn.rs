//! What a user should look at before the numbers are believed.

use super::result::{Replay, Specimen, directions};
use super::scatter::{Scatter, deviating};
use crate::policy;
use data::{Coupon, Direction, Pulled};
use models::fabrics::specimen::{self as fit, Slip};

/// Label and direction, for messages.
pub(super) fn who(coupon: &Coupon) -> String {
    format!("specimen {} ({}°)", coupon.specimen, coupon.direction.degrees())
}

/// A specimen that slipped in its grips, and rows that were left out. Rows: strain or displacement, and stress or force.
pub(super) fn slips(coupon: &Coupon, rows: &[[f64; 2]], warnings: &mut Vec<String>) {
    let who = who(coupon);
    warnings.extend(coupon.told.iter().map(|warning| format!("{who}: {warning}")));
    if coupon.jitter > 0 {
        let (rows, column) = (coupon.jitter, &coupon.columns[0]);
        warnings.push(format!("{who}: {rows} rows in which {column} went back a little are left out"));
    }
    // A bias test without thickness comes as displacement.
    let displaced = matches!(coupon.pulled, Pulled::Force(_)) && coupon.thickness_m.is_none();
    let length_m = coupon.length_m.filter(|_| displaced).unwrap_or(1.0);
    let even = fit::thinned(rows, 2000);
    let plateau = || if coupon.direction.along_yarn() { fit::plateau(&even) } else { None };
    if let Some(Slip { at, until, lost }) = fit::drop(&even).or_else(plateau) {
        let how = match lost > 0.0 {
            true => format!("the force drops by {:.0} %", 100.0 * lost),
            false => "the force stays constant".into(),
        };
        let [at, until] = [at, until].map(|x| 100.0 * x / length_m);
        warnings.push(format!(
            "{who}: {how} from {at:.2} % strain on and is back at {until:.2} %: it probably slipped in its grips; its modulus \
             may be right, its curve beyond is not: leave its rows out or repeat it"
        ));
    }
}

/// A modulus from a part of the curve that is much softer than what follows. `modulus`: its strain and its size \[Pa\].
pub(super) fn stiffens(coupon: &Coupon, stress: &[[f64; 2]], modulus: Option<[f64; 2]>, warnings: &mut Vec<String>) {
    let Some([up_to, soft_pa]) = modulus.filter(|_| coupon.direction.along_yarn()) else { return };
    let Some([at, steep_pa]) = fit::stiffening(stress, up_to) else { return };
    let who = who(coupon);
    let [soft_mpa, steep_mpa] = [soft_pa, steep_pa].map(|pa| 1e-6 * pa);
    let [up_to, at] = [up_to, at].map(|strain| 100.0 * strain);
    warnings.push(format!(
        "{who}: its modulus is {soft_mpa:.1} MPa up to {up_to:.1} % strain, and the curve rises to \
         {steep_mpa:.1} MPa at {at:.1} %: crimp of the yarns, where the first number holds, or slack in the grips, where the second \
         does; for slack leave out the rows before the specimen is taut"
    ));
}

pub(super) fn slack(specimens: &[Specimen]) -> Option<String> {
    let one = |Specimen { name, direction, slack, .. }: &Specimen| {
        format!("{name} ({}°) {:.3} %", direction.degrees(), 100.0 * slack)
    };
    let all: Vec<String> = specimens.iter().filter(|s| s.slack > 0.0).map(one).collect();
    let text = "slack subtracted, a soft start before the specimen is taut";
    (!all.is_empty()).then(|| format!("{text}: {}", all.join(", ")))
}

/// Specimens that deviate from the others of their direction; directions that look confused.
pub(super) fn deviations(specimens: &[Specimen], warnings: &mut Vec<String>) {
    for direction in directions(specimens) {
        let (degrees, same) = (direction.degrees(), with_modulus(specimens, direction));
        let values: Vec<f64> = same.iter().map(|(_, modulus)| *modulus).collect();
        for (i, off) in deviating(&values) {
            let (name, modulus) = (&same[i].0.name, values[i] * 1e-6);
            let other = nearest_direction(specimens, direction, values[i]).map(Direction::degrees);
            let hint = other.map_or(String::new(), |d| format!("; it is like those at {d}°: is its direction right?"));
            warnings.push(format!(
                "specimen {name} ({degrees}°): its modulus {modulus:.4} MPa is {:+.0} % off the mean of the others{hint}",
                100.0 * off
            ));
        }
        for specimen in same.iter().map(|(s, _)| s).filter(|s| s.modulus_strain > 0.03) {
            let (name, percent) = (&specimen.name, 100.0 * specimen.modulus_strain);
            warnings.push(format!(
                "specimen {name} ({degrees}°): few rows at small strain: its modulus is the slope up to {percent:.1} %"
            ));
        }
    }
}

fn with_modulus(specimens: &[Specimen], direction: Direction) -> Vec<(&Specimen, f64)> {
    let same = specimens.iter().filter(|s| s.direction == direction);
    same.filter_map(|s| Some((s, s.modulus_pa?))).collect()
}

/// Another direction whose mean is within a fifth of a value that is off in its own.
fn nearest_direction(specimens: &[Specimen], own: Direction, value: f64) -> Option<Direction> {
    let near = |d: &Direction| {
        let moduli = with_modulus(specimens, *d).into_iter().map(|(_, modulus)| modulus);
        let mean = Scatter::of(moduli);
        *d != own && mean.is_some_and(|s| policy::is_like_another(value, s.mean))
    };
    directions(specimens).into_iter().find(near)
}

/// Tests at other angles than a law was made from.
pub(super) fn checks(replays: &[Replay], law: &str, warnings: &mut Vec<String>) {
    let others = replays.iter().filter(|r| r.law == law && !r.used);
    let [low, high] = others.map(|r| r.at_end).fold([0.0_f64, 0.0_f64], |[a, b], o| [a.min(o), b.max(o)]);
    if !policy::meets(low) || !policy::meets(high) {
        let [low, high] = [low, high].map(|off| 100.0 * off);
        warnings.push(format!(
            "tests at other angles than the law was made from: it is off by {low:+.0} to {high:+.0} % at their ends; not asked \
             yet: a Poisson's ratio that was not measured, yarns cut at the edges of a strip as narrow as the weave is coarse"
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
