//! Robots with strips round the body held against measurements in x, y and z.

use crate::refused::refuse;
use crate::support::Folder;
use serde_json::Value;

const ROBOT: &str = "epam-two-strips";

fn made(protocol: &str) -> Folder {
    let folder = Folder::new();
    let ran = folder.run(&["data", "generate", ROBOT, "--protocol", protocol, "--out", "made"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    folder
}

#[test]
fn a_robot_with_strips_is_held_against_data_in_space() {
    let folder = made("0/0,20/10,10/25,0/0@2");
    let csv = std::fs::read_to_string(folder.path("made/markers.csv")).unwrap();
    assert!(csv.starts_with("run,actuator,t_s,p_body_kpa,p_act_kpa,p_act_1_kpa,phase,marker,x_mm,y_mm,z_mm,s_mm\n"));
    let checked = folder.run(&["data", "check", "made"]);
    assert!(
        checked.stdout.contains("20.00/10.00") && checked.stdout.contains("z varies by up to"),
        "{}",
        checked.stdout
    );
    let ran = folder.run(&["compare", ROBOT, "made", "--effect", "pressure_loss:fraction=0.2", "--out", "report"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    for word in ["in x, y and z", "20/10 kPa load", "tip error x, y, z mm", "were left out", "+ pressure_loss"] {
        assert!(ran.stdout.contains(word), "{word}: {}", ran.stdout);
    }
    for file in ["report.html", "shapes.svg", "shapes_z.svg", "markers.csv"] {
        assert!(folder.path(&format!("report/{file}")).exists(), "{file}");
    }
    let found = folder.run(&["compare", ROBOT, "made", "--effect", "pressure_loss:fraction=0.2", "--json"]);
    let found: Value = found.json("ibr.compare.space");
    let errors = |k: usize| found["models"][k]["overall"]["systematic_mm"].as_f64().unwrap();
    assert!(errors(0) < 0.5 && errors(1) > 1.0, "{} {}", errors(0), errors(1));
    assert_eq!(found["axes"], 3);
    // A robot that comes with its data needs no name.
    folder.write("made/scenario.toml", std::fs::read(folder.path("made/truth.toml")).unwrap());
    let own = folder.run(&["compare", "made", "--json"]).json("ibr.compare.space");
    assert_eq!((&own["scenario"], &own["overall"]), (&Value::from("its own"), &found["overall"]));
    assert_eq!(folder.run(&["data", "check", "made"]).code, 0);
    assert_eq!(folder.run(&["compare", "made", "--max-error", "1mm", "--sigma", "1mm"]).code, 0);
    let loose = ["compare", "made", "--effect", "pressure_loss:fraction=0.2", "--max-error", "1mm"];
    assert_eq!(folder.run(&loose).code, 1);
    assert_eq!(folder.run(&["compare", "epam-helix", "made", "--json"]).code, 2);
}

#[test]
fn what_does_not_fit_in_space_is_refused_with_a_remedy() {
    let folder = made("0/0,20/10,10/25,0/0@2");
    let words = ["nothing is supplied by channel 1", "p_act_1_kpa"];
    for robot in ["epam", "epam-helix"] {
        refuse(&folder, &["compare", robot, "made"], 2, &words);
    }
    refuse(&folder, &["compare", ROBOT, "made", "--calibrate"], 2, &["--calibrate is built for planar robots"]);
    refuse(&folder, &["diagnose", "epam", "made"], 3, &["pressures of 2 supply channels", "ibr compare"]);
    refuse(&folder, &["diagnose", ROBOT, "made"], 3, &["strips round the body", "ibr compare take"]);
    let few = ["data", "generate", ROBOT, "--protocol", "0/0,10@2", "--out", "other"];
    refuse(&folder, &few, 2, &["holds have 2 and 1 channels"]);
    let lost = ["data", "generate", "epam", "--protocol", "0/0,10/20@2", "--out", "other"];
    refuse(&folder, &lost, 2, &["nothing is supplied by channel 1"]);
}

#[test]
fn z_beside_a_planar_robot_is_told_or_refused() {
    let folder = Folder::new();
    let csv = data::set_file("synthetic-epam", "markers.csv").unwrap();
    let with_z = |z: &dyn Fn(usize) -> String| -> String {
        let line = |(i, line): (usize, &str)| format!("{line},{}\n", if i == 0 { "z_mm".into() } else { z(i) });
        csv.lines().enumerate().map(line).collect()
    };
    folder.write("plain.csv", csv);
    folder.write("flat.csv", with_z(&|_| "0".into()));
    folder.write("wobbly.csv", with_z(&|i| format!("{:.1}", (i % 7) as f64 * 0.3)));
    let compared = |file: &str| folder.run(&["compare", "epam-textbook", file, "--json"]).json("ibr.compare");
    let (plain, flat, wobbly) = (compared("plain.csv"), compared("flat.csv"), compared("wobbly.csv"));
    assert_eq!((&plain["overall"], &plain["holds"]), (&flat["overall"], &flat["holds"]));
    assert_eq!(plain["overall"], wobbly["overall"]);
    let told = |found: &Value| found["warnings"].to_string().contains("z varies by up to");
    assert!(told(&wobbly) && !told(&flat) && !told(&plain), "{}", wobbly["warnings"]);
    folder.write("turned.csv", csv.replace("y_mm,s_mm", "z_mm,y_mm"));
    refuse(&folder, &["compare", "epam-textbook", "turned.csv"], 3, &["towards z", "exchange the names"]);
    refuse(&folder, &["diagnose", "epam-textbook", "turned.csv"], 3, &["towards z", "exchange the names"]);
}
