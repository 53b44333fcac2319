//! Moduli that only another unit explains.

use data::{Coupon, DataError, Direction, Pulled};

use super::specimen::fault;
use crate::policy;

/// What may be written for what: unit of the column, its size \[Pa\].
const STRESSES: [(&str, f64); 3] = [("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6)];

/// Refuses a modulus far from any fabric, and says which unit would make sense of it.
pub(super) fn plausible(coupon: &Coupon, modulus_pa: f64) -> Result<(), DataError> {
    let range = match coupon.direction {
        Direction::Warp | Direction::Fill => policy::ALONG_PA,
        Direction::Bias => policy::BIAS_PA,
        Direction::Between(_) => [policy::BIAS_PA[0], policy::ALONG_PA[1]],
    };
    let fits = |pa: f64| (range[0]..=range[1]).contains(&pa);
    if fits(modulus_pa) {
        return Ok(());
    }
    let (mpa, [low, high]) = (short(modulus_pa * 1e-6), range.map(|pa| pa * 1e-6));
    let message = format!("its modulus would be {mpa} MPa; fabrics pulled in this direction have {low} to {high} MPa");
    let [x, y] = &coupon.columns;
    let thickness = coupon.thickness_m.map_or("–".into(), |t| short(1e3 * t));
    let advice = match coupon.pulled {
        Pulled::Stress(_) => stress_advice(coupon, modulus_pa, fits),
        Pulled::Force(_) => format!("check the units of {y}, {x}, and width, length and thickness ({thickness} mm)"),
    };
    Err(fault(coupon, message, format!("{advice}; if the number is right, add --any-modulus")))
}

fn stress_advice(coupon: &Coupon, modulus_pa: f64, fits: impl Fn(f64) -> bool) -> String {
    let [strain, stress] = &coupon.columns;
    let written = stress.to_lowercase();
    let own = STRESSES.iter().find(|(unit, _)| written.ends_with(&format!("_{}", unit.to_lowercase())));
    let renamed = |(unit, size): &(&str, f64)| {
        let (name, pa) = (own?.0, modulus_pa * size / own?.1);
        let (suffix, mpa) = (unit.to_lowercase(), short(pa * 1e-6));
        let words = format!("if {stress} holds {unit}, name it stress_{suffix} (modulus {mpa} MPa)");
        (name != *unit && fits(pa)).then_some(words)
    };
    let mut found: Vec<String> = STRESSES.iter().filter_map(renamed).collect();
    let other = if strain.to_lowercase().ends_with("ratio") { ("pct", 100.0) } else { ("ratio", 0.01) };
    if fits(modulus_pa * other.1) {
        let pa = short(modulus_pa * other.1 * 1e-6);
        found.push(format!("if {strain} is not what it says, name it strain_{} (modulus {pa} MPa)", other.0));
    }
    if found.is_empty() { format!("check the units of {strain} and {stress}") } else { found.join("; ") }
}

/// Four digits.
fn short(x: f64) -> String {
    if x != 0.0 && !(1e-3..1e6).contains(&x.abs()) {
        return format!("{x:.3e}");
    }
    let decimals = (3 - x.abs().max(1e-3).log10().floor() as i32).clamp(0, 6) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}
