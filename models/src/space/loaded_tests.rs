//! Laws of robots in space under loads.

use super::frame::direction;
use super::lever::{Coupling, Outer};
use super::loaded::couple;
use super::section::StripSection;
use super::tests::{at, full, random, robot};
use super::*;
use crate::term::RowKind;
use crate::{Loads, Model, Pose, Prediction, Scenario, Unsolved};

const QUARTER: &str = "[[strip]]\nazimuth_deg = 90\nchannel = 1";
const THREE: &str = "[[strip]]\nazimuth_deg = 100\nchannel = 1\n[[strip]]\nazimuth_deg = -95\nchannel = 2";

/// With loads in the plane of an azimuth: a weight along the third direction and a force on the tip, in x and across.
fn loaded(scenario: &Scenario, azimuth_deg: f64, weight: f64, [along, across]: [f64; 2]) -> Scenario {
    let [cos, sin] = direction(azimuth_deg.to_radians());
    let mut loaded = scenario.with_effect("gravity", &[weight]);
    loaded.gravity_direction = [0.6, -0.8 * cos, -0.8 * sin];
    loaded.with_effect("tip_load", &[along, across * cos, across * sin])
}

fn tip(out: &Prediction) -> [f64; 3] {
    [out.tip.x_m, out.tip.y_m, out.tip.z_m]
}

fn far(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
}

/// Energy of the loads at the frames in `work`.
fn outer_energy(model: &Model, work: &SpaceWork) -> f64 {
    let nodes = work.nodes();
    let pose = Pose::new(&nodes, 2e3, 0.0);
    model.assembly().node_terms.iter().map(|term| term.add(&pose, &mut vec![0.0; nodes.len()])).sum()
}

#[test]
fn one_strip_under_loads_in_its_plane_is_the_planar_robot_turned() {
    let loads = [(0.0, [0.0, 0.2]), (0.4, [0.0, 0.0]), (0.3, [0.2, -0.15]), (0.2, [-0.2, 0.1])];
    for (kind, p) in [("spam", 20.0), ("cpam", 15.0), ("epam", 30.0), ("fpam", 25.0)] {
        for (weight, force) in loads {
            // Where no strip lies, the planar hinge is numerical, and here it is sharp.
            let sharp = |scenario: Scenario| Scenario { hinge_curvature: 1e-6, ..scenario };
            let (_, planar) = at(&loaded(&sharp(robot(kind, "", "")), 0.0, weight, force), [p; 4]);
            for degrees in [-120.0, -90.0, 0.0, 33.0, 90.0, 180.0] {
                // Closed strips make a robot at azimuth 0 one in space.
                let others = format!("[[strip]]\nazimuth_deg = {}\nchannel = 1", degrees + 120.0);
                let scenario = sharp(robot(kind, &format!("azimuth_deg = {degrees}"), &others));
                let (model, turned) = at(&loaded(&scenario, degrees, weight, force), [p, 0.0, 0.0, 0.0]);
                assert_eq!(model.assembly().segments.len(), 12);
                let [cos, sin] = direction(f64::to_radians(degrees));
                for (i, [x, y]) in planar.markers.iter().enumerate() {
                    let ([a, b], c) = (turned.markers[i], turned.markers_z_m[i]);
                    let off = far([a, b, c], [*x, y * cos, y * sin]);
                    assert!(off < 1e-9, "{kind} {degrees} {weight} {force:?}: {off:e}");
                }
            }
        }
    }
}

/// The convex minimum of a strip alone takes over where a load leaves its plane, and is the same there.
#[test]
fn a_load_that_barely_leaves_the_plane_changes_barely_anything() {
    let scenario = full("azimuth_deg = 90", "").with_bending(0.1);
    let (_, before) = at(&scenario.with_effect("tip_load", &[0.05, 0.0, 0.1]), [30.0; 4]);
    let (_, after) = at(&scenario.with_effect("tip_load", &[0.05, 1e-9, 0.1]), [30.0; 4]);
    assert!(far(tip(&before), tip(&after)) < 1e-8, "{:?} {:?}", before.tip, after.tip);
    assert!(after.tip.y_m > 0.0);
}

#[test]
fn a_robot_turned_with_its_loads_is_the_same_turned() {
    let base = |degrees: f64| {
        let other = format!("[[strip]]\nazimuth_deg = {}\nchannel = 1", degrees + 90.0);
        let mut scenario = robot("epam", &format!("azimuth_deg = {degrees}"), &other).with_bending(0.3);
        let turn = |[y, z]: [f64; 2]| {
            let [cos, sin] = direction(degrees.to_radians());
            [y * cos - z * sin, y * sin + z * cos]
        };
        let ([gy, gz], [fy, fz]) = (turn([0.0, -1.0]), turn([0.1, -0.2]));
        scenario.gravity_direction = [0.0, gy, gz];
        let scenario = scenario.with_effect("gravity", &[0.5]).with_effect("tip_load", &[0.1, fy, fz]);
        tip(&at(&scenario, [20.0, 12.0, 0.0, 0.0]).1)
    };
    let [x, y, z] = base(0.0);
    for degrees in [90.0, 37.0, -150.0] {
        let [cos, sin] = direction(f64::to_radians(degrees));
        let off = far(base(degrees), [x, y * cos - z * sin, y * sin + z * cos]);
        assert!(off < 1e-9, "{degrees}: {off:e}");
    }
}

#[test]
fn the_loads_of_a_section_are_the_slopes_of_the_work_of_all_forces() {
    let scenario = loaded(&robot("epam", "", THREE).with_bending(0.3), 40.0, 0.4, [0.1, 0.15]);
    let (model, out) = at(&scenario, [30.0, 20.0, 25.0, 0.0]);
    let mut work = out.work.space.clone();
    for (i, bend) in work.bends.iter_mut().enumerate() {
        let angle = 0.7 * i as f64;
        let kappa = [3.0 * angle.cos(), 2.0 * angle.sin()];
        *bend = Bend { kappa: if i == 5 { [0.0; 2] } else { kappa }, contraction: 0.14 };
    }
    let found = forces(model.assembly(), 2e3, &mut work);
    for (i, segment) in model.assembly().segments.iter().enumerate() {
        for (q, force) in found[i].into_iter().enumerate() {
            let energy = |change: f64| {
                let mut moved = work.clone();
                match q {
                    2 => moved.bends[i].contraction += change,
                    _ => moved.bends[i].kappa[q] += change,
                }
                place(model.assembly(), &mut moved);
                outer_energy(&model, &moved)
            };
            let h = if q == 2 { 1e-3 } else { 1e-2 };
            let wide = (energy(h) - energy(-h)) / (2.0 * h);
            let narrow = (energy(0.5 * h) - energy(-0.5 * h)) / h;
            let slope = (4.0 * narrow - wide) / 3.0 / segment.length_m;
            assert!((force + slope).abs() < 1e-9, "{i} {q}: {force} and {slope}");
        }
    }
}

#[test]
fn at_equilibrium_no_bend_of_any_section_has_less_potential_energy() {
    for (scenario, kpa) in [
        (full("", THREE).with_bending(0.3), [30.0, 20.0, 25.0, 0.0]),
        (robot("epam", "", QUARTER).with_bending(0.3), [15.0, 0.0, 0.0, 0.0]),
        (robot("fpam", "", THREE), [25.0, 10.0, 0.0, 0.0]),
        (robot("epam", "turns = 0.3", "").with_bending(0.3), [20.0; 4]),
    ] {
        let scenario = loaded(&scenario, 50.0, 0.3, [0.05, 0.1]);
        let (model, out) = at(&scenario, kpa);
        let potential = |work: &SpaceWork, i: usize| {
            let section = StripSection::new(model.assembly(), i, 2e3);
            let (bend, mut strips) = (work.bends[i], work.strips[i].clone());
            let own = section.energy(&mut strips, bend.kappa, bend.contraction);
            own * model.assembly().segments[i].length_m + outer_energy(&model, work)
        };
        for i in 0..model.assembly().segments.len() {
            let least = potential(&out.work.space, i);
            for turn in 0..12 {
                let e = direction(f64::from(turn) * std::f64::consts::TAU / 12.0);
                for (size, shorter) in [(0.02, 0.0), (0.02, 1e-3), (0.0, 1e-3)] {
                    let mut work = out.work.space.clone();
                    let bend = &mut work.bends[i];
                    bend.kappa = [bend.kappa[0] + size * e[0], bend.kappa[1] + size * e[1]];
                    bend.contraction = (bend.contraction + shorter).max(0.04 * bend.size());
                    place(model.assembly(), &mut work);
                    let more = potential(&work, i);
                    assert!(more > least - 1e-12, "{} {i} {turn}: {more} below {least}", scenario.name);
                }
            }
        }
    }
}

#[test]
fn a_passive_tube_bends_alike_in_all_directions() {
    let bent = |force: [f64; 3]| {
        let scenario = robot("epam", "", QUARTER).with_bending(0.5).with_effect("tip_load", &force);
        tip(&at(&scenario, [0.0; 4]).1)
    };
    let [x, y, z] = bent([0.05, 2.0, 0.0]);
    assert!(y > 0.01 && z.abs() < 1e-15, "{y} {z}");
    assert!(far(bent([0.05, 0.0, 2.0]), [x, 0.0, y]) < 1e-12);
    assert!(far(bent([0.05, -1.2, 1.6]), [x, -0.6 * y, 0.8 * y]) < 1e-9);
}

/// The centre line of the planar robot is shorter where it bends towards the actuator than where it bends away: this one is between.
#[test]
fn flat_strips_leave_the_hinge_of_the_planar_robot() {
    let flat = |robot: Scenario, force: [f64; 3], kpa: f64| {
        at(&robot.with_effect("displaced_gas", &[1.0]).with_effect("tip_load", &force), [kpa; 4]).1.tip
    };
    for (force, kpa) in [(1.0, 0.0), (0.2, 0.0), (0.9, 1.0)] {
        let [towards, away] = [force, -force].map(|force| flat(robot("epam", "", ""), [0.0, force, 0.0], kpa));
        for (degrees, sign) in [(0.0, 1.0), (0.0, -1.0), (10.0, 1.0), (-150.0, -1.0)] {
            let [cos, sin] = direction(f64::to_radians(degrees)).map(|e| sign * e);
            let around = robot("epam", &format!("azimuth_deg = {degrees}"), QUARTER);
            let tip = flat(around, [0.0, force * cos, force * sin], kpa);
            let across = tip.y_m * cos + tip.z_m * sin;
            let place = format!("{force} {degrees} {sign}: {tip:?} {towards:?} {away:?}");
            assert!(towards.y_m < across && across < -away.y_m && across < 1.005 * towards.y_m, "{place}");
            assert!(towards.angle_rad < tip.angle_rad && tip.angle_rad < -away.angle_rad, "{place}");
            assert!(towards.x_m < tip.x_m && tip.x_m < away.x_m && tip.x_m <= 0.36, "{place}");
            assert!((tip.y_m * sin - tip.z_m * cos).abs() < 1e-12, "{place}");
        }
    }
}

/// The wall carries πp_bR³ at the clamp, and a tube without stiffness nothing beyond it.
#[test]
fn a_tube_without_stiffness_holds_up_to_its_collapse() {
    let tube = robot("epam", "", QUARTER);
    let model = Model::new(&tube);
    // The moment of the loads is that of a section's middle.
    let arm = tube.length_m - 0.5 * tube.length_m / 12.0;
    let collapse = std::f64::consts::PI * 2e3 * 0.04_f64.powi(3) / arm;
    let (_, below) = at(&tube.with_effect("tip_load", &[0.0, 0.0, 0.99 * collapse]), [0.0; 4]);
    assert!(below.tip.z_m > 0.0 && below.tip.angle_rad < 0.03, "{:?}", below.tip);
    assert_eq!(model.assembly().segments.len(), 1);
    for force in [[0.0, 0.0, 1.01 * collapse], [-20.0, 0.0, 0.01]] {
        let model = Model::new(&tube.with_effect("tip_load", &force));
        let refused = model.predict(&Loads::uniform(2e3, 0.0), &mut model.prediction());
        assert!(matches!(refused, Err(Unsolved::NotConverged { .. })), "{refused:?}");
    }
}

#[test]
fn the_work_of_a_slowly_raised_force_is_the_energy_stored() {
    let scenario = full("", QUARTER).with_bending(0.3);
    let kpa = [25.0, 15.0, 0.0, 0.0];
    let way = [0.1, -0.12, 0.2];
    let state = |share: f64| {
        let (model, out) = at(&scenario.with_effect("tip_load", &way.map(|f| f * share)), kpa);
        let loads = Loads { body_pa: 2e3, actuator_pa: kpa.map(|p| p * 1e3) };
        let rows = model.ledger(&loads, &out);
        let own = rows.iter().filter(|row| row.name != "tip_load").map(|row| row.energy_j).sum::<f64>();
        let reach = tip(&out).iter().zip(way).map(|(x, f)| x * f).sum::<f64>();
        (own, reach, rows)
    };
    // ∫F dx = [F x] − ∫x dF by Simpson's rule; at no force the body is one arc, so the least share is above zero.
    let (from, steps) = (1e-6, 16);
    let share = |i: usize| from + (1.0 - from) * i as f64 / steps as f64;
    let states: Vec<_> = (0..=steps).map(|i| state(share(i))).collect();
    let weight = |i: usize| if i == 0 || i == steps { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
    let area: f64 = states.iter().enumerate().map(|(i, state)| weight(i) * state.1).sum::<f64>() * (1.0 - from)
        / (3.0 * steps as f64);
    let work = states[steps].1 - from * states[0].1 - area;
    let stored = states[steps].0 - states[0].0;
    assert!(work > 1e-4 && (work - stored).abs() < 1e-7 * work, "{work} {stored}");
    let load = states[steps].2.iter().find(|row| row.name == "tip_load").unwrap();
    let rest = scenario.length_m * way[0];
    assert!((load.energy_j + states[steps].1 - rest).abs() < 1e-12 && load.kind == RowKind::Stored);
}

#[test]
fn the_ledger_has_a_line_for_every_load() {
    let scenario = loaded(&full("", QUARTER), 90.0, 0.4, [0.0, 0.1]);
    let (model, out) = at(&scenario, [25.0, 15.0, 0.0, 0.0]);
    let loads = Loads { body_pa: 2e3, actuator_pa: [25e3, 15e3, 0.0, 0.0] };
    let names: Vec<&str> = model.ledger(&loads, &out).iter().map(|row| row.name).collect();
    for name in ["actuator_pressure", "body_pressure", "bending", "gravity", "tip_load"] {
        assert!(names.contains(&name), "{names:?}");
    }
}

/// Random loads and pressures: a state or an error, the same from any buffers, and a state wherever the loads are small.
#[test]
fn any_loads_end_in_a_state_or_an_error() {
    let mut random = random(11);
    for base in
        [robot("epam", "", THREE).with_bending(0.3), full("", THREE), robot("fpam", "", THREE).with_bending(1.0)]
    {
        let mut solved = [0; 2];
        for i in 0..60 {
            let size = [0.1, 1.0][i % 2];
            let force: [f64; 3] = std::array::from_fn(|_| size * (2.0 * random() - 1.0));
            let scenario = base.with_effect("tip_load", &force).with_effect("gravity", &[size * random()]);
            let pressures: [f64; 4] = std::array::from_fn(|_| 40e3 * random());
            let (model, loads) = (Model::new(&scenario), Loads { body_pa: 2e3, actuator_pa: pressures });
            let mut out = model.prediction();
            let Ok(()) = model.predict(&loads, &mut out) else { continue };
            solved[i % 2] += 1;
            let first = out.clone();
            model.predict(&loads, &mut out).unwrap();
            assert_eq!(tip(&first), tip(&out));
        }
        // Two of the larger loads are next to those at which a robot folds.
        assert!(solved[0] == 30 && solved[1] >= 28, "{}: {solved:?}", base.name);
    }
}

/// Generalised forces per length at the bends in `work`.
fn forces(assembly: &Assembly, p_body_pa: f64, work: &mut SpaceWork) -> Vec<Outer> {
    place(assembly, work);
    couple(assembly, p_body_pa, work);
    let sum = |c: &Coupling| std::array::from_fn(|q| c.residual[q] + c.outer[q]);
    work.loaded.sections.iter().map(sum).collect()
}
