//! A section whose strips are all flat: the wall alone resists, and its step at κ = 0 is as soft as a planar robot's.
//!
//! ```text
//! U(κ) = h (p_b (A R + m·n) − f c) + ½ B|κ|² − M·κ        h = k₀ ln cosh(|κ|/k₀),  n = κ/|κ|
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | k₀ | `hinge_curvature_per_m` | 1/m |
//! | c, c h | distance of the centre line from the taut generator, contraction of the centre line | m, - |
//!
//! In the plane of a strip this is the planar hinge `π p_b R³ tanh(κ/k₀)`. The centre line of a planar robot differs by up to
//! c k₀ ln 2, with a sign that depends on the side to which it bends. Derived here.

use super::frame::Bend;
use super::lever::Matrix;
use super::section::{STRAIGHT, SectionBalance, StripSection, dot};
use super::state::StripState;
use crate::body::soft_step;
use crate::error::Solved;

/// Share of the wall's moment up to which the first bend tried comes from the soft step.
const SOFT_SHARE: f64 = 0.99;

impl StripSection<'_> {
    pub(super) fn is_passive(&self, strips: &[StripState]) -> bool {
        self.strips.iter().zip(strips).all(|(strip, state)| !self.is_open(strip, state))
    }

    /// Area of gas that a bend of the wall alone takes: `h (A R + m·n)` \[m²\].
    pub(super) fn displaced_m2(&self, kappa: [f64; 2]) -> f64 {
        let size = kappa[0].hypot(kappa[1]).max(STRAIGHT);
        soft_step(size, self.hinge_per_m).0 * (self.area_m2 * self.radius_m + dot(self.moment_m3, kappa) / size)
    }

    /// Slope and curvature of the potential U by κ, from wall, gas and outer loads.
    pub(super) fn passive_balance(&self, kappa: [f64; 2]) -> SectionBalance {
        let [y, z, axial] = self.outer;
        let size = kappa[0].hypot(kappa[1]).max(STRAIGHT);
        let n = kappa.map(|k| k / size);
        let (h, rise) = soft_step(size, self.hinge_per_m);
        let bow = (1.0 - rise * rise) / self.hinge_per_m;
        let from_taut_m = self.radius_m + self.offset_m;
        let round = self.p_body_pa * self.area_m2 * self.radius_m - axial * from_taut_m;
        let gas = self.moment_m3.map(|m| self.p_body_pa * m);
        // h/|κ| = s: its slope, and its second derivative times |κ|.
        let share = h / size;
        let d_share = (rise - share) / size;
        let (along, dd_share) = (dot(gas, n), bow - 2.0 * d_share);
        let slope = |i: usize| {
            round * rise * n[i] + share * gas[i] + d_share * size * along * n[i] + self.bending * kappa[i] - [y, z][i]
        };
        let second = |i: usize, j: usize| {
            let (same, nn) = (if i == j { 1.0 } else { 0.0 }, n[i] * n[j]);
            let across = same - nn;
            let gas = d_share * (gas[i] * n[j] + n[i] * gas[j] + along * across) + along * dd_share * nn;
            round * (bow * nn + rise / size * across) + gas + self.bending * same
        };
        SectionBalance {
            contraction: from_taut_m * h - self.offset_m * size,
            slope: [slope(0), slope(1)],
            second: [[second(0, 0), second(0, 1)], [second(1, 0), second(1, 1)]],
            taut_n: 0.0,
            hinge_nm: 0.0,
            along: n.map(|n| from_taut_m * rise * n),
            give: 0.0,
        }
    }

    /// The equilibrium without open strips, and its compliance.
    pub(super) fn passive(&self, strips: &mut [StripState], near: Bend) -> Solved<(Bend, Matrix)> {
        for state in &mut *strips {
            (state.coordinate, state.tension) = (0.0, 0.0);
        }
        let [y, z, axial] = self.outer;
        let moment = [y - self.p_body_pa * self.moment_m3[0], z - self.p_body_pa * self.moment_m3[1]];
        let thrust = self.p_body_pa * self.area_m2;
        let carried = thrust * self.radius_m - axial * (self.radius_m + self.offset_m);
        let size = moment[0].hypot(moment[1]);
        let more = size - carried;
        if axial > thrust || carried <= 0.0 {
            return Err(self.unsolved(strips, (axial - thrust) * self.radius_m));
        }
        if more >= 0.0 && self.bending == 0.0 {
            return Err(self.unsolved(strips, more));
        }
        let first = |size: f64| {
            let soft = self.hinge_per_m * (size / carried).min(SOFT_SHARE).atanh();
            if more > 0.0 { soft + more / self.bending } else { soft }
        };
        let own = y.hypot(z);
        let start = match near.size() > STRAIGHT {
            true => near.kappa,
            false if own == 0.0 => [0.0; 2],
            false => [y, z].map(|m| first(own) * m / own),
        };
        let bend = self.minimum(strips, start)?;
        let compliance = self.compliance(strips, &bend)?;
        Ok((bend, compliance))
    }
}
