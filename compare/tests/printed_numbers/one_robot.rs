//! One robot that a tail holds back: every number that its diagnosis prints.

use crate::reference::{Fit, Reference, f_tail};
use crate::robots::{BENDING, curvature, holds, scattered, scenario, text};
use crate::{diagnosed, only, ranked, same, same_interval};
use compare::diagnosis::{Confidence, Diagnosis, Options, ParameterValue, Ranked, Verdict};
use compare::extension::error_steps;
use compare::{Evidence, ScenarioFile, extend, ladder};
use data::Dataset;
use models::Scenario;
use nalgebra::{DMatrix, SymmetricEigen};
use statrs::distribution::{ContinuousCDF, Normal};
use std::sync::OnceLock;

/// Bounds of the search for B, and for the moment of a tail \[N·m², N·m\].
const BENDING_BOUNDS: [f64; 2] = [0.0, 200.0];
const TAIL_BOUNDS: [f64; 2] = [-0.3, 1.5];

fn ends(p: &ParameterValue) -> [f64; 2] {
    [p.lo.unwrap(), p.hi.unwrap()]
}

/// A robot that a tail holds back, seen in five runs. Body pressures alternate by 1 Pa: no two holds are then one branch, from which
/// the program would take ∂f/∂ln p in place of the model's.
struct Tail {
    base: Scenario,
    data: Dataset,
    found: Diagnosis,
}

const TRIED: [&str; 3] = ["tail_tension", "camera_scale", "creep"];

fn tail() -> &'static Tail {
    static MADE: OnceLock<Tail> = OnceLock::new();
    MADE.get_or_init(|| {
        let base = scenario();
        let holds = holds(&[[2000.0, 0.0], [2001.0, 10e3], [2000.0, 16e3], [2001.0, 22e3], [2000.0, 28e3]], 2);
        let truth = base.with_bending(1.35).with_effect("tail_tension", &[0.3]);
        let data = scattered(&truth, "tail", &holds, 5, 1);
        let found = diagnosed(&base, &[(&data, None)], &Options { missing_moment: true, ..only(&TRIED) });
        Tail { base, data, found }
    })
}

fn reference(t: &Tail) -> Reference<'_> {
    Reference::of(&t.base, &[&t.data], &[2000.0])
}

/// The effects with one parameter, at its bounds.
const ONE_PARAMETER: [(&str, [f64; 2]); 2] = [("tail_tension", TAIL_BOUNDS), ("camera_scale", [-0.2, 0.2])];

#[test]
fn values_gains_and_errors_are_those_of_generalised_least_squares() {
    let (t, r) = (tail(), reference(tail()));
    let (d, base) = (&t.found, r.base());
    same("B of the base", d.base.bending[0].value_nm2, base.at[0], 1e-5);
    same("error of the base", d.base.systematic_mm, r.error_mm(&[], &base.at), 1e-3);
    same("error as given", d.base.systematic_nominal_mm, r.error_mm(&[], &[BENDING]), 1e-3);
    for (name, _) in ONE_PARAMETER {
        let (printed, fit) = (ranked(d, name), r.with(&[name]));
        same(name, printed.value, fit.at[1], 1e-3);
        same("its B", printed.bending_nm2[0], fit.at[0], 1e-4);
        same("its gain", printed.gain, base.cost() - fit.cost(), 1e-3);
        same("its error", printed.systematic_after_mm, r.error_mm(&[name], &fit.at), 1e-3);
    }
    assert_eq!((d.verdict, d.added.len()), (Some(Verdict::Effect), 1), "{:?}", d.summary);
    let answer = r.with(&["tail_tension"]);
    same("error of the answer", d.base.systematic_with_added_mm, r.error_mm(&["tail_tension"], &answer.at), 1e-3);
    same("B of the answer", d.base.bending_with_added_nm2[0], answer.at[0], 1e-4);
    assert_eq!(d.confidence, Some(Confidence::Hint), "a gain below 25");
}

/// Of one number there is one interval, wherever it is printed: in the ranking, in the answer, in the scenario that is written.
#[test]
fn intervals_count_what_the_other_numbers_may_be_and_are_the_same_everywhere() {
    let (t, r) = (tail(), reference(tail()));
    let (d, base) = (&t.found, r.base());
    let of_base = &d.base.bending[0];
    let printed = [of_base.lo.unwrap(), of_base.hi.unwrap()];
    same_interval("B of the base", printed, r.interval(&[], &base, 0, BENDING_BOUNDS), 5e-3);
    for (name, bounds) in ONE_PARAMETER {
        let fit = r.with(&[name]);
        let derived = r.interval(&[name], &fit, 1, bounds);
        let printed = ranked(d, name);
        same_interval(name, [printed.lo.unwrap(), printed.hi.unwrap()], derived, 2e-3);
        same_interval("as a parameter", ends(&printed.parameters[0]), derived, 2e-3);
        for added in d.added.iter().filter(|added| added.effect == name) {
            same_interval("as an answer", ends(&added.parameters[0]), derived, 2e-3);
            let file = extend(&ScenarioFile::parse("tail", &text()).unwrap(), d).unwrap().file;
            let words = file.text.split("interval = \"moment_nm ").nth(1).unwrap();
            let numbers: Vec<f64> = words.split([' ', '(']).filter_map(|word| word.parse().ok()).take(2).collect();
            same_interval("as it is written", [numbers[0], numbers[1]], derived, 1e-2);
        }
    }
}

#[test]
fn errors_at_what_was_left_out_are_those_of_fits_that_have_not_seen_it() {
    let (t, r) = (tail(), reference(tail()));
    let check = |what: &str, effects: &[&str], fit: &Fit, printed: [Option<f64>; 2]| {
        same(&format!("{what}, pressures"), printed[0].unwrap(), r.left_out_pressure_mm(effects, fit), 5e-3);
        same(&format!("{what}, runs"), printed[1].unwrap(), r.left_out_run_mm(effects, fit), 5e-3);
    };
    let base = &t.found.base;
    check("base", &[], &r.base(), [base.heldout_mm, base.heldout_run_mm]);
    for (name, _) in ONE_PARAMETER {
        let (fit, row) = (r.with(&[name]), ranked(&t.found, name));
        check(name, &[name], &fit, [row.heldout_mm, row.heldout_run_mm]);
        if name == "tail_tension" {
            check("answer", &[name], &fit, [base.heldout_with_added_mm, base.heldout_run_with_added_mm]);
        }
    }
}

/// `C = G/A − q ln(n/A) − odd` with `A = 1 + 0.05 G₁/6`, from the printed gains and values alone.
#[test]
fn the_order_counts_a_price_for_every_parameter_and_the_size_of_every_value() {
    let (d, values) = (&tail().found, tail().data.values_per_run() as f64);
    let best_gain = d.ranked.iter().filter(|r| !r.at_bound).map(|r| r.gain).fold(0.0, f64::max);
    let allowance = 1.0 + 0.05 * best_gain / 6.0;
    let criterion = |row: &Ranked| {
        let own = models::effects::by_name(&row.effect).unwrap().parameters;
        let price = own.len() as f64 * (values / allowance).ln();
        let odd = match own {
            [p] => {
                let (size, usual) = (row.value - p.neutral, p.typical_for("epam") - p.neutral);
                let reach = [p.neutral - p.lower, p.upper - p.neutral].map(|reach| 2.0 * reach.ln());
                let against = if size * usual < 0.0 { (reach[1] - reach[0]) * usual.signum() } else { 0.0 };
                ((size / usual).abs().clamp(1e-3, 1e3).ln() / 3_f64.ln()).powi(2) + against.max(0.0)
            }
            _ => 0.0,
        };
        price + odd - row.gain / allowance
    };
    let first = criterion(ranked(d, &d.indistinguishable[0]));
    assert!(d.ranked.iter().any(|row| row.effect == "creep" && row.parameters.len() == 2));
    for row in &d.ranked {
        let derived = criterion(row) - first;
        assert!((row.bic_difference - derived).abs() < 1e-6, "{}: {} {derived}", row.effect, row.bic_difference);
        assert_eq!(row.in_set, derived < 6.0, "{}", row.effect);
    }
}

/// Independent tests among the effects, `(Σ√λ)²/Σλ` over the eigenvalues of the correlations of their traces.
fn tests(r: &Reference) -> f64 {
    // A first bit of each effect, a fiftieth of its usual size.
    let bits: [(&str, &[f64]); 3] = [("tail_tension", &[9e-3]), ("camera_scale", &[5e-4]), ("creep", &[5e-3, 2.0])];
    let traces = bits.map(|(name, values)| r.trace(&[name], values).normalize());
    let alike = SymmetricEigen::new(DMatrix::from_fn(3, 3, |i, j| traces[i].dot(&traces[j])));
    alike.eigenvalues.iter().map(|l| l.max(0.0).sqrt()).sum::<f64>().powi(2) / 3.0
}

#[test]
fn chances_count_fitted_parameters_and_every_effect_that_was_tried() {
    let (t, r) = (tail(), reference(tail()));
    let (d, base) = (&t.found, r.base());
    for row in &d.ranked {
        let q = row.parameters.len();
        let derived = (tests(&r) * f_tail(row.gain / q as f64, q, r.noise[0].dof)).min(1.0);
        same(&format!("p of {}", row.effect), row.p_corrected.unwrap(), derived, 1e-2);
    }
    let (values, width) = (t.data.values_per_run(), 2 * t.data.markers.len());
    let answer = r.with(&["tail_tension"]);
    for (lack, effects, fit) in
        [(d.lack_of_fit_before, &[][..], &base), (d.lack_of_fit_after, &["tail_tension"], &answer)]
    {
        let (lack, fitted) = (lack.unwrap(), fit.at.len());
        let all = f_tail(fit.cost() / (values - fitted) as f64, values - fitted, r.noise[0].dof);
        same("p of all values", lack.all, all, 1e-3);
        let of_holds = r.lack_of_means(effects, &fit.at, |i| i / width / 2 * width + i % width, values / 2 - fitted);
        same("p of hold means", lack.hold_means, of_holds, 2e-3);
        same("p of marker means", lack.marker_means, r.lack_of_means(effects, &fit.at, |i| i % width, width), 2e-3);
        let least = [lack.all, lack.hold_means, lack.drift, lack.marker_means].into_iter().fold(1.0, f64::min);
        same("p of four tests", lack.p_value, (4.0 * least).min(1.0), 1e-9);
    }
    let least = d.ranked.iter().filter(|row| row.in_set).filter_map(|row| row.p_corrected).fold(1.0, f64::min);
    same("p of the verdict", d.p_value.unwrap(), (least / 0.8).min(d.lack_of_fit_before.unwrap().p_value / 0.2), 1e-9);
}

/// What the scenario as given misses on a robot with B and a tail is `(B₀ − B) κ − ΔM tanh(κ/k₀)`, with k₀ = 0.05 1/m.
#[test]
fn curves_of_the_missing_moment_are_the_laws_and_their_bands_the_covariance_of_the_fit() {
    let (t, r) = (tail(), reference(tail()));
    let fits = [("stiffness alone", r.base()), ("tail_tension", r.with(&["tail_tension"]))];
    let per_m = |bend_deg: f64| bend_deg.to_radians() / t.base.length_m;
    for (name, fit) in fits {
        let curves = &t.found.missing_moment.as_ref().unwrap().curves;
        let curve = curves.iter().find(|curve| curve.answer == name && !curve.is_unloading).unwrap();
        let robot =
            t.base.with_bending(fit.at[0]).with_effect("tail_tension", &[fit.at.get(1).copied().unwrap_or(0.0)]);
        assert!(curve.points.len() > 10);
        for [p_act_kpa, bend_deg, moment_nm, half_nm] in &curve.points {
            let kappa = per_m(*bend_deg);
            same("bend", kappa, curvature(&robot, 2e3, 1e3 * p_act_kpa), 1e-3);
            let by_number = [-kappa, -(kappa / 0.05).tanh()];
            let law = |i: usize| by_number[i] * (fit.at[i] - if i == 0 { BENDING } else { 0.0 });
            same("moment", *moment_nm, (0..fit.at.len()).map(law).sum(), 2e-3);
            let covariance = fit.covariance();
            let each =
                |i: usize| (0..fit.at.len()).map(|j| by_number[i] * by_number[j] * covariance[(i, j)]).sum::<f64>();
            let variance: f64 = (0..fit.at.len()).map(each).sum();
            same(&format!("band of {name} at {p_act_kpa:.1} kPa"), *half_nm, 1.96 * variance.sqrt(), 0.1);
        }
    }
}

/// One effect is missing: it is added where one may be added, and then noise is left.
#[test]
fn a_climb_adds_as_many_effects_as_it_may() {
    let (t, file) = (tail(), ScenarioFile::parse("tail", &text()).unwrap());
    let evidence = [Evidence::of(t.data.clone(), None)];
    let climbed = |most: usize| ladder(&file, &evidence, &only(&TRIED), most, &mut |_, _| ()).unwrap();
    let climb = climbed(1);
    let added: Vec<&str> = climb.steps.iter().flat_map(|step| &step.added).map(|e| e.effect.as_str()).collect();
    assert_eq!((added, climb.stopped), (vec!["tail_tension"], "noise"));
    let last = climb.rungs.last().unwrap();
    same("B of the last rung", last.bending_nm2, ranked(&t.found, "tail_tension").bending_nm2[0], 1e-4);
    let none = climbed(0);
    assert_eq!((none.steps.len(), none.stopped), (0, "most_effects"));
}

/// The table of an extension: as given, with B fitted, with the effect.
#[test]
fn a_table_of_errors_has_the_errors_of_its_own_rows() {
    let (t, r) = (tail(), reference(tail()));
    let steps = error_steps(&t.found, &t.base);
    let (base, fit) = (r.base(), r.with(&["tail_tension"]));
    same("as given", steps[0].training_mm, r.error_mm(&[], &[BENDING]), 1e-3);
    assert_eq!((steps.len(), steps[0].bending_nm2, steps[0].heldout_pressure_mm), (3, BENDING, None));
    for (step, (effects, fit)) in steps[1..].iter().zip([(&[][..], base), (&["tail_tension"][..], fit)]) {
        same(&step.model, step.training_mm, r.error_mm(effects, &fit.at), 1e-3);
        same("its B", step.bending_nm2, fit.at[0], 1e-4);
        same("pressures", step.heldout_pressure_mm.unwrap(), r.left_out_pressure_mm(effects, &fit), 5e-3);
        same("runs", step.heldout_run_mm.unwrap(), r.left_out_run_mm(effects, &fit), 5e-3);
    }
}

/// An effect of that size is seen with 90 % probability: its trace, B fitted out, is `(z_{1−α/2m} + z_{0.9})²`.
#[test]
fn the_smallest_size_that_is_seen_leaves_the_trace_that_is_needed() {
    let (t, r) = (tail(), reference(tail()));
    let smallest = t.found.undetectable.iter().find(|u| u.effect == "camera_scale").unwrap();
    let z = |p: f64| Normal::new(0.0, 1.0).unwrap().inverse_cdf(p);
    let needed = (z(1.0 - t.found.alpha / (2.0 * tests(&r))) + z(0.9)).powi(2);
    let trace = r.trace(&["camera_scale"], &[smallest.smallest_detectable.unwrap()]).norm_squared();
    same("trace", trace, needed, 0.021);
}
