//! Folders of finite element runs: what is damaged, half begun or not ours is told or mended, never taken for something else.

use crate::refused::refuse;
use crate::support::Folder;
use serde_json::json;
use sha2::Digest;

/// An ePAM on a coarse mesh, inflated in a hundredth of a second: what it gives is no result.
fn with_robot() -> Folder {
    let folder = Folder::new();
    let quick = "\n[fem]\nbody_mesh_mm = 14\nactuator_mesh_mm = 14\nbody_ramp_s = 0.004\nactuator_ramp_s = 0.006\nguard_hourglass = 1\npressures_kpa = [10]\n";
    folder.write("my.toml", models::shipped("epam").unwrap().to_string() + quick);
    folder
}

const BOTH: [&str; 9] = ["compare", "my.toml", "--engines", "--runs", "R", "--out", "page", "--seeds", "1"];

/// The only run's folder in `R`, as it is typed.
fn only_run(folder: &Folder) -> String {
    let mut names = std::fs::read_dir(folder.path("R")).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    let name = names.next().unwrap();
    assert!(names.next().is_none());
    format!("R/{name}")
}

#[test]
fn a_damaged_run_is_an_error_with_file_line_and_field_and_goes_on_once_it_is_deleted() {
    let folder = with_robot();
    assert_eq!(folder.run(&BOTH).code, 0);
    let run = only_run(&folder);
    let summary = format!("{run}/summary.json");
    let text = std::fs::read_to_string(folder.path(&summary)).unwrap();
    let delete = format!("delete {run} and give the command again");
    let refused = |name: &str, bytes: String, words: &[&str]| {
        folder.write(name, bytes);
        for args in [&BOTH[..], &["diagnose", "epam", "fem-epam", "--runs", "R"]] {
            refuse(&folder, args, 3, &[&[delete.as_str()], words].concat());
        }
    };
    refused(&summary, text[..text.len() / 2].into(), &[&format!("{summary}:"), "the file is cut short"]);
    let renamed = text.replacen("\"tip_angle_rad\"", "\"tip_angle\"", 1);
    refused(&summary, renamed, &["robot.readings[0]: missing field \"tip_angle_rad\""]);
    refused(&summary, text.replace("\"seed\"", "\"sed\""), &["robot.settings: missing field \"seed\""]);
    refused(
        &summary,
        text.replace("\"version\": 1", "\"version\": 7"),
        &["version 7", "reads ibr.simulate, version 1"],
    );
    folder.write(&summary, &text);
    let manifest = format!("{run}/manifest.json");
    let whole = std::fs::read_to_string(folder.path(&manifest)).unwrap();
    refused(&manifest, whole.replace("\"cost\"", "\"costs\""), &[&manifest, "missing field \"cost\""]);
    std::fs::remove_dir_all(folder.path(&run)).unwrap();
    assert_eq!(folder.run(&BOTH).code, 0, "the run is made anew");
    assert_eq!(std::fs::read_to_string(folder.path(&summary)).unwrap(), text, "to the same bits");
}

/// A pillow whose run a guard stops after several outputs, with checkpoints: `run` is as a kill leaves it.
fn with_stopped() -> Folder {
    let folder = Folder::new();
    let text = crate::simulate::small().replace("[output]", "[output]\nstations_mm = [-200, 0, 200]");
    folder.write("my.toml", text.replace("mass_damping_1_s", "guard_speed_m_s = 1\nmass_damping_1_s"));
    let ran = folder.run(&["simulate", "my.toml", "--out", "run", "--checkpoint-every", "0.01ms"]);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    assert!(folder.path("run/checkpoint").exists() && folder.path("run/frames/run_00004.vtu").exists());
    folder
}

const RESUME: [&str; 5] = ["simulate", "my.toml", "--out", "run", "--resume"];

#[test]
fn rows_and_frames_that_are_missing_are_told_before_an_interrupted_run_goes_on() {
    let folder = with_stopped();
    let history = String::from_utf8(folder.contents()[&folder.path("run/history.csv")].clone()).unwrap();
    let fewer: String =
        history.split_inclusive('\n').enumerate().filter(|(i, _)| *i != 1).map(|(_, line)| line).collect();
    folder.write("run/history.csv", fewer);
    refuse(&folder, &RESUME, 3, &["run/history.csv has lost the row of 0 s", "put the file back", "--force"]);
    std::fs::remove_file(folder.path("run/history.csv")).unwrap();
    refuse(&folder, &RESUME, 3, &["run/history.csv has lost the row"]);
    folder.write("run/history.csv", history);
    for name in ["run/frames/run_00000.vtu", "run/centre_line.csv"] {
        let bytes = std::fs::read(folder.path(name)).unwrap();
        std::fs::remove_file(folder.path(name)).unwrap();
        refuse(&folder, &RESUME, 3, &[name, "--force"]);
        folder.write(name, bytes);
    }
    std::fs::remove_file(folder.path("run/run.pvd")).unwrap();
    assert_eq!(folder.run(&RESUME).code, 4, "goes on, and is stopped where it was");
    assert!(folder.path("run/run.pvd").exists(), "the list is made again");
}

#[test]
fn a_run_that_was_killed_before_it_wrote_its_case_gets_it() {
    let folder = with_robot();
    assert_eq!(folder.run(&BOTH).code, 0);
    let run = only_run(&folder);
    let files = |name: &str| std::fs::read(folder.path(&format!("{run}/{name}"))).unwrap();
    let whole = ["case.toml", "summary.json", "history.csv"].map(files);
    let case = String::from_utf8(whole[0].clone()).unwrap();
    let scenario = models::Scenario::parse(&case).unwrap();
    let problem = fem::robot::RobotRun::parse(&case, &scenario).unwrap().problem(&scenario).unwrap();
    std::fs::remove_dir_all(folder.path(&run)).unwrap();
    folder.write(&format!("{run}/unfinished.json"), mark(&case, problem.settings.end_s));
    let ran = folder.run(&BOTH);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    assert!(["case.toml", "summary.json", "history.csv"].map(files) == whole);
}

/// What stands in a folder from the first moment of a run to its last.
fn mark(case: &str, end_s: f64) -> String {
    let case_sha256: String = sha2::Sha256::digest(case).iter().map(|b| format!("{b:02x}")).collect();
    let mark = json!({
        "schema": "ibr.unfinished", "version": 1, "case_sha256": case_sha256, "end_s": end_s, "frames": false
    });
    mark.to_string()
}

#[test]
fn a_mark_among_other_files_lets_nothing_be_deleted() {
    let folder = Folder::new();
    folder.write("my.toml", crate::simulate::small());
    folder.write("mine/picture.png", "somebody's own");
    folder.write("mine/frames/film.mp4", "somebody's own");
    folder.write("mine/unfinished.json", mark(&crate::simulate::small(), 1.0));
    for more in [&[][..], &["--force"], &["--resume"], &["--resume", "--force"]] {
        let args = [&["simulate", "my.toml", "--out", "mine"], more].concat();
        refuse(&folder, &args, 3, &["frames/film.mp4", "new or empty folder"]);
    }
    std::fs::remove_dir_all(folder.path("mine/frames")).unwrap();
    refuse(
        &folder,
        &["simulate", "my.toml", "--out", "mine", "--force"],
        3,
        &["unfinished.json, and not the case.toml"],
    );
}

#[test]
fn a_complete_run_of_another_case_is_not_taken_for_this_one() {
    let folder = Folder::new();
    folder.write("my.toml", crate::simulate::small());
    assert_eq!(folder.run(&["simulate", "my.toml", "--out", "run"]).code, 0);
    folder.write("my.toml", crate::simulate::small().replace("end_s = 0.01", "end_s = 0.008"));
    refuse(&folder, &RESUME, 3, &["of another case, or the case has changed", "--force"]);
    folder.write("run/notes.txt", "somebody's own");
    refuse(&folder, &["simulate", "my.toml", "--out", "run", "--force"], 3, &["notes.txt"]);
}
