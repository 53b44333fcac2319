//! Creep: a part of the wall's stiffness relaxes with time (standard linear solid).
//!
//! q is the curvature to which the relaxing part has flowed: at once the wall has (1 + a) B, in the end B. It stores ½ a B (κ − q)² and
//! loses a B (κ − q)²/τ per time. Over a step of length Δt the solution is exact for a κ that runs from κ₀ as what relaxes does,
//! κ' ~ e^{−t/τ}. With x = Δt/τ and e₀ = κ₀ − q₀
//!
//! ```text
//! κ − q = e₀ e^{−x} + (κ − κ₀) φ      φ = x/(e^x − 1)
//! ```
//!
//! so a kept bend relaxes exactly and a moving one is integrated to second order in Δt, with a small error as long as the rest of
//! the wall is not much softer than the relaxing part. The potential at fixed memory is `aB [½e₀² + e₀ e^{−x}(κ − κ₀) + ½φ(κ − κ₀)²]`. Real
//! fabrics creep over several decades of time, of which a test sees the one it lasts. The form over a step is derived here.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "creep",
    group: Group::Body,
    history: true,
    formula: "M = −a B (κ − q), q' = (κ − q)/τ",
    sentence: "The wall gives way slowly: the robot goes on bending in a hold, and straightens slowly after it.",
    differs: "The bend grows within every hold and goes on falling for a while after unloading.",
    remedy: "Hold one pressure for a minute and watch the tip.",
    validity: "linear, one relaxation time; needs B > 0",
    reference: "standard linear solid (Zener 1948)",
    parameters: &[
        parameter("share", "a", "-", 1.0).usual(0.25, [0.0, 2.0]).means("relaxing stiffness as a share of B"),
        parameter("time_s", "τ", "s", 1.0)
            .around(2.0, [0.4, 30.0])
            .possible(ABOVE_ZERO)
            .starts(&[0.7, 2.0, 6.0, 18.0])
            .means("relaxation time"),
    ],
    add: |values, assembly| {
        if values[0] == 0.0 {
            return;
        }
        for site in &mut assembly.sites {
            let stiffness = values[0] * site.bending.stiffness;
            site.body_terms.push(Box::new(Creep { stiffness, time_s: values[1] }));
        }
    },
    ..BALANCE
};

struct Creep {
    stiffness: f64,
    time_s: f64,
}

/// What it remembers: κ and κ − q.
const CURVATURE: usize = 0;
const STRETCH: usize = 1;
/// Below this x = Δt/τ the closed form of the loss has fewer digits than Simpson's rule.
const SIMPSON_BELOW: f64 = 0.1;

impl Creep {
    /// Decay e^{−x} over x = Δt/τ, and the weight φ of the present state.
    fn decay(&self, dt_s: f64) -> (f64, f64) {
        let x = dt_s / self.time_s;
        if x == 0.0 {
            return (1.0, 1.0);
        }
        let gone = -(-x).exp_m1();
        (1.0 - gone, x * (1.0 - gone) / gone)
    }
}

/// ∫ e² du over a step of length x in units of τ, for `e = e^{−u}(e₀ + c u)` with `c = (κ − κ₀)/(1 − e^{−x})`.
fn squared(before: f64, c: f64, x: f64) -> f64 {
    if x < SIMPSON_BELOW {
        let at = |u: f64| ((-u).exp() * (before + c * u)).powi(2);
        return x / 6.0 * (at(0.0) + 4.0 * at(0.5 * x) + at(x));
    }
    let left = (-2.0 * x).exp();
    let (constant, linear) = (0.5 * (1.0 - left), 0.25 - left * (0.5 * x + 0.25));
    let square = 0.25 - left * (0.5 * x * x + 0.5 * x + 0.25);
    before * before * constant + 2.0 * before * c * linear + c * c * square
}

impl Term for Creep {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (left, mean) = self.decay(at.dt_s);
        let (change, stretch) = (at.q[0] - at.remembered(CURVATURE), at.remembered(STRETCH));
        force[0] -= self.stiffness * (stretch * left + change * mean);
        self.stiffness * (0.5 * stretch * stretch + change * (stretch * left + 0.5 * mean * change))
    }
}

impl Remembering for Creep {
    fn memory(&self) -> Memory {
        Memory { values: 2, time_s: self.time_s }
    }

    /// The loss is `aB ∫ e² dt/τ` over the step.
    fn remember(&self, at: &Pose, next: &mut [f64]) -> f64 {
        let (left, mean) = self.decay(at.dt_s);
        let (change, before) = (at.q[0] - at.remembered(CURVATURE), at.remembered(STRETCH));
        next[CURVATURE] = at.q[0];
        next[STRETCH] = before * left + change * mean;
        if at.dt_s == 0.0 {
            return 0.0;
        }
        let x = at.dt_s / self.time_s;
        self.stiffness * squared(before, -change / (-x).exp_m1(), x)
    }
}
