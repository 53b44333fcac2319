//! Runs from text to result without the program: interrupted and resumed, in memory, several at once, refused with their place.

#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use fem::FemError;
use fem::session::{FeRun, Job, Settings, Source, simulate, simulate_all};
use std::ops::ControlFlow;
use std::path::Path;

/// A pillow of few elements that is hardly filled.
fn small() -> Source {
    let text = fem::case::shipped_case("pillow").unwrap();
    let text = text.replace("elements = 32 ", "elements = 8 ").replace("end_s = 0.15", "end_s = 0.01");
    Source::new("pillow", &text.replace("output_every_s = 0.005", "output_every_s = 0.002"))
}

fn into(folder: &Path) -> Settings {
    Settings { folder: Some(folder.into()), resume: true, threads: 1, ..Settings::default() }
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
    let run = simulate(&small(), &Settings::default(), &mut go_on).unwrap();
    let names: Vec<&str> = run.files.iter().map(|(name, _)| name.as_str()).collect();
    assert!(names == ["summary.json", "picture.png"] && run.folder.is_none() && run.frames().is_empty());
    // Steps are not shortened to meet a moment.
    let summary = &run.summary;
    assert!((summary.time_s - 0.01).abs() <= summary.dt_s && summary.kinetic_share.outputs == 1);
}

#[test]
fn the_same_problem_is_run_once_and_found_again() {
    let folder = tempfile::tempdir().unwrap();
    let job = |what: &str| Job { source: small(), what: what.into(), folder: None };
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
    let refused = simulate(&Source::new("my.toml", &text), &Settings::default(), &mut go_on).unwrap_err();
    assert!(refused.to_string().starts_with(&format!("my.toml:{line}: ")), "{refused}");
    assert!(refused.help().unwrap().contains("elements"), "{:?}", refused.help());
}
