//! Fold energy: a sheet that leaves a weld at an angle folds there as the elastica does, at the ends of the lens and at its sides.
//!
//! ```text
//! U = 4 √(D T) (1 − cos ½φ) per width of each sheet at each edge
//! ends   φ = θ,  T = P r outside, (P − p_b) r inside,  r = L/2θ,  two edges of width W
//! sides  φ = ψ₀,  T = P̄ ρ,  P̄ = P − χ p_b,  two sheets on two sides:  ∫ (…) dx ≈ (…)₀ ½π r sinθ (1 + θ²/32 + 13 θ⁴/3072)
//!        ρ = a₀ + ρ₀,  cosψ₀ = ρ₀/ρ,  a₀ = r (1 − cosθ),  ρ₀ = p_b R' cosα/2P̄
//! ```
//!
//! T is the tension across the fold, a₀ the half height of the lens in its middle, ρ and ψ₀ are radius and angle of the arcs at the sides
//! there (where ρ₀ is small, ½π, and the sum over the sides is exact to θ⁶), R' and α radius and half chord angle of the wall's section
//! (`section.rs`). Includes the work of T on the way that the round of the fold cuts short; the tension follows the pressure. Folds are a
//! fraction of a millimetre at high pressures; 0 < θ < π. The elastica is in `verification::exact::fold`, the sum derived here.

use super::entry::*;
use crate::trig::sin_cos;
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "fold_energy",
    formula: "U = 4 √(D T)(1 − cos ½φ) per width of each fold; ends φ = θ, T = P r and (P − p_b) r; sides φ = ψ₀, T = P̄ρ",
    sentence: "The sheets must be folded at the welds, and a fabric that is stiff in bending resists.",
    differs: "The bend comes late and less, more so at low pressures and with stiff fabrics.",
    remedy: "Measure the bending length of the fabric: let a strip droop over an edge.",
    validity: "stiff welds, folds farther apart than √(D/T)",
    reference: "Love 1927, §262 (elastica); derived here",
    parameters: &[parameter("bending_nm", "D", "N m", 1.0)
        .usual(1e-4, [0.0, 1e-2])
        .fitted(Fitted::FromDesign)
        .means("bending stiffness of one sheet")],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        if values[0] == 0.0 {
            return;
        }
        for site in assembly.active_sites(Family::Pouch) {
            let term = FoldEnergy {
                root: values[0].sqrt(),
                length_m: site.shape.length_m,
                width_m: site.shape.width_m,
                sealed: site.actuator.map_or(0.0, |actuator| (actuator.edge_restraint)(&site.shape)),
                inner: site.inner_share,
                // A weld wider than its circle has walls that do not pull its sides apart.
                wall_m: site.drawn_in(site.strip_m).map_or(0.0, |flat| (0.5 * flat.by_chord_m()).max(0.0)),
            };
            site.sheet_nm = values[0];
            site.act(term, SideEffects::SHIFT);
        }
    },
    ..BALANCE
};

struct FoldEnergy {
    root: f64,
    length_m: f64,
    width_m: f64,
    /// Number e of folded sides, as in the effect `sealed_sides`.
    sealed: f64,
    /// Share χ of the pouch that is in the body.
    inner: f64,
    /// ½ R' cosα of the wall's section \[m\], which gives ρ₀.
    wall_m: f64,
}

impl FoldEnergy {
    /// Energy of the sides over √D and its derivative by θ, from sine and cosine of ½θ.
    fn sides(&self, theta: f64, (sin, cos): (f64, f64), at: &Pose) -> [f64; 2] {
        let across = (at.p_act_pa - self.inner * at.p_body_pa).max(0.0);
        if self.sealed * across == 0.0 {
            return [0.0; 2];
        }
        let (per_theta, t2) = (1.0 / theta, theta * theta);
        let radius = 0.5 * self.length_m * per_theta;
        let (height, chord) = (2.0 * radius * sin * sin, 2.0 * radius * sin * cos);
        let (d_height, d_chord) = (chord - height * per_theta, radius * (cos * cos - sin * sin) - chord * per_theta);
        let rho0 = at.p_body_pa * self.wall_m / across;
        let rho = height + rho0;
        let (per_rho, root) = (1.0 / rho, rho.sqrt());
        let share = rho0 * per_rho;
        let half = (0.5 * (1.0 + share)).sqrt();
        // 1 − cos ½ψ₀ without cancellation.
        let turned = 0.5 * height * per_rho / (1.0 + half);
        let d_turned = 0.25 * share * per_rho / half * d_height;
        let round = 1.0 + t2 * (1.0 / 32.0 + t2 * (13.0 / 3072.0));
        let d_round = theta * (1.0 / 16.0 + t2 * (13.0 / 768.0));
        let (along, d_along) = (chord * round, d_chord * round + chord * d_round);
        let d_value = root * (d_turned * along + turned * (0.5 * d_height * per_rho * along + d_along));
        [turned * root * along, d_value].map(|value| SIDES * self.sealed * across.sqrt() * value)
    }
}

/// Four sheets at 4, and π/2.
const SIDES: f64 = 8.0 * PI;

impl Term for FoldEnergy {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let theta = at.q[actuator_q::COORDINATE];
        if theta == 0.0 {
            // Flat sheets are not folded; below the quotients are 0/0.
            return 0.0;
        }
        let root = |pressure: f64| pressure.max(0.0).sqrt();
        let (sin, cos) = sin_cos(0.5 * theta);
        let pull = root(at.p_act_pa) + root(at.p_act_pa - at.p_body_pa);
        let ends = 8.0 * self.width_m * pull * (0.5 * self.length_m / theta).sqrt();
        let folded = sin * sin / (1.0 + cos);
        let [sides, d_sides] = self.sides(theta, (sin, cos), at);
        let scale = self.root / self.length_m;
        force[actuator_q::COORDINATE] -= scale * (ends * 0.5 * (sin - folded / theta) + d_sides);
        scale * (ends * folded + sides)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// Energy per width of a sheet that leaves a clamp at an angle from its pull.
    fn energy_j_m(stiffness_nm: f64, pull_n_m: f64, angle: f64) -> f64 {
        4.0 * (stiffness_nm * pull_n_m).sqrt() * (1.0 - (0.5 * angle).cos())
    }

    #[test]
    fn it_is_the_elastica_at_every_weld_and_side() {
        let (length, width, bending, p_act, p_body) = (0.057, 0.05, 6e-5, 20e3, 2e3);
        let term = FoldEnergy {
            root: f64::sqrt(bending),
            length_m: length,
            width_m: width,
            sealed: 1.0,
            inner: 0.5,
            wall_m: 0.0,
        };
        for theta in [0.2, 0.7, 1.2] {
            let radius = 0.5 * length / theta;
            let ends: f64 =
                [p_act, p_act - p_body].map(|p| 2.0 * width * energy_j_m(bending, p * radius, theta)).iter().sum();
            // Along the sides, by the middles of short pieces.
            let n = 20_000;
            let piece = |i: i32| {
                let phi = theta * ((2 * i + 1) as f64 / f64::from(n) - 1.0);
                let height = radius * (phi.cos() - theta.cos());
                energy_j_m(bending, (p_act - 0.5 * p_body) * height, FRAC_PI_2) * radius * phi.cos() * 2.0 * theta
                    / f64::from(n)
            };
            let sides = 4.0 * (0..n).map(piece).sum::<f64>();
            let computed = length * term.add(&Pose::new(&[theta, 0.0, 0.0, 0.0], p_body, p_act), &mut [0.0; 4]);
            assert!((computed / (ends + sides) - 1.0).abs() < 0.002, "{theta}: {computed} {ends} {sides}");
        }
        assert_eq!(term.add(&Pose::new(&[0.0; 4], p_body, p_act), &mut [0.0; 4]), 0.0);
    }
}
