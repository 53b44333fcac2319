//! Robots with two bodies, with two effects, with separate tests, with a gauge; and one that changes within a hold.

use crate::reference::Reference;
use crate::robots;
use crate::robots::{BENDING, about, curvature, exact, holds, missing_moment, positions, scattered, scenario, text};
use crate::{diagnosed, only, ranked, same};
use compare::diagnosis::Options;
use compare::extension::{EffectWish, add};
use compare::{Evidence, ScenarioFile, extend};
use data::{Dataset, Hold};
use models::Scenario;

/// A robot that stiffens within every hold: a hold misses the mean over its samples, and a change is the difference to the
/// first of them. B as given is what both are relative to, not the fitted one.
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
        if point.is_change {
            continue;
        }
        // As far as the bend may be another one, the moment may be.
        let at = |robot: &Scenario, by: f64| {
            let Hold { p_body_pa, p_act_pa, .. } = holds[point.hold - 1];
            missing_moment(&base, p_body_pa, p_act_pa, curvature(robot, p_body_pa, p_act_pa) + by)
        };
        let slope = robots.iter().map(|robot| (at(robot, 1e-3) - at(robot, -1e-3)) / 2e-3 / 3.0).sum::<f64>();
        let bend_sd = point.bend_sd_deg.to_radians() / base.length_m;
        same(&format!("{point:?}, scatter"), point.moment_sd_nm, slope.abs() * bend_sd, 1e-2);
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
    let data = Dataset {
        coordinates_m: soft.coordinates_m.iter().zip(&stiff.coordinates_m).enumerate().map(pick).collect(),
        ..soft.clone()
    };
    let r = Reference::of(&file, &[&data], &[2e3, 4e3]);
    let (base, fit) = (r.base(), r.with(&["camera_scale"]));
    let (options, evidence) = (only(&["tail_tension", "camera_scale"]), [Evidence::of(data.clone(), None)]);
    let wish = EffectWish::Fitted("camera_scale".into());
    let extension = add(&file, &wish, &evidence, &options, &mut |_, _| ()).unwrap();
    let d = diagnosed(&file, &[(&data, None)], &options);
    assert_ne!(d.ranked[0].effect, "camera_scale");
    for (level, printed) in d.base.bending.iter().enumerate() {
        same("B of the base", printed.value_nm2, base.at[level], 1e-4);
    }
    let step = extension.steps.last().unwrap();
    same("B in the table of errors", step.bending_nm2, fit.at[1], 1e-3);
    same("error in that table", step.training_mm, r.error_mm(&["camera_scale"], &fit.at), 1e-3);
    same("B that is written", extension.file.bending_stiffness, fit.at[1], 1e-3);
    same("B without the effect", extension.additions[0].bending_without_nm2.unwrap(), base.at[1], 1e-3);
    let written = extension.file.effects.iter().find(|e| e.name == "camera_scale").unwrap();
    same("value that is written", written.values[0], fit.at[2], 5e-3);
    same("value that is listed", extension.fitted[0].parameters[0].value, fit.at[2], 5e-3);
}

/// Of two tests of one quantity that contradict each other the first counts, once; so does a bending test.
#[test]
fn separate_tests_count_as_one_value_each() {
    let base = scenario();
    let holds = holds(&[[2000.0, 0.0], [2001.0, 10e3], [2000.0, 19e3], [2001.0, 28e3]], 2);
    let truth = base.with_bending(1.35).with_effect("tail_tension", &[0.3]);
    let elsewhere = robots::holds(&[[2000.0, 0.0], [2001.0, 13e3], [2000.0, 24e3], [2001.0, 33e3]], 2);
    let [one, other] =
        [(&holds, 21), (&elsewhere, 22)].map(|(holds, seed)| scattered(&truth, &seed.to_string(), holds, 4, seed));
    let first =
        about("[bending]\nstiffness_nm2 = 1.2\nsd_nm2 = 0.03\n[measured.tail_tension]\nmoment_nm = [0.2, 0.03]\n");
    let second =
        about("[bending]\nstiffness_nm2 = 1.6\nsd_nm2 = 0.02\n[measured.tail_tension]\nmoment_nm = [0.5, 0.02]\n");
    let d = diagnosed(&base, &[(&one, Some(&first)), (&other, Some(&second))], &only(&["tail_tension"]));
    let r = Reference::with_tests(&base, &[&one, &other], &[2000.0], [Some([1.2, 0.03]), Some([0.2, 0.03])]);
    let fit = r.with(&["tail_tension"]);
    same("B of the base", d.base.bending[0].value_nm2, r.base().at[0], 1e-4);
    let row = ranked(&d, "tail_tension");
    same("moment", row.value, fit.at[1], 2e-3);
    same("its B", row.bending_nm2[0], fit.at[0], 1e-3);
    // The base has no such effect and pays for the value that the test found.
    let base = r.base();
    same("gain", row.gain, base.cost() + (0.2_f64 / 0.03).powi(2) - fit.cost(), 1e-3);
    for (printed, (effects, at)) in
        [(d.base.systematic_mm, (&[][..], &base.at)), (row.systematic_after_mm, (&["tail_tension"][..], &fit.at))]
    {
        same("error in the first data", printed, r.error_in_mm(0, effects, at), 5e-3);
    }
    same("pressures left out", row.heldout_mm.unwrap(), r.left_out_pressure_mm(&["tail_tension"], &fit), 1e-2);
    same("runs left out", row.heldout_run_mm.unwrap(), r.left_out_run_mm(&["tail_tension"], &fit), 1e-2);
    let lack = d.lack_of_fit_before.unwrap();
    let least = [lack.all, lack.hold_means, lack.drift, lack.marker_means].into_iter().fold(1.0, f64::min);
    same("p of two data", lack.p_value, (2.0 * 4.0 * least).min(1.0), 1e-9);
    assert!(lack.p_value < 0.9, "{lack:?}");
    let beside = &d.beside[0];
    same("error in the second data", beside.systematic_mm, r.error_in_mm(1, &[], &base.at), 5e-3);
    same("with the effect", beside.systematic_with_added_mm, r.error_in_mm(1, &["tail_tension"], &fit.at), 5e-3);
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

/// Two effects are missing that do not take each other's place.
#[test]
fn two_effects_have_the_values_of_one_fit_and_each_its_own() {
    let base = scenario();
    let holds = holds(&[[2000.0, 0.0], [2001.0, 10e3], [2000.0, 16e3], [2001.0, 22e3], [2000.0, 28e3]], 2);
    let truth = base.with_bending(1.35).with_effect("tail_tension", &[0.5]).with_effect("camera_scale", &[0.01]);
    let data = scattered(&truth, "two", &holds, 5, 31);
    let options = Options { pairs: true, ..only(&["tail_tension", "camera_scale"]) };
    let d = diagnosed(&base, &[(&data, None)], &options);
    let r = Reference::of(&base, &[&data], &[2000.0]);
    let names = ["camera_scale", "tail_tension"];
    let fit = r.with(&names);
    assert_eq!(d.added.iter().map(|added| added.effect.as_str()).collect::<Vec<_>>(), names);
    for (k, added) in d.added.iter().enumerate() {
        same(&added.effect, added.parameters[0].value, fit.at[1 + k], 1e-3);
        same("in the pair", d.pairs[0].parameters[k].value, fit.at[1 + k], 1e-3);
    }
    same("gain", d.pairs[0].gain, r.base().cost() - fit.cost(), 1e-4);
    same(
        "error at pressures left out",
        d.base.heldout_with_added_mm.unwrap(),
        r.left_out_pressure_mm(&names, &fit),
        5e-3,
    );
    let extension = extend(&ScenarioFile::parse("two", &text()).unwrap(), &d).unwrap();
    same("B that is written", extension.file.bending_stiffness, fit.at[0], 1e-4);
    for (k, name) in names.iter().enumerate() {
        let written = extension.file.effects.iter().find(|e| e.name == *name).unwrap();
        same(name, written.values[0], fit.at[1 + k], 1e-3);
    }
}

/// The formula that was learned, fitted to the markers as an effect of the scenario.
#[test]
fn a_learned_law_has_the_numbers_and_errors_of_its_own_fit() {
    let base = scenario();
    let holds = holds(&[[2000.0, 0.0], [2001.0, 10e3], [2000.0, 16e3], [2001.0, 22e3], [2000.0, 28e3]], 2);
    let data = scattered(&base.with_bending(1.35).with_effect("tail_tension", &[0.6]), "learns", &holds, 5, 1);
    let d = diagnosed(&base, &[(&data, None)], &Options { learn: true, ..only(&["camera_scale"]) });
    let law = d.learned.as_ref().unwrap();
    assert_eq!((law.parameters.len(), law.line.is_none()), (1, true), "{law:?}");
    let with_law = Scenario::parse(&format!("{}\n{}", text(), law.toml)).unwrap();
    let r = Reference::of(&with_law, &[&data], &[2000.0]);
    let (without, fit) = (r.base(), r.with(&["learned"]));
    same("number", law.parameters[0].value, fit.at[1], 1e-3);
    same("B", law.bending_nm2[0], fit.at[0], 1e-3);
    for (when, effects, fit, [training, pressures]) in [
        ("before", &[][..], &without, [Some(law.before_mm), law.heldout_before_mm]),
        ("after", &["learned"], &fit, [Some(law.after_mm), law.heldout_after_mm]),
    ] {
        same(when, training.unwrap(), r.error_mm(effects, &fit.at), 5e-3);
        same(&format!("{when}, pressures"), pressures.unwrap(), r.left_out_pressure_mm(effects, fit), 1e-2);
    }
    same("after, runs", law.heldout_run_after_mm.unwrap(), r.left_out_run_mm(&["learned"], &fit), 1e-2);
    let extension = extend(&ScenarioFile::parse("learns", &text()).unwrap(), &d).unwrap();
    same("B that is written", extension.file.bending_stiffness, fit.at[0], 1e-3);
    let written = extension.file.effects.iter().find(|e| e.name == "learned").unwrap();
    same("number that is written", written.values[0], fit.at[1], 1e-3);
    same("B in the table", extension.steps.last().unwrap().bending_nm2, fit.at[0], 1e-3);
    same("error in the table", extension.steps.last().unwrap().training_mm, law.after_mm, 1e-9);
}
