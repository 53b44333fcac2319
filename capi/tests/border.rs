//! The border to C: the same numbers as the library, bad arguments refused with words, and the example compiled and run.

#![allow(clippy::unwrap_used, reason = "tests: a panic is the failure to report")]

use ibr_capi::*;
use models::{Loads, Model, Scenario, Target, shipped};
use std::ffi::{CStr, CString, c_char};
use std::path::Path;
use std::process::{Command, Stdio};
use std::ptr::{null, null_mut};

fn open(text: &str) -> Result<*mut ibr_robot, String> {
    let (text, mut error) = (CString::new(text).unwrap(), [0 as c_char; 200]);
    // SAFETY: a text that ends with a zero, and a buffer of its size.
    let robot = unsafe { ibr_open(text.as_ptr(), error.as_mut_ptr(), error.len()) };
    // SAFETY: ibr_open closes its text.
    let words = || unsafe { CStr::from_ptr(error.as_ptr()) }.to_str().unwrap().to_string();
    if robot.is_null() { Err(words()) } else { Ok(robot) }
}

fn said(robot: *const ibr_robot) -> String {
    // SAFETY: the robot is open or null, and the text ends with a zero.
    unsafe { CStr::from_ptr(ibr_error(robot)) }.to_str().unwrap().to_string()
}

#[test]
fn the_numbers_are_those_of_the_library() {
    for name in ["spam", "cpam", "epam", "fpam"] {
        let model = Model::new(&Scenario::parse(shipped(name).unwrap()).unwrap());
        let (robot, mut state) = (open(name).unwrap(), model.prediction());
        let (mut tip, mut p) = (ibr_tip { x_m: 0.0, y_m: 0.0, angle_rad: 0.0 }, 0.0);
        let mut slopes = [ibr_slope { x_per_pa: 0.0, y_per_pa: 0.0, angle_per_pa: 0.0 }; IBR_CHANNELS];
        // The robots have one channel: what is in the others does not count.
        let (mut all, mut markers) = ([f64::NAN; IBR_CHANNELS], [0.0; 12]);
        all[0] = 15e3;
        // SAFETY: the robot is open, every pointer leads to as many numbers as told.
        let codes = unsafe {
            [
                ibr_predict(robot, 2e3, all.as_ptr(), &raw mut tip, markers.as_mut_ptr()),
                ibr_pressure_for_height(robot, 2e3, 0.06, &raw mut p),
                ibr_jacobian(robot, 2e3, all.as_ptr(), slopes.as_mut_ptr()),
            ]
        };
        assert_eq!((codes, said(robot)), ([IBR_OK; 3], String::new()));
        assert_eq!(p, model.pressure_for(Target::TipHeight(0.06), 2e3, &mut state).unwrap());
        let loads = Loads::uniform(2e3, 15e3);
        assert_eq!(slopes[0].y_per_pa, model.jacobian(&loads, &mut state).unwrap()[0].y_per_pa);
        model.predict(&loads, &mut state).unwrap();
        assert_eq!((tip.x_m, tip.y_m, tip.angle_rad), (state.tip.x_m, state.tip.y_m, state.tip.angle_rad));
        assert_eq!(markers.as_slice(), state.markers.as_flattened());
        // SAFETY: opened above, not used again.
        unsafe { ibr_close(robot) };
    }
}

#[test]
fn what_means_nothing_is_refused_with_words() {
    assert_eq!(open("").unwrap_err().lines().count(), 1);
    let told = open("[body]\nradius_mm = 40\nlength_mm = 360\npressure = 2\n").unwrap_err();
    assert!(told.starts_with("line 4: unknown field `pressure`") && told.contains("length_mm"), "{told}");
    let robot = open("epam").unwrap();
    let (mut tip, all) = (ibr_tip { x_m: 0.0, y_m: 0.0, angle_rad: 0.0 }, [15e3; IBR_CHANNELS]);
    let mut p = 0.0;
    // SAFETY: the robot is open or null, every pointer leads to as many numbers as told or is null.
    unsafe {
        assert_eq!(ibr_predict(null_mut(), 2e3, all.as_ptr(), &raw mut tip, null_mut()), IBR_BAD_ARGUMENT);
        assert_eq!(said(null()), "the robot is a null pointer");
        assert_eq!(ibr_predict(robot, 2e3, null(), &raw mut tip, null_mut()), IBR_BAD_ARGUMENT);
        assert!(said(robot).contains("null"));
        assert_eq!(ibr_predict(robot, f64::NAN, all.as_ptr(), &raw mut tip, null_mut()), IBR_BAD_ARGUMENT);
        assert!(said(robot).contains("body pressure"), "{}", said(robot));
        assert_eq!(ibr_pressure_for_height(robot, 2e3, 0.9, &raw mut p), IBR_OUT_OF_REACH);
        assert!(said(robot).contains("pressures from 0 to 100 kPa give"), "{}", said(robot));
        assert_eq!(ibr_pressure_for_height(robot, 2e3, f64::NAN, &raw mut p), IBR_OUT_OF_REACH);
        assert_eq!(ibr_steer(robot, 2e3, f64::NAN, 0.0, null(), 0.0, null_mut()), IBR_BAD_ARGUMENT);
        assert!(ibr_open(null(), null_mut(), 0).is_null() && ibr_marker_count(null()) == 0);
        assert_eq!(ibr_predict(robot, 2e3, all.as_ptr(), &raw mut tip, null_mut()), IBR_OK);
        assert_eq!(said(robot), "");
        ibr_close(robot);
        ibr_close(null_mut());
    }
}

/// The example follows its path: from the middle of the circle on it is within a millimetre, with the valves' rate kept.
#[test]
fn the_example_compiles_and_follows_its_path() {
    let is_there = Command::new("cc").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    if !is_there.is_ok_and(|status| status.success()) {
        eprintln!("skipped: no C compiler `cc` here");
        return;
    }
    let (crate_folder, out) = (Path::new(env!("CARGO_MANIFEST_DIR")), tempfile::tempdir().unwrap());
    let program = out.path().join("controller");
    // Beside the tests: a build of the library alone would put it one folder above.
    let library = std::env::current_exe().unwrap().with_file_name("libibr_capi.a");
    let mut cc = Command::new("cc");
    cc.args(["-std=c99", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I"]).arg(crate_folder);
    cc.arg(crate_folder.join("examples/controller.c"))
        .arg(&library)
        .args(["-lm", "-lpthread", "-ldl", "-o"])
        .arg(&program);
    let built = cc.output().unwrap();
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let ran = Command::new(&program).output().unwrap();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let text = String::from_utf8(ran.stdout).unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 200);
    let [miss, p0, p1] = [5, 6, 7].map(|i| rows.iter().map(|row| row[i]).collect::<Vec<f64>>());
    assert!(miss[..20].iter().any(|mm| *mm > 1.0), "the model is wrong by a tenth of the pressure, and it shows");
    assert!(miss[100..].iter().all(|mm| *mm < 1.0), "{:?}", &miss[100..]);
    for p in [p0, p1] {
        assert!(p.windows(2).all(|pair| (pair[1] - pair[0]).abs() <= 3.0 + 0.011), "60 kPa/s are 3 kPa a cycle");
    }
}
