//! Pressure logs beside a camera: another clock, frames outside the log, a sensor of absolute pressure.

use super::{refused_paths, told};
use data::import::{ImportOptions, Imported, Offset, import};
use std::fmt::Write as _;
use std::path::PathBuf;

/// The log's time minus the camera's \[s\].
const AHEAD_S: f64 = 3.4;

/// Pressure over the camera's time: 0, 10, 20, 30, 0 kPa, each for 4 s after a ramp of 1 s.
fn pressure_kpa(t: f64) -> f64 {
    let steps: [f64; 5] = [0.0, 10.0, 20.0, 30.0, 0.0];
    let k = ((t / 5.0).max(0.0) as usize).min(4);
    let before = if k == 0 { 0.0 } else { steps[k - 1] };
    before + (steps[k] - before) * (t - 5.0 * k as f64).clamp(0.0, 1.0)
}

/// A recording of 25 s at 20 frames per second in millimetres, and its log at 50 readings per second, `ahead_s` ahead.
fn files(folder: &tempfile::TempDir, ahead_s: f64, add_kpa: f64) -> [PathBuf; 2] {
    let mut tracks = String::from("time_s,x_a_mm,y_a_mm,x_b_mm,y_b_mm\n");
    for frame in 0..500 {
        let t = 0.05 * f64::from(frame);
        let p = pressure_kpa(t);
        let _ = writeln!(tracks, "{t:.2},{:.3},{:.3},{:.3},{:.3}", 150.0 - 0.2 * p, p, 300.0 - 0.7 * p, 3.5 * p);
    }
    let mut log = String::from("time_s,p_act_kpa,p_body_kpa\n");
    for reading in 0..1500 {
        let t = 0.02 * f64::from(reading);
        let p = pressure_kpa(t - ahead_s) + 0.02 * (5.0 * t).sin();
        let _ = writeln!(log, "{t:.2},{:.4},{:.4}", p + add_kpa, 2.0 + add_kpa);
    }
    let paths = ["tracks.csv", "log.csv"].map(|name| folder.path().join(name));
    std::fs::write(&paths[0], tracks).unwrap();
    std::fs::write(&paths[1], log).unwrap();
    paths
}

fn options(log: &std::path::Path) -> ImportOptions {
    ImportOptions { pressure_logs: vec![log.to_path_buf()], actuator: Some("epam".into()), ..ImportOptions::default() }
}

fn is_right(made: &Imported) {
    let holds: Vec<f64> = made.dataset.holds.iter().map(|hold| (hold.p_act_pa / 1e3).round()).collect();
    assert_eq!(holds, [0.0, 10.0, 20.0, 30.0, 0.0], "{:?}", made.told);
    for hold in 0..5 {
        let (p, n) = (pressure_kpa(5.0 * hold as f64 + 3.0), made.dataset.samples_per_hold);
        for sample in 0..n {
            let [x, y] = made.dataset.xy(0, hold, sample, 1);
            assert!((y - 3.5e-3 * p).abs() < 2e-4 && (x - 0.3 + 0.7e-3 * p).abs() < 2e-4, "hold {hold}: {x} {y}");
        }
    }
}

/// The clock of the computer that a serial monitor writes is found.
#[test]
fn the_clock_of_a_serial_monitor_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let [tracks, log] = files(&folder, 3.4, 0.0);
    let line = |line: &str| {
        let [t, act, body] = [0, 1, 2].map(|k| line.split(',').nth(k).unwrap().parse::<f64>().unwrap());
        format!("10:11:{t:06.3} -> act {act:.3} body {body:.3}\n")
            .replace(" act ", " p: ")
            .replace(" body ", " kPa pb: ")
    };
    let text = std::fs::read_to_string(&log).unwrap();
    std::fs::write(&log, text.lines().skip(1).map(line).collect::<String>()).unwrap();
    let options = ImportOptions { offset: Offset::Find, pressure_unit_pa: Some(1e3), ..options(&log) };
    let made = import(&[tracks], &options, &mut |_, _| ()).unwrap();
    told(&made, &["the text of a serial monitor", "is 36663.40 s ahead"]);
}

#[test]
fn a_log_of_another_clock_is_noticed_and_its_offset_found_or_given() {
    let folder = tempfile::tempdir().unwrap();
    let [tracks, log] = files(&folder, AHEAD_S, 0.0);
    let files = [tracks];
    refused_paths(&files, &options(&log), &["0 of 4 changes of pressure", "is 3.40 s ahead", "--clock-offset find"]);
    let found = import(&files, &ImportOptions { offset: Offset::Find, ..options(&log) }, &mut |_, _| ()).unwrap();
    is_right(&found);
    told(&found, &["is 3.40 s ahead of the camera's (4 of 4 changes); r = 1.00"]);
    let given =
        import(&files, &ImportOptions { offset: Offset::Given(AHEAD_S), ..options(&log) }, &mut |_, _| ()).unwrap();
    is_right(&given);
    let late = ImportOptions { offset: Offset::Given(AHEAD_S + 1.0), ..options(&log) };
    refused_paths(&files, &late, &["4.4 s ahead, as given", "change up to 1.0 s apart", "is 3.40 s ahead"]);
}

/// Three frames a hold: too few changes to find a clock, enough to refuse one. No wrong clock sends the user to turn the picture first.
#[test]
fn a_recording_with_few_changes_refuses_wrong_clocks() {
    let runs = [1, 2, 3].map(|run| super::case(&format!("cases/c01-deeplabcut/run{run}.csv")));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("late.csv");
    let text = std::fs::read_to_string(super::case("cases/c01-deeplabcut/pressure.csv")).unwrap();
    for (late_s, words) in [
        (0.3, "5 frames have no pressure"),
        (0.9, "5 frames have no pressure"),
        (1.2, "the robot is there before the pressure changes"),
        (3.0, "does not follow the pressure"),
        (5.0, "bent where it should be straight"),
        (7.3, "does not follow the pressure"),
        (-3.0, "does not follow the pressure"),
        (-10.0, "where log and camera have two clocks"),
    ] {
        let row = |line: &str| {
            let (t, rest) = line.split_once(',').unwrap();
            t.parse::<f64>().map_or(line.to_string(), |t| format!("{:.3},{rest}", t + late_s))
        };
        std::fs::write(&path, text.lines().map(|line| row(line) + "\n").collect::<String>()).unwrap();
        let pressure_logs = vec![path.clone()];
        let options = ImportOptions { pressure_logs, ..super::pixels("cases/c01-deeplabcut/pressure.csv") };
        refused_paths(&runs, &options, &[words, "--clock-offset"]);
        let right = import(&runs, &ImportOptions { offset: Offset::Given(late_s), ..options }, &mut |_, _| ());
        assert_eq!(right.unwrap().dataset.holds.len(), 5, "{late_s}");
    }
}

/// Frames between two readings in which the pressure changes have neither of them.
#[test]
fn a_log_with_a_reading_a_second_leaves_out_what_it_does_not_know() {
    let folder = tempfile::tempdir().unwrap();
    let [tracks, log] = files(&folder, 0.0, 0.0);
    let text = std::fs::read_to_string(&log).unwrap();
    for first in [0, 10, 45] {
        let few: String =
            text.lines().take(1).chain(text.lines().skip(1 + first).step_by(50)).map(|l| format!("{l}\n")).collect();
        std::fs::write(&log, few).unwrap();
        let made = import(std::slice::from_ref(&tracks), &options(&log), &mut |_, _| ()).unwrap();
        is_right(&made);
        told(&made, &["between two readings in which the pressure changes"]);
    }
}

/// 19 holds of 20 s; one phone films 30 frames per second, the other 27.75 in the mean.
#[test]
fn a_frame_rate_that_is_not_that_of_the_video_is_refused_and_found() {
    let log = "cases/c39-frame-rate/pressure.csv";
    for (video, given, right) in [("30.csv", 30.0, 30.0), ("30.csv", 25.0, 30.0), ("vfr.csv", 30.0, 27.75)] {
        let video = format!("cases/c39-frame-rate/{video}");
        let options = ImportOptions { frames_per_s: Some(given), ..super::pixels(log) };
        let find = ImportOptions { offset: Offset::Find, ..options.clone() };
        let made = super::read(&[&video], &find);
        assert_eq!(made.dataset.holds.len(), 19, "{:?}", made.told);
        let [_, y] = made.dataset.xy(0, 3, 2, 2);
        assert!((y - 0.1229).abs() < 1e-3, "{y}");
        if given == right {
            super::read(&[&video], &options);
        } else {
            told(&made, &["frames per second"]);
            super::refused(&[&video], &options, &["frames per second", "--clock-offset find"]);
            super::read(&[&video], &ImportOptions { frames_per_s: Some(right), ..options });
        }
    }
}

#[test]
fn one_clock_needs_nothing_and_pictures_have_the_holds() {
    let folder = tempfile::tempdir().unwrap();
    let [tracks, log] = files(&folder, 0.0, 0.0);
    let made = import(&[tracks], &options(&log), &mut |_, _| ()).unwrap();
    is_right(&made);
    let track = &made.tracks[0];
    assert_eq!((track.lines.len(), track.lines[0].1.len(), track.holds.len()), (2, 500, 5));
    assert!((track.holds[1][0] - 6.0).abs() < 0.1 && (track.holds[1][1] - 10.0).abs() < 0.1, "{:?}", track.holds);
}

#[test]
fn absolute_pressure_is_refused_until_the_room_s_is_given() {
    let folder = tempfile::tempdir().unwrap();
    let [tracks, log] = files(&folder, 0.0, 101.3);
    refused_paths(std::slice::from_ref(&tracks), &options(&log), &["absolute", "--room 101.3kPa"]);
    is_right(&import(&[tracks], &ImportOptions { room_pa: Some(101.3e3), ..options(&log) }, &mut |_, _| ()).unwrap());
}

/// A second run that stops at 20 kPa.
#[test]
fn runs_of_other_protocols_are_refused_with_their_holds() {
    let folder = tempfile::tempdir().unwrap();
    let [tracks, log] = files(&folder, 0.0, 0.0);
    let short: String =
        std::fs::read_to_string(&tracks).unwrap().lines().take(1 + 300).map(|line| format!("{line}\n")).collect();
    let other = folder.path().join("tracks2.csv");
    std::fs::write(&other, short).unwrap();
    let words = ["holds found", "run tracks: 0, 10, 20, 30, 0; run tracks2: 0, 10, 20", "--bin"];
    refused_paths(&[tracks, other], &options(&log), &words);
}

#[test]
fn a_log_that_ends_early_leaves_frames_out_and_one_of_another_day_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let [tracks, log] = files(&folder, 0.0, 0.0);
    let text = std::fs::read_to_string(&log).unwrap();
    let early: String = text.lines().take(1 + 18 * 50).map(|line| format!("{line}\n")).collect();
    std::fs::write(&log, early).unwrap();
    let made = import(std::slice::from_ref(&tracks), &options(&log), &mut |_, _| ()).unwrap();
    assert_eq!(made.dataset.holds.len(), 4);
    told(&made, &["outside the pressure log"]);
    refused_paths(
        std::slice::from_ref(&tracks),
        &ImportOptions { offset: Offset::Given(5000.0), ..options(&log) },
        &["no frame is within", "5000"],
    );
}

#[test]
fn a_refused_clock_comes_with_both_tracks_and_their_changes() {
    let folder = tempfile::tempdir().unwrap();
    let [tracks, log] = files(&folder, 3.4, 0.0);
    let error = import(&[tracks], &options(&log), &mut |_, _| ()).unwrap_err();
    let data::DataError::Clock(_, seen) = &error else { panic!("{error}") };
    let [movement, pressure] = &seen.changes_s;
    assert_eq!((movement.len(), pressure.len(), seen.offset_s), (4, 4, 0.0));
    assert!(movement.iter().zip(pressure).all(|(m, p)| (p - m - 3.4).abs() < 0.3), "{movement:?} {pressure:?}");
    let is_share = |points: &[[f64; 2]]| points.len() > 400 && points.iter().all(|[_, v]| (0.0..=1.0).contains(v));
    assert!(is_share(&seen.movement) && is_share(&seen.pressure));
}
