//! A wish that some design has is found; one that none has is told with what holds it back.

use super::*;
use crate::sample::{Method, Points};
use compare::ScenarioFile;
use models::{Loads, Model};
use std::ops::ControlFlow;
use std::path::Path;

const FREE: &str = r#"
[[free]]
key = "actuator.width_mm"
from = 40
to = 70
[[free]]
key = "actuator.count"
values = [4, 5, 6]
[[free]]
key = "pressure_kpa"
from = 5
to = 30
"#;

fn wish(text: &str) -> Result<Wish, String> {
    let told = |error: compare::CompareError| format!("{error} {}", error.help().unwrap_or_default());
    Wish::parse("wish.toml", text, Path::new(""), ScenarioFile::read).map_err(told)
}

fn found(wish: &Wish) -> Design {
    design(wish, &mut |_, _| ControlFlow::Continue(())).unwrap()
}

/// Tip of the ePAM with values of [`FREE`].
fn tip(width_mm: f64, count: usize, kpa: f64) -> [f64; 2] {
    let set = [("actuator.width_mm".into(), format!("{width_mm}")), ("actuator.count".into(), format!("{count}"))];
    let file = ScenarioFile::read("epam").unwrap().with(&set).unwrap();
    let model = Model::new(&file.scenario);
    let mut at = model.prediction();
    model.predict(&Loads::uniform(file.p_body_pa, 1e3 * kpa), &mut at).unwrap();
    [1e3 * at.tip.x_m, 1e3 * at.tip.y_m]
}

#[test]
fn wishes_that_hidden_designs_have_are_reached() {
    let hidden = Points::new(Method::LatinHypercube, 10, 3, 20).unwrap();
    let reached = (0..10).filter(|k| {
        let [w, c, p] = [0, 1, 2].map(|i| hidden.of(*k)[i]);
        let [x, y] = tip(40.0 + 30.0 * w, 4 + (3.0 * c) as usize, 5.0 + 25.0 * p);
        let wish = wish(&format!("scenario = \"epam\"\n[wish]\ntip_mm = [{x}, {y}]\n{FREE}")).unwrap();
        let found = found(&wish);
        // The robot that is written has the shape that is told.
        let own = Model::new(&found.file.scenario);
        let mut at = own.prediction();
        own.predict(&found.loads, &mut at).unwrap();
        assert_eq!(at.tip, found.pose.tip);
        assert!((found.file.pressures_pa[0] - found.loads.actuator_pa[0]).abs() < 1e-6);
        let width = found.file.text.lines().find(|line| line.starts_with("width_mm")).unwrap();
        assert!(width.ends_with("# chosen") && found.file.name == "design.toml", "{width}");
        let miss = (1e3 * at.tip.x_m - x).hypot(1e3 * at.tip.y_m - y);
        assert!((1e-3 * miss - found.worst_m()).abs() < 1e-9);
        found.reached(&wish) && miss <= 0.01 * 1e3 * found.file.length_m
    });
    let reached = reached.count();
    assert!(reached >= 8, "{reached} of 10");
}

#[test]
fn a_wish_beyond_the_ranges_is_told_with_the_end_that_holds_it_back() {
    let text = format!("scenario = \"epam\"\n[wish]\ntip_angle_deg = 120\n{FREE}");
    let near = found(&wish(&text).unwrap());
    assert!(!near.reached(&wish(&text).unwrap()) && !near.held.is_empty());
    let held: Vec<&str> = near.held.iter().map(|held| held.key.as_str()).collect();
    assert!(held.contains(&"pressure_kpa") || held.contains(&"actuator.width_mm"), "{held:?}");
    // What is said of a unit beyond the end is what a moved end gives.
    let first = &near.held[0];
    let (from, to) = if first.key == "pressure_kpa" { ("to = 30", "to = 30.2") } else { ("to = 70", "to = 70.2") };
    let further = found(&wish(&text.replace(from, to)).unwrap());
    let gained = (near.worst_m() - further.worst_m()) / 0.2;
    assert!((gained / first.gain_m - 1.0).abs() < 0.2, "{gained} against {}", first.gain_m);
}

#[test]
fn turns_add_up_to_the_tip_and_stations_lie_on_the_line() {
    let text = format!(
        "scenario = \"epam\"\n[wish]\ntip_angle_deg = 40\nturns = [{{ from_mm = 0, to_mm = 360, angle_deg = 40 }}]\n\
         places = [{{ s_mm = 0, at_mm = [0, 0] }}, {{ s_mm = 360, at_mm = [300, 100] }}]\n{FREE}"
    );
    let found = found(&wish(&text).unwrap());
    let of = |what: &str| found.misses.iter().find(|miss| miss.what == what).unwrap().found.clone();
    assert!((of("angle of the tip")[0] - of("turn from 0 to 360 mm")[0]).abs() < 1e-12);
    assert_eq!(of("station 0 mm"), [0.0, 0.0]);
    let end = of("station 360 mm");
    assert!((end[0] - found.pose.tip.x_m).abs() < 1e-9 && (end[1] - found.pose.tip.y_m).abs() < 1e-9);
}

#[test]
fn a_force_at_the_tip_is_carried_and_threads_change_no_bit() {
    let [x, y] = tip(55.0, 5, 15.0);
    let text = format!("scenario = \"epam\"\n[wish]\ntip_mm = [{x}, {y}]\nforce_n = [0, -0.1]\n{FREE}");
    let wish = wish(&text).unwrap();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(|| found(&wish));
    let two = rayon::ThreadPoolBuilder::new().num_threads(2).build().unwrap().install(|| found(&wish));
    assert_eq!((&one.chosen, one.pose.tip), (&two.chosen, two.pose.tip));
    assert!(one.reached(&wish) && one.file.text.contains("tip_load"));
}

#[test]
fn the_interval_is_that_of_the_assumed_numbers() {
    let [x, y] = tip(55.0, 5, 15.0);
    let with = |range: &str| {
        let assumed = format!("[[assumed]]\nkey = \"body.pressure_kpa\"\n{range}\n");
        wish(&format!("scenario = \"epam\"\n[wish]\ntip_mm = [{x}, {y}]\n{FREE}{assumed}")).unwrap()
    };
    let narrow = found(&with("from = 1.99\nto = 2.01"));
    let wide = found(&with("from = 1.8\nto = 2.2"));
    let width = |design: &Design| design.spread.map_or(0.0, |s| s.y_m[1] - s.y_m[0]);
    assert!(width(&narrow) > 0.0 && width(&wide) > 10.0 * width(&narrow), "{} {}", width(&narrow), width(&wide));
    let spread = wide.spread.unwrap();
    assert!((spread.y_m[0]..=spread.y_m[1]).contains(&wide.pose.tip.y_m) && spread.worst_m >= wide.worst_m());
}

#[test]
fn a_wrong_wish_is_refused_with_its_line_and_what_to_write() {
    let good = format!("scenario = \"epam\"\n[wish]\ntip_mm = [300, 120]\n{FREE}");
    assert!(wish(&good).is_ok());
    for (old, new, says) in [
        ("tip_mm = [300, 120]", "", "nothing is wished for"),
        ("tip_mm = [300, 120]", "tip_mm = [300, 120]\ntolerance = 0", "tolerance"),
        ("tip_mm = [300, 120]", "tip_m = [0.3, 0.12]", "unknown field"),
        ("tip_mm = [300, 120]", "tip_mm = [300, 120, 0]", "3 numbers in place of two"),
        ("tip_mm = [300, 120]", "places = [{ s_mm = 900, at_mm = [0, 0] }]", "not on the body"),
        ("tip_mm = [300, 120]", "turns = [{ from_mm = 90, to_mm = 10, angle_deg = 5 }]", "stretch that is none"),
        ("width_mm", "widht_mm", "widht_mm"),
        ("key = \"pressure_kpa\"", "key = \"pressure_kpa.7\"", "no pressure"),
        ("from = 5\nto = 30", "from = -5\nto = 30", "no pressure"),
        ("from = 5\nto = 30", "from = 5\nto = 30\nsteps = 4", "steps"),
        ("key = \"pressure_kpa\"", "key = \"actuator.width_mm\"", "twice"),
        (FREE, "", "0 keys are free"),
        ("scenario = \"epam\"", "scenario = \"epan\"", "epan"),
        ("scenario = \"epam\"", "scenario = \"wish.toml\"", "names the wish itself"),
        ("[wish]", "[cost]\nrobustness = 1\n[wish]", "robustness against nothing"),
        ("[wish]", "[cost]\npressure = -1\n[wish]", "not from 0 to 1000"),
        ("[wish]", "[[assumed]]\nkey = \"actuator.width_mm\"\nfrom = 1\nto = 2\n[wish]", "free and assumed"),
    ] {
        let told = wish(&good.replacen(old, new, 1)).unwrap_err();
        assert!(told.contains(says), "{new}: {told}");
    }
}
