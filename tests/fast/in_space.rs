//! Robots with strips round the body held against measurements in x, y and z.

use crate::refused::refuse;
use crate::support::Folder;
use serde_json::Value;

const ROBOT: &str = "epam-two-strips";

fn made(protocol: &str) -> Folder {
    let folder = Folder::new();
    let ran = folder.run(&["data", "generate", ROBOT, "--protocol", protocol, "--scatter", "white", "--out", "made"]);
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
    for word in
        ["camera noise", "20/10 kPa load", "tip error x mm", "tip distance mm", "+ pressure_loss", "P/p scaling"]
    {
        assert!(ran.stdout.contains(word), "{word}: {}", ran.stdout);
    }
    for file in ["report.html", "shapes.svg", "shapes_z.svg", "residual_map.svg", "holds.csv"] {
        assert!(folder.path(&format!("report/{file}")).exists(), "{file}");
    }
    let found = folder.run(&["compare", ROBOT, "made", "--effect", "pressure_loss:fraction=0.2", "--json"]);
    let found: Value = found.json("ibr.compare");
    let errors = |k: usize| found["models"][k]["overall"]["systematic_mm"].as_f64().unwrap();
    assert!(errors(0) < 0.5 && errors(1) > 1.0, "{} {}", errors(0), errors(1));
    let p_values = [0, 1].map(|k| found["models"][k]["overall"]["p_value"].as_f64().unwrap());
    assert!(p_values[0] > 1e-3 && p_values[1] < 1e-5, "{p_values:?}");
    let hold = &found["holds"][1];
    assert_eq!(hold["p_act_channels_kpa"], serde_json::json!([20.0, 10.0]));
    assert!(hold["tip_error_z_mm"].is_number() && found["residual_map"]["cells"][0][0]["z"].is_object());
    let fitted = folder.run(&["compare", ROBOT, "made", "--calibrate", "--json"]).json("ibr.compare");
    assert!(fitted["models"][1]["label"].as_str().unwrap().starts_with("+ bending B = "), "{}", fitted["models"][1]);
    // A robot that comes with its data needs no name.
    folder.write("made/scenario.toml", std::fs::read(folder.path("made/truth.toml")).unwrap());
    let own = folder.run(&["compare", "made", "--json"]).json("ibr.compare");
    assert_eq!((&own["scenario"], &own["overall"]), (&Value::from("its own"), &found["overall"]));
    assert_eq!(folder.run(&["data", "check", "made"]).code, 0);
    assert_eq!(folder.run(&["compare", "made", "--max-error", "1mm", "--sigma", "1mm"]).code, 0);
    let loose = ["compare", "made", "--effect", "pressure_loss:fraction=0.2", "--max-error", "1mm"];
    assert_eq!(folder.run(&loose).code, 1);
    assert_eq!(folder.run(&["compare", "epam-helix", "made", "--json"]).code, 2);
}

#[test]
fn a_robot_with_strips_is_diagnosed_and_its_table_checked() {
    let folder = made("0/0,20/0,30/10,30/30,10/30,0/20,0/0@2");
    let truth = std::fs::read_to_string(folder.path("made/truth.toml")).unwrap();
    folder.write("lacking.toml", truth.replace("[effects.chord_arm]\nshare = 1\nbasis = \"predicted\"\n", ""));
    let found = folder.run(&["diagnose", "lacking.toml", "made", "--json", "--out", "report"]).json("ibr.diagnose");
    assert_eq!((&found["verdict"], &found["indistinguishable"][0]), (&"effect".into(), &"chord_arm".into()));
    assert!(found["limits"].to_string().contains("not built for strips round the body"), "{}", found["limits"]);
    assert!(folder.path("report/residuals_before.svg").exists());
    let csv = std::fs::read_to_string(folder.path("made/markers.csv")).unwrap();
    folder.write("turned.csv", csv.replace("x_mm,y_mm,z_mm", "x_mm,z_mm,y_mm"));
    let told = |out: &str| out.contains("y and z look exchanged") || out.contains("channels 0 and 1 look exchanged");
    for (file, is_told) in [("made", false), ("turned.csv", true)] {
        let checked = folder.run(&["data", "check", file, ROBOT]);
        assert_eq!(told(&checked.stdout), is_told, "{file}: {}", checked.stdout);
    }
    let compared = folder.run(&["compare", ROBOT, "turned.csv", "--json"]).json("ibr.compare");
    assert!(told(&compared["warnings"][0].to_string()), "{}", compared["warnings"]);
}

#[test]
fn what_does_not_fit_in_space_is_refused_with_a_remedy() {
    let folder = made("0/0,20/10,10/25,0/0@2");
    let words = ["nothing is supplied by channel 1", "p_act_1_kpa"];
    for verb in ["compare", "diagnose"] {
        refuse(&folder, &[verb, "epam-helix", "made"], 2, &words);
        refuse(&folder, &[verb, "epam", "made"], 3, &["towards z", "the robot is planar"]);
    }
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
