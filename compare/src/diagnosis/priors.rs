//! What is known of parameters before any data.

use super::candidates::Free;
use crate::moment::Prior;
use crate::policy;
use models::Scenario;

/// Of a bending stiffness: as it was measured, or as likely a third as three times the scenario's, or of anything usual.
pub(super) fn bending_prior(known: Option<[f64; 2]>, scenario: &Scenario) -> Prior {
    let bounds = [0.0, policy::MOST_BENDING];
    match (known, scenario.bending_stiffness) {
        (Some([centre, sd]), _) => Prior { centre, sd, is_size: false, bounds },
        (None, told) if told > 0.0 => Prior { centre: told, sd: policy::SIZE_FACTOR.ln(), is_size: true, bounds },
        _ => Prior { centre: 1.0, sd: 2.0 * policy::SIZE_FACTOR.ln(), is_size: true, bounds },
    }
}

/// Of an effect's parameter, and what is added to it.
pub(super) fn parameter_prior(p: &Free, value: f64) -> (Prior, f64) {
    let typical = p.typical - p.neutral;
    let is_size = typical != 0.0 && (p.neutral == 0.0 || p.lower < 0.0);
    if is_size {
        let centre = if (value - p.neutral) * typical < 0.0 && p.lower < p.neutral { -typical } else { typical };
        let bounds = if centre > 0.0 { [0.0, p.upper - p.neutral] } else { [p.lower - p.neutral, 0.0] };
        return (Prior { centre, sd: policy::SIZE_FACTOR.ln(), is_size: true, bounds }, p.neutral);
    }
    if p.typical > 0.0 && p.lower >= 0.0 {
        return (
            Prior { centre: p.typical, sd: policy::SIZE_FACTOR.ln(), is_size: true, bounds: [p.lower, p.upper] },
            0.0,
        );
    }
    (Prior { centre: p.typical, sd: 0.25 * (p.upper - p.lower), is_size: false, bounds: [p.lower, p.upper] }, 0.0)
}
