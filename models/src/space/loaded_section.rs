//! A section under loads from outside: its energy less `m·κ + f ε`, with ε the contraction of the centre line.

use super::frame::{Bend, direction};
use super::lever::{Matrix, of_each};
use super::section::{Acting, FLAT, STRAIGHT, StripSection, dot};
use super::state::StripState;
use crate::error::Solved;

/// Moment across the plane of a strip that is rounding, relative to the pressure's moment.
const IN_PLANE: f64 = 1e-12;
/// Largest contraction per axial force \[1/N\] that Newton's step sees: a strip at the end of its range has none.
const MOST_GIVE: f64 = 1e3;
/// First bend that is tried from a straight body, over 1/R.
const FIRST_BEND: f64 = 0.1;

impl StripSection<'_> {
    /// The equilibrium, from a state nearby, and its compliance: the change of κ and ε per change of the loads.
    pub(super) fn solve_under(&self, strips: &mut [StripState], near: Bend) -> Solved<(Bend, Matrix)> {
        let bend = match self.acting(strips) {
            Acting::Nothing => return self.passive(strips, near),
            Acting::One(one) => match self.in_plane(one, strips) {
                Some(found) => return Ok(found),
                None => self.bent(strips, near)?,
            },
            Acting::Several => self.bent(strips, near)?,
        };
        if bend.contraction >= 1.0 {
            return Err(self.unsolved(strips, self.outer[0].hypot(self.outer[1])));
        }
        let compliance = self.compliance(strips, &bend)?;
        Ok((bend, compliance))
    }

    /// A strip alone whose load is in its plane, and does not bend the body against it.
    fn in_plane(&self, one: usize, strips: &mut [StripState]) -> Option<(Bend, Matrix)> {
        let e = direction(self.strips[one].azimuth_rad);
        let across = e[0] * self.outer[1] - e[1] * self.outer[0];
        if across.abs() > IN_PLANE * self.p_body_pa * self.area_m2 * self.radius_m {
            return None;
        }
        let (bend, compliance) = self.alone(one, &mut strips[one]).ok()?;
        let way = [e[0], e[1], self.radius_m + self.offset_m];
        (dot(bend.kappa, e) > 0.0).then(|| (bend, of_each(|i, j| compliance * way[i] * way[j])))
    }

    fn bent(&self, strips: &mut [StripState], near: Bend) -> Solved<Bend> {
        let straight = self.balance(strips, [0.0; 2])?;
        let size = straight.slope[0].hypot(straight.slope[1]);
        let is_taut = straight.taut_n > 0.0;
        if is_taut && size <= straight.hinge_nm {
            return Ok(Bend::default());
        }
        let start = if near.size() > STRAIGHT { near.kappa } else { self.first_guess(strips) };
        if is_taut && start == [0.0; 2] {
            let first = FIRST_BEND / self.radius_m / size;
            return self.minimum(strips, straight.slope.map(|slope| -first * slope));
        }
        self.minimum(strips, start)
    }

    /// Inverse of the second derivatives of its energy, the contraction at its best.
    pub(crate) fn compliance(&self, strips: &mut [StripState], bend: &Bend) -> Solved<Matrix> {
        let at = self.balance(strips, bend.kappa)?;
        if bend.size() <= STRAIGHT && at.taut_n > 0.0 {
            return Ok([[0.0; 3]; 3]);
        }
        let ([[mut a, b], [_, mut d]], along) = (at.second, at.along);
        let usual = self.p_body_pa * self.area_m2 * self.radius_m.powi(2);
        if a + d <= FLAT * usual || a * d - b * b <= FLAT * (a + d).powi(2) {
            (a, d) = (a + usual, d + usual);
        }
        let per = 1.0 / (a * d - b * b);
        let inverse = [[d * per, -b * per], [-b * per, a * per]];
        let mixed = inverse.map(|row| dot(row, along));
        let give = dot(along, mixed) + at.give.min(MOST_GIVE);
        Ok([
            [inverse[0][0], inverse[0][1], mixed[0]],
            [inverse[1][0], inverse[1][1], mixed[1]],
            [mixed[0], mixed[1], give],
        ])
    }
}
