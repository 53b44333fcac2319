//! `ibr predict`: inverse, several channels, limits of pressure, refusals.

use crate::refused::{refuse, with_report};
use crate::support::Folder;
use serde_json::Value;

fn state(args: &[&str]) -> Value {
    let answer = Folder::new().run(&[args, &["--json"]].concat()).json("ibr.predict");
    answer["states"][0].clone()
}

#[test]
fn the_pressure_for_a_wanted_tip_gives_that_tip_when_predicted() {
    for robot in ["spam", "cpam", "epam", "fpam"] {
        for (target, place) in [("tip=60mm", "y_mm"), ("angle=15deg", "angle_deg")] {
            let wanted: f64 = target.trim_matches(|c: char| !c.is_ascii_digit()).parse().unwrap();
            let found = state(&["predict", robot, "--inverse", target]);
            let pressure = format!("{}kPa", found["p_act_kpa"]);
            let back = state(&["predict", robot, "--pressure", &pressure]);
            let reached = back["tip"][place].as_f64().unwrap();
            assert!((reached - wanted).abs() < 1e-3, "{robot} {target}: {reached} at {pressure}");
        }
    }
}

#[test]
fn a_tip_out_of_reach_is_answered_with_the_reachable_range() {
    let words = ["tip height 900", "out of reach", "pressures from 0 to 100 kPa give 0.0000 to 190.2"];
    refuse(&with_report(), &["predict", "epam-textbook", "--inverse", "tip=900mm", "--out", "report"], 4, &words);
    let words = ["bending angle 200", "out of reach", "91.4", "deg"];
    refuse(&with_report(), &["predict", "epam-textbook", "--inverse", "angle=200deg"], 4, &words);
}

#[test]
fn a_load_that_the_body_cannot_carry_is_said_to_be_close_to_collapse() {
    let folder = with_report();
    let text = models::shipped("epam-textbook").unwrap();
    let long = text.replace("length_mm = 360", "length_mm = 2400").replace("count = 6", "count = 40");
    folder.write("long.toml", long);
    let args = ["predict", "long.toml", "--pressure", "1kPa", "--effect", "gravity", "--out", "report"];
    refuse(&folder, &args, 4, &["P = 1.000 kPa", "collapse"]);
}

#[test]
fn a_robot_of_two_metres_and_forty_pouches_is_predicted() {
    let folder = Folder::new();
    let text = models::shipped("epam-textbook").unwrap();
    folder.write("long.toml", text.replace("length_mm = 360", "length_mm = 2400").replace("count = 6", "count = 40"));
    let ran = folder.run(&["predict", "long.toml", "--pressure", "1kPa", "--json"]);
    let tip = &ran.json("ibr.predict")["states"][0]["tip"];
    // Same pressure, same curvature: the angle grows with the length.
    let short = state(&["predict", "epam-textbook", "--pressure", "1kPa"]);
    let ratio = tip["angle_deg"].as_f64().unwrap() / short["tip"]["angle_deg"].as_f64().unwrap();
    assert!((ratio - 2400.0 / 360.0).abs() < 1e-9, "{ratio}");
}

#[test]
fn supply_channels_and_zones_are_told_apart() {
    let folder = Folder::new();
    let mut text = models::shipped("epam-textbook").unwrap().to_string();
    text.push_str("\n[[zone]]\nfrom_mm = 180\nto_mm = 360\nchannel = 1\n");
    folder.write("two.toml", text);
    let angle = |pressure: &str| {
        let ran = folder.run(&["predict", "two.toml", "--pressure", pressure, "--json"]);
        ran.json("ibr.predict")["states"][0]["tip"]["angle_deg"].as_f64().unwrap()
    };
    let (both, near, far) = (angle("10kPa"), angle("10kPa/0kPa"), angle("0kPa/10kPa"));
    assert!((near + far - both).abs() < 1e-9 && (near - far).abs() < 1e-9, "{near} {far} {both}");
}

#[test]
fn ten_thousand_pressures_are_predicted_in_one_call() {
    let list: Vec<String> = (1..=10_000).map(|i| format!("{}Pa", 3 * i)).collect();
    let answer =
        Folder::new().run(&["predict", "epam-textbook", "--pressure", &list.join(","), "--json"]).json("ibr.predict");
    let states = answer["states"].as_array().unwrap();
    let heights: Vec<f64> = states.iter().map(|s| s["tip"]["y_mm"].as_f64().unwrap()).collect();
    assert_eq!(heights.len(), 10_000);
    assert!(heights.windows(2).all(|pair| pair[1] > pair[0]), "more pressure lifts the tip of this robot");
}

#[test]
fn a_pressure_above_the_limit_of_the_scenario_is_predicted_with_a_warning() {
    let ran = Folder::new().run(&["predict", "epam-textbook", "--pressure", "250kPa"]);
    assert_eq!(ran.code, 0);
    assert!(ran.stderr.contains("250 kPa is above max_pressure_kpa = 100"), "{}", ran.stderr);
}

#[test]
fn units_of_one_pressure_give_one_answer() {
    let pressures = "10kPa,0.1bar,10000Pa,0.01MPa,1.450377377psi";
    let answer =
        Folder::new().run(&["predict", "cpam-textbook", "--pressure", pressures, "--json"]).json("ibr.predict");
    let heights: Vec<f64> =
        answer["states"].as_array().unwrap().iter().map(|s| s["tip"]["y_mm"].as_f64().unwrap()).collect();
    assert!(heights.iter().all(|y| (y - heights[0]).abs() < 1e-6), "{heights:?}");
}

#[test]
fn a_pole_of_a_formula_is_no_equilibrium() {
    let folder = with_report();
    let own = "[[formula]]\nname = \"own\"\nmoment = \"A*kappa/(1 - kappa*R*10)\"\n[formula.parameters.A]\nunit = \"N m2\"\n\
               typical = 0.5\nbounds = [0, 20]\n[effects.own]\nA = 0.5\n";
    folder.write("pole.toml", format!("{}\n{own}", models::shipped("epam-textbook").unwrap()));
    let words = ["no equilibrium", "the formula own", "kappa = 2.50 1/m"];
    refuse(&folder, &["predict", "pole.toml", "--pressure", "10kPa", "--out", "report"], 4, &words);
}

#[test]
fn an_offset_below_zero_is_continuous_and_the_inverse_gives_what_was_asked() {
    let found =
        state(&["predict", "epam-textbook", "--effect", "pressure_offset:offset_kpa=-1", "--inverse", "tip=30mm"]);
    assert!((found["tip"]["y_mm"].as_f64().unwrap() - 30.0).abs() < 1e-6, "{found}");
}

#[test]
fn a_pose_beyond_collapse_is_told_and_a_flat_pouch_has_no_slope() {
    let folder = Folder::new();
    let beam = "[body]\nradius_mm = 80\nlength_mm = 1000\npressure_kpa = 30\nbending_stiffness_nm2 = 50\n\
                wall_stiffness_n_per_m = 178000\n[effects.tip_load]\nforce_y_n = -60\nbasis = \"measured\"\n";
    folder.write("beam.toml", beam);
    let ran = folder.run(&["predict", "beam.toml"]);
    assert!(ran.code == 0 && ran.stderr.contains("times what the wall and the pull can carry"), "{}", ran.stderr);
    let flat = folder.run(&["predict", "epam-textbook", "--pressure", "0kPa", "--json"]).json("ibr.predict");
    assert!(
        flat["states"][0]["jacobian"][0]["y_mm_per_kpa"].is_null()
            && flat["states"][0]["beyond"] == serde_json::json!([])
    );
}

#[test]
fn a_straight_robot_folds_where_its_weight_reaches_the_moment_of_the_pressure() {
    let args = ["predict", "epam-textbook", "--limits", "--effect", "gravity:weight_n_per_m=1.5", "--json"];
    let answer = Folder::new().run(&args).json("ibr.predict.limits");
    let length = |i: usize| answer["collapse"][i]["length_mm"].as_f64().unwrap();
    // w L²/2 = π p_b R³, longer by what its sag shortens the lever.
    let straight = 1e3 * (2.0 * std::f64::consts::PI * 2e3 * 0.04_f64.powi(3) / 1.5).sqrt();
    assert!(length(0) > straight && length(0) < 1.02 * straight, "{} {straight}", length(0));
    assert!(length(3) > length(0), "a steered robot has a shorter lever");
}

#[test]
fn a_place_is_reached_by_the_pressures_of_two_channels_or_the_limit_that_holds_is_told() {
    let folder = Folder::new();
    let two = "\n[[zone]]\nfrom_mm = 180\nto_mm = 360\nchannel = 1\n";
    folder.write("two.toml", models::shipped("epam-textbook").unwrap().to_string() + two);
    let answer = folder.run(&["predict", "two.toml", "--inverse", "300mm,120mm", "--json"]).json("ibr.predict");
    let (state, nearest) = (&answer["states"][0], &answer["nearest"]);
    assert!(nearest["miss_mm"].as_f64().unwrap() < 1e-6 && nearest["held_back"] == serde_json::json!([]), "{nearest}");
    let [p0, p1] = [0, 1].map(|i| state["p_act_channels_kpa"][i].as_f64().unwrap());
    let back = folder.run(&["predict", "two.toml", "--pressure", &format!("{p0}kPa/{p1}kPa"), "--json"]);
    let tip = &back.json("ibr.predict")["states"][0]["tip"];
    assert!(
        (tip["x_mm"].as_f64().unwrap() - 300.0).abs() < 1e-6 && (tip["y_mm"].as_f64().unwrap() - 120.0).abs() < 1e-6
    );
    let ran = folder.run(&["predict", "two.toml", "--inverse", "300mm,250mm"]);
    assert!(ran.code == 0 && ran.stderr.contains("channel 0 is at its largest pressure, 100 kPa"), "{}", ran.stderr);
    refuse(&with_report(), &["predict", "epam", "--inverse", "300mm,x"], 2, &["not a quantity"]);
}

#[test]
fn lines_of_a_stream_are_answered_before_the_next_one_comes() {
    use std::io::{BufRead, BufReader, Write};
    let folder = Folder::new();
    let mut command = folder.ibr(&["predict", "epam", "--follow"]);
    let piped = std::process::Stdio::piped;
    let mut running = command.stdin(piped()).stdout(piped()).stderr(piped()).spawn().unwrap();
    let (mut input, output) = (running.stdin.take().unwrap(), running.stdout.take().unwrap());
    let mut lines = BufReader::new(output).lines().map(Result::unwrap);
    for (given, answered) in
        [("t_s,p_kpa", "t_s,x_mm,y_mm,angle_deg,p0_kpa,mark"), ("0,0", "0,360.0000,0.0000,0.0000,0.0000,")]
    {
        writeln!(input, "{given}").unwrap();
        assert_eq!(lines.next().unwrap(), answered);
    }
    writeln!(input, "1,many").unwrap();
    assert_eq!(lines.next().unwrap(), "1,360.0000,0.0000,0.0000,0.0000,held");
    drop(input);
    let ended = running.wait_with_output().unwrap();
    let told = String::from_utf8_lossy(&ended.stderr).into_owned();
    assert!(
        ended.status.code() == Some(0) && told.contains("1 of 2 lines are marked held, the first is line 3"),
        "{told}"
    );
    refuse(&with_report(), &["predict", "epam", "--follow", "--json"], 2, &["leave out --json"]);
}

#[test]
fn strips_round_the_body_bend_it_out_of_the_plane() {
    let equal = state(&["predict", "epam-two-strips", "--pressure", "20kPa"]);
    let [y, z] = ["y_mm", "z_mm"].map(|key| equal["tip"][key].as_f64().unwrap());
    assert!(y > 20.0 && (y - z).abs() < 1e-6, "{y} {z}");
    assert_eq!(equal["sections"][0]["tension_n"].as_array().unwrap().len(), 2);
    let more = state(&["predict", "epam-two-strips", "--pressure", "20kPa/10kPa"]);
    assert!(more["tip"]["y_mm"].as_f64().unwrap() > more["tip"]["z_mm"].as_f64().unwrap());
    let folder = Folder::new();
    let drawn = folder.run(&["predict", "epam-helix", "--pressure", "20kPa", "--out", "seen"]);
    assert_eq!(drawn.code, 0, "{}", drawn.stderr);
    assert!(drawn.stdout.contains("tip z [mm]") && drawn.stdout.contains("x, y, z [mm]"), "{}", drawn.stdout);
    for side in ["shapes", "shapes_z"] {
        assert!(folder.path(&format!("seen/{side}.svg")).exists(), "{side}");
    }
}

#[test]
fn values_of_the_scenario_can_be_typed() {
    let folder = Folder::new();
    let epam = models::shipped("epam").expect("shipped");
    folder.write(
        "mine.toml",
        epam.replace("width_mm = 60 ", "width_mm = 50 ").replace("radius_mm = 40 ", "radius_mm = 45 "),
    );
    let asked = |words: &[&str]| folder.run(&[words, &["--pressure", "20kPa", "--json"]].concat()).json("ibr.predict");
    let tip = |words: &[&str]| asked(words)["states"][0]["tip"].clone();
    let typed = tip(&["predict", "epam", "--set", "actuator.width_mm=50", "--set", "body.radius_mm = 45"]);
    assert_eq!(typed, tip(&["predict", "mine.toml"]));
    let [plain, turned] =
        ["0", "90"].map(|angle| tip(&["predict", "epam", "--set", &format!("actuator.azimuth_deg={angle}")]));
    assert_eq!((&turned["y_mm"], &turned["z_mm"]), (&0.0.into(), &plain["y_mm"]));
    assert_ne!(plain["y_mm"], typed["y_mm"]);
    for (set, code, words) in [
        ("body.radius_mn=45", 3, "unknown field `radius_mn`"),
        ("body.radius_mm=45mm", 2, "is not a TOML value"),
        ("body.radius_mm", 2, "the = is missing"),
        ("strip.1.azimuth_deg=9", 3, "expected a sequence"),
    ] {
        refuse(&with_report(), &["predict", "epam", "--set", set], code, &[words]);
    }
}

#[test]
fn what_is_not_built_in_space_is_refused() {
    let robot = "epam-two-strips";
    let words = ["strips round the body", "ibr predict, compare and diagnose take it"];
    for args in [vec!["predict", robot, "--follow"], vec!["export", "linear", robot]] {
        let ran = Folder::new().run(&args);
        assert!(ran.code != 0 && words.iter().all(|word| ran.stderr.contains(word)), "{args:?}: {}", ran.stderr);
    }
}

#[test]
fn an_inverse_has_the_interval_of_the_unmeasured_numbers_and_a_bare_robot_has_none() {
    let answer = Folder::new().run(&["predict", "epam", "--inverse", "tip=100mm", "--json"]).json("ibr.predict");
    let (found, state) = (&answer["pressure_interval"], &answer["states"][0]);
    let [low, high, at] =
        [&found["p_kpa"][0], &found["p_kpa"][1], &state["p_act_kpa"]].map(|kpa| kpa.as_f64().unwrap());
    assert!(low < at && at < high && found["numbers"].as_array().unwrap().len() == 4, "{found}");
    let bare = Folder::new().run(&["predict", "epam-textbook", "--inverse", "tip=100mm", "--json"]).json("ibr.predict");
    assert!(bare.get("pressure_interval").is_none());
}
