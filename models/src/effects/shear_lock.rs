//! Shear locking of an fPAM's weave: beyond an angle the yarns jam and the muscle shortens no further.
//!
//! α and α₀ are the yarns' angles to the axis now and at rest; K acts over both layers of the flat tube, 2W. The free stroke of an ideal
//! muscle cut at 45° shears it by 0.34 rad: a larger γ_L is never reached. A large K, 2000 N/m, some 40 times a coated weave's, is a hard
//! stop; yarns that are pressed together little by little have a smaller one. Bias-extension tests lock near 45° for a plain weave, far
//! beyond the muscle's stroke; a coating or a tight weave locks earlier.

use super::entry::*;
use std::f64::consts::FRAC_PI_2;

pub(super) const ENTRY: Effect = Effect {
    name: "shear_lock",
    formula: "E = K (γ − γ_L)²₊ W per metre, γ = 2(α − α₀), cosα = (1 − ε) cosα₀",
    sentence: "The yarns of the muscle jam at a certain shear angle and stop it.",
    differs: "The bend stops at a value that no further pressure exceeds; below it nothing changes.",
    remedy: "Take the locking angle from a bias-extension test of the fabric.",
    validity: "locking at one angle, then a linear stiffness",
    reference: "trellis kinematics, Cao et al. 2008; usual K assumed",
    parameters: &[
        parameter("lock_rad", "γ_L", "rad", 1.0)
            .usual(0.22, [0.05, 1.0])
            .neutral(1.0)
            .possible([0.0, FRAC_PI_2])
            .starts(&[0.08, 0.14, 0.2, 0.26, 0.32])
            .means("shear angle at which the yarns touch"),
        parameter("stiffness_n_per_m", "K", "N/m", 1.0)
            .around(JAMMED, [20.0, 20e3])
            .possible(ABOVE_ZERO)
            .starts(&[60.0, 200.0, 600.0])
            .means("stiffness of the jammed weave"),
    ],
    needs: Needs::Family(Family::Mckibben),
    add: |values, assembly| {
        let [lock, stiffness] = [values[0], values[1]];
        for site in assembly.active_sites(Family::Mckibben) {
            let shape = site.shape;
            site.actuator_terms.push(ENTRY.law(Account::Wall, move |at, force| {
                let [shear, d_shear] = shape.yarn_shear(at.q[actuator_q::CONTRACTION]);
                let beyond = (shear - lock).max(0.0);
                let moment = 2.0 * stiffness * shape.width_m * beyond;
                force[actuator_q::CONTRACTION] -= moment * d_shear;
                0.5 * moment * beyond
            }));
        }
    },
    ..BALANCE
};

/// Usual stiffness of the jammed weave \[N/m\].
const JAMMED: f64 = 2000.0;
