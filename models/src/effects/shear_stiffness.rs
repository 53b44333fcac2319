//! Shear stiffness of the fabric of an fPAM: contracting shears the weave, and a coated weave resists.
//!
//! α and α₀ are the yarns' angles to the axis now and at rest (45° unless `bias_deg` gives another); n = 1 is ½ G_t γ² over the flat tube's
//! two layers, 2W. Below n = 1 the weave softens as it is sheared, above it stiffens. 1/G of an orthotropic sheet with ν₁₂ ≈ 0 gives 51.6 N/m
//! for E₀, E₄₅, E₉₀ = 96.5, 4.05, 120 MPa, 50 µm. Makes the free stroke rise with pressure, which no ideal McKibben law does. With stretching
//! yarns the part with n = 1 turns with them, the rest with the tube of stiff yarns.

use super::entry::*;

/// Shear at which G_t is the stiffness whatever the exponent \[rad\].
const REFERENCE_RAD: f64 = 0.3;

pub(super) const ENTRY: Effect = Effect {
    name: "shear_stiffness",
    formula: "E = G_t γ² W · 2/(1 + n) (γ/γ_r)ⁿ⁻¹ per metre, γ_r = 0.3, γ = 2(α − α₀), cosα = (1 − ε) cosα₀",
    sentence: "The coated weave resists shearing, so the muscle contracts less, most at low pressure.",
    differs: "Most bend is missing at low pressure; the free stroke rises with pressure.",
    remedy: "Take G_t from a 45° tensile or bias-extension test of the fabric.",
    validity: "below shear locking (|γ| < 35°)",
    reference: "derived here; 1/G = 4/E45 − (1/E0 + 1/E90)",
    parameters: &[
        parameter("shear_n_per_m", "G_t", "N/m", 1.0)
            .usual(45.0, [0.0, 400.0])
            .means("shear modulus times thickness of the fabric, at a shear of 0.3"),
        shape("exponent", "n", "-", 1.0)
            .around(1.0, [0.2, 3.0])
            .possible(ABOVE_ZERO)
            .means("exponent of the shear force"),
    ],
    needs: Needs::Family(Family::Mckibben),
    add: |values, assembly| {
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
    },
    ..BALANCE
};

/// Moment and energy per metre with n ≠ 1; `size` is the linear moment at the reference shear.
fn of_power(size: f64, exponent: f64, shear: f64) -> (f64, f64) {
    let moment = size * (shear.abs() / REFERENCE_RAD).powf(exponent).copysign(shear);
    (moment, moment * shear / (1.0 + exponent))
}
