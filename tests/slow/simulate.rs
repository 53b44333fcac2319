//! Runs that are killed or interrupted at any moment, and the frames as another program reads them.
#![cfg(unix)]

use crate::alone;
use crate::support::{Folder, Ran, repository};
use std::collections::BTreeMap;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A run of about half a second, with every kind of file.
fn with_case() -> Folder {
    let text = fem::case::shipped_case("pillow").unwrap();
    let text =
        text.replace("elements = 32 ", "elements = 24 ").replace("[output]", "[output]\nstations_mm = [-200, 0, 200]");
    let folder = Folder::new();
    folder.write("my.toml", text);
    folder
}

fn start(folder: &Folder, more: &[&str]) -> Child {
    let args = [&["simulate", "my.toml", "--checkpoint-every", "50ms", "--out", "run"], more].concat();
    folder.ibr(&args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// All files of the run but the manifest, which says when and how it was made.
fn results(folder: &Folder) -> BTreeMap<String, Vec<u8>> {
    let root = folder.path("run");
    let named = folder.contents().into_iter().filter_map(|(path, bytes)| {
        let name = path.strip_prefix(&root).ok()?.to_string_lossy().into_owned();
        (name != "manifest.json").then_some((name, bytes))
    });
    named.collect()
}

fn assert_same(whole: &BTreeMap<String, Vec<u8>>, folder: &Folder, what: &str) {
    let found = results(folder);
    assert_eq!(found.keys().collect::<Vec<_>>(), whole.keys().collect::<Vec<_>>(), "{what}");
    for (name, bytes) in whole {
        assert!(found[name] == *bytes, "{what}: {name} differs");
    }
}

fn wait_for(folder: &Folder, file: &str) {
    let patience = Instant::now();
    while !folder.path(file).exists() {
        assert!(patience.elapsed() < Duration::from_secs(60), "{file} was not written");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Next number in 0..1 of the SplitMix64 sequence.
fn uniform(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn a_run_that_is_killed_at_any_moment_and_resumed_ends_with_the_same_bytes() {
    let _alone = alone();
    let reference = with_case();
    let began = Instant::now();
    let ran = Ran::from(start(&reference, &[]).wait_with_output().unwrap());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let takes = began.elapsed();
    let whole = results(&reference);
    let (mut random, mut unfinished, mut with_checkpoint) = (2026, 0, 0);
    for trial in 0..20 {
        let folder = with_case();
        let mut more: &[&str] = &[];
        // Some are killed a second time while they go on.
        for _ in 0..1 + trial % 2 {
            let mut child = start(&folder, more);
            // By the clock, or, however busy the machine is, a moment after one of the 31 frames.
            if trial % 4 == 0 || !more.is_empty() {
                std::thread::sleep(takes.mul_f64(0.5 * uniform(&mut random)));
            } else {
                let frame = format!("run/frames/run_{:05}.vtu", (28.0 * uniform(&mut random)) as u32);
                wait_for(&folder, &frame);
                std::thread::sleep(takes.mul_f64(uniform(&mut random) / 31.0));
            }
            child.kill().unwrap();
            child.wait().unwrap();
            unfinished += i32::from(!folder.path("run/manifest.json").exists());
            with_checkpoint += i32::from(folder.path("run/checkpoint").exists());
            more = &["--resume"];
        }
        let ran = Ran::from(start(&folder, more).wait_with_output().unwrap());
        assert_eq!(ran.code, 0, "trial {trial}: {}", ran.stderr);
        assert_same(&whole, &folder, &format!("trial {trial}"));
    }
    println!("{unfinished} of 30 kills met an unfinished run, {with_checkpoint} one with a checkpoint");
    assert!(
        unfinished >= 15 && with_checkpoint >= 10,
        "{unfinished} {with_checkpoint}: kills came too late or too early"
    );
}

#[test]
fn an_interrupt_writes_a_checkpoint_and_the_command_that_goes_on() {
    let _alone = alone();
    let reference = with_case();
    assert_eq!(Ran::from(start(&reference, &[]).wait_with_output().unwrap()).code, 0);
    let folder = with_case();
    let child = start(&folder, &[]);
    wait_for(&folder, "run/frames/run_00002.vtu");
    let kill = format!("kill -INT {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
    let ran = Ran::from(child.wait_with_output().unwrap());
    assert_eq!((ran.code, ran.stdout.as_str()), (130, ""), "{}", ran.stderr);
    let command = ran.stderr.split("go on with: ibr ").nth(1).expect("the command to go on with").trim();
    assert_eq!(command, "simulate my.toml --out run --resume");
    let other_end = folder.run(&["simulate", "my.toml", "--out", "run", "--resume", "--end", "0.1s"]);
    assert!(other_end.code == 2 && other_end.stderr.contains("ends at 0.15 s"), "{}", other_end.stderr);
    let ran = folder.run(&command.split(' ').collect::<Vec<_>>());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    assert_same(&results(&reference), &folder, "resumed");
}

#[test]
fn two_runs_do_not_write_to_one_folder() {
    let _alone = alone();
    let folder = with_case();
    let mut child = start(&folder, &[]);
    wait_for(&folder, "run/frames/run_00000.vtu");
    let second = folder.run(&["simulate", "my.toml", "--out", "run", "--resume"]);
    assert!(second.code == 3 && second.stderr.contains("another run is writing to it"), "{}", second.stderr);
    child.kill().unwrap();
    child.wait().unwrap();
}

/// A Python that has a module; else says how to have one.
fn python_with(module: &str) -> Option<String> {
    let python = std::env::var("IBR_PYTHON").unwrap_or_else(|_| "python3".into());
    let import = format!("import {module}");
    let has = Command::new(&python).args(["-c", &import]).output().is_ok_and(|o| o.status.success());
    if !has {
        println!("skipped: `{python} -c \"{import}\"` does not work here; set IBR_PYTHON to a Python with {module}");
    }
    has.then_some(python)
}

#[test]
fn vtk_reads_every_frame_that_the_series_names() {
    let _alone = alone();
    let Some(python) = python_with("vtk") else { return };
    let folder = with_case();
    assert_eq!(Ran::from(start(&folder, &[]).wait_with_output().unwrap()).code, 0);
    let script = repository().join("tests/read_pvd.py");
    let read = Ran::from(Command::new(&python).arg(script).arg(folder.path("run/run.pvd")).output().unwrap());
    assert_eq!(read.code, 0, "{}{}", read.stdout, read.stderr);
    assert!(read.stdout.contains("31 frames"), "{}", read.stdout);
}

/// The tube and its end are a cylinder and a disc, cut into flat elements of some 5 mm.
#[test]
fn another_reader_of_abaqus_files_finds_every_robot_whole() {
    let Some(python) = python_with("meshio") else { return };
    let folder = Folder::new();
    for robot in ["spam", "cpam", "epam", "fpam"] {
        let ran = folder.run(&["simulate", robot, "--export", "robot.inp", "--force"]);
        let script = repository().join("tests/read_inp.py");
        let read = Ran::from(Command::new(&python).arg(script).arg(folder.path("robot.inp")).output().unwrap());
        assert_eq!((ran.code, read.code), (0, 0), "{}{}", ran.stderr, read.stderr);
        let found: serde_json::Value = serde_json::from_str(&read.stdout).unwrap();
        let told = format!("robot.inp: {} nodes, {} elements\n", found["nodes"], found["elements"]);
        assert_eq!(ran.stdout, told, "{robot}");
        let parts = found["of_parts_mm2"].as_object().unwrap();
        let area = |is_wanted: &dyn Fn(&str) -> bool| -> f64 {
            parts.iter().filter(|part| is_wanted(part.0)).map(|part| part.1.as_f64().unwrap()).sum()
        };
        let tube = area(&|name| name == "wall" || name == "face" || name.starts_with("seam"));
        let cap = area(&|name| name == "tip_cap");
        let (radius, length) = (40.0, 360.0);
        let cylinder = std::f64::consts::TAU * radius * length;
        assert!((tube / cylinder - 1.0).abs() < 3e-3, "{robot}: {tube} mm² of a tube, not {cylinder}");
        assert!((cap / (std::f64::consts::PI * radius * radius) - 1.0).abs() < 5e-3, "{robot}: a cap of {cap} mm²");
        assert!(found["node_sets"].as_array().unwrap().iter().any(|set| set == "marker_6"), "{robot}: {found}");
    }
}
