//! Finite element robots: many runs from one command, which are kept. The robots are coarse and fast: what they give is no
//! result.

use crate::alone;
use crate::support::{Folder, Ran};
use serde_json::Value;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// A tenth of a second of processor time.
const QUICK: [&str; 11] = [
    "--mesh",
    "14mm",
    "--set",
    "body_ramp_s=0.004",
    "--set",
    "actuator_ramp_s=0.006",
    "--set",
    "guard_hourglass=1",
    "--no-frames",
    "--quiet",
    "--json",
];

fn simulate(folder: &Folder, more: &[&str]) -> Value {
    let ran = folder.run(&[&["simulate", "epam"], &QUICK[..], more].concat());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    serde_json::from_str(&ran.stdout).unwrap()
}

#[test]
fn seeds_and_separate_pressures_are_runs_of_their_own_which_are_kept() {
    let _alone = alone();
    let folder = Folder::new();
    let more = ["--pressure", "10kPa,15kPa", "--set", "separate=true", "--seeds", "2", "--out", "batch"];
    let answer = simulate(&folder, &more);
    let runs = answer["runs"].as_array().unwrap();
    let labels: Vec<&str> = runs.iter().map(|r| r["run"].as_str().unwrap()).collect();
    assert_eq!(labels, ["seed-1-10kPa", "seed-1-15kPa", "seed-2-10kPa", "seed-2-15kPa"]);
    let groups = answer["groups"].as_array().unwrap();
    assert_eq!(groups.len(), 2, "one mean per pressure");
    let tip = |k: usize| runs[k]["heights"][0]["tip_mm"].as_f64().unwrap();
    let mean = groups[0]["tip_mean_mm"].as_f64().unwrap();
    assert!((mean - 0.5 * (tip(0) + tip(2))).abs() < 1e-12 && tip(0) != tip(2), "{groups:?}");
    let before = std::fs::metadata(folder.path("batch/seed-1-10kPa/manifest.json")).unwrap().modified().unwrap();
    assert_eq!(simulate(&folder, &more)["runs"], answer["runs"], "the same from what is kept");
    let after = std::fs::metadata(folder.path("batch/seed-1-10kPa/manifest.json")).unwrap().modified().unwrap();
    assert_eq!(before, after);
    // The first is free again: the second refuses before any is begun.
    std::fs::remove_dir_all(folder.path("batch/seed-1-10kPa")).unwrap();
    let other = folder.run(&[&["simulate", "epam"], &QUICK[..], &more, &["--set", "hourglass=0.02"]].concat());
    assert_eq!(other.code, 3);
    for words in ["batch/seed-1-15kPa", "another case", "--force"] {
        assert!(other.stderr.contains(words), "{words}: {}", other.stderr);
    }
    assert!(!folder.path("batch/seed-1-10kPa").exists());
}

#[cfg(unix)]
#[test]
fn an_interrupted_robot_goes_on_to_the_same_end() {
    let _alone = alone();
    let folder = Folder::new();
    // With the ramps and the hold of every robot.
    let start = |name: &str, more: &[&str]| {
        let all = [
            &[
                "simulate",
                "epam",
                "--mesh",
                "14mm",
                "--set",
                "guard_hourglass=1",
                "--no-frames",
                "--quiet",
                "--out",
                name,
            ],
            more,
        ]
        .concat();
        folder.ibr(&all).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
    };
    let whole = Ran::from(start("whole", &[]).wait_with_output().unwrap());
    assert_eq!(whole.code, 0, "{}", whole.stderr);
    let child = start("run", &[]);
    let history = folder.path("run/history.csv");
    let patience = Instant::now();
    while std::fs::read_to_string(&history).unwrap_or_default().lines().count() < 5 {
        assert!(patience.elapsed() < Duration::from_secs(60), "no history was written");
        std::thread::sleep(Duration::from_millis(2));
    }
    // Twice, as `timeout` does; the second comes when a checkpoint is being written.
    for _ in 0..2 {
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    }
    let ran = Ran::from(child.wait_with_output().unwrap());
    assert_eq!(ran.code, 130, "{}", ran.stderr);
    assert!(folder.path("run/checkpoint").exists() && ran.stderr.contains("--resume"), "{}", ran.stderr);
    let ran = Ran::from(start("run", &["--resume"]).wait_with_output().unwrap());
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    for name in ["readings.csv", "markers.csv", "history.csv", "centre_line.csv", "summary.json"] {
        let [a, b] = ["whole", "run"].map(|run| std::fs::read(folder.path(&format!("{run}/{name}"))).unwrap());
        assert!(a == b, "{name}");
    }
}

#[test]
fn a_hypercube_tells_intervals_and_weights_goes_on_and_leaves_what_is_known_alone() {
    let _alone = alone();
    let folder = Folder::new();
    let robots = |more: &[&str]| simulate(&folder, &[&["--uncertain", "12", "--out", "u"], more].concat());
    let first = robots(&["--set", "weld_mm=3"]);
    let names: Vec<&str> = first["numbers"].as_array().unwrap().iter().map(|n| n["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"bending_factor") && !names.contains(&"glue_mm"), "an ePAM has no glue: {names:?}");
    assert!(!names.contains(&"weld_mm"), "its width is known");
    let tip = &first["pressures"][0]["markers_mm"].as_array().unwrap().last().unwrap()[1];
    let [low, middle, high] = [0, 1, 2].map(|k| tip[k].as_f64().unwrap());
    assert!(low < middle && middle < high, "{tip}");
    assert_eq!(first["weights"].as_array().unwrap().len(), names.len());
    let record = || std::fs::read(folder.path("u/uncertain.json")).unwrap();
    let kept = record();
    assert!(folder.path("u/markers.png").exists() && folder.path("u/tornado.png").exists());
    std::fs::remove_dir_all(folder.path("u/robot-3")).unwrap();
    assert_eq!(robots(&["--set", "weld_mm=3"]), first, "one run is made again, the others are kept");
    assert!(record() == kept);
}

#[test]
fn a_breakdown_is_drawn_from_runs_that_are_kept() {
    let _alone = alone();
    let folder = Folder::new();
    folder.write(
        "quick.toml",
        models::shipped("fpam").unwrap().to_string() + "\n[fem]\nbody_ramp_s = 0.004\nactuator_ramp_s = 0.006\n",
    );
    let args = [
        "breakdown",
        "quick.toml",
        "--mesh",
        "14mm",
        "--pressure",
        "10kPa,20kPa",
        "--body-pressure",
        "3kPa",
        "--out",
        "map",
        "--runs",
        "runs",
        "--json",
    ];
    let answer = folder.run(&args).json("ibr.breakdown");
    let cells = answer["cells"].as_array().unwrap();
    assert_eq!(cells.len(), 4, "two pressures at the body's own and at 3 kPa; no pouches to vary");
    assert!(cells.iter().any(|c| c["body_kpa"] == 3.0) && folder.path("map/breakdown_fpam_0.png").exists());
    let first = std::fs::read(folder.path("map/breakdown.csv")).unwrap();
    folder.run(&args).json("ibr.breakdown");
    assert_eq!(std::fs::read(folder.path("map/breakdown.csv")).unwrap(), first);
    assert_eq!(std::fs::read_dir(folder.path("runs")).unwrap().count(), 2);
}

#[test]
fn runs_of_shards_are_those_of_the_whole_and_the_last_shard_draws() {
    let _alone = alone();
    let (whole, parts) = (Folder::new(), Folder::new());
    let more = ["--pressure", "10kPa,15kPa", "--set", "separate=true", "--seeds", "2", "--out", "batch"];
    let expected = simulate(&whole, &more);
    let shard = |shard: &str| simulate(&parts, &[&more[..], &["--shard", shard]].concat());
    let first = shard("1/3");
    assert_eq!((&first["schema"], &first["made"], &first["missing"]), (&"ibr.shard".into(), &2.into(), &2.into()));
    assert_eq!((&shard("1/3")["made"], &shard("2/3")["missing"]), (&0.into(), &1.into()));
    let numbers = |answer: &Value| {
        let runs = answer["runs"].as_array().unwrap();
        runs.iter().map(|run| (run["run"].clone(), run["heights"].clone())).collect::<Vec<_>>()
    };
    assert_eq!(numbers(&shard("3/3")), numbers(&expected));
    let script = ["simulate", "epam", "--seeds", "4", "--engine", "slurm", "--shards", "2", "--script", "--out", "b"];
    let told = parts.run(&script).stdout;
    assert!(told.contains("#SBATCH --array=1-2\n") && told.contains("'--seeds' '4' '--out' 'b' --quiet"), "{told}");
    for (args, code, words) in [
        (&["simulate", "epam", "--seeds", "4", "--shard", "3/2"][..], 2, "write K/N"),
        (&["simulate", "epam", "--shard", "1/2"], 2, "one run has no shards"),
        (&["simulate", "epam", "--seeds", "4", "--engine", "hq", "--force"], 2, "leave --force out"),
        (&["breakdown", "epam", "--shard", "0/2"], 2, "write K/N"),
    ] {
        let ran = parts.run(args);
        assert!(ran.code == code && ran.stderr.contains(words), "{args:?}: {}", ran.stderr);
    }
}

#[test]
fn a_breakdown_in_shards_is_that_of_the_whole() {
    let _alone = alone();
    let folder = Folder::new();
    let text = models::shipped("fpam").unwrap().to_string();
    folder.write("quick.toml", text + "\n[fem]\nbody_ramp_s = 0.004\nactuator_ramp_s = 0.006\n");
    let words = "breakdown quick.toml --mesh 14mm --pressure 10kPa,20kPa --body-pressure 3kPa";
    let run = |more: &str| {
        let args: Vec<&str> = words.split(' ').chain(more.split(' ')).collect();
        let ran = folder.run(&args);
        assert_eq!(ran.code, 0, "{}", ran.stderr);
        ran.stdout
    };
    run("--out whole --runs runs");
    assert!(run("--out map --runs shared --shard 1/2").contains("1 of all 2 are not there"));
    assert!(!folder.path("map").exists());
    run("--out map --runs shared --shard 2/2");
    let csv = |name: &str| std::fs::read(folder.path(&format!("{name}/breakdown.csv"))).unwrap();
    assert_eq!(csv("whole"), csv("map"));
}
