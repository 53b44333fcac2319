//! `ibr simulate`: what a run leaves behind, what is refused, and that nothing depends on threads.

use crate::refused::{refuse, with_report};
use crate::support::{Folder, assert_hashes};
use serde_json::Value;

/// A pillow airbag of few elements for a hundredth of a second.
pub(crate) fn small() -> String {
    let text = fem::case::shipped_case("pillow").unwrap();
    let mut small = text.replace("elements = 32 ", "elements = 8 ").replace("end_s = 0.15", "end_s = 0.01");
    small = small.replace("output_every_s = 0.005", "output_every_s = 0.002");
    assert!(small.contains("elements = 8 ") && small.contains("end_s = 0.01\n") && small.contains("0.002"));
    small
}

fn with_case(text: &str) -> Folder {
    let folder = Folder::new();
    folder.write("my.toml", text);
    folder
}

/// All files of a run but the manifest, which says when and how it was made.
fn results(folder: &Folder, run: &str) -> Vec<(String, Vec<u8>)> {
    let root = folder.path(run);
    let all = folder.contents().into_iter().filter_map(|(path, bytes)| {
        let name = path.strip_prefix(&root).ok()?.to_string_lossy().into_owned();
        (name != "manifest.json").then_some((name, bytes))
    });
    all.collect()
}

#[test]
fn a_run_leaves_frames_history_picture_summary_and_a_manifest_whose_hashes_match() {
    let folder = with_case(&small());
    let ran = folder.run(&["simulate", "my.toml"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    for words in ["Square pillow airbag", "centre_top", "mass damping", "residual over external work", "CPU second"] {
        assert!(ran.stdout.contains(words), "{words}: {}", ran.stdout);
    }
    assert!(ran.stderr.contains("open in ParaView: ibr-report/simulate-my/run.pvd"), "{}", ran.stderr);
    let names = assert_hashes(&folder.path("ibr-report/simulate-my"));
    let mut wanted = vec!["case.toml", "history.csv", "run.pvd"];
    let frames: Vec<String> = (0..6).map(|i| format!("frames/run_{i:05}.vtu")).collect();
    wanted.extend(frames.iter().map(String::as_str));
    wanted.extend(["picture.png", "summary.json"]);
    assert_eq!(names, wanted);
    assert_eq!(folder.contents().len(), names.len() + 3, "manifest, end of the run, my.toml and nothing else");
}

#[test]
fn the_answer_as_json_has_displacements_energies_and_both_rules_on_kinetic_energy() {
    let folder = with_case(&small());
    let answer = folder.run(&["simulate", "my.toml", "--json", "--threads", "1"]).json("ibr.simulate");
    let number = |v: &Value| v.as_f64().unwrap();
    assert!((number(&answer["time_s"]) - 0.01).abs() < 1e-4 && number(&answer["steps"]) > 20.0, "{answer}");
    let rise = number(&answer["probes"][0]["displacement_mm"][2]);
    assert!(rise > 1.0 && answer["probes"][0]["set"] == "centre_top", "the pillow fills: {rise}");
    let sum = |kind: &str| {
        let rows = answer["ledger"].as_array().unwrap().iter().filter(|r| r["kind"] == kind);
        rows.map(|r| number(&r["energy_j"])).sum::<f64>()
    };
    let held = number(&answer["kinetic_j"]) + sum("stored") + sum("dissipated");
    assert!((held - sum("supplied") - number(&answer["residual_j"])).abs() < 1e-9, "the ledger closes: {answer}");
    assert!(number(&answer["residual_share_peak"]) < 0.02 && number(&answer["chambers"][0]["volume_cm3"]) > 0.0);
    assert_eq!(answer["kinetic_share"]["outputs"], 5);
    assert!(answer["kinetic_share"]["below_10_pct_of_internal"]["kept_at"].is_u64());
    assert!(number(&answer["cost"]["element_steps_per_cpu_s"]) >= 0.0);
    let summary: Value =
        serde_json::from_slice(&std::fs::read(folder.path("ibr-report/simulate-my/summary.json")).unwrap()).unwrap();
    assert!(summary["probes"] == answer["probes"] && summary["cost"].is_null(), "no times in the summary");
}

#[test]
fn one_thread_and_two_leave_the_same_bytes() {
    let folder =
        with_case(&small().replace("elements = 8 ", "elements = 48 ").replace("end_s = 0.01", "end_s = 0.001"));
    for threads in ["1", "2"] {
        let ran = folder.run(&["simulate", "my.toml", "--threads", threads, "--out", threads]);
        assert_eq!(ran.code, 0, "{}", ran.stderr);
    }
    assert!(results(&folder, "1") == results(&folder, "2"));
}

#[test]
fn options_choose_the_end_and_leave_frames_out() {
    let folder = with_case(&small());
    let ran = folder.run(&["simulate", "my.toml", "--out", "a/b", "--end", "4ms", "--no-frames", "--quiet"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    assert!(ran.stderr.contains("history: a/b/history.csv"), "{}", ran.stderr);
    let names: Vec<String> = results(&folder, "a/b").into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["case.toml", "checkpoint.end", "history.csv", "picture.png", "summary.json"]);
    let history = String::from_utf8(std::fs::read(folder.path("a/b/history.csv")).unwrap()).unwrap();
    assert_eq!(history.lines().count(), 1 + 3, "0, 2 and 4 ms");
    for wrong in ["5", "x", "5h", "20us", "nans"] {
        let words = ["--end", &format!("`{wrong}`"), "units s, ms, min"];
        refuse(&folder, &["simulate", "my.toml", "--end", wrong, "--out", "c"], 2, &words);
    }
    refuse(&folder, &["simulate", "my.toml", "--end", "0s", "--out", "c"], 2, &["out of range"]);
    refuse(&folder, &["simulate", "my.toml", "--checkpoint-every", "30", "--out", "c"], 2, &["--checkpoint-every"]);
}

#[test]
fn a_finished_run_is_replaced_only_by_force_and_only_when_the_new_one_is_complete() {
    let folder = with_case(&small());
    assert_eq!(folder.run(&["simulate", "my.toml", "--out", "run"]).code, 0);
    let first = results(&folder, "run");
    refuse(&folder, &["simulate", "my.toml", "--out", "run"], 3, &["holds a finished run", "--force"]);
    let again = folder.run(&["simulate", "my.toml", "--out", "run", "--resume"]);
    assert!(
        again.code == 0 && again.stderr.contains("is complete at t =") && again.stderr.contains("nothing was done"),
        "{}",
        again.stderr
    );
    assert!(again.stdout.contains("centre_top"), "the summary is shown again: {}", again.stdout);
    folder.write("my.toml", small() + "frames = false\n");
    assert_eq!(folder.run(&["simulate", "my.toml", "--out", "run", "--force"]).code, 0);
    let second = results(&folder, "run");
    assert!(second.iter().all(|(name, _)| !name.starts_with("frames")), "nothing is left of the first");
    assert!(first.iter().any(|(name, _)| name.starts_with("frames")));
    assert!(!folder.path("run.new").exists() && !folder.path("run.new-replaces").exists());
    folder.write("my.toml", small() + "\n[settings.x]\n");
    refuse(&folder, &["simulate", "my.toml", "--out", "run", "--force"], 3, &["my.toml"]);
}

#[test]
fn a_folder_with_other_files_is_never_touched() {
    let folder = with_report();
    folder.write("my.toml", small());
    let words = ["cannot write to report", "other files", "new or empty folder"];
    for more in [&[][..], &["--force"], &["--resume"]] {
        refuse(&folder, &[&["simulate", "my.toml", "--out", "report"], more].concat(), 3, &words);
    }
    folder.write("file", "text");
    refuse(&folder, &["simulate", "my.toml", "--out", "file/x"], 3, &["file is a file"]);
}

/// Hencky's clamped disc, 0.6536 R (p R / (E t))^(1/3) for ν = 0.3, with a mesh of twelve elements along the radius.
#[test]
fn a_clamped_disc_rises_as_hencky_says() {
    let case = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/foreign/disc.toml");
    let answer = Folder::new().run(&["simulate", case, "--out", "disc", "--json"]).json("ibr.simulate");
    let rise_mm = answer["probes"][0]["displacement_mm"][2].as_f64().unwrap();
    let hencky_mm = 0.6536 * 100.0 * (2e3 * 0.1_f64 / (300e6 * 1e-4)).cbrt();
    assert!((rise_mm / hencky_mm - 1.0).abs() < 0.01, "{rise_mm} and {hencky_mm} mm");
}

#[test]
fn a_wrong_case_is_shown_with_its_place_and_what_to_type() {
    let refused = |old: &str, new: &str, words: &[&str]| {
        let text = small();
        assert_eq!(text.matches(old).count(), 1, "{old}");
        let folder = with_case(&text.replace(old, new));
        refuse(&folder, &["simulate", "my.toml"], 3, &[&["my.toml:"], words].concat());
    };
    refused("side_mm = 848.5", "sdie_mm = 848.5", &["unknown key", "my.toml:10:1", "did you mean `side_mm`?"]);
    refused("side_mm = 848.5", "side_mm = 0.8485", &["not 0.8485", "my.toml:10:11", "looks like metres"]);
    refused("[0.05, 5]]", "[0.05, 5000]]", &["not 5000", "looks like pascals"]);
    refused("nu = 0.4 ", "nu = 1.4 ", &["nu must be from 0 to 0.5", "neo-hookean"]);
    refused("thickness_mm = 0.6 ", "thickness_mm = -0.6 ", &["not -0.6", "a negative value means nothing"]);
    refused("\"mid_edge\"]", "\"mid_edgs\"]", &["unknown node set `mid_edgs`", "centre_bottom, centre_top, corners"]);
    refused("[chamber.air]", "[chamber.iar]", &["`air` without a pressure", "add [chamber.air]"]);
    refused("elements = 8 ", "elements = 7 ", &["even"]);
    refused("generator = \"pillow\"", "file = \"no.mesh\"", &["unknown key of a mesh from a file", "side_mm"]);
    refused("end_s = 0.01", "end_s = 0.01\ndt_s = 0.005", &["not stable", "mass_scaling"]);
}

#[test]
fn a_case_is_exported_for_another_solver_once_and_runs_from_the_mesh_of_that_file() {
    let folder = with_case(&small());
    let ran = folder.run(&["simulate", "my.toml", "--export", "a.inp"]);
    assert_eq!((ran.code, ran.stdout.as_str()), (0, "a.inp: 130 nodes, 128 elements\n"), "{}", ran.stderr);
    assert!(ran.stderr.contains("the file does not say: curves, wrinkling"), "{}", ran.stderr);
    refuse(&folder, &["simulate", "my.toml", "--export", "a.inp"], 2, &["a.inp exists already", "--force"]);
    let ran = folder.run(&["simulate", "my.toml", "--export", "ccx.inp", "--for", "calculix"]);
    assert_eq!((ran.code, ran.stdout.as_str()), (0, "ccx.inp: 130 nodes, 128 elements\n"), "{}", ran.stderr);
    let help = ["CalculiX does not read a.vtu", "end it with .inp"];
    refuse(&folder, &["simulate", "my.toml", "--export", "a.vtu", "--for", "calculix"], 2, &help);
    refuse(&folder, &["simulate", "my.toml", "--export", "a.foo"], 2, &["names no known format", ".vtu"]);
    refuse(&folder, &["simulate", "epam", "--seeds", "2", "--export", "b.inp"], 2, &["one run", "--seeds"]);
    let start = small().find("generator").unwrap();
    let end = small().find("[fabric").unwrap();
    let file = "file = \"a.inp\"\nunit = \"m\"\n";
    folder.write("own.toml", format!("{}{file}{}", &small()[..start], &small()[end..]));
    let ran = folder.run(&["simulate", "own.toml", "--force"]);
    assert!(ran.code == 0 && ran.stderr.contains("behind the surface `air`"), "{}", ran.stderr);
}

#[test]
fn files_that_are_no_case_are_refused() {
    let folder = with_report();
    folder.write("empty.toml", "\n");
    let help = "`ibr new pillow > my.toml` makes a start";
    refuse(&folder, &["simulate", "empty.toml"], 3, &["the file is empty", help]);
    refuse(&folder, &["simulate", "nothing.toml"], 3, &["No such file", "pillow, tube"]);
    let mesh = small().replace("generator = \"pillow\"\nside_mm = 848.5", "file = \"no.mesh\"");
    let start = mesh.find("elements = 8 ").unwrap();
    let end = mesh[start..].find('\n').unwrap() + start;
    folder.write("sub/mesh.toml", format!("{}{}", &mesh[..start], &mesh[end..]));
    refuse(&folder, &["simulate", "sub/mesh.toml"], 3, &["sub/no.mesh cannot be read", "folder of the case file"]);
}

#[test]
fn robots_run_from_their_scenarios_and_bad_ones_are_refused_with_their_place() {
    let folder = with_report();
    let epam = models::shipped("epam").unwrap();
    folder.write("wide.toml", epam.replace("width_mm = 60", "width_mm = 150"));
    refuse(&folder, &["simulate", "wide.toml"], 3, &["wide.toml", "150 mm is wider than half of the body, 125.664 mm"]);
    folder.write("long.toml", epam.replace("count = 6", "count = 7"));
    refuse(&folder, &["simulate", "long.toml"], 3, &["long.toml:16", "beyond the body's 360.0 mm", "lower count"]);
    let ran = folder.run(&["simulate", "epam", "--end", "0.2ms", "--no-frames", "--out", "robot"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let line = std::fs::read_to_string(folder.path("robot/centre_line.csv")).unwrap();
    assert!(line.contains(",3.6e2,"), "{line}");
}

#[test]
fn a_run_that_cannot_be_trusted_stops_with_4_and_keeps_what_it_wrote() {
    let folder = with_case(&small().replace("mass_damping_1_s", "guard_speed_m_s = 0.1\nmass_damping_1_s"));
    let ran = folder.run(&["simulate", "my.toml", "--out", "run"]);
    assert_eq!((ran.code, ran.stdout.as_str()), (4, ""), "{}", ran.stderr);
    assert!(ran.stderr.contains("stopped at step") && ran.stderr.contains("moves at"), "{}", ran.stderr);
    assert!(ran.stderr.contains("what was written until then is in run"), "{}", ran.stderr);
    let names: Vec<String> = results(&folder, "run").into_iter().map(|(name, _)| name).collect();
    assert!(names.iter().any(|n| n == "frames/run_00000.vtu") && names.iter().any(|n| n == "history.csv"), "{names:?}");
    refuse(&folder, &["simulate", "my.toml", "--out", "run"], 3, &["holds an interrupted run", "--resume", "--force"]);
    folder.write("my.toml", small());
    let words = ["of another case, or the case has changed", "run/case.toml", "--force"];
    refuse(&folder, &["simulate", "my.toml", "--out", "run", "--resume"], 3, &words);
    assert_eq!(folder.run(&["simulate", "my.toml", "--out", "run", "--force"]).code, 0);
}

/// Exact: p λ L₀ W cos θ/θ at the θ where 1 − λ sin θ/θ is the share of 60 mm that the ends came closer.
#[test]
fn the_force_of_a_blocked_pouch_is_in_history_and_summary() {
    use verification::exact::{elastic_pouch, pouch::Pouch};
    let (pouch, film) = (Pouch { length_m: 0.06, width_m: 0.01 }, elastic_pouch::PouchFilm::Linear(2e9 * 1e-4));
    let (mut low, mut high) = (0.1, 1.5);
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        let far = elastic_pouch::contraction(&pouch, film, middle, 20e3) > 9.5 / 60.0;
        if far { high = middle } else { low = middle }
    }
    let exact = elastic_pouch::force_n(&pouch, film, low, 20e3);
    assert!((exact - 6.38).abs() < 0.005, "{exact}");
    let folder = Folder::new();
    let answer = folder.run(&["simulate", "blocked-pouch", "--out", "run", "--json"]).json("ibr.simulate");
    let close = |force: f64| (force / exact - 1.0).abs() < 2e-3;
    let reaction = |set: &str| {
        let rows = answer["reactions"].as_array().unwrap();
        rows.iter().find(|r| r["set"] == set).unwrap()["force_n"].clone()
    };
    assert!(close(reaction("right")[0].as_f64().unwrap()) && close(-reaction("left")[0].as_f64().unwrap()), "{answer}");
    assert!(reaction("open_0")[0].is_null(), "not held along x");
    let history = String::from_utf8(std::fs::read(folder.path("run/history.csv")).unwrap()).unwrap();
    let column = history.lines().next().unwrap().split(',').position(|name| name == "right_x_N").unwrap();
    let last: f64 = history.lines().last().unwrap().split(',').nth(column).unwrap().parse().unwrap();
    assert!(close(last), "{last}, exact {exact}");
}

#[test]
fn every_shipped_case_is_listed_printed_and_runs() {
    let folder = Folder::new();
    let listed = folder.run(&["list", "cases", "--json"]).json("ibr.list");
    let names: Vec<_> =
        listed["cases"]["shipped"].as_array().unwrap().iter().map(|c| c["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["pillow", "tube", "blocked-pouch"]);
    for name in names {
        folder.write("mine.toml", folder.run(&["new", name]).stdout);
        let [mine, shipped] = ["mine.toml", name].map(|case| {
            let ran = folder.run(&["simulate", case, "--end", "0.1ms", "--out", &format!("{name}-of-{case}")]);
            assert_eq!(ran.code, 0, "{}", ran.stderr);
            results(&folder, &format!("{name}-of-{case}"))
        });
        assert!(mine == shipped, "{name}");
    }
}
