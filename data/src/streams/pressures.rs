//! The pressures by which rows fall into holds.

use crate::header::{P_ACT, P_BODY, P_MORE};
use crate::policy::{tolerance_act_pa, tolerance_body_pa};
use crate::rows::Row;

/// Pressures of a row: body, actuator, and the supply channels from 1 on.
pub(crate) const PRESSURES: [usize; 2 + P_MORE.len()] = [P_BODY, P_ACT, P_MORE[0], P_MORE[1], P_MORE[2]];

/// The pressures of a row \[Pa\].
pub(crate) fn pressures_pa(row: &Row) -> [f64; PRESSURES.len()] {
    let [one, two, three] = row.more_act_pa;
    [row.p_body_pa, row.p_act_pa, one, two, three]
}

/// Whether pressures, in the order of [`PRESSURES`], are within so many tolerances of the first.
pub(crate) fn are_near(of: [f64; PRESSURES.len()], other: [f64; PRESSURES.len()], tolerances: f64) -> bool {
    let tolerance = |k: usize| if k == 0 { tolerance_body_pa(of[0]) } else { tolerance_act_pa(of[k]) };
    (0..of.len()).all(|k| (other[k] - of[k]).abs() <= tolerances * tolerance(k))
}
