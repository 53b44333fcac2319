//! The pressures of body and actuator, one in the other's column.

use super::seen::{Doubt, Seen};
use crate::policy::{tolerance_act_pa, tolerance_body_pa};
use crate::units::kpa;

/// The actuator's pressure never changes and is below the body's, which does.
pub(super) fn exchanged(seen: &Seen) -> Option<Doubt> {
    let range = |k: usize| {
        let values = || seen.runs.iter().flat_map(|run| &run.pressures_pa[k]).copied().filter(|p| p.is_finite());
        [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
    };
    let [body, act] = [range(0), range(1)];
    let constant = act[1] - act[0] <= 2.0 * tolerance_act_pa(act[1]);
    let steps = body[1] - body[0] > 2.0 * tolerance_body_pa(body[1]) + act[1];
    let message = format!(
        "the actuator's pressure stays at {:.2} kPa while the body's goes from {:.2} to {:.2} kPa: their columns are exchanged",
        kpa(act[1]),
        kpa(body[0]),
        kpa(body[1])
    );
    let help = "exchange the names of the two columns; for an import: --map p_act=COLUMN,p_body=COLUMN";
    (constant && act[0] > 0.0 && steps && act[1] < body[1]).then(|| Doubt::new(message, help))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::exchanged;

    #[test]
    fn exchanged_columns_are_refused() {
        let slip = |made: &mut Made| made.exchanged = true;
        refused(exchanged, slip, &["stays at 2.00 kPa", "their columns are exchanged", "--map p_act="]);
        right(exchanged);
    }
}
