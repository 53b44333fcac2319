//! What the bodies of the finite elements lose in volume, and what the reduced model knows of it.
//!
//! A reduced body folds about its taut generator and loses `πR³θ` at a turn θ ([`models::body::BodyPressure`]). What the
//! bodies of the finite elements lose beyond it is counted in volumes of the actuator, and the actuator's volume in volumes of
//! ideal lenses ([`models::actuators::pouch`]) that have contracted as much:
//!
//! ```text
//! χ = (ΔV_b − πR³θ)/ΔV_a      c = ΔV_a/(n V(ε))      ε = θ D/(n L₀)
//! V(ε) = L₀² W (t − sin t cos t)/(2t²)               1 − sin t/t = ε
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | ΔV_b, ΔV_a | what the body has lost, and the actuator gained, since the body was full | m³, printed in cm³ |
//! | θ | turn of the tip | rad |
//! | R, D | radius of the body, arm of the actuator at rest (2R for pouches) | m |
//! | n, L₀, W | pouches, their flat length and width | -, m, m |
//! | χ | body volume that an actuator volume displaces: its gas works against χ p_b, E = χ p_b ΔV_a | - |
//! | c | share of the ideal lens | - |
//!
//! **Validity**: both are read off finished runs and predict nothing. χ is a quotient of totals; what one more cm³ displaces
//! may be more or less. c holds whatever parts a pouch from a lens of arm D: sealed edges, welds of some width, a shorter
//! arm. Small turns have neither, being quotients of small differences. Uniform robots only: zones are not looked at.

use super::{EngineRun, EngineState, MeanOverSeeds, ensemble, over_seeds};
use crate::policy;
use models::Scenario;
use models::actuators::{ActuatorShape, pouch};
use serde::Serialize;
use std::f64::consts::{FRAC_2_PI, PI};

/// Volumes of one state of a finite element run, or their means over seeds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Volumes<V = f64> {
    /// Actuator gauge pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Loss of the body since it was full \[cm³\].
    pub body_lost_cm3: V,
    /// Loss of a reduced body at this turn, πR³θ \[cm³\].
    pub by_bend_cm3: V,
    /// Gain of the actuator since the body was full \[cm³\].
    pub actuator_cm3: V,
    /// χ \[-\]; `None` at small turns.
    pub displaced: Option<V>,
    /// c \[-\]; `None` at small turns, for muscles, and beyond the contraction of a round lens.
    pub lens_share: Option<V>,
}

/// [`Volumes`] over the seeds of an ensemble; the quotients over those that have one.
pub type MeanVolumes = Volumes<MeanOverSeeds>;

/// Volumes of every state after the filled one.
pub fn volumes(scenario: &Scenario, run: &EngineRun) -> Vec<Volumes> {
    let Some((filled, states)) = run.states.split_first() else { return Vec::new() };
    let last = states.last().unwrap_or(filled);
    states.iter().map(|state| volumes_of(scenario, filled, state, last)).collect()
}

fn volumes_of(scenario: &Scenario, filled: &EngineState, state: &EngineState, last: &EngineState) -> Volumes {
    let body_lost_cm3 = filled.body_cm3 - state.body_cm3;
    let by_bend_cm3 = PI * scenario.radius_m.powi(3) * state.turn_rad * 1e6;
    let actuator_cm3 = state.actuator_cm3 - filled.actuator_cm3;
    let full_cm3 = last.actuator_cm3 - filled.actuator_cm3;
    let filled = policy::is_filled(actuator_cm3, full_cm3.max(0.0));
    let bent = policy::is_bent(state.turn_rad, last.turn_rad.max(0.0)) && filled;
    let displaced = bent.then(|| (body_lost_cm3 - by_bend_cm3) / actuator_cm3);
    let lens_cm3 = lens_m3(scenario, state.turn_rad).filter(|_| bent).map(|m3| m3 * 1e6);
    let lens_share = lens_cm3.map(|cm3| actuator_cm3 / cm3);
    Volumes { actuator_kpa: state.actuator_kpa, body_lost_cm3, by_bend_cm3, actuator_cm3, displaced, lens_share }
}

/// Volume n V(ε) of ideal pouches at a turn \[m³\]; `None` for muscles and outside of 0 < ε < 1 − 2/π.
fn lens_m3(scenario: &Scenario, turn_rad: f64) -> Option<f64> {
    let actuator = &scenario.actuator;
    let arm_m = actuator.arm_m.unwrap_or_else(|| (actuator.kind.arm)(scenario.radius_m, &actuator.shape));
    let count = actuator.count as f64;
    let contraction = turn_rad * arm_m / (count * actuator.shape.length_m);
    let inside = contraction > 0.0 && contraction < 1.0 - FRAC_2_PI;
    (inside && actuator.kind.has_pouches()).then(|| {
        let lens = ActuatorShape { volume_gain: 1.0, ..actuator.shape };
        let at = pouch::stroke(&lens, pouch::half_angle(contraction));
        count * lens.length_m * at.volume
    })
}

/// A robot at one body pressure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BodyVolumes {
    /// Name of the scenario that was run.
    pub robot: String,
    /// Actuator kind of the robot, such as `epam`.
    pub actuator: String,
    /// Body gauge pressure \[kPa\].
    pub body_kpa: f64,
    /// Whether that is the scenario's own.
    pub own: bool,
    /// Element size at the actuator \[mm\].
    pub mesh_mm: f64,
    /// Number of seeds in the means.
    pub seeds: usize,
    /// Mean volumes at every pressure of the runs.
    pub states: Vec<MeanVolumes>,
}

/// A robot at its own body pressure, then at the others that have runs, lowest first; recommended settings.
pub fn body_volumes(scenario: &Scenario, runs: &[EngineRun]) -> Vec<BodyVolumes> {
    let own_kpa = scenario.p_body_pa * 1e-3;
    let other = |run: &EngineRun| run.scenario == scenario.name && !policy::is_same_reading(run.body_kpa, own_kpa);
    let mut others: Vec<f64> = runs.iter().filter(|run| other(run)).map(|run| run.body_kpa).collect();
    others.sort_by(f64::total_cmp);
    others.dedup();
    let at = |body_kpa: f64| {
        let changed = Scenario { p_body_pa: body_kpa * 1e3, ..scenario.clone() };
        let ensemble = ensemble(runs, &changed);
        let mesh_mm = ensemble.runs.first()?.mesh_mm[1];
        Some(BodyVolumes {
            robot: scenario.name.clone(),
            actuator: scenario.actuator.kind.name.to_string(),
            body_kpa,
            own: body_kpa == own_kpa,
            mesh_mm,
            seeds: ensemble.runs.len(),
            states: mean_volumes(&changed, &ensemble.runs),
        })
    };
    std::iter::once(own_kpa).chain(others).filter_map(at).collect()
}

fn mean_volumes(scenario: &Scenario, runs: &[EngineRun]) -> Vec<MeanVolumes> {
    let all: Vec<Vec<Volumes>> = runs.iter().map(|run| volumes(scenario, run)).collect();
    let at = |kpa: f64| {
        let here = || all.iter().flatten().filter(move |v| policy::is_same_reading(v.actuator_kpa, kpa));
        let known = |value: fn(&Volumes) -> Option<f64>| over_seeds(here().filter_map(value));
        Some(MeanVolumes {
            actuator_kpa: kpa,
            body_lost_cm3: over_seeds(here().map(|v| v.body_lost_cm3))?,
            by_bend_cm3: over_seeds(here().map(|v| v.by_bend_cm3))?,
            actuator_cm3: over_seeds(here().map(|v| v.actuator_cm3))?,
            displaced: known(|v| v.displaced),
            lens_share: known(|v| v.lens_share),
        })
    };
    all.iter().take(1).flatten().filter_map(|v| at(v.actuator_kpa)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::stored;
    use super::*;
    use crate::study::published::textbook_scenario;

    /// A run of the ePAM whose body loses πR³θ + χ ΔV_a, and whose pouches are a share of ideal lenses.
    fn made_up(scenario: &Scenario, displaced: f64, share: f64) -> EngineRun {
        let filled = EngineState { body_cm3: 1800.0, actuator_cm3: -1.5, ..EngineState::default() };
        let mut states = vec![filled.clone()];
        for (actuator_kpa, turn_rad) in [(5.0, 0.02), (10.0, 0.3), (30.0, 0.9)] {
            let gained = share * lens_m3(scenario, turn_rad).unwrap() * 1e6;
            let body_cm3 = filled.body_cm3 - PI * 64.0 * turn_rad - displaced * gained;
            let actuator_cm3 = filled.actuator_cm3 + gained;
            states.push(EngineState { actuator_kpa, turn_rad, body_cm3, actuator_cm3, ..filled.clone() });
        }
        EngineRun { states, ..EngineRun::default() }
    }

    #[test]
    fn a_run_that_displaces_a_multiple_of_its_actuator_gives_it_back_but_for_small_turns() {
        let scenario = textbook_scenario("epam").unwrap();
        let [small, bent @ ..] = &volumes(&scenario, &made_up(&scenario, 1.1, 0.6))[..] else { panic!() };
        assert!(small.displaced.is_none() && small.lens_share.is_none() && bent.len() == 2);
        for v in bent {
            assert!((v.displaced.unwrap() - 1.1).abs() < 1e-12 && (v.lens_share.unwrap() - 0.6).abs() < 1e-12, "{v:?}");
        }
    }

    #[test]
    fn a_slack_actuator_a_muscle_and_a_contraction_past_the_round_lens_have_no_share() {
        let scenario = textbook_scenario("epam").unwrap();
        let mut run = made_up(&scenario, 1.1, 0.6);
        run.states[2].actuator_cm3 = 0.04 * run.states[3].actuator_cm3 + run.states[0].actuator_cm3;
        run.states[3].turn_rad = (1.0 - FRAC_2_PI) * 0.36 / 0.08 + 1e-6;
        let found = volumes(&scenario, &run);
        assert!(found[1].displaced.is_none());
        assert!(found[2].displaced.is_some() && found[2].lens_share.is_none());
        let muscle = volumes(&textbook_scenario("fpam").unwrap(), &made_up(&scenario, 1.1, 0.6));
        assert!(muscle[2].displaced.is_some() && muscle.iter().all(|v| v.lens_share.is_none()));
    }

    #[test]
    fn pouches_of_the_stored_epam_hold_six_tenths_of_the_lens_at_all_pressures() {
        let scenario = textbook_scenario("epam").unwrap();
        let [own, ..] = &body_volumes(&scenario, &stored().unwrap())[..] else { panic!() };
        assert!(own.own && own.seeds == 5 && own.states.len() == 6);
        let ensemble = ensemble(&stored().unwrap(), &scenario);
        for v in ensemble.runs.iter().flat_map(|run| volumes(&scenario, run)) {
            assert!((0.57..0.65).contains(&v.lens_share.unwrap()), "{v:?}");
        }
    }

    /// Share η of stroke and volume at once, ΔV_a = η n V(ε/η), by bisection; `None` if no η does it.
    fn share_of_both(scenario: &Scenario, turn_rad: f64, actuator_cm3: f64) -> Option<f64> {
        let over = |share: f64| lens_m3(scenario, turn_rad / share).map(|m3| share * m3 * 1e6 - actuator_cm3);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if over(middle).is_some_and(|cm3| cm3 > 0.0) { high = middle } else { low = middle }
        }
        over(high + 1e-9).filter(|cm3| cm3.abs() < 1e-3).map(|_| high)
    }

    #[test]
    fn the_share_of_stroke_and_volume_that_gives_the_volumes_of_the_stored_epam_rises_with_pressure() {
        let scenario = textbook_scenario("epam").unwrap();
        let ensemble = ensemble(&stored().unwrap(), &scenario);
        let shares: Vec<Option<f64>> = volumes(&scenario, &ensemble.runs[0])
            .iter()
            .zip(&ensemble.runs[0].states[1..])
            .map(|(v, state)| share_of_both(&scenario, state.turn_rad, v.actuator_cm3))
            .collect();
        let found: Vec<f64> = shares.iter().flatten().copied().collect();
        // At 30 kPa the robot bends beyond what any share allows with so little gas.
        assert!(found.len() == 5 && shares[5].is_none(), "{shares:?}");
        assert!(found.is_sorted() && found[0] < 0.47 && found[4] > 0.51, "{shares:?}");
    }
}
