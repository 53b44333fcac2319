//! A sweep is what its cases are one by one, however it is cut, killed or gone on with.

use super::*;
use crate::axis::as_number;
use crate::sample::{Method, Points};
use compare::ScenarioFile;
use data::table::Column;
use models::{Loads, Model};
use std::ops::ControlFlow;
use std::path::Path;

const GRID: &str = r#"
scenario = "epam"
outputs = ["tip", "markers", "ledger", "limits"]
[[vary]]
key = "actuator.width_mm"
values = [50, 55.5, 60, 300]
[[vary]]
key = "pressure_kpa"
from = 0
to = 30
steps = 31
"#;

fn study(text: &str) -> Result<Study, String> {
    let told = |error: compare::CompareError| format!("{error} {}", error.help().unwrap_or_default());
    Study::parse("study.toml", text, Path::new(""), ScenarioFile::read).map_err(told)
}

fn settings(folder: &Path, shard: Shard) -> Settings {
    Settings { folder: folder.to_path_buf(), shard, keep_runs: true, threads: 2, maker: fem::session::Maker::default() }
}

fn made(study: &Study, folder: &Path, shard: Shard) -> Found {
    run(study, &settings(folder, shard), &mut |_, _| ControlFlow::Continue(())).unwrap()
}

fn csv(study: &Study, folder: &Path) -> String {
    let mut out = Vec::new();
    collect(study, folder, false).unwrap().to_csv(&mut out).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn every_row_is_the_prediction_of_its_own_scenario_to_the_bit() {
    let (study, folder) = (study(GRID).unwrap(), tempfile::tempdir().unwrap());
    made(&study, folder.path(), Shard::WHOLE);
    let table = collect(&study, folder.path(), false).unwrap();
    let numbers = |name: &str| match &table.columns.iter().find(|c| c.0 == name).unwrap().1 {
        Column::F64(values) => values.clone(),
        other => panic!("{name}: {other:?}"),
    };
    let (width, kpa, tip) = (numbers("actuator.width_mm"), numbers("pressure_kpa"), numbers("tip_y_mm"));
    let (wall, marker) = (numbers("actuator_gas_mj"), numbers("marker_6_y_mm"));
    assert_eq!((table.rows(), width[40], kpa[40]), (124, 55.5, 9.0));
    for row in 0..93 {
        let set = [("actuator.width_mm".to_string(), width[row].to_string())];
        let model = Model::new(&ScenarioFile::read("epam").unwrap().with(&set).unwrap().scenario);
        let (loads, mut at) = (Loads::uniform(2e3, 1e3 * kpa[row]), model.prediction());
        model.predict(&loads, &mut at).unwrap();
        assert_eq!((tip[row], marker[row]), (1e3 * at.tip.y_m, 1e3 * at.markers[5][1]), "row {row}");
        let gas: f64 = model
            .ledger(&loads, &at)
            .iter()
            .filter(|l| l.account == models::Account::ActuatorGas)
            .map(|l| 1e3 * l.energy_j)
            .sum();
        assert!((wall[row] - gas).abs() <= 1e-9 * gas.abs(), "row {row}");
    }
    // A pouch wider than half of the tube is a failed row that says why.
    let Column::Str(reason) = &table.columns.last().unwrap().1 else { panic!() };
    assert!(tip[93..].iter().all(|y| y.is_nan()) && reason[93].contains("300 mm"), "{}", reason[93]);
}

#[test]
fn one_two_and_seven_shards_give_the_same_table_to_the_bit() {
    let many = GRID.replace("steps = 31", "steps = 9001");
    let study = study(&many).unwrap();
    let whole = tempfile::tempdir().unwrap();
    made(&study, whole.path(), Shard::WHOLE);
    let wanted = csv(&study, whole.path());
    for of in [2, 7] {
        let folder = tempfile::tempdir().unwrap();
        for which in (1..=of).rev() {
            assert!(collect(&study, folder.path(), false).is_err());
            made(&study, folder.path(), Shard { which, of });
        }
        assert!(csv(&study, folder.path()) == wanted, "{of} shards");
    }
}

#[test]
fn what_is_there_is_kept_and_what_is_missing_is_made() {
    let (study, folder) = (study(&GRID.replace("steps = 31", "steps = 9001")).unwrap(), tempfile::tempdir().unwrap());
    let mut calls = 0;
    let stopped = run(&study, &settings(folder.path(), Shard::WHOLE), &mut |_, _| {
        calls += 1;
        if calls == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(matches!(stopped, Err(SweepError::Run(fem::FemError::Interrupted { .. }))), "{stopped:?}");
    let kept = made(&study, folder.path(), Shard::WHOLE).kept;
    assert!((2..=4).contains(&kept), "{kept} of 96 parts");
    let wanted = csv(&study, folder.path());
    let part = std::fs::read_dir(folder.path().join("parts")).unwrap().next().unwrap().unwrap().path();
    std::fs::remove_file(&part).unwrap();
    assert!(matches!(collect(&study, folder.path(), false), Err(SweepError::Missing(1))));
    let so_far = collect(&study, folder.path(), true).unwrap().rows();
    assert!((35_000..36_004).contains(&so_far), "{so_far}");
    assert!(matches!(collect(&study, Path::new("nowhere"), true), Err(SweepError::Missing(96))));
    let found = made(&study, folder.path(), Shard::WHOLE);
    assert_eq!((found.parts, found.kept, found.missing), (96, 95, 0));
    assert!(csv(&study, folder.path()) == wanted);
}

/// Wherever a bit flips and wherever the file is cut: never another table.
#[test]
fn a_part_that_was_changed_is_an_error_with_its_file_and_what_to_do() {
    let (study, folder) = (study(GRID).unwrap(), tempfile::tempdir().unwrap());
    made(&study, folder.path(), Shard::WHOLE);
    let wanted = csv(&study, folder.path());
    let part = std::fs::read_dir(folder.path().join("parts")).unwrap().next().unwrap().unwrap().path();
    let bytes = std::fs::read(&part).unwrap();
    let flipped = (0..29).map(|k| (k * bytes.len() / 29, k % 8)).map(|(at, bit)| {
        let mut other = bytes.clone();
        other[at] ^= 1 << bit;
        other
    });
    for other in flipped.chain([bytes[..bytes.len() - 3].to_vec(), Vec::new()]) {
        std::fs::write(&part, other).unwrap();
        for told in [
            collect(&study, folder.path(), false).unwrap_err(),
            run(&study, &settings(folder.path(), Shard::WHOLE), &mut |_, _| ControlFlow::Continue(())).unwrap_err(),
        ] {
            let name = part.file_name().unwrap().to_string_lossy().into_owned();
            assert!(told.to_string().contains(&name) && told.help().contains("delete the file"), "{told}");
        }
    }
    std::fs::remove_file(&part).unwrap();
    std::fs::write(folder.path().join("parts/.x.part.another-1-0.partial"), "half").unwrap();
    made(&study, folder.path(), Shard::WHOLE);
    assert!(csv(&study, folder.path()) == wanted);
}

#[test]
fn a_sample_meets_every_nth_of_each_range_and_sobol_points_are_even() {
    for method in [Method::LatinHypercube, Method::Sobol] {
        let (cases, axes) = (64, 3);
        let points = Points::new(method, cases, axes, 5);
        for axis in 0..axes {
            let mut strata: Vec<usize> = (0..cases).map(|i| (points.of(i)[axis] * cases as f64) as usize).collect();
            strata.sort_unstable();
            assert_eq!(strata, (0..cases).collect::<Vec<_>>(), "{method:?}, axis {axis}");
        }
        assert_ne!(points, Points::new(method, cases, axes, 6));
    }
}

/// The mean of a product over two nets has the error of even points, not of random ones, 3e-4 here.
#[test]
fn sobol_points_beyond_one_net_are_even_and_never_the_same_ones_again() {
    let (cases, axes) = (3 << 16, 2);
    let points = Points::new(Method::Sobol, cases, axes, 1);
    let mean = (0..cases).map(|i| points.of(i)[0] * points.of(i)[1]).sum::<f64>() / cases as f64;
    assert!((mean - 0.25).abs() < 1e-6, "{mean}");
    let same = (0..1 << 16).filter(|i| points.of(*i) == points.of(i + (1 << 16))).count();
    assert!(same < 4, "{same}");
}

#[test]
fn a_sampled_study_varies_words_counts_and_pressures() {
    let text = r#"
scenario = "epam"
[[vary]]
key = "actuator.count"
values = [4, 5, 6]
[[vary]]
key = "actuator.width_mm"
from = 40
to = 60
log = true
[[vary]]
key = "pressure_kpa"
from = 5
to = 30
[sample]
method = "latin hypercube"
cases = 50
"#;
    let (study, folder) = (study(text).unwrap(), tempfile::tempdir().unwrap());
    assert_eq!((study.cases(Engine::Reduced), study.per_robot()), (50, 1));
    assert_eq!(made(&study, folder.path(), Shard::WHOLE).missing, 0);
    let csv = csv(&study, folder.path());
    assert!(
        !csv.contains("failed")
            && csv.starts_with("case,engine,actuator.count,actuator.width_mm,pressure_kpa,tip_x_mm")
    );
}

#[test]
fn finite_elements_make_one_run_per_robot_and_find_it_again() {
    let text = r#"
scenario = "epam"
engines = ["reduced", "finite elements"]
[[vary]]
key = "fem.seed"
values = [1, 2]
[[vary]]
key = "fem.actuator_mesh_mm"
values = [10]
[[vary]]
key = "pressure_kpa"
values = [4, 3, 1]
"#;
    let (study, folder) = (study(text).unwrap(), tempfile::tempdir().unwrap());
    for which in [1, 2] {
        made(&study, folder.path(), Shard { which, of: 2 });
    }
    let table = csv(&study, folder.path());
    let rows: Vec<&str> = table.lines().filter(|line| line.contains("finite elements")).collect();
    assert!(rows.len() == 6 && rows.iter().filter(|row| row.contains(",ok,")).count() == 4, "{table}");
    assert!(rows[2].contains("an actuator at 1 kPa in a body at 2 kPa stays flat"), "{table}");
    std::fs::remove_dir_all(folder.path().join("parts")).unwrap();
    let started = std::time::Instant::now();
    let first = std::fs::read_dir(folder.path().join("runs")).unwrap().count();
    made(&study, folder.path(), Shard::WHOLE);
    assert_eq!(std::fs::read_dir(folder.path().join("runs")).unwrap().count(), first);
    assert!(csv(&study, folder.path()) == table, "after {:?}", started.elapsed());
    // In memory: no folder of a run, and the same numbers.
    let other = tempfile::tempdir().unwrap();
    let in_memory = Settings { keep_runs: false, ..settings(other.path(), Shard::WHOLE) };
    run(&study, &in_memory, &mut |_, _| ControlFlow::Continue(())).unwrap();
    assert!(csv(&study, other.path()) == table && !other.path().join("runs").exists());
}

#[test]
fn assumed_numbers_are_drawn_within_their_intervals_and_time_is_told() {
    let text = r#"
scenario = "epam"
engines = ["reduced", "finite elements"]
outputs = ["tip", "time"]
assumed = true
[[vary]]
key = "fem.weld_mm"
values = [3]
[sample]
method = "latin hypercube"
cases = 40
checked = 1
"#;
    let mut study = study(text).unwrap();
    let keys: Vec<&str> = study.axes.iter().map(|axis| axis.key.as_str()).collect();
    assert!(
        keys.contains(&"fem.density_kg_m3") && keys.iter().filter(|key| **key == "fem.weld_mm").count() == 1,
        "{keys:?}"
    );
    let density = keys.iter().position(|key| *key == "fem.density_kg_m3").unwrap();
    let drawn: Vec<f64> = (0..40).map(|robot| as_number(&study.values(robot)[density]).unwrap()).collect();
    assert!(drawn.iter().all(|kg| (700.0..1300.0).contains(kg)) && drawn.iter().any(|kg| *kg < 715.0), "{drawn:?}");
    assert!(drawn.iter().any(|kg| *kg > 1285.0), "{drawn:?}");
    let folder = tempfile::tempdir().unwrap();
    study.engines = vec![Engine::Reduced];
    made(&study, folder.path(), Shard::WHOLE);
    let table = collect(&study, folder.path(), false).unwrap();
    let seconds = table.columns.iter().find(|(name, _)| name == "cpu_s").map(|(_, column)| column);
    assert!(
        matches!(seconds, Some(Column::F64(all)) if all.len() == 120 && all.iter().all(|s| *s > 0.0)),
        "{seconds:?}"
    );
}

/// Two strips a quarter round the body from each other, their pressures and the place of one of them varied.
#[test]
fn strips_round_the_body_have_channels_and_a_third_coordinate() {
    const TEXT: &str = "[body]\nradius_mm = 40\nlength_mm = 360\npressure_kpa = 2\n[actuator]\nkind = 'epam'\nlength_mm = 60\n\
                width_mm = 50\ncount = 6\nazimuth_deg = 0\n[[strip]]\nazimuth_deg = 90\nchannel = 1\n[markers]\ns_mm = [180]\n";
    let robot = |_: &str| ScenarioFile::parse("two", TEXT);
    let asked = "scenario = 'two'\noutputs = ['tip', 'markers']\n[[vary]]\nkey = 'strip.1.azimuth_deg'\nvalues = [90, 180]\n\
                 [[vary]]\nkey = 'pressure_kpa.0'\nvalues = [10, 20]\n[[vary]]\nkey = 'pressure_kpa.1'\nfrom = 0\nto = 20\nsteps = 3\n";
    let study = Study::parse("study.toml", asked, Path::new(""), robot).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for which in 1..=2 {
        made(&study, folder.path(), Shard { which, of: 2 });
    }
    let table = collect(&study, folder.path(), false).unwrap();
    let numbers = |name: &str| match table.columns.iter().find(|c| c.0 == name) {
        Some((_, Column::F64(values))) => values.clone(),
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!((table.rows(), table.columns.iter().any(|c| c.0 == PRESSURE)), (12, false));
    let [azimuth, first, second] = ["strip.1.azimuth_deg", "pressure_kpa.0", "pressure_kpa.1"].map(numbers);
    let columns = ["tip_y_mm", "tip_z_mm", "tip_angle_deg", "marker_1_y_mm", "marker_1_z_mm"].map(numbers);
    for row in 0..12 {
        let set = [("strip.1.azimuth_deg".to_string(), azimuth[row].to_string())];
        let model = Model::new(&robot("").unwrap().with(&set).unwrap().scenario);
        let mut at = model.prediction();
        let actuator_pa = [1e3 * first[row], 1e3 * second[row], 0.0, 0.0];
        model.predict(&Loads { body_pa: 2e3, actuator_pa }, &mut at).unwrap();
        let (tip, z_m) = (at.tip, at.markers_z_m[0]);
        let alone = [tip.y_m * 1e3, tip.z_m * 1e3, tip.angle_rad.to_degrees(), at.markers[0][1] * 1e3, z_m * 1e3];
        assert_eq!(columns.each_ref().map(|column| column[row].to_bits()), alone.map(f64::to_bits), "row {row}");
    }
    // An antagonist of the same pressure holds it straight.
    let straight = (0..12).find(|row| azimuth[*row] == 180.0 && first[*row] == 20.0 && second[*row] == 20.0).unwrap();
    assert!(columns[0][straight].abs() < 1e-9 && columns[1][5] > 1.0, "{columns:?}");
    let keys: Vec<String> =
        influence::influences(&study, &table, Engine::Reduced, "tip_z_mm").into_iter().map(|i| i.key).collect();
    assert_eq!((keys.len(), keys[0].as_str()), (3, "strip.1.azimuth_deg"), "{keys:?}");
}

#[test]
fn a_wrong_study_is_refused_with_its_line_and_what_to_write() {
    let with = |old: &str, new: &str| study(&GRID.replace(old, new)).unwrap_err();
    for (old, new, says) in [
        ("scenario = \"epam\"", "scenario = \"epan\"", "epan"),
        ("width_mm", "widht_mm", "widht_mm"),
        ("steps = 31", "", "has no steps"),
        ("steps = 31", "steps = 0", "no step"),
        ("to = 30", "", "has no values"),
        ("from = 0", "from = 0\nlog = true", "goes from 0 to 30"),
        ("values = [50, 55.5, 60, 300]", "values = []", "no single list"),
        ("key = \"pressure_kpa\"", "key = \"actuator.width_mm\"", "is there twice"),
        ("steps = 31", "steps = 31\nstep = 1", "unknown field"),
        ("scenario = ", "assumed = true\nscenario = ", "assumed numbers are drawn"),
        ("steps = 31", "steps = 9000000", "more than 20000000 cases"),
        ("outputs", "output", "unknown field"),
        ("\"tip\"", "\"tips\"", "unknown variant"),
        ("[\"tip\", \"markers\", \"ledger\", \"limits\"]", "[]", "`outputs` is empty"),
        ("scenario = ", "engines = []\nscenario = ", "`engines` is empty"),
        ("scenario = ", "engines = [\"reduced\", \"reduced\"]\nscenario = ", "twice"),
        ("actuator.width_mm", "predict.pressures_kpa", "vary pressure_kpa"),
        ("actuator.width_mm", "pressure_kpa.1", "a pressure for all channels together with one for a channel"),
        ("key = \"pressure_kpa\"", "key = \"pressure_kpa.1\"", "nothing of epam is on supply channel 1"),
        ("actuator.width_mm", "pressure_kpa.4", "pressure_kpa.0 to pressure_kpa.3"),
        ("from = 0", "from = -1", "not a pressure, or has a value below zero"),
    ] {
        let told = with(old, new);
        assert!(told.contains(says), "{new}: {told}");
    }
    let twice = with("key = \"pressure_kpa\"", "key = \"actuator.width_mm\"");
    assert!(twice.contains("study.toml") && twice.contains('7'), "{twice}");
    let sampled = format!("{GRID}[sample]\nmethod = \"sobol\"\ncases = 10\n");
    assert!(study(&sampled).unwrap_err().contains("has steps, but a sample draws between"));
    let drawn = sampled.replace("steps = 31\n", "");
    assert!(study(&drawn.replace("cases = 10", "cases = 0")).unwrap_err().contains("a sample without a case"));
    assert!(study(&format!("{drawn}checked = 3\n")).unwrap_err().contains("`checked` without finite elements"));
}

#[test]
fn shards_are_read_as_they_are_typed() {
    assert_eq!(Shard::parse("2/7"), Ok(Shard { which: 2, of: 7 }));
    for wrong in ["0/7", "8/7", "2", "2/0", "a/b", "-1/3"] {
        assert!(Shard::parse(wrong).unwrap_err().contains("K/N"), "{wrong}");
    }
}

#[test]
fn the_key_that_moves_the_tip_most_comes_first_and_its_groups_have_the_means_of_their_cases() {
    let (study, folder) = (study(&GRID.replace(", 300]", "]")).unwrap(), tempfile::tempdir().unwrap());
    made(&study, folder.path(), Shard::WHOLE);
    let table = collect(&study, folder.path(), false).unwrap();
    let found = influence::influences(&study, &table, Engine::Reduced, "tip_y_mm");
    assert_eq!(found.iter().map(|i| &*i.key).collect::<Vec<_>>(), ["pressure_kpa", "actuator.width_mm"]);
    assert_eq!((found[0].groups.len(), found[1].groups.len()), (10, 3));
    let (Column::F64(width), Column::F64(tip)) = (&table.columns[2].1, &table.columns[5].1) else { panic!() };
    let own: Vec<f64> = (0..93).filter(|i| width[*i] == 55.5).map(|i| tip[i]).collect();
    let mean = own.iter().sum::<f64>() / own.len() as f64;
    assert!((found[1].groups[1].1 - mean).abs() < 1e-9 && found[1].groups[1].0 == "55.5", "{found:?}");
    let map = influence::map(&table, Engine::Reduced, "tip_y_mm", ["actuator.width_mm", "pressure_kpa"]).unwrap();
    let of_row =
        map.means[1].iter().zip([3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 4.0]).map(|(m, n)| m * n).sum::<f64>()
            / 31.0;
    assert!((of_row - mean).abs() < 1e-9, "{map:?}");
}

#[test]
fn a_scheduler_gets_one_array_job_of_the_same_command() {
    let job = schedule::Job {
        program: "/opt/it's/ibr".into(),
        words: ["sweep", "study.toml", "--out", "out"].map(String::from).to_vec(),
        started_in: "/data".into(),
        folder: "out".into(),
        shards: 4,
        threads: 2,
        options: "--time=2:00:00 --mem=4G".into(),
    };
    let script = job.script(schedule::Cluster::Slurm);
    assert!(script.contains("#SBATCH --array=1-4\n#SBATCH --cpus-per-task=2"), "{script}");
    assert!(script.contains("\n#SBATCH --time=2:00:00 --mem=4G\ncd '/data'\n"), "{script}");
    let command = "exec '/opt/it'\\''s/ibr' 'sweep' 'study.toml' '--out' 'out' --quiet --threads 2 --shard \"$SLURM_ARRAY_TASK_ID/4\"";
    assert!(script.contains(command), "{script}");
    assert!(job.script(schedule::Cluster::HyperQueue).contains("--shard \"$HQ_TASK_ID/4\""));
}

/// A share of the range, 60/119 of it, would give 60.99999999999999, which a seed or a count refuses.
#[test]
fn whole_steps_of_a_range_are_whole_numbers() {
    let text = "scenario = \"epam\"\n[[vary]]\nkey = \"actuator.count\"\nfrom = 1\nto = 120\nsteps = 120\n[[vary]]\nkey = \"pressure_kpa\"\nvalues = [10]\n";
    let study = study(text).unwrap();
    assert!((0..120).all(|robot| study.values(robot)[0] == toml::Value::Integer(robot as i64 + 1)));
}
