//! Plastic set: the wall keeps a share of the largest bend it has seen.
//!
//! κ_max is the largest κ so far, towards the actuator. Stored is ½B(κ − sκ_max)², lost B s (1 − s) κ_max κ_max' per time. The incremental
//! potential from the remembered κ_max = m, less the ½Bκ² of the base, is `−Bsmκ + ½Bs²m²` below m and `−½Bsκ² − ½Bs(1 − s)m²` beyond, where
//! the largest bend goes along, without a threshold.

use super::entry::*;

pub(super) const ENTRY: Effect = Effect {
    name: "plastic_set",
    group: Group::Body,
    history: true,
    formula: "M = −B (κ − s κ_max)",
    sentence: "The wall keeps a share of the largest bend it has seen, as a creased sheet does.",
    differs: "After the first full pressure the robot stays bent; later cycles follow the unloading branch.",
    remedy: "Compare the straight robot before and after the first full pressure, after a rest of some minutes.",
    validity: "no recovery with time; bends towards the actuator; needs B > 0",
    reference: "linear plastic hardening; derived here",
    parameters: &[parameter("share", "s", "-", 1.0)
        .usual(0.12, [0.0, 0.5])
        .possible([0.0, 1.0])
        .means("share of the largest bend that stays")],
    add: |values, assembly| {
        if values[0] == 0.0 {
            return;
        }
        for site in &mut assembly.sites {
            let stiffness = site.bending.stiffness;
            site.body_terms.push(Box::new(PlasticSet { stiffness, share: values[0] }));
        }
    },
    ..BALANCE
};

struct PlasticSet {
    stiffness: f64,
    share: f64,
}

impl Term for PlasticSet {
    fn line(&self) -> LedgerLine {
        ENTRY.line(Account::Wall)
    }

    fn add(&self, at: &Pose, force: &mut [f64]) -> f64 {
        let (kappa, before) = (at.q[0], at.remembered(0));
        let moment = self.stiffness * self.share * kappa.max(before);
        force[0] += moment;
        if kappa <= before {
            -moment * (kappa - 0.5 * self.share * before)
        } else {
            -0.5 * (moment * kappa + self.stiffness * self.share * (1.0 - self.share) * before * before)
        }
    }
}

impl Remembering for PlasticSet {
    fn memory(&self) -> Memory {
        Memory { values: 1, time_s: f64::INFINITY }
    }

    fn remember(&self, at: &Pose, next: &mut [f64]) -> f64 {
        let before = at.remembered(0);
        next[0] = at.q[0].max(before);
        0.5 * self.stiffness * self.share * (1.0 - self.share) * (next[0] * next[0] - before * before)
    }
}
