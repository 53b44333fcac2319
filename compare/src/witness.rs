//! What finite element runs of the same robot say about a diagnosis.
//!
//! Two questions. **Do the finite elements meet the measurement where the model does not?** Then the missing effect is one that
//! they contain: sealed edges, folds, contact, stretch and shear of the fabric, the shape of the section. If they miss it too,
//! it is rather in what they lack: the supply, the camera, memory of the fabric. **Whose ledger is theirs?** Candidates that
//! bend the robot alike may spend the work of the gas differently; at the bend θ that the finite elements reach,
//!
//! ```text
//! apart = Σ |E_fe,k(θ) − E_candidate,k(θ)|        k: pouch gas, body folds, wall bending, stretch, contact
//! ```
//!
//! is least for the candidate that spends it as they do. **Validity**: the runs are models too, with assumed numbers; a ledger
//! compares energies and not their slopes. It speaks for or against a candidate, it proves nothing.

use crate::diagnosis::{Diagnosis, EffectAnswer, ParameterValue, Ranked, Standing, with_fitted};
use crate::error::CompareError;
use crate::fit::numbers::{largest, least, mean, sort_by};
use crate::moment::{CurvePoint, at_turn, degrees};
use crate::policy;
use crate::study::engines::{Energies, EngineRun, Ensemble, TERMS, between, ensemble, over_seeds};
use crate::study::predict::{fit_scenario, predict_dataset};
use crate::wording::{list, short};
use data::{About, Dataset, Phase};
use models::{Loads, Scenario};
use serde::Serialize;

/// Terms that are physics: all but hourglass control.
const PHYSICAL: usize = TERMS.len() - 1;
const MOST: usize = 6;
const GAS: usize = 0;
const BENDING: usize = 2;

/// Outermost shared marker at one pressure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Height {
    /// Actuator gauge pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Mean of the runs, first loading \[mm\].
    pub measured_mm: f64,
    /// The model with its calibrated B \[mm\].
    pub base_mm: f64,
    /// The final model of the diagnosis, with the effects it adds \[mm\].
    pub best_mm: f64,
    /// Finite elements, mean over seeds \[mm\].
    pub fe_mm: f64,
    /// Their standard deviation over seeds; `None` for one run \[mm\].
    pub fe_sd_mm: Option<f64>,
    /// Whether finite elements meet the measurement: within a tenth of it or two of their own deviations.
    pub meets: bool,
}

/// The ledger of one model next to the ledger of the finite elements.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WitnessRow {
    /// `base`, or the effects it has beyond it.
    pub name: String,
    /// Ledger in [`TERMS`] at the finite elements' bend \[mJ\].
    pub energies_mj: Energies,
    /// Σ of the differences from the finite elements' \[mJ\].
    pub apart_mj: f64,
    /// The diagnosis names it: in the set that the data cannot separate, or as the attempt.
    pub named: bool,
}

/// The moment that the diagnosed model, as given, misses at the bend of the finite elements.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FeMoment {
    /// Actuator gauge pressure \[kPa\].
    pub actuator_kpa: f64,
    /// Bend, as the turn of the whole body at this curvature, mean over seeds \[°\].
    pub bend_deg: f64,
    /// Its standard deviation over seeds; zero for one run.
    pub bend_sd_deg: f64,
    /// Missing moment, mean over seeds \[N·m\].
    pub moment_nm: f64,
    /// Its standard deviation over seeds; zero for one run.
    pub moment_sd_nm: f64,
}

/// A diagnosis compared with finite element runs of the same robot.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Witness {
    /// Runs, one per seed of the imperfections.
    pub runs: usize,
    /// Element size of the actuator \[mm\].
    pub mesh_mm: f64,
    /// How their numbers are known: `assumed` or `calibrated`.
    pub known: String,
    /// Outermost marker at the pressures that runs and data share.
    pub heights: Vec<Height>,
    /// What the model misses at their bends, to be read with the diagnosis's own; empty unless that was asked for.
    pub moments: Vec<FeMoment>,
    /// Actuator pressure of the ledgers \[kPa\].
    pub actuator_kpa: f64,
    /// Their ledger in [`TERMS`] from the first bend to that pressure, mean over seeds \[mJ\]; `None` if the calibrated model
    /// cannot bend as they do.
    pub fe_mj: Option<Energies>,
    /// The base first, then candidates, nearest ledger first; empty without a ledger.
    pub models: Vec<WitnessRow>,
    /// Conclusions for the reader, one sentence each.
    pub sentences: Vec<String>,
}

/// Holds finite element runs of the scenario's robot against a diagnosis; `None` where there is none, or none at a pressure
/// of the data, and of a robot in space or with several supply channels.
pub fn witness(
    d: &Diagnosis,
    scenario: &Scenario,
    dataset: &Dataset,
    about: Option<&About>,
    runs: &[EngineRun],
) -> Result<Option<Witness>, CompareError> {
    if scenario.is_spatial() || dataset.channels_differ() {
        return Ok(None);
    }
    let (scenario, _) = fit_scenario(scenario, dataset, about)?;
    let ensemble = ensemble(runs, &scenario);
    let (both, candidates) = cases(d, &scenario);
    let heights = heights(&both, dataset, &ensemble)?;
    let (Some(top), Some(first)) = (heights.last(), ensemble.runs.first()) else { return Ok(None) };
    let kpa = top.actuator_kpa;
    let row = |(name, s, named): &(String, Scenario, bool)| Some(beside(name, s, &ensemble, (kpa, *named))?.0);
    let mut models: Vec<WitnessRow> = candidates.iter().filter_map(row).collect();
    sort_by(&mut models, |model| model.apart_mj);
    let own = beside("base", &both[0], &ensemble, (kpa, false));
    let fe_mj = own.as_ref().map(|o| o.1);
    match own {
        Some((own, _)) => models.insert(0, own),
        None => models.clear(),
    }
    let mut found = Witness {
        runs: ensemble.runs.len(),
        mesh_mm: first.mesh_mm[1],
        known: first.known.clone(),
        actuator_kpa: kpa,
        fe_mj,
        models,
        heights,
        moments: d
            .missing_moment
            .as_ref()
            .map_or(Vec::new(), |m| moments(&scenario.with_bending(m.bending_nm2), &ensemble)),
        sentences: Vec::new(),
    };
    found.sentences = sentences(&found, d);
    Ok(Some(found))
}

/// Base and final model, and every candidate with a ledger, with its name and whether the diagnosis names it.
fn cases(d: &Diagnosis, scenario: &Scenario) -> ([Scenario; 2], Vec<(String, Scenario, bool)>) {
    let level = d.level(scenario.p_body_pa * 1e-3);
    let added = if d.added.is_empty() { &d.attempt } else { &d.added };
    let all: Vec<(&str, &[ParameterValue])> = added.iter().map(|a| (&*a.effect, &*a.parameters)).collect();
    let b = d.base.bending_with_added_nm2.get(level).copied();
    let has_ledger = |r: &Ranked| !r.group.is_nuisance();
    // In addition to the stated set, single effects: their ledgers show what each of them does.
    let wanted = |a: &EffectAnswer| a.helps() && (a.standing != Standing::Other || a.effects.len() == 1);
    let answers = d.answers().into_iter().filter(|a| wanted(a) && a.effects.iter().any(|(r, _)| has_ledger(r)));
    let candidate = |a: EffectAnswer| {
        let name = a.effects.iter().map(|(r, _)| format!("+ {}", r.effect)).collect::<Vec<_>>().join(" ");
        (name, a.on_with(scenario, level, has_ledger), a.standing != Standing::Other)
    };
    let models = [d.calibrated(scenario, level), with_fitted(scenario, &all, b)];
    (models, answers.take(MOST).map(candidate).collect())
}

/// The outermost marker that data and runs share, on first loading at the body pressure of the runs, where both have the same
/// actuator pressure.
fn heights(models: &[Scenario; 2], dataset: &Dataset, ensemble: &Ensemble) -> Result<Vec<Height>, CompareError> {
    let Some(run) = ensemble.runs.first() else { return Ok(Vec::new()) };
    let stations = &models[0].markers_m;
    let pressures = || pressures(run);
    let shared = |m: &usize| pressures().any(|p| ensemble.marker_at(stations[*m], p).is_some());
    let Some(marker) = (0..stations.len()).rev().find(shared) else { return Ok(Vec::new()) };
    let [base, best] = models.each_ref().map(|model| predict_dataset(model, dataset));
    let (base, best) = (base?, best?);
    let mut found: Vec<Height> = Vec::new();
    for (h, hold) in dataset.holds.iter().enumerate() {
        let kpa = hold.p_act_pa * 1e-3;
        let body = policy::is_same_pressure(hold.p_body_pa, 1e3 * run.body_kpa);
        let nearest = least(pressures(), |p| (p - kpa).abs());
        let Some(shared) = nearest.filter(|p| policy::is_same_set_point(*p, kpa)) else { continue };
        let Some((fe_mm, fe_sd_mm)) = ensemble.marker_at(stations[marker], shared) else { continue };
        let unseen = !dataset.is_seen(h, marker);
        if !body || unseen || hold.phase == Phase::Unload || found.iter().any(|f| f.actuator_kpa == shared) {
            continue;
        }
        let samples = dataset.samples_per_hold;
        let y_mm = |xy: &[f64], s: usize| 1e3 * xy[dataset.offset(h, s, marker) + 1];
        let of = |xy: &[f64]| mean((0..samples).map(|s| y_mm(xy, s)));
        let measured_mm = mean((0..dataset.runs.len()).map(|r| of(dataset.run(r))));
        let [base_mm, best_mm] = [of(&base.coordinates_m), of(&best.coordinates_m)];
        let meets =
            policy::meets(fe_mm / measured_mm - 1.0) || (fe_mm - measured_mm).abs() <= 2.0 * fe_sd_mm.unwrap_or(0.0);
        found.push(Height { actuator_kpa: shared, measured_mm, base_mm, best_mm, fe_mm, fe_sd_mm, meets });
    }
    sort_by(&mut found, |height| height.actuator_kpa);
    Ok(found)
}

fn moments(scenario: &Scenario, ensemble: &Ensemble) -> Vec<FeMoment> {
    let at = |kpa: f64| -> Option<FeMoment> {
        let of = |run: &EngineRun| {
            let state = run.states.iter().find(|s| policy::is_same_reading(s.actuator_kpa, kpa))?;
            // The pull of a nearly straight actuator has no bound.
            let bent = policy::is_bent(state.turn_rad, run.states.last()?.turn_rad);
            let loads = Loads::uniform(1e3 * run.body_kpa, 1e3 * kpa);
            at_turn(scenario, &loads, state.turn_rad).filter(|_| bent)
        };
        let found: Vec<CurvePoint> = ensemble.runs.iter().filter_map(of).collect();
        let [bend, moment] = [0, 1].map(|k| over_seeds(found.iter().map(|p| p[k])));
        let (per, bend, moment) = (degrees(scenario.length_m), bend?, moment?);
        Some(FeMoment {
            actuator_kpa: kpa,
            bend_deg: per * bend.0,
            bend_sd_deg: per * bend.1.unwrap_or(0.0),
            moment_nm: moment.0,
            moment_sd_nm: moment.1.unwrap_or(0.0),
        })
    };
    ensemble.runs.first().into_iter().flat_map(pressures).filter_map(at).collect()
}

/// Actuator pressures of a run above zero \[kPa\].
fn pressures(run: &EngineRun) -> impl Iterator<Item = f64> {
    run.states.iter().map(|s| s.actuator_kpa).filter(|kpa| *kpa > 0.0)
}

fn beside(
    name: &str,
    scenario: &Scenario,
    ensemble: &Ensemble,
    (kpa, named): (f64, bool),
) -> Option<(WitnessRow, Energies)> {
    let ledgers: Vec<[Energies; 2]> =
        ensemble.runs.iter().map(|run| between(scenario, run, kpa)).collect::<Option<_>>()?;
    let [fe, own]: [Energies; 2] = [0, 1].map(|i| std::array::from_fn(|k| mean(ledgers.iter().map(|l| l[i][k]))));
    let apart_mj = (0..PHYSICAL).map(|k| (fe[k] - own[k]).abs()).sum();
    Some((WitnessRow { name: name.into(), energies_mj: own, apart_mj, named }, fe))
}

fn sentences(w: &Witness, d: &Diagnosis) -> Vec<String> {
    let Some(top) = w.heights.last() else { return Vec::new() };
    let at = short(top.actuator_kpa);
    let sd = top.fe_sd_mm.map_or(String::new(), |sd| format!(" ± {sd:.1}"));
    let runs = match w.runs {
        1 => "one run".to_string(),
        runs => format!("{runs} runs"),
    };
    let mut out = vec![format!(
        "Outermost marker at {at} kPa: data {:.1} mm; model with calibrated B {:.1}, final model {:.1}, finite elements {:.1}{sd} mm ({runs}, {} mm elements, numbers {}).",
        top.measured_mm,
        top.base_mm,
        top.best_mm,
        top.fe_mm,
        short(w.mesh_mm),
        w.known
    )];
    out.push(meeting(w));
    if let (Some(fe), [base, others @ ..]) = (w.fe_mj, &w.models[..]) {
        out.extend(stiffness(base, &fe).filter(|_| !d.is_quiet()));
        out.push(nearest(base, others, &fe, d));
    } else {
        out.push(
            "No ledgers: they take readings at two pressures that bend the robot, and a model that can bend as far."
                .into(),
        );
    }
    out
}

/// Whether they are where the robot is, and what follows for the effect that is missing.
fn meeting(w: &Witness) -> String {
    let (met, missed): (Vec<&Height>, Vec<&Height>) = w.heights.iter().partition(|h| h.meets);
    let kpa = |of: &[&Height]| list(of.iter().map(|h| short(h.actuator_kpa)));
    let contain = "They contain sealed edges, folds, contact, stretch and shear of the fabric, but no supply, no camera and no memory.";
    let first = match (&met[..], &missed[..]) {
        ([_], []) => "They meet the measurement at the one shared pressure, which decides little.".into(),
        (_, []) => "They meet the measurement at every shared pressure: the missing effect can be one that they contain.".into(),
        ([], _) => "They miss it everywhere: the robot is not the one they were given, one of their assumed numbers is wrong (`ibr simulate ROBOT --uncertain`), or they lack the missing effect too.".into(),
        _ => format!(
            "They meet the measurement at {} kPa and miss it at {} kPa: they lack something too, or one of their assumed numbers is wrong (`ibr simulate ROBOT --uncertain`).",
            kpa(&met),
            kpa(&missed)
        ),
    };
    format!("{first} {contain}")
}

/// A calibrated B that holds far more energy than the wall.
fn stiffness(base: &WitnessRow, fe: &Energies) -> Option<String> {
    let (own, theirs) = (base.energies_mj[BENDING], fe[BENDING]);
    (own > 2.0 * theirs.max(0.0) && own > 0.1 * fe[GAS].abs()).then(|| {
        format!("On the way there the calibrated B stores {own:.0} mJ in the wall, theirs {theirs:.0} mJ: in a robot like theirs this B includes something that is not bending.")
    })
}

fn nearest(base: &WitnessRow, others: &[WitnessRow], fe: &Energies, d: &Diagnosis) -> String {
    let off = |m: &WitnessRow, k: usize| (fe[k] - m.energies_mj[k]).abs();
    let widest = largest(0..PHYSICAL, |k| off(base, *k)).unwrap_or(GAS);
    let where_ = format!("{} ({:.0} mJ, theirs {:.0} mJ)", TERMS[widest], base.energies_mj[widest], fe[widest]);
    match others.first().filter(|m| policy::falls(m.apart_mj, base.apart_mj)) {
        Some(m) => {
            let named = d.indistinguishable.iter().chain(d.added.iter().map(|a| &a.effect));
            let named = named.map(|n| format!("+ {n}")).any(|n| n == m.name);
            let by = if named { "which the data name too" } else { "which the data alone do not put first" };
            let rivals = others[1..].iter().filter(|o| !policy::falls(m.apart_mj, o.apart_mj));
            let rivals = list(rivals.map(|o| o.name.trim_start_matches("+ ")));
            let rivals = if rivals.is_empty() { String::new() } else { format!("; {rivals} hardly less so") };
            format!(
                "Their ledger points at {}, {by}: at the same bends {:.0} mJ apart from theirs instead of {:.0}{rivals}. The model without it differs most in {where_}.",
                m.name.trim_start_matches("+ "),
                m.apart_mj,
                base.apart_mj
            )
        }
        None => format!(
            "No candidate spends the work of the gas much more like them than the model itself ({:.0} mJ apart); it differs most in {where_}.",
            base.apart_mj
        ),
    }
}
