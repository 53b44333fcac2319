//! `ibr export`: what a C compiler and the model say of the files.

use crate::refused::{refuse, with_report};
use crate::support::{Folder, repository};
use models::{Loads, Model, Scenario, Target, shipped};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Nanoseconds that a call may take; it takes a tenth of that.
const MOST_NS: f64 = 200.0;

/// Whether there is a C compiler; says so where there is none.
fn has_cc() -> bool {
    let there = Command::new("cc").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    let is_there = there.is_ok_and(|status| status.success());
    if !is_there {
        eprintln!("skipped: no C compiler `cc` here");
    }
    is_there
}

/// Exports as robot.c, compiles with the program of the tests and gives it lines.
fn answers(folder: &Folder, args: &[&str], lines: &str) -> Vec<Vec<f64>> {
    let told = folder.run(&[&["export", "c"], args, &["--out", "robot.c", "--json"]].concat()).json("ibr.export.c");
    assert!(told["bytes"].as_u64().unwrap() <= 4096, "{told}");
    let main = repository().join("tests/fast/c/table.c");
    let flags = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I.", "robot.c"];
    let mut cc = Command::new("cc");
    cc.args(flags).arg(main).args(["-o", "table", "-lm"]).current_dir(folder.path(""));
    let built = cc.output().unwrap();
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    folder.write("lines", lines);
    let lines = std::fs::File::open(folder.path("lines")).unwrap();
    let ran = Command::new(folder.path("table")).stdin(lines).output().unwrap();
    let text = String::from_utf8(ran.stdout).unwrap();
    text.lines().map(|line| line.split(' ').map(|word| word.parse().unwrap()).collect()).collect()
}

/// The bound that the header states on a line, in its unit.
fn stated(folder: &Folder, what: &str) -> f64 {
    let header = std::fs::read_to_string(folder.path("robot.h")).unwrap();
    let line = header.lines().find_map(|line| line.strip_prefix(&format!(" *   {what}"))).unwrap().to_string();
    line.split_whitespace().next().unwrap().parse().unwrap()
}

#[test]
fn a_table_in_c_is_within_its_stated_bounds_of_the_model_at_random_pressures() {
    if !has_cc() {
        return;
    }
    for (name, effect) in [("epam", ""), ("fpam", ""), ("cpam-textbook", "gravity:weight_n_per_m=0.5")] {
        let folder = Folder::new();
        let mut scenario = Scenario::parse(shipped(name).unwrap()).unwrap();
        let mut args = vec![name, "--pressure", "0:40kPa"];
        if !effect.is_empty() {
            scenario = scenario.with_effect("gravity", &[0.5]);
            args.extend(["--effect", effect]);
        }
        let model = Model::new(&scenario);
        let mut state = model.prediction();
        let mut seed = 7_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let asked: Vec<[f64; 2]> = (0..2000).map(|_| [40e3 * random(), 1e-3 + 0.06 * random()]).collect();
        let lines: String = asked.iter().map(|[p, y]| format!("{p} {y}\n")).collect();
        let mut rows = answers(&folder, &args, &lines);
        let [tip, angle, slope] = ["tip", "angle", "slope"].map(|what| stated(&folder, what));
        let times = rows.pop().unwrap();
        for ([p, y], row) in asked.iter().zip(&rows) {
            let loads = Loads::uniform(scenario.p_body_pa, *p);
            let steep = model.jacobian(&loads, &mut state).unwrap()[0].y_per_pa;
            model.predict(&loads, &mut state).unwrap();
            let miss = 1e3 * (row[1] - state.tip.x_m).hypot(row[2] - state.tip.y_m);
            assert!(row[0] == 0.0 && miss <= tip, "{name} at {p} Pa: {miss} mm, stated {tip}");
            assert!((row[3] - state.tip.angle_rad).abs().to_degrees() <= angle, "{name} at {p} Pa");
            let flat = name == "epam" && *p < 2e3;
            assert!(row[4].is_finite() && (!flat || row[4] == 0.0), "{name} at {p} Pa: {}", row[4]);
            assert!(*p < 3e3 || 1e6 * (row[4] - steep).abs() <= slope, "{name} at {p} Pa: {} {steep}", row[4]);
            for (i, xy) in state.markers.iter().enumerate().filter(|(i, _)| row.len() > 7 + 2 * i) {
                let miss = 1e3 * (row[6 + 2 * i] - xy[0]).hypot(row[7 + 2 * i] - xy[1]);
                assert!(miss <= stated(&folder, "markers"), "{name} marker {i} at {p} Pa: {miss} mm");
            }
            model.predict(&Loads::uniform(scenario.p_body_pa, row[5]), &mut state).unwrap();
            assert!(1e3 * (state.tip.y_m - y).abs() <= tip, "{name}: {} Pa for {y} m gives {}", row[5], state.tip.y_m);
        }
        assert!(times.iter().all(|ns| *ns <= MOST_NS), "{name}: tip, slope, pressure take {times:?} ns");
        let start = Instant::now();
        for [_, y] in &asked[..200] {
            model.pressure_for(Target::TipHeight(*y), scenario.p_body_pa, &mut state).unwrap();
        }
        let library_ns = start.elapsed().as_secs_f64() / 200.0 * 1e9;
        println!("{name}: tip, slope, pressure in C {times:?} ns; the library's inverse {library_ns:.0} ns");
        assert!(times[2] < library_ns, "the table is there because it is quicker");
    }
}

#[test]
fn outside_its_range_a_table_says_so_and_gives_the_end() {
    if !has_cc() {
        return;
    }
    let rows =
        answers(&Folder::new(), &["epam", "--pressure", "5:40kPa"], "1e3 -1\n5e3 0.1\n4e4 0.1\n1e5 1\nnan nan\n");
    let outside: Vec<f64> = rows[..5].iter().map(|row| row[0]).collect();
    assert_eq!(outside, [3.0, 0.0, 0.0, 3.0, 3.0]);
    assert!((rows[0][1], rows[0][2]) == (rows[1][1], rows[1][2]) && rows[3][2] == rows[2][2]);
    assert!((rows[0][5] - 5e3).abs() < 1e-2 && (rows[3][5] - 4e4).abs() < 1e-2 && rows[4][1].is_finite(), "{rows:?}");
}

#[test]
fn what_a_table_cannot_hold_is_refused_with_the_way_out() {
    let folder = with_report();
    let cases: [(&[&str], &[&str]); 5] = [
        (&["epam", "--effect", "friction", "--effect", "creep"], &["friction, creep", "--loading"]),
        (&["epam", "--pressure", "40kPa"], &["not a range", "0:40kPa"]),
        (&["epam", "--pressure", "0:1kPa"], &["flat up to", "0:40kPa"]),
        (&["epam", "--out", "robot.txt"], &["does not end with .c"]),
        (&["two.toml"], &["2 supply channels"]),
    ];
    let two = format!("{}\n[[zone]]\nfrom_mm = 180\nto_mm = 360\nchannel = 1\n", shipped("epam-textbook").unwrap());
    folder.write("two.toml", two);
    for (args, words) in cases {
        refuse(&folder, &[&["export", "c"], args].concat(), 2, words);
    }
    let told = folder.run(&["export", "c", "epam", "--effect", "friction", "--loading", "--out", "first.c"]);
    let header = std::fs::read_to_string(folder.path("first.h")).unwrap();
    assert!(told.code == 0 && header.contains("FIRST LOADING FROM REST, AT ONCE: friction"), "{}", told.stderr);
}

#[test]
fn a_chain_for_simulators_and_a_unit_are_files_that_are_replaced_only_when_asked() {
    let folder = Folder::new();
    for (format, file) in [("mjcf", "robot.xml"), ("urdf", "robot.urdf"), ("fmu", "robot.fmu")] {
        let range = if format == "fmu" { "0:40kPa" } else { "20kPa" };
        let typed = ["export", format, "epam", "--pressure", range];
        let ran = folder.run(&typed);
        let first = std::fs::read(folder.path(file)).unwrap();
        assert!(ran.code == 0 && first.len() > 1000, "{}", ran.stderr);
        let again = folder.run(&typed);
        assert!(again.code == 2 && again.stderr.contains("--force"), "{}", again.stderr);
        assert_eq!(folder.run(&[&typed[..], &["--force"]].concat()).code, 0);
        assert_eq!(std::fs::read(folder.path(file)).unwrap(), first, "equal input, equal bytes");
    }
    let joints = std::fs::read_to_string(folder.path("robot.xml")).unwrap().matches("<joint name=").count();
    assert_eq!((joints, &std::fs::read(folder.path("robot.fmu")).unwrap()[..2]), (6, &b"PK"[..]));
    let folder = with_report();
    let flat: &[&str] = &["cannot export a chain", "flat at", "--pressure 20kPa"];
    let collapsed: &[&str] = &["does not hold", "the body folds", "--pressure"];
    let heavy = "tip_load:force_y_n=-4";
    let cases: [(&[&str], &[&str]); 11] = [
        (&["mjcf", "epam", "--pressure", "0kPa"], flat),
        (&["urdf", "epam", "--pressure", "1kPa"], flat),
        (&["linear", "epam", "--pressure", "0kPa"], flat),
        (&["c", "epam", "--pressure", "10:40kPa", "--effect", heavy], collapsed),
        (&["fmu", "epam", "--pressure", "10:40kPa", "--effect", heavy], collapsed),
        (&["linear", "epam", "--pressure", "20kPa", "--effect", heavy], collapsed),
        (&["mjcf", "epam", "--pressure", "20kPa", "--effect", heavy], collapsed),
        (&["urdf", "epam", "--pressure", "20kPa", "--effect", heavy], collapsed),
        (&["urdf", "epam", "--pressure", "20kPa", "--mass", "0"], &["--mass is 0 kg/m", "--mass 0.1"]),
        (&["mjcf", "cpam", "--pressure", "60kPa", "--joints", "1"], &["joint 1 is bent by", "--joints 4"]),
        (&["fmu", "epam", "--out", "robot.c"], &["does not end with .fmu"]),
    ];
    for (args, words) in cases {
        refuse(&folder, &[&["export"], args].concat(), 2, words);
    }
}

/// Rows of a table of docs/control.md, without its head.
fn published_rows() -> Vec<[f64; 6]> {
    let text = std::fs::read_to_string(repository().join("data/sets/jitosho-2023-arm/joint_model.csv")).unwrap();
    let scenario = repository().join("data/sets/jitosho-2023-arm/scenario.toml");
    let args = ["export", "linear", scenario.to_str().unwrap(), "--pressure", "3psi", "--json"];
    let chain = Folder::new().run(&args).json("ibr.export.linear");
    let rows = text.lines().skip(1).zip(chain["joints"].as_array().unwrap()).map(|(line, joint)| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let of = |key: &str| joint[key].as_f64().unwrap();
        let (k, b) = (of("k_nm_per_rad"), joint["b_nm_per_kpa"][0].as_f64().unwrap() * 6.894_757_293_168);
        [cells[2], k, cells[5], b, cells[5] / cells[2], b / k]
    });
    rows.collect()
}

#[test]
fn the_published_chain_stands_beside_the_predicted_one_in_the_document() {
    let rows = published_rows();
    assert_eq!(rows.len(), 5);
    let digits = |[kp, k, bp, b, rp, r]: &[f64; 6]| format!("{kp:.2} | {k:.1} | {bp:.4} | {b:.2} | {rp:.3} | {r:.3} |");
    let lines: Vec<String> = rows.iter().enumerate().map(|(i, row)| format!("| {} | {}", i + 1, digits(row))).collect();
    let page = std::fs::read_to_string(repository().join("docs/control.md")).unwrap();
    assert!(page.contains(&lines.join("\n")), "docs/control.md should have\n{}", lines.join("\n"));
    // What the page says of it: eight to nine times as large, B/K near the published mean.
    let mean = |i: usize| rows.iter().map(|row| row[i]).sum::<f64>() / 5.0;
    let [k, b, turn] = [mean(1) / mean(0), mean(3) / mean(2), mean(5) / mean(4)];
    assert!((8.0..9.5).contains(&k) && (8.0..9.5).contains(&b) && (0.8..1.25).contains(&turn), "{k} {b} {turn}");
}

/// Code of the page: C goes into main.c, shell is run.
#[test]
fn the_examples_of_the_document_run_as_they_stand() {
    if !has_cc() {
        return;
    }
    let page = std::fs::read_to_string(repository().join("docs/control.md")).unwrap();
    let folder = Folder::new();
    let block = |kind: &str| {
        let start = format!("```{kind}\n");
        let parts = page.split(&start).skip(1);
        parts.map(|part| part.split("```").next().unwrap().to_string()).collect::<Vec<_>>()
    };
    folder.write("main.c", &block("c")[0]);
    let bin = std::path::Path::new(env!("CARGO_BIN_EXE_ibr")).parent().unwrap();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let mut told = String::new();
    for script in block("sh") {
        let mut sh = Command::new("sh");
        sh.args(["-ec", &script]).env("PATH", &path).env("NO_COLOR", "1").current_dir(folder.path(""));
        let ran = sh.output().unwrap();
        told += &String::from_utf8_lossy(&ran.stdout);
        let stderr = String::from_utf8_lossy(&ran.stderr);
        assert!(ran.status.success(), "{script}\n{stderr}");
        told += &stderr;
    }
    for words in ["kPa: x 3", "y 60.0 mm", "channel 0 is at its largest pressure", "0.3,", "K [N m/rad]", "\"joints\""]
    {
        assert!(told.contains(words), "no `{words}` in\n{told}");
    }
}
