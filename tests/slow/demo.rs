//! `ibr demo`: the whole story in one report, with a real finite element run, in less than two minutes.

use crate::alone;
use crate::support::{Folder, assert_hashes, assert_opens_offline};
use std::time::Instant;

#[test]
fn demo_tells_the_story_in_text_json_and_a_report_in_less_than_two_minutes() {
    let _alone = alone();
    let folder = Folder::new();
    let start = Instant::now();
    let ran = folder.run(&["demo", "--out", "report"]);
    let text_s = start.elapsed().as_secs_f64();
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let row = |model: &str| {
        let found = ran.stdout.lines().find(|line| line.starts_with("| ePAMs") && line.contains(model));
        found.unwrap_or_else(|| panic!("no row {model} in {}", ran.stdout)).to_string()
    };
    let (bare, weld, sealed) = (row("bare model"), row("+ weld_width"), row("+ sealed_sides"));
    assert!(bare.contains("161.6") && bare.contains("119.4") && bare.contains("predicted"), "{bare}");
    assert!(weld.contains("156.8") && weld.contains("assumed"), "{weld}");
    assert!(sealed.contains("117.9") && sealed.contains("119.4") && sealed.contains("predicted"), "{sealed}");
    assert!(ran.stdout.contains("calibrated"), "what was fitted is called so");

    let names = assert_hashes(&folder.path("report"));
    for ending in [".html", ".png", ".svg", ".csv"] {
        assert!(names.iter().any(|name| name.ends_with(ending)), "{ending} of {names:?}");
    }
    let page = std::fs::read_to_string(folder.path("report/report.html")).unwrap();
    assert_opens_offline(&page);
    for number in ["161.6", "117.9", "119.4", "159.7", "67.5", "67.2"] {
        assert!(page.contains(number), "{number}");
    }

    let start = Instant::now();
    let answer = folder.run(&["demo", "--out", "report", "--json"]).json("ibr.demo");
    let json_s = start.elapsed().as_secs_f64();
    assert_eq!(answer["published"].as_array().unwrap().len(), 4, "four actuators");
    assert_eq!(answer["marker_sets"].as_array().unwrap().len(), 5);
    let diagnosis = &answer["diagnosis"];
    assert_eq!(diagnosis["added"][0]["effect"], "end_constraint", "{}", diagnosis["summary"]);
    assert!(ran.stdout.contains("What is missing in ePAM") && page.contains("id=\"diagnosis-missing\""));
    println!("demo: {text_s:.1} s and {json_s:.1} s");
    assert!(text_s.min(json_s) < 120.0, "{text_s:.1} s and {json_s:.1} s");
}
