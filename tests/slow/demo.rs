//! `ibr demo`: the whole story in five panels.

use crate::alone;
use crate::support::{Folder, assert_hashes, assert_opens_offline};
use std::time::Instant;

#[test]
fn demo_tells_the_story_in_five_panels_and_the_error_falls() {
    let _alone = alone();
    let folder = Folder::new();
    let start = Instant::now();
    let ran = folder.run(&["demo", "--out", "report"]);
    let seconds = start.elapsed().as_secs_f64();
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    assert!(ran.stdout.lines().count() <= 45, "{}", ran.stdout);
    for panel in ["1. This is a vine robot", "2. A model", "3. Which effect", "4. Add them", "5. Where the analytic"] {
        assert!(ran.stdout.lines().any(|line| line.starts_with(panel)), "{panel}: {}", ran.stdout);
    }

    let names = assert_hashes(&folder.path("report"));
    for name in ["robot.svg", "residuals.png", "missing_moment.svg", "waterfall.svg", "breaking.svg", "engines.csv"] {
        assert!(names.iter().any(|own| own == name), "{name} of {names:?}");
    }
    let page = std::fs::read_to_string(folder.path("report/report.html")).unwrap();
    assert_opens_offline(&page);
    assert!(!page.contains("{%") && !page.contains("{{"));
    for id in 1..=5 {
        assert!(page.contains(&format!("id=\"panel-{id}\"")));
    }

    let answer = folder.run(&["demo", "--out", "report", "--json"]).json("ibr.demo");
    let errors = |key: &str| -> Vec<f64> {
        answer["steps"].as_array().unwrap().iter().map(|step| step[key].as_f64().unwrap()).collect()
    };
    let (fitted, left_out) = (errors("error_mm"), errors("left_out_mm"));
    assert!(fitted.windows(2).all(|pair| pair[1] < pair[0]), "{fitted:?}");
    assert!(left_out[left_out.len() - 1] < 0.5 * left_out[0], "{left_out:?}");
    println!("demo: {seconds:.1} s");
    assert!(seconds < 120.0, "{seconds:.1} s");
}
