//! Coulomb friction of threads, folds and layers against each other: a moment that opposes every change of bend.
//!
//! ```text
//! M = −clamp(M_f (κ − q)/κ_s, ±M_f)      q follows κ at a distance of at most κ_s
//! incremental potential from q₀, with u = |κ − q₀|:
//! E = ½ M_f u²/κ_s (u ≤ κ_s, sticks),  E = ½ M_f κ_s + M_f (u − κ_s) (slides): stored + lost
//! ```
//!
//! q is the curvature at which the friction is free, which it remembers; κ_s the elastic slide before it gives way. The same bend needs more
//! pressure going up than coming down; after unloading the robot stays bent if M_f exceeds the wall's restoring moment there. Nothing gives way
//! gradually.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "friction",
    group: Group::Body,
    history: true,
    formula: "M = ∓M_f against the change of κ, elastic within ±M_f",
    sentence: "Threads, folds and layers rub on each other, so the robot bends less going up and springs back less coming down.",
    differs: "Less bend going up and more coming down at the same pressure; a rest after unloading that time does not remove.",
    remedy: "Repeat the test with pressures going up and down, and tap the robot in each hold: friction lets go.",
    validity: "independent of rate and of pressure; one sliding moment",
    reference: "Coulomb friction with elastic slide; Tondu & Lopez 2000 for braided muscles",
    parameters: &[parameter("moment_nm", "M_f", "N m", 1.0)
        .usual(0.5, [0.0, 5.0])
        .starts(&[0.05, 0.2, 0.6, 1.5])
        .by_actuator(&[("spam", 1.15), ("epam", 0.58), ("cpam", 0.52), ("fpam", 0.07)])
        .means("moment at which it slides")],
    add: |values, assembly| {
        if values[0] == 0.0 {
            return;
        }
        for site in &mut assembly.sites {
            site.body_terms.push(Box::new(Friction { moment: values[0] }));
        }
    },
    ..BALANCE
};

/// Elastic slide κ_s before the friction gives way \[1/m\]; numerical.
const SLIDE: f64 = 0.02;

struct Friction {
    moment: f64,
}

impl Friction {
    /// How far it slides from the remembered place to curvature `kappa`, with sign \[1/m\].
    fn slip(kappa: f64, free: f64) -> f64 {
        let away = kappa - free;
        away - away.clamp(-SLIDE, SLIDE)
    }
}

impl Term for Friction {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let free = at.remembered(0);
        let slip = Friction::slip(at.q[0], free);
        let elastic = at.q[0] - free - slip;
        let moment = self.moment * elastic / SLIDE;
        force[0] -= moment;
        0.5 * moment * elastic + self.moment * slip.abs()
    }
}

impl Remembering for Friction {
    fn memory(&self) -> Memory {
        Memory { values: 1, time_s: f64::INFINITY }
    }

    fn remember(&self, at: &Pose, next: &mut [f64]) -> f64 {
        let slip = Friction::slip(at.q[0], at.remembered(0));
        next[0] = at.remembered(0) + slip;
        self.moment * slip.abs()
    }
}
