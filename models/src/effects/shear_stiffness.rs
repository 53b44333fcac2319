//! Shear stiffness of the fabric of an fPAM: contracting shears the weave, and a coated weave resists.
//!
//! ```text
//! cosα = (1 − ε) cosα₀      γ = 2(α − α₀)      E = G_t γ² W per metre   (½ G_t γ² over the flat tube's two layers, 2W)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | α, α₀ | yarn angle to the axis, at rest (45° unless `bias_deg` says otherwise) | rad |
//! | γ | shear angle | rad |
//! | G_t | shear modulus × thickness; 1/G = 4/E₄₅ − (1/E₀ + 1/E₉₀): 51.6 N/m for E₀, E₄₅, E₉₀ = 96.5, 4.05, 120 MPa, 50 µm | N/m |
//!
//! Makes the free stroke rise with pressure, which no ideal McKibben law does. Validity: linear in γ, below locking
//! (about 35–45°). Derived here; modulus relation of an orthotropic sheet at 45° with ν₁₂ ≈ 0.

use super::*;

pub(super) const ENTRY: Effect = Effect {
    name: "shear_stiffness",
    group: Group::Actuator,
    stage: Stage::Balance,
    history: false,
    formula: "E = G_t γ² W per metre, γ = 2(α − α₀), cosα = (1 − ε) cosα₀",
    sentence: "The coated weave resists shearing, so the muscle contracts less, most at low pressure.",
    differs: "Most bend is missing at low pressure; the free stroke rises with pressure.",
    remedy: "Take G_t from a 45° tensile or bias-extension test of the fabric.",
    validity: "below shear locking (|γ| < 35°); linear",
    reference: "derived here; 1/G = 4/E45 − (1/E0 + 1/E90)",
    parameters: &[Parameter {
        key: "shear_n_per_m",
        symbol: "G_t",
        unit: "N/m",
        typical: 45.0,
        upper: 400.0,
        meaning: "shear modulus times thickness of the fabric",
        ..PLAIN
    }],
    needs: Needs::Family(Family::Mckibben),
    add,
};

struct ShearStiffness {
    shear_n_per_m: f64,
    shape: ActuatorShape,
}

fn add(values: &[f64], assembly: &mut Assembly) {
    for site in assembly.active_sites(Family::Mckibben) {
        if site.weave.is_cell() {
            site.weave.shear_n_per_m = values[0];
            continue;
        }
        let shape = site.shape;
        site.actuator_terms.push(Box::new(ShearStiffness { shear_n_per_m: values[0], shape }));
    }
}

impl Term for ShearStiffness {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Stretch)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let [shear, d_shear] = self.shape.yarn_shear(at.q[actuator_q::CONTRACTION]);
        let moment = 2.0 * self.shear_n_per_m * self.shape.width_m * shear;
        force[actuator_q::CONTRACTION] -= moment * d_shear;
        0.5 * moment * shear
    }
}
