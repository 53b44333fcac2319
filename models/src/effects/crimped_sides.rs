//! Crimped sides: the side welds keep their length while the pouch shortens, so they fold out of their line, and a weld of bonded
//! plies resists.
//!
//! A weld that is pushed out of its line by w lowers one of its two sheets and lifts the other. Their quarter circles of radius a
//! (`sealed_sides`) become arcs of ρ(1 − cosψ) = a ∓ w that gather as much width, ρ(ψ − sinψ) = (π/2 − 1) a, and the section loses
//! ½ k w² of its area:
//!
//! ```text
//! ∂²S/∂h² = −(v − ψv')/(u'v − uv'),  u = 1 − cosψ,  v = ψ − sinψ     two sheets at ψ = π/2:  k = 4/(4 − π)
//! F = 2 √(k P̄ D_w b)     E = 2 e F (1 − (½π − 1)²) ε per metre     P̄ = P − χ p_b
//! ```
//!
//! The weld follows the chord of the wall, which is narrowest in the middle of a pouch: the way round in the plane of the wall, of slope
//! (½π − 1) tanφ where the lens has tanφ, spares (½π − 1)² ε. F is the compression that folds a beam on the foundation k P̄, and keeps
//! folding it; e the edge restraint of the actuator (1 sealed, 0
//! freed by gussets). D_w of bonded plies is ½ E t · t² for two. The foundation does not depend on a. Folds are short compared with the
//! pouch, 2π (D_w b/k P̄)^¼ ≪ L, and not yet steep, where F falls slowly. Left
//! out: bending of the weld in the plane of the wall, and of the sheets next to it.

use super::entry::*;
use crate::gusset::GATHERED;
use std::f64::consts::PI;

pub(super) const ENTRY: Effect = Effect {
    name: "crimped_sides",
    formula: "E = 2 F (1 − (½π − 1)²) ε per metre, F = 2 √(4/(4 − π) · (P − χ p_b) D_w b)",
    sentence: "The side welds are too long for a pouch that has shortened, so they fold, and bonded plies resist.",
    differs: "The bend comes late and less, most where the pull is weak: at low pressures.",
    remedy: "Look at the sides of a full pouch: one sharp fold each, in its middle. Cut the side welds narrower.",
    validity: "folds short compared with the pouch, two sheets that meet at a weld",
    reference: "Hetényi 1946, §7 (beam on a foundation); foundation derived here",
    parameters: &[parameter("bending_nm2", "D_w b", "N m2", 1.0)
        .usual(5e-6, [0.0, 1e-3])
        .fitted(Fitted::FromDesign)
        .means("bending stiffness of one side weld along the robot")],
    needs: Needs::Family(Family::Pouch),
    add: |values, assembly| {
        for site in assembly.active_sites(Family::Pouch) {
            let restraint = site.actuator.map_or(0.0, |actuator| (actuator.edge_restraint)(&site.shape));
            if values[0] * restraint > 0.0 {
                // Compression of both sides over √P̄ [m √(N)], and χ.
                let (sides, inner) = (4.0 * restraint * FOLDED * (FOUNDATION * values[0]).sqrt(), site.inner_share);
                let law = ENTRY.law(Account::Wall, move |at, force| {
                    let push = sides * (at.p_act_pa - inner * at.p_body_pa).max(0.0).sqrt();
                    force[actuator_q::CONTRACTION] -= push;
                    push * at.q[actuator_q::CONTRACTION]
                });
                site.weld_nm2 = values[0];
                site.act(*law, SideEffects::SHIFT);
            }
        }
    },
    ..BALANCE
};

/// Part of the contraction that the way round in the plane of the wall leaves to the folds.
pub(super) const FOLDED: f64 = 1.0 - GATHERED * GATHERED;
/// Curvature of the lost area over the weld's displacement.
pub(super) const FOUNDATION: f64 = 4.0 / (4.0 - PI);
