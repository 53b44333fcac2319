//! Runs from text to result without the program: interrupted and resumed, in memory, several at once, refused with their place.

#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use fem::FemError;
use fem::session::{FeRun, RunJob, RunSettings, RunSource, simulate, simulate_all};
use std::ops::ControlFlow;
use std::path::Path;

/// A pillow of few elements that is hardly filled.
fn small() -> RunSource {
    let text = fem::case::shipped_case("pillow").unwrap();
    let text = text.replace("elements = 32 ", "elements = 8 ").replace("end_s = 0.15", "end_s = 0.01");
    RunSource::new("pillow", &text.replace("output_every_s = 0.005", "output_every_s = 0.002"))
}

fn into(folder: &Path) -> RunSettings {
    RunSettings { folder: Some(folder.into()), resume: true, keep_end: true, threads: 1, ..RunSettings::default() }
}

fn go_on(_: &str, _: Option<f64>) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn stop(_: &str, _: Option<f64>) -> ControlFlow<()> {
    ControlFlow::Break(())
}

fn bytes(run: &FeRun, name: &str) -> Vec<u8> {
    std::fs::read(run.folder.as_deref().unwrap().join(name)).unwrap()
}

#[test]
fn a_run_that_its_caller_stops_goes_on_and_ends_with_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let whole = simulate(&small(), &into(&folder.path().join("whole")), &mut go_on).unwrap();
    assert!(whole.fresh && whole.frames().len() > 2 && whole.summary.steps > 10);
    let cut = into(&folder.path().join("cut"));
    let mut reached = 0;
    for _ in 0..3 {
        let stopped = simulate(&small(), &cut, &mut stop).unwrap_err();
        let FemError::Interrupted { step, of: 1, .. } = stopped else { panic!("{stopped}") };
        assert!(step > reached, "{step} after {reached}");
        reached = step;
    }
    let resumed = simulate(&small(), &cut, &mut go_on).unwrap();
    assert!(resumed.summary == whole.summary && resumed.cost.resumed_at_step == reached);
    for name in ["summary.json", "history.csv", "run.pvd", "picture.png"] {
        assert!(bytes(&resumed, name) == bytes(&whole, name), "{name}");
    }
    let again = simulate(&small(), &cut, &mut go_on).unwrap();
    assert!(!again.fresh && again.summary == whole.summary);
}

#[test]
fn without_a_folder_the_files_of_the_end_are_in_memory() {
    let run = simulate(&small(), &RunSettings::default(), &mut go_on).unwrap();
    let names: Vec<&str> = run.files.iter().map(|(name, _)| name.as_str()).collect();
    assert!(names == ["summary.json", "picture.png"] && run.folder.is_none() && run.frames().is_empty());
    // Steps are not shortened to meet a moment.
    let summary = &run.summary;
    assert!((summary.time_s - 0.01).abs() <= summary.dt_s && summary.kinetic_share.outputs == 1);
}

#[test]
fn the_same_problem_is_run_once_and_found_again() {
    let folder = tempfile::tempdir().unwrap();
    let job = |what: &str| RunJob { source: small(), what: what.into(), folder: None };
    let jobs = [job("first"), job("second")];
    let made = simulate_all(&jobs, &into(folder.path()), &mut go_on).unwrap();
    assert!(made.of == [0, 0] && made.runs[0].as_ref().unwrap().fresh);
    let found = simulate_all(&jobs, &into(folder.path()), &mut stop).unwrap();
    let (made, found) = (made.runs[0].as_ref().unwrap(), found.runs[0].as_ref().unwrap());
    assert!(found.summary == made.summary && !found.fresh);
}

#[test]
fn an_error_says_file_line_and_what_to_type() {
    let text = small().text.replace("elements = 8 ", "element = 8 ");
    let line = text.lines().position(|line| line.contains("element = 8")).unwrap() + 1;
    let refused = simulate(&RunSource::new("my.toml", &text), &RunSettings::default(), &mut go_on).unwrap_err();
    assert!(refused.to_string().starts_with(&format!("my.toml:{line}: ")), "{refused}");
    assert!(refused.help().unwrap().contains("elements"), "{:?}", refused.help());
}

fn from(earlier: &Path, folder: &Path) -> RunSettings {
    RunSettings { from: Some(earlier.into()), ..into(folder) }
}

#[test]
fn a_complete_run_goes_on_to_a_later_end_as_if_it_had_been_asked_for_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let whole = simulate(&small(), &into(&folder.path().join("whole")), &mut go_on).unwrap();
    let until = |end_s: f64| RunSettings { end_s: Some(end_s), ..into(&folder.path().join("longer")) };
    assert!(simulate(&small(), &until(0.008), &mut go_on).unwrap().fresh);
    assert!(!simulate(&small(), &until(0.008), &mut go_on).unwrap().fresh);
    let back = simulate(&small(), &until(0.007), &mut go_on).unwrap_err();
    assert!(back.to_string().contains("after --end 0.007 s"), "{back}");
    // It is an unfinished run until it is complete again.
    assert!(matches!(simulate(&small(), &until(0.01), &mut stop).unwrap_err(), FemError::Interrupted { .. }));
    let longer = simulate(&small(), &until(0.01), &mut go_on).unwrap();
    assert!(longer.fresh && longer.summary == whole.summary, "{:?}", longer.summary);
    for name in ["summary.json", "history.csv", "run.pvd", "picture.png", "checkpoint.end"] {
        assert!(bytes(&longer, name) == bytes(&whole, name), "{name}");
    }
}

#[test]
fn a_run_that_goes_on_from_another_keeps_time_shape_and_books() {
    let folder = tempfile::tempdir().unwrap();
    let place = |name: &str| folder.path().join(name);
    let energy = |run: &FeRun, name: &str| run.summary.ledger.iter().find(|r| r.name == name).map(|r| r.energy_j);
    let longer = RunSource { text: small().text.replace("end_s = 0.01", "end_s = 0.02"), ..small() };
    let heavy = "[gravity]\ng_m_s2 = [0, 0, -90]\nlinear_s = [[0.01, 0], [0.012, 1]]\n[output]";
    let heavy = RunSource { text: longer.text.replace("[output]", heavy), ..small() };
    simulate(&small(), &into(&place("first")), &mut go_on).unwrap();
    let straight = simulate(&longer, &into(&place("straight")), &mut go_on).unwrap();
    let same = simulate(&longer, &from(&place("first"), &place("same")), &mut go_on).unwrap();
    let volume = |run: &FeRun| run.summary.chambers[0].volume_cm3;
    assert!((volume(&same) / volume(&straight) - 1.0).abs() < 1e-3, "{} {}", volume(&same), volume(&straight));
    assert!((same.summary.began_s - 0.01).abs() < same.summary.dt_s && same.notices.is_empty(), "{:?}", same.notices);
    let rows = String::from_utf8(bytes(&same, "history.csv")).unwrap();
    assert_eq!(rows.lines().count(), 1 + 6, "one row at the start and one every 2 ms: {rows}");
    // Weight that only the second run has works on it alone, and the third keeps that work when the weight is gone.
    let pulled = simulate(&heavy, &from(&place("first"), &place("heavy")), &mut go_on).unwrap();
    assert!(pulled.summary.residual_share < 1e-3 && pulled.notices.is_empty(), "{:?}", pulled.notices);
    let last = RunSource { text: longer.text.replace("end_s = 0.02", "end_s = 0.022\nguard_hourglass = 1"), ..small() };
    let light = simulate(&last, &from(&place("heavy"), &place("light")), &mut go_on).unwrap();
    assert!(light.notices[0].contains("gravity [m/s²] jumps from -90"), "{:?}", light.notices);
    assert_eq!(energy(&light, "earlier loads"), energy(&pulled, "gravity"));
    assert!(light.summary.residual_share < 1e-3, "{}", light.summary.residual_share);
    let work = |run: &FeRun| energy(run, "gravity").unwrap();
    assert!(work(&pulled).abs() > 1e-3 * pulled.summary.external_work_j.abs(), "{}", work(&pulled));
}

#[test]
fn a_run_of_another_structure_or_an_earlier_end_cannot_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let first = folder.path().join("first");
    simulate(&small(), &into(&first), &mut go_on).unwrap();
    let thin = RunSource { text: small().text.replace("thickness_mm = 0.6", "thickness_mm = 0.5"), ..small() };
    for (source, words) in [(thin, "its mesh, fabrics"), (small(), "cannot end at 0.01 s")] {
        let refused = simulate(&source, &from(&first, &folder.path().join("second")), &mut go_on).unwrap_err();
        assert!(refused.to_string().contains(words) && refused.help().is_some(), "{refused}");
    }
    let nothing = simulate(&small(), &from(folder.path(), &folder.path().join("second")), &mut go_on).unwrap_err();
    assert!(nothing.to_string().contains("no complete run"), "{nothing}");
}
