//! Memory of a run against what is told before it, by the peak of this process, in which nothing else runs.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use fem::session::{RunSettings, RunSource, least_bytes, simulate};
use std::ops::ControlFlow;

/// Largest memory of this process so far \[bytes\].
fn peak() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse::<u64>().unwrap() * 1024
}

/// The most of a robot of many layers: peaks of 3810 to 4110 were seen of one run, as pages are as large as the system likes \[bytes an element\].
const MOST_BYTES: f64 = 4500.0;

/// The first is a plain tube; the second, larger, is the robot with the most layers.
#[test]
fn what_is_said_before_a_run_is_a_lower_bound_of_what_it_takes() {
    let tube = fem::case::shipped_case("tube").unwrap();
    let tube = tube.replace("elements_around = 48", "elements_around = 150");
    let tube = tube.replace("elements_along = 72", "elements_along = 300");
    let cpam = RunSource::new("cpam", models::shipped("cpam").unwrap());
    let cpam = cpam.with(&fem::session::mesh_keys(&[1.3; 2])).unwrap();
    let program = peak();
    for source in [RunSource::new("tube", &tube), cpam] {
        let folder = tempfile::tempdir().unwrap();
        let settings =
            RunSettings { folder: Some(folder.path().join("run")), end_s: Some(2e-5), ..RunSettings::default() };
        let problem = source.load().unwrap().case.problem;
        let (least, most) = (least_bytes(&problem) as f64, MOST_BYTES * problem.mesh.elements() as f64);
        drop(problem);
        simulate(&source, &settings, &mut |_, _| ControlFlow::Continue(())).unwrap();
        let taken = (peak() - program) as f64;
        println!("{}: {:.2} of the bound", source.name, taken / least);
        assert!((least..most).contains(&taken), "{}: {taken} bytes, at least {least}", source.name);
    }
}
