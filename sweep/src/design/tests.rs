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
    let hidden = Points::new(Method::LatinHypercube, 10, 3, 20);
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

/// The end of a list is named too, with the gain of the next entry that it might have.
#[test]
fn the_end_of_a_list_holds_a_design_back() {
    let of = |widths: &str| {
        let free = format!("[[free]]\nkey = \"actuator.width_mm\"\nvalues = {widths}\n");
        let text = format!("scenario = \"epam\"\n[wish]\ntip_angle_deg = 120\n{free}");
        found(&wish(&text).unwrap())
    };
    let (short, longer) = (of("[60, 40, 50]"), of("[60, 40, 50, 70]"));
    let held = &short.held[0];
    assert_eq!((short.held.len(), held.key.as_str(), held.value), (1, "actuator.width_mm", 60.0));
    let gained_m = short.worst_m() - longer.worst_m();
    assert!(gained_m > 1e-3 && (0.1 * gained_m - held.gain_m).abs() < 1e-12, "{gained_m} {}", held.gain_m);
    assert!(of("[60]").held.is_empty(), "nobody knows what comes after one entry");
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
        ("tip_mm = [300, 120]", "tip_mm = [300, 120, 0]", "invalid length 3"),
        ("tip_mm = [300, 120]", "places = [{ s_mm = 900, at_mm = [0, 0] }]", "not on the body"),
        ("tip_mm = [300, 120]", "turns = [{ from_mm = 90, to_mm = 10, angle_deg = 5 }]", "stretch that is none"),
        ("width_mm", "widht_mm", "widht_mm"),
        ("key = \"pressure_kpa\"", "key = \"pressure_kpa.7\"", "is not a pressure"),
        ("from = 5\nto = 30", "from = -5\nto = 30", "is not a pressure"),
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

/// Designs until the end, checked by a truth that is the model plus an offset of places \[m\] that depends on the pressure \[kPa\].
fn checked(wish: &Wish, corrections: usize, offset: impl Fn(f64) -> [f64; 2]) -> Rounds {
    let mut rounds = Rounds::new(corrections);
    while let Some(design) = rounds.search(wish, &mut |_, _| ControlFlow::Continue(())).unwrap() {
        let by = offset(1e-3 * design.loads.actuator_pa[0]);
        let of = |miss: &Miss| {
            let found = miss.found.iter().zip(by).map(|(number, by)| number + by).collect();
            Miss::new(miss.what.clone(), miss.wanted.clone(), found, design.file.length_m)
        };
        let misses = design.misses.iter().filter(|miss| !miss.what.starts_with("turn")).map(of).collect();
        rounds.answer(Ok(Checked { misses, ..Checked::default() }));
    }
    rounds
}

fn tip_wish(more: &str) -> Wish {
    let [x, y] = tip(55.0, 5, 15.0);
    wish(&format!("scenario = \"epam\"\n[wish]\ntip_mm = [{x}, {y}]\n{more}{FREE}")).unwrap()
}

/// What the truth lacks where another design than the wished one has the wish, so that one with the wish can be found \[m\].
fn lacks(share: f64) -> [f64; 2] {
    let (here, there) = (tip(55.0, 5, 15.0), tip(62.0, 5, 19.0));
    [0, 1].map(|k| 1e-3 * share * (here[k] - there[k]))
}

#[test]
fn one_correction_is_exact_for_a_constant_offset_of_every_part_that_is_read() {
    let [x, y] = tip(55.0, 5, 15.0);
    let more = format!("places = [{{ s_mm = 360, at_mm = [{x}, {y}] }}]\ntolerance = 0.1\n");
    let turn = "turns = [{ from_mm = 0, to_mm = 100, angle_deg = 6 }]\n";
    for more in ["", &format!("{turn}{more}")] {
        let wish = tip_wish(more);
        let rounds = checked(&wish, 3, |_| lacks(1.0));
        let [first, second] = &rounds.all[..] else { panic!("{} rounds", rounds.all.len()) };
        assert!(first.corrected.is_none() && !first.reached(&wish) && second.reached(&wish));
        assert_eq!((rounds.best(), rounds.end(&wish), rounds.reached(&wish)), (1, Some(StopReason::Reached), true));
        for miss in second.corrected.as_ref().unwrap() {
            // What is not read is not corrected.
            let by_model = second.design.misses.iter().find(|other| other.what == miss.what).unwrap();
            let truth = second.by_elements(&miss.what).unwrap_or(by_model);
            assert!(miss.found.iter().zip(&truth.found).all(|(a, b)| (a - b).abs() < 1e-12), "{miss:?} {truth:?}");
            assert_eq!(miss.wanted, first.design.misses.iter().find(|other| other.what == miss.what).unwrap().wanted);
        }
        // The model's own answer is told as it is, and is now off by what it lacks.
        let own = Model::new(&second.design.file.scenario);
        let mut at = own.prediction();
        own.predict(&second.design.loads, &mut at).unwrap();
        assert_eq!(second.design.misses[0].found, [at.tip.x_m, at.tip.y_m]);
    }
}

#[test]
fn one_correction_of_a_smooth_offset_lands_within_the_tolerance_and_near() {
    let wish = tip_wish("");
    let rounds = checked(&wish, 1, |kpa| lacks(0.8 + 0.005 * (kpa - 15.0)));
    let [first, second] = &rounds.all[..] else { panic!("{} rounds", rounds.all.len()) };
    assert!(!first.reached(&wish) && second.reached(&wish), "{} {}", first.worst_m(), second.worst_m());
    let count = |round: &Round| round.design.chosen[1].clone();
    assert_eq!(count(first), count(second));
    // A search for the same wish near a design goes nowhere, though others have the wish as well.
    let (from, mut silent) = (&first.design.shares, |_: &str, _: Option<f64>| ControlFlow::Continue(()));
    let again = search::design_near(&wish, Some(from), &mut silent).unwrap();
    assert_eq!(again.chosen[1], first.design.chosen[1]);
    assert!([0, 2].iter().all(|k| (again.shares[*k] - from[*k]).abs() < 0.02), "{:?} {from:?}", again.shares);
}

#[test]
fn without_a_correction_the_design_is_the_same_to_the_bit() {
    let wish = tip_wish("");
    let plain = found(&wish);
    let of_zero = found(&wish.less(&[0.0; 2]));
    let none_allowed = checked(&wish, 0, |_| [0.1; 2]);
    let none_needed = checked(&wish, 4, |_| [0.0; 2]);
    for rounds in [&none_allowed, &none_needed] {
        let [only] = &rounds.all[..] else { panic!("{} rounds", rounds.all.len()) };
        assert_eq!((&only.design.file.text, &only.design.misses), (&plain.file.text, &plain.misses));
    }
    assert_eq!((&of_zero.file.text, &of_zero.misses), (&plain.file.text, &plain.misses));
    assert_eq!((none_allowed.end(&wish), none_needed.end(&wish)), (Some(StopReason::Spent), Some(StopReason::Reached)));
    // Without corrections the model decides, as the check is only told.
    assert!(none_allowed.reached(&wish) && !none_allowed.all[0].reached(&wish));
}

#[test]
fn the_best_checked_design_is_returned_though_corrections_lead_away() {
    let wish = tip_wish("");
    // The further from 10 kPa the worse.
    let truth = |kpa: f64| [0.01, -0.01 - 0.01 * (kpa - 10.0).abs()];
    let rounds = checked(&wish, 3, truth);
    let misses: Vec<f64> = rounds.all.iter().map(Round::worst_m).collect();
    let least = misses.iter().copied().fold(f64::INFINITY, f64::min);
    assert_eq!(misses[rounds.best()], least);
    assert!(rounds.all.len() > 1 && misses.last().unwrap() > &least && !rounds.reached(&wish), "{misses:?}");
}

#[test]
fn the_end_is_told() {
    let free = "[[free]]\nkey = \"pressure_kpa\"\nfrom = 5\nto = 12\n";
    let [x, y] = tip(80.0, 5, 12.0);
    let text = format!("scenario = \"epam\"\n[wish]\ntip_mm = [{x}, {y}]\n{free}");
    let wish = wish(&text).unwrap();
    // More bend than the range has: the end of the range again.
    let rounds = checked(&wish, 3, |_| [0.01, -0.05]);
    assert_eq!((rounds.end(&wish), rounds.best()), (Some(StopReason::Same), 0));
    let mut rounds = Rounds::new(3);
    assert_eq!(rounds.end(&wish), None);
    rounds.search(&wish, &mut |_, _| ControlFlow::Continue(())).unwrap();
    rounds.answer(Err("the run was stopped".into()));
    assert!(rounds.search(&wish, &mut |_, _| ControlFlow::Continue(())).unwrap().is_none());
    assert_eq!((rounds.end(&wish), rounds.best(), rounds.all.len()), (Some(StopReason::Unchecked), 0, 1));
}
