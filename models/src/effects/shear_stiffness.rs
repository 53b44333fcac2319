//! Shear stiffness of the fabric of an fPAM: contracting shears the weave, and a coated weave resists.
//!
//! ```text
//! cosα = (1 − ε) cosα₀      γ = 2(α − α₀)      E = G_t γ² W · 2/(1 + n) |γ/γ_r|^{n−1} per metre
//! n = 1: ½ G_t γ² over the flat tube's two layers, 2W      γ_r = 0.3
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | α, α₀ | yarn angle to the axis, at rest (45° unless `bias_deg` gives another) | rad |
//! | γ | shear angle | rad |
//! | n | exponent of the shear force: below 1 the weave softens as it is sheared, above it stiffens | - |
//! | G_t | shear modulus × thickness; 1/G = 4/E₄₅ − (1/E₀ + 1/E₉₀): 51.6 N/m for E₀, E₄₅, E₉₀ = 96.5, 4.05, 120 MPa, 50 µm | N/m |
//!
//! Makes the free stroke rise with pressure, which no ideal McKibben law does. Validity: below locking (about 35–45°).
//! With stretching yarns the part with n = 1 turns with them, the rest with the tube of stiff yarns. Derived here; modulus
//! relation of an orthotropic sheet at 45° with ν₁₂ ≈ 0.

use super::entry::*;

/// Shear at which G_t is the stiffness whatever the exponent \[rad\].
const REFERENCE_RAD: f64 = 0.3;

pub(super) const ENTRY: Effect = Effect {
    name: "shear_stiffness",
    group: Group::Actuator,
    formula: "E = G_t γ² W · 2/(1 + n) (γ/γ_r)ⁿ⁻¹ per metre, γ_r = 0.3, γ = 2(α − α₀), cosα = (1 − ε) cosα₀",
    sentence: "The coated weave resists shearing, so the muscle contracts less, most at low pressure.",
    differs: "Most bend is missing at low pressure; the free stroke rises with pressure.",
    remedy: "Take G_t from a 45° tensile or bias-extension test of the fabric.",
    validity: "below shear locking (|γ| < 35°)",
    reference: "derived here; 1/G = 4/E45 − (1/E0 + 1/E90)",
    parameters: &[
        Parameter {
            key: "shear_n_per_m",
            symbol: "G_t",
            unit: "N/m",
            typical: 45.0,
            upper: 400.0,
            meaning: "shear modulus times thickness of the fabric, at a shear of 0.3",
            ..PLAIN
        },
        Parameter {
            key: "exponent",
            symbol: "n",
            neutral: 1.0,
            typical: 1.0,
            lower: 0.2,
            upper: 3.0,
            possible: ABOVE_ZERO,
            meaning: "exponent of the shear force",
            ..SHAPE
        },
    ],
    needs: Needs::Family(Family::Mckibben),
    add,
    ..BALANCE
};

fn add(values: &[f64], assembly: &mut Assembly) {
    let [shear_n_per_m, exponent] = [values[0], values[1]];
    for site in assembly.active_sites(Family::Mckibben) {
        // The part with n = 1 is in the muscle's cell.
        let beyond = site.weave.is_cell();
        if beyond {
            site.weave.shear_n_per_m = shear_n_per_m;
        }
        if !beyond || exponent != 1.0 {
            let shape = site.shape;
            site.actuator_terms.push(ENTRY.law(Account::Stretch, move |at, force| {
                let [shear, d_shear] = shape.yarn_shear(at.q[actuator_q::CONTRACTION]);
                let linear = 2.0 * shear_n_per_m * shape.width_m * shear;
                let (moment, energy) = match exponent == 1.0 {
                    true => (linear, 0.5 * linear * shear),
                    false => of_power(2.0 * shear_n_per_m * shape.width_m * REFERENCE_RAD, exponent, shear),
                };
                let of_cell = if beyond { linear } else { 0.0 };
                force[actuator_q::CONTRACTION] -= (moment - of_cell) * d_shear;
                energy - 0.5 * of_cell * shear
            }));
        }
    }
}

/// Moment and energy per metre with n ≠ 1; `size` is the linear moment at the reference shear.
fn of_power(size: f64, exponent: f64, shear: f64) -> (f64, f64) {
    let moment = size * (shear.abs() / REFERENCE_RAD).powf(exponent).copysign(shear);
    (moment, moment * shear / (1.0 + exponent))
}
