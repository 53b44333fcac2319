//! Printed numbers of made-up robots.

mod reference;
mod robots;

use compare::diagnosis::{Diagnosis, Options, PRESSURES_ARE_RIGHT, ParameterValue, Ranked, Verdict};
use compare::extension::{Wish, add};
use compare::{Evidence, ScenarioFile, diagnose, extend, ladder};
use data::{About, Dataset};
use models::Scenario;
use nalgebra::{DMatrix, SymmetricEigen};
use reference::{Fit, Reference, f_tail};
use robots::{BENDING, about, curvature, exact, holds, measured, positions, scenario, text};
use std::sync::OnceLock;

/// Bounds of the search for B, and for the moment of a tail \[N·m², N·m\].
const BENDING_BOUNDS: [f64; 2] = [0.0, 200.0];
const TAIL_BOUNDS: [f64; 2] = [-0.3, 1.5];

/// A diagnosis that tries these effects alone.
fn only(tried: &[&str]) -> Options {
    let others = models::effects::EFFECTS.iter().map(|e| e.name).filter(|name| !tried.contains(name));
    Options {
        not: others.chain([PRESSURES_ARE_RIGHT]).map(String::from).collect(),
        tolerance_m: Some(0.0),
        pairs: false,
        next_experiment: false,
        missing_moment: false,
        ..Options::default()
    }
}

fn diagnosed(base: &Scenario, data: &[(&Dataset, Option<&About>)], options: &Options) -> Diagnosis {
    let evidence: Vec<Evidence> = data.iter().map(|(d, about)| Evidence::of((*d).clone(), about.cloned())).collect();
    diagnose(base, &evidence, options, &mut |_, _| ()).unwrap()
}

fn ranked<'d>(d: &'d Diagnosis, name: &str) -> &'d Ranked {
    d.ranked.iter().find(|r| r.effect == name).unwrap()
}

/// Asserts that a printed number is the one derived here, to a share of it.
fn same(what: &str, printed: f64, derived: f64, share: f64) {
    assert!((printed - derived).abs() <= share * derived.abs(), "{what}: {printed} is printed and {derived} derived");
}

fn ends(p: &ParameterValue) -> [f64; 2] {
    [p.lo.unwrap(), p.hi.unwrap()]
}

/// Asserts that both ends of an interval are those derived here, to a share of its width.
fn same_interval(what: &str, printed: [f64; 2], derived: [f64; 2], share: f64) {
    let away = (0..2).map(|end| (printed[end] - derived[end]).abs()).fold(0.0, f64::max);
    assert!(away <= share * (derived[1] - derived[0]), "{what}: {printed:?} is printed and {derived:?} derived");
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

fn scattered(truth: &Scenario, name: &str, holds: &[data::Hold], runs: usize, seed: u64) -> Dataset {
    let at = |factor: f64| positions(truth, holds, factor);
    let slope: Vec<f64> = at(1.0 + 1e-4).iter().zip(at(1.0 - 1e-4)).map(|(high, low)| (high - low) / 2e-4).collect();
    measured(name, holds, (&at(1.0), &slope), runs, seed)
}

fn reference(t: &Tail) -> Reference<'_> {
    Reference::of(&t.base, &[&t.data], &[2000.0], None)
}

/// The effects with one parameter, at its bounds.
const ONE_PARAMETER: [(&str, [f64; 2]); 2] = [("tail_tension", TAIL_BOUNDS), ("camera_scale", [-0.2, 0.2])];

#[test]
fn values_gains_and_errors_are_those_of_generalised_least_squares() {
    let (t, r) = (tail(), reference(tail()));
    let (d, base) = (&t.found, r.base());
    same("B of the base", d.base.bending[0].value_nm2, base.at[0], 1e-5);
    same("error of the base", d.base.systematic_mm, r.error_mm(None, &base.at), 1e-3);
    same("error as given", d.base.systematic_nominal_mm, r.error_mm(None, &[BENDING]), 1e-3);
    for (name, _) in ONE_PARAMETER {
        let (printed, fit) = (ranked(d, name), r.with(name, None));
        same(name, printed.value, fit.at[1], 1e-3);
        same("its B", printed.bending_nm2[0], fit.at[0], 1e-4);
        same("its gain", printed.gain, base.cost() - fit.cost(), 1e-3);
        same("its error", printed.systematic_after_mm, r.error_mm(Some(name), &fit.at), 1e-3);
    }
    assert_eq!((d.verdict, d.added.len()), (Some(Verdict::Effect), 1), "{:?}", d.summary);
    same("error of the answer", d.base.systematic_with_added_mm, ranked(d, "tail_tension").systematic_after_mm, 1e-9);
}

/// Of one number there is one interval, wherever it is printed: in the ranking, in the answer, in the scenario that is written.
#[test]
fn intervals_count_what_the_other_numbers_may_be_and_are_the_same_everywhere() {
    let (t, r) = (tail(), reference(tail()));
    let (d, base) = (&t.found, r.base());
    let of_base = &d.base.bending[0];
    let printed = [of_base.lo.unwrap(), of_base.hi.unwrap()];
    same_interval("B of the base", printed, r.interval(None, &base, 0, BENDING_BOUNDS), 5e-3);
    for (name, bounds) in ONE_PARAMETER {
        let fit = r.with(name, None);
        let derived = r.interval(Some(name), &fit, 1, bounds);
        let printed = ranked(d, name);
        same_interval(name, [printed.lo.unwrap(), printed.hi.unwrap()], derived, 5e-3);
        same_interval("as a parameter", ends(&printed.parameters[0]), derived, 5e-3);
        for added in d.added.iter().filter(|added| added.effect == name) {
            same_interval("as an answer", ends(&added.parameters[0]), derived, 5e-3);
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
    let check = |what: &str, effect: Option<&str>, fit: &Fit, printed: [Option<f64>; 2]| {
        same(&format!("{what}, pressures"), printed[0].unwrap(), r.left_out_pressure_mm(effect, fit), 5e-3);
        same(&format!("{what}, runs"), printed[1].unwrap(), r.left_out_run_mm(effect, fit), 5e-3);
    };
    let base = &t.found.base;
    check("base", None, &r.base(), [base.heldout_mm, base.heldout_run_mm]);
    for (name, _) in ONE_PARAMETER {
        let (fit, row) = (r.with(name, None), ranked(&t.found, name));
        check(name, Some(name), &fit, [row.heldout_mm, row.heldout_run_mm]);
        if name == "tail_tension" {
            check("answer", Some(name), &fit, [base.heldout_with_added_mm, base.heldout_run_with_added_mm]);
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

#[test]
fn chances_count_fitted_parameters_and_every_effect_that_was_tried() {
    let (t, r) = (tail(), reference(tail()));
    let (d, base) = (&t.found, r.base());
    // A first bit of each effect, a fiftieth of its usual size.
    let bits: [(&str, &[f64]); 3] = [("tail_tension", &[9e-3]), ("camera_scale", &[5e-4]), ("creep", &[5e-3, 2.0])];
    let traces = bits.map(|(name, values)| r.trace(name, values).normalize());
    let alike = SymmetricEigen::new(DMatrix::from_fn(3, 3, |i, j| traces[i].dot(&traces[j])));
    let tests = alike.eigenvalues.iter().map(|l| l.max(0.0).sqrt()).sum::<f64>().powi(2) / 3.0;
    assert!(tests > 1.2, "{tests}");
    for row in &d.ranked {
        let q = row.parameters.len();
        let derived = (tests * f_tail(row.gain / q as f64, q, r.noise[0].dof)).min(1.0);
        same(&format!("p of {}", row.effect), row.p_corrected.unwrap(), derived, 1e-2);
    }
    let lack = |fit: &Fit| {
        let dof = t.data.values_per_run() - fit.at.len();
        f_tail(fit.cost() / dof as f64, dof, r.noise[0].dof)
    };
    let [before, after] = [d.lack_of_fit_before, d.lack_of_fit_after].map(|lack| lack.unwrap());
    same("lack of fit of the base", before.all, lack(&base), 1e-3);
    same("lack of fit of the answer", after.all, lack(&r.with("tail_tension", None)), 1e-3);
    let least = d.ranked.iter().filter(|row| row.in_set).filter_map(|row| row.p_corrected).fold(1.0, f64::min);
    same("p of the verdict", d.p_value.unwrap(), (least / 0.8).min(before.p_value / 0.2), 1e-9);
}

/// What the scenario as given misses on a robot with B and a tail is `(B₀ − B) κ − ΔM tanh(κ/k₀)`, with k₀ = 0.05 1/m.
#[test]
fn curves_of_the_missing_moment_are_the_laws_and_their_bands_the_covariance_of_the_fit() {
    let (t, r) = (tail(), reference(tail()));
    let fits = [("stiffness alone", r.base()), ("tail_tension", r.with("tail_tension", None))];
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

/// A robot that stiffens within every hold: what is missing of a hold is the mean over its samples, and a change is what came
/// since the first of them. B as given is what both are relative to, not the fitted one.
#[test]
fn missing_moments_are_means_over_a_hold_and_changes_since_its_first_sample() {
    let base = scenario();
    let holds = holds(&[[2000.0, 10e3], [2001.0, 18e3], [2000.0, 26e3]], 3);
    let robots = [1.3, 1.5, 1.7].map(|bending| base.with_bending(bending));
    let all = robots.clone().map(|robot| positions(&robot, &holds, 1.0));
    let width = 2 * base.markers_m.len();
    let seen: Vec<f64> = (0..all[0].len()).map(|i| all[i / width % 3][i]).collect();
    let options = Options { sigma_m: Some(1e-5), missing_moment: true, ..only(&["tail_tension"]) };
    let d = diagnosed(&base, &[(&exact("stiffens", &holds, &seen), None)], &options);
    let found = d.missing_moment.unwrap();
    assert_eq!(found.bending_nm2, BENDING);
    let missing = |hold: usize| {
        let at = |robot: &Scenario| curvature(robot, holds[hold].p_body_pa, holds[hold].p_act_pa);
        robots.each_ref().map(|robot| (BENDING - robot.bending_stiffness) * at(robot))
    };
    let mut kinds = [0; 2];
    for point in &found.points {
        let [first, second, third] = missing(point.hold - 1);
        let derived = match (point.is_change, point.t_s - holds[point.hold - 1].t_s[0]) {
            (false, _) => (first + second + third) / 3.0,
            (true, since) if since < 1.5 => second - first,
            (true, _) => third - first,
        };
        kinds[usize::from(point.is_change)] += 1;
        same(&format!("{point:?}"), point.moment_nm, derived, 1e-2);
    }
    assert!(kinds[0] >= 3 && kinds[1] == 6, "{kinds:?}");
}

/// B is 1.2 N·m² at 2 kPa and 1.9 at 4, the body pressure of the scenario; the effect that is added is not the best one.
#[test]
fn an_extension_writes_the_fit_of_its_own_effect_and_the_stiffness_of_its_own_body_pressure() {
    let text = text().replace("pressure_kpa = 2 ", "pressure_kpa = 4 ");
    let file = ScenarioFile::parse("two bodies", &text).unwrap();
    assert_eq!(file.p_body_pa, 4e3);
    let pressures = [[2e3, 8e3], [4e3, 12e3], [2e3, 16e3], [4e3, 20e3], [2e3, 24e3], [4e3, 28e3]];
    let holds = holds(&pressures, 2);
    let of = |bending: f64| {
        let truth =
            file.with_bending(bending).with_effect("tail_tension", &[0.3]).with_effect("camera_scale", &[0.002]);
        scattered(&truth, "two bodies", &holds, 5, 11)
    };
    let (soft, stiff) = (of(1.2), of(1.9));
    let width = soft.values_per_run() / holds.len();
    let is_stiff = |i: usize| i / width % 2 == 1;
    let pick = |(i, (a, b)): (usize, (&f64, &f64))| if is_stiff(i) { *b } else { *a };
    let data = Dataset { xy_m: soft.xy_m.iter().zip(&stiff.xy_m).enumerate().map(pick).collect(), ..soft.clone() };
    let r = Reference::of(&file, &[&data], &[2e3, 4e3], None);
    let (base, fit) = (r.base(), r.with("camera_scale", None));
    let (options, evidence) = (only(&["tail_tension", "camera_scale"]), [Evidence::of(data.clone(), None)]);
    let wish = Wish::Fitted("camera_scale".into());
    let extension = add(&file, &wish, &evidence, &options, &mut |_, _| ()).unwrap();
    let d = diagnosed(&file, &[(&data, None)], &options);
    assert_ne!(d.ranked[0].effect, "camera_scale");
    for (level, printed) in d.base.bending.iter().enumerate() {
        same("B of the base", printed.value_nm2, base.at[level], 1e-4);
    }
    let step = extension.steps.last().unwrap();
    same("B in the table of errors", step.bending_nm2, fit.at[1], 1e-3);
    same("error in that table", step.training_mm, r.error_mm(Some("camera_scale"), &fit.at), 1e-3);
    same("B that is written", extension.file.bending_stiffness, fit.at[1], 1e-3);
    same("B without the effect", extension.additions[0].bending_without_nm2.unwrap(), base.at[1], 1e-3);
    let written = extension.file.effects.iter().find(|e| e.name == "camera_scale").unwrap();
    same("value that is written", written.values[0], fit.at[2], 5e-3);
    same("value that is listed", extension.fitted[0].parameters[0].value, fit.at[2], 5e-3);
}

/// Of two tests of one quantity that contradict each other the first counts, once; so does a bending test.
#[test]
fn tests_of_their_own_count_as_one_value_each() {
    let base = scenario();
    let holds = holds(&[[2000.0, 0.0], [2001.0, 10e3], [2000.0, 19e3], [2001.0, 28e3]], 2);
    let truth = base.with_bending(1.35).with_effect("tail_tension", &[0.3]);
    let [one, other] = [21, 22].map(|seed| scattered(&truth, &seed.to_string(), &holds, 4, seed));
    let first =
        about("[bending]\nstiffness_nm2 = 1.2\nsd_nm2 = 0.03\n[measured.tail_tension]\nmoment_nm = [0.2, 0.03]\n");
    let second = about("[measured.tail_tension]\nmoment_nm = [0.5, 0.02]\n");
    let d = diagnosed(&base, &[(&one, Some(&first)), (&other, Some(&second))], &only(&["tail_tension"]));
    let r = Reference::of(&base, &[&one, &other], &[2000.0], Some([1.2, 0.03]));
    let fit = r.with("tail_tension", Some([0.2, 0.03]));
    same("B of the base", d.base.bending[0].value_nm2, r.base().at[0], 1e-4);
    let row = ranked(&d, "tail_tension");
    same("moment", row.value, fit.at[1], 2e-3);
    same("its B", row.bending_nm2[0], fit.at[0], 1e-3);
}

/// Nine tenths of the set pressure arrive, and a gauge at the actuator reads it.
#[test]
fn positions_are_predicted_at_what_a_gauge_read() {
    let base = scenario();
    let holds = holds(&[[2000.0, 0.0], [2001.0, 10e3], [2000.0, 19e3], [2001.0, 28e3]], 2);
    let truth = base.with_bending(1.35);
    let data = exact("gauge", &holds, &positions(&truth, &holds, 0.9));
    let read: Vec<f64> = holds.iter().flat_map(|hold| [0.9 * hold.p_act_pa; 2]).collect();
    let data = Dataset { gauge_pa: Some(read.clone()), ..data };
    let d = diagnosed(
        &base,
        &[(&data, None)],
        &Options { sigma_m: Some(1e-4), ..only(&["tail_tension", "pressure_loss"]) },
    );
    same("B", d.base.bending[0].value_nm2, 1.35, 2e-3);
    let gauge = &d.gauges[0];
    let sets = gauge.set_kpa.iter().zip(&gauge.read_kpa);
    sets.for_each(|(set, read)| same("reading", *read, 0.9 * set, 1e-9));
    let off: f64 = gauge.set_kpa.iter().map(|set| (0.1 * set).powi(2)).sum();
    same("set against read", gauge.before_kpa, (off / gauge.set_kpa.len() as f64).sqrt(), 1e-6);
    same("share that is lost", ranked(&d, "pressure_loss").value, 0.1, 0.05);
}

#[test]
fn what_was_measured_directly_explains_nothing() {
    let base = scenario();
    let holds = holds(&[[2000.0, 0.0], [2001.0, 10e3], [2000.0, 19e3], [2001.0, 28e3]], 2);
    let data = exact("direct", &holds, &positions(&base.with_bending(1.35), &holds, 1.0));
    let options = Options { sigma_m: Some(1e-4), ..only(&["tail_tension", "camera_scale", "pressure_loss"]) };
    let tried = |lines: &str| {
        let d = diagnosed(&base, &[(&data, Some(&about(lines)))], &options);
        let mut names: Vec<String> = d.ranked.iter().map(|row| row.effect.clone()).collect();
        names.sort();
        names
    };
    assert_eq!(tried(""), ["camera_scale", "pressure_loss", "tail_tension"]);
    assert_eq!(tried("[direct]\npressure = true\n"), ["camera_scale", "tail_tension"]);
    assert_eq!(tried("[direct]\npressure = true\nframe = true\n"), ["tail_tension"]);
}

/// One effect is missing: of one that may be added it is, of none it is not, and what is left then is noise.
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
