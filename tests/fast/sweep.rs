//! `ibr sweep`: studies in shards, with schedulers and resumed work.

use crate::refused::refuse;
use crate::support::{Folder, Ran};
use std::process::Command;

const STUDY: &str = "scenario = \"epam\"\n[[vary]]\nkey = \"actuator.width_mm\"\nvalues = [50, 60]\n[[vary]]\n\
    key = \"pressure_kpa\"\nfrom = 0\nto = 30\nsteps = 9001\n";

fn read(folder: &Folder, name: &str) -> String {
    std::fs::read_to_string(folder.path(name)).unwrap()
}

fn with_study() -> Folder {
    let folder = Folder::new();
    folder.write("study.toml", STUDY);
    folder
}

#[test]
fn a_study_becomes_a_table_with_pictures_and_is_kept() {
    let folder = with_study();
    let ran = folder.run(&["sweep", "study.toml", "--out", "s"]);
    assert!(
        ran.code == 0 && ran.stdout.contains("18002 cases by reduced; 0 of 71 parts"),
        "{}{}",
        ran.stdout,
        ran.stderr
    );
    let table = read(&folder, "s/table.csv");
    assert!(table.starts_with(
        "case,engine,actuator.width_mm,pressure_kpa,tip_x_mm,tip_y_mm,tip_angle_deg,trusted,status,reason\n"
    ));
    assert_eq!(table.lines().count(), 18003);
    let row = table.lines().nth(9001 + 6001).unwrap();
    let predicted = folder.run(&["predict", "epam", "--pressure", "20kPa", "--json"]);
    let state: serde_json::Value = serde_json::from_str(&predicted.stdout).unwrap();
    let tip = state["states"][0]["tip"]["y_mm"].as_f64().unwrap();
    assert!(
        row.contains(",60,20,") && (row.split(',').nth(5).unwrap().parse::<f64>().unwrap() - tip).abs() < 1e-9,
        "{row}"
    );
    assert!(folder.path("s/map.svg").exists() && folder.path("s/influence.png").exists());
    let again = folder.run(&["sweep", "study.toml", "--out", "s"]);
    assert!(again.stdout.contains("71 of 71 parts were there before"), "{}", again.stdout);
    assert_eq!(read(&folder, "s/table.csv"), table);
    for k in ["2/2", "1/2"] {
        assert_eq!(folder.run(&["sweep", "study.toml", "--out", "t", "--shard", k]).code, 0);
    }
    assert_eq!(read(&folder, "t/table.csv"), table);
}

#[test]
fn what_cannot_be_swept_is_refused() {
    let folder = with_study();
    refuse(&folder, &["sweep", "study.toml", "--shard", "3/2"], 2, &["3/2", "K/N"]);
    refuse(&folder, &["sweep", "nothing.toml"], 3, &["nothing.toml"]);
    folder.write("wrong.toml", STUDY.replace("width_mm", "widht_mm"));
    refuse(&folder, &["sweep", "wrong.toml"], 3, &["widht_mm", "width_mm"]);
    folder.write("no-steps.toml", STUDY.replace("steps = 9001\n", ""));
    refuse(&folder, &["sweep", "no-steps.toml"], 3, &["no-steps.toml:5", "`pressure_kpa` has no steps", "steps = 7"]);
    refuse(&folder, &["sweep", "study.toml", "--script"], 2, &["--engine"]);
}

/// Commands of Slurm that run the array at once on this machine, the second task only at the second submission, as if it was killed.
const SBATCH: &str = r#"#!/bin/bash
script="${@: -1}"
tries=$(cat tries 2>/dev/null || echo 0); echo $((tries + 1)) > tries
for task in 1 2 3; do
  [ "$task$tries" = 20 ] || SLURM_ARRAY_TASK_ID=$task bash "$script" > /dev/null
done
echo "17;cluster"
"#;

#[cfg(unix)]
#[test]
fn a_scheduler_gets_the_shards_and_a_killed_task_is_submitted_again() {
    use std::os::unix::fs::PermissionsExt;
    let folder = with_study();
    for (name, text) in [("bin/sbatch", SBATCH), ("bin/squeue", "#!/bin/bash\nexit 0\n")] {
        folder.write(name, text);
        std::fs::set_permissions(folder.path(name), std::fs::Permissions::from_mode(0o755)).unwrap();
    }
    let path = format!("{}:{}", folder.path("bin").display(), std::env::var("PATH").unwrap());
    let mut ibr = Command::new(env!("CARGO_BIN_EXE_ibr"));
    ibr.args(["sweep", "study.toml", "--out", "s", "--engine", "slurm", "--shards", "3"]);
    let ran = Ran::from(ibr.env("PATH", &path).env("NO_COLOR", "1").current_dir(folder.path("")).output().unwrap());
    assert_eq!(ran.code, 0, "{}{}", ran.stdout, ran.stderr);
    assert_eq!(read(&folder, "tries").trim(), "2");
    assert_eq!(folder.run(&["sweep", "study.toml", "--out", "t"]).code, 0);
    assert_eq!(read(&folder, "s/table.csv"), read(&folder, "t/table.csv"));
    let mut absent = Command::new(env!("CARGO_BIN_EXE_ibr"));
    absent.args(["sweep", "study.toml", "--out", "u", "--engine", "hq"]);
    let ran =
        Ran::from(absent.env("PATH", "/nowhere").env("NO_COLOR", "1").current_dir(folder.path("")).output().unwrap());
    assert!(
        ran.code == 2 && ran.stderr.contains("`hq` cannot be started") && ran.stderr.contains("--shard K/N"),
        "{}",
        ran.stderr
    );
}

/// One robot with two strips by both engines, each strip with a pressure of its own.
#[test]
fn robots_in_space_are_swept_by_both_engines() {
    let folder = Folder::new();
    let key = |key: &str, value: f64| format!("[[vary]]\nkey = \"{key}\"\nvalues = [{value}]\n");
    let coarse = [("mesh_mm", 12.0), ("ramp_s", 0.01)];
    let coarse =
        coarse.map(|(what, value)| ["body", "actuator"].map(|part| key(&format!("fem.{part}_{what}"), value)).concat());
    let pressures = [("pressure_kpa.0", 5.0), ("pressure_kpa.1", 15.0)].map(|(name, kpa)| key(name, kpa)).concat();
    let head = "scenario = \"epam-two-strips\"\nengines = [\"reduced\", \"finite elements\"]\noutputs = [\"tip\"]\n";
    folder.write("study.toml", format!("{head}{pressures}{}", coarse.concat()));
    let ran = folder.run(&["sweep", "study.toml", "--out", "s"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    assert!(ran.stdout.contains("the model's z of the tip differs"), "{}", ran.stdout);
    let table = read(&folder, "s/table.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert!(rows.len() == 3 && !rows[0].contains(&"pressure_kpa"), "{table}");
    let at = |name: &str| rows[0].iter().position(|column| *column == name).expect("a column");
    for row in &rows[1..] {
        let [y, z] = ["tip_y_mm", "tip_z_mm"].map(|name| row[at(name)].parse::<f64>().expect("a number"));
        assert!(z > y && z > 5.0 && row[at("status")] == "ok", "{table}");
    }
}
