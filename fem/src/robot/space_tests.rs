//! Strips round the body: the planar robot turned, the pattern wound on the wall, and what cannot be meshed.

use super::tests::{area_m2, coarse, radius_m, volume_m3};
use super::*;
use crate::Simulation;
use models::CHANNELS;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const TWO: &str = include_str!("../../../studies/epam-two-strips.toml");
const HELIX: &str = include_str!("../../../studies/epam-helix.toml");

fn scenario(text: &str) -> Scenario {
    Scenario::parse(text).unwrap()
}

fn shipped(name: &str) -> Scenario {
    scenario(models::shipped(name).unwrap())
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

#[test]
fn a_strip_at_an_azimuth_is_the_planar_robot_turned() {
    for (name, azimuth) in [("epam", FRAC_PI_2), ("cpam", -2.0), ("spam", PI), ("fpam", 0.3)] {
        let planar = problem(&shipped(name), &coarse()).unwrap();
        let mut turned = shipped(name);
        turned.actuator.azimuth_rad = azimuth;
        let turned = problem(&turned, &coarse()).unwrap();
        let (sin, cos) = azimuth.sin_cos();
        for (a, b) in planar.mesh.points.iter().zip(&turned.mesh.points) {
            let expected = [a[0], cos * a[1] - sin * a[2], sin * a[1] + cos * a[2]];
            assert!(distance(expected, *b) < 1e-15, "{name}: {expected:?} {b:?}");
        }
        let parts = |problem: &Problem| {
            problem.mesh.parts.iter().map(|p| (p.name.clone(), p.quads.clone())).collect::<Vec<_>>()
        };
        assert_eq!(parts(&planar), parts(&turned), "{name}");
    }
}

#[test]
fn every_strip_has_its_own_sheet_and_chamber_and_its_channel_fills_it() {
    let text = format!("{TWO}\n[fem]\npressures_kpa = [[20, 10], 30, [0, 15]]\n");
    let robot = scenario(&text);
    let run = RobotRun::parse(&text, &robot).unwrap();
    let problem = run.problem(&robot).unwrap();
    let names: Vec<&str> = problem.chambers.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["body", "actuator", "actuator_2"]);
    for (chamber, kpa) in [(1, [20.0, 30.0, 0.0]), (2, [10.0, 30.0, 15.0])] {
        let amplitude = problem.chambers[chamber].pressure.filling();
        for (hold, kpa) in run.holds()[1..].iter().zip(kpa) {
            assert!((amplitude.at(hold.time_s) - 1e3 * kpa).abs() < 1e-6, "{chamber} {hold:?}");
        }
    }
    let areas = ["top", "top_2"].map(|name| area_m2(&problem.mesh, |part| part == name));
    assert!((areas[0] / areas[1] - 1.0).abs() < 1e-12, "{areas:?}");
    let mut run = Simulation::new(&problem).unwrap();
    run.advance_until(20.0 * run.dt_s(), &mut |_| true).unwrap();
}

#[test]
fn a_helix_is_its_pattern_wound_on_the_wall() {
    let robot = scenario(HELIX);
    let straight = Scenario { actuator: ActuatorChoice { turns: 0.0, ..robot.actuator }, ..robot.clone() };
    let [wound, flat] = [&robot, &straight].map(|robot| problem(robot, &coarse()).unwrap());
    // Chords of a helix are longer than those across the body: sheets differ by how far both are from their arcs.
    let areas = [&wound, &flat].map(|problem| area_m2(&problem.mesh, |part| part == "top"));
    assert!((areas[0] / areas[1] - 1.0).abs() < 2e-3, "{areas:?}");
    assert!((areas[0] / (0.36 * 0.06) - 1.0).abs() < 2e-3, "{areas:?}");
    let volumes = [&wound, &flat].map(|problem| volume_m3(problem, "body"));
    assert!((volumes[0] / volumes[1] - 1.0).abs() < 5e-3, "{volumes:?}");
    // Seams at the ends lie half a turn apart, and every ring closes at the base and at the tip.
    let on_wall = |problem: &Problem| {
        let part = problem.mesh.parts.iter().find(|p| p.name == "face").unwrap();
        let middle = |x_m: f64| {
            let near = |node: &&u32| (problem.mesh.points[**node as usize][0] - x_m).abs() < 4e-3;
            let nodes: Vec<_> =
                part.quads.iter().flatten().filter(near).map(|n| problem.mesh.points[*n as usize]).collect();
            let sum = |k: usize| nodes.iter().map(|p| p[k]).sum::<f64>();
            sum(2).atan2(sum(1))
        };
        [50e-3, 188.7e-3, 327e-3].map(middle)
    };
    let found = on_wall(&wound);
    for (angle, x_m) in found.iter().zip([50e-3, 188.7e-3, 327e-3]) {
        assert!((angle - robot.actuator.azimuth_at(0.04, x_m)).abs() < 0.05, "{found:?}");
    }
    for (set, x_m) in [("base", 0.0), ("tip", robot.length_m)] {
        assert!(wound.mesh.sets[set].iter().all(|n| (wound.mesh.points[*n as usize][0] - x_m).abs() < 1e-12), "{set}");
    }
    assert!(wound.mesh.sets["tip"].iter().all(|n| (radius_m(&wound.mesh, *n) - 0.04).abs() < 1e-12));
    let mut run = Simulation::new(&wound).unwrap();
    run.advance_until(20.0 * run.dt_s(), &mut |_| true).unwrap();
}

#[test]
fn few_turns_are_nearly_none() {
    let robot = scenario(HELIX);
    let made = |turns: f64| {
        let actuator = ActuatorChoice { turns, start_m: 0.01, ..robot.actuator };
        problem(&Scenario { actuator, ..robot.clone() }, &coarse()).unwrap().mesh.points
    };
    let [none, few] = [0.0, 1e-6].map(made);
    let most = none.iter().zip(&few).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max);
    assert!(most > 1e-9 && most < TAU * 0.04 * 2e-6, "{most}");
}

#[test]
fn what_the_grid_cannot_follow_is_refused_with_a_remedy() {
    let refused = |text: String| problem(&scenario(&text), &coarse()).unwrap_err().to_string();
    let helices = format!("{HELIX}\n[[strip]]\nazimuth_deg = 180\nturns = 0.25\n");
    assert!(refused(helices.replace("width_mm = 60", "width_mm = 30")).contains("the same turns"));
    let base = refused(HELIX.replace("start_mm = 20", "start_mm = 3"));
    assert!(base.contains("beyond its middle") && base.contains("move start_mm"), "{base}");
    let close = refused(TWO.replace("azimuth_deg = 90 ", "azimuth_deg = 73 "));
    assert!(close.contains("between the welds of two strips") && close.contains("azimuth_deg"), "{close}");
    let seams = refused(TWO.replace("channel = 1", "channel = 1\nstart_mm = 0.5\ncount = 5"));
    assert!(seams.contains("too close for elements"), "{seams}");
    let run = |pressures: &str| {
        let text = format!("{TWO}\n[fem]\npressures_kpa = {pressures}\n");
        RobotRun::parse(&text, &scenario(&text)).map(|run| run.pressures_pa)
    };
    assert_eq!(run("[[20, 0]]").unwrap(), [[20e3, 0.0, 0.0, 0.0]]);
    assert_eq!(run("[20]").unwrap(), [[20e3; CHANNELS]]);
    for (text, told) in [
        ("[[20, 1]]", "stays flat"),
        ("[[0, 0]]", "stays flat"),
        ("[[1, 2, 3, 4, 5]]", "5 channels"),
        ("[[]]", "0 channels"),
        ("[[20, 10], [20, 10]]", "differ one by one"),
        ("[[[20]]]", "pressures_kpa"),
    ] {
        let error = run(text).unwrap_err().to_string();
        assert!(error.contains(told), "{text}: {error}");
    }
}
