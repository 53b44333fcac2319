//! Second laws at their limits, and what they must conserve.

use super::{ALSO, HIDDEN, HiddenEffect, Laws, OUTSIDE, by_name};
use crate::camera::{Camera, SeenPoint};
use crate::drive::Drive;
use crate::robot::TrueRobot;
use crate::supply::TrueSupply;
use crate::truth::usual;
use crate::wall::{CellMemory, CellWall};

/// The usual robot with an amount of a second law.
fn robot(kind: &str, name: &str, amount: f64) -> TrueRobot {
    let mut robot = TrueRobot::new(&usual(kind).unwrap()).unwrap();
    by_name(name).unwrap().put(Laws::Second, &mut robot, amount);
    robot
}

fn wall(name: &str, amount: f64) -> CellWall {
    robot("epam", name, amount).cells[0].wall
}

fn drive(kind: &str, name: &str, amount: f64) -> Drive {
    robot(kind, name, amount).cells[0].drive.unwrap()
}

/// Moment of a wall at its first bend \[N·m\].
fn moment(wall: &CellWall, kappa: f64, p_body_pa: f64) -> f64 {
    wall.moment(kappa, p_body_pa, &CellMemory::default(), 0.0)
}

/// Work done on a wall along a path, beyond what its bending takes \[N·m/m\].
fn work(wall: &CellWall, path: &[f64]) -> f64 {
    let (mut memory, mut last, mut sum) = (CellMemory::default(), [0.0; 2], 0.0);
    for kappa in path {
        let now = [*kappa, wall.moment(*kappa, 0.0, &memory, 0.01) - wall.bending * kappa];
        sum += 0.5 * (now[1] + last[1]) * (now[0] - last[0]);
        wall.remember(*kappa, &mut memory, 0.01);
        last = now;
    }
    sum
}

/// Up, part of the way back, further up and back to the start, in steps of 1/1000.
fn loops() -> Vec<f64> {
    let to =
        |from: i32, to: i32| (1..=(to - from).abs()).map(move |i| 1e-3 * f64::from(from + i * (to - from).signum()));
    [(0, 1500), (1500, 900), (900, 2500), (2500, -700), (-700, 0)].into_iter().flat_map(|(a, b)| to(a, b)).collect()
}

fn near(a: f64, b: f64, within: f64) {
    assert!((a - b).abs() <= within, "{a} is not {b}");
}

#[test]
fn names_are_unique_and_every_entry_says_what_it_is() {
    let all: Vec<&HiddenEffect> = HIDDEN.iter().chain(ALSO).chain(OUTSIDE).collect();
    assert_eq!((HIDDEN.len(), ALSO.len(), OUTSIDE.len()), (25, 5, 6));
    for (i, effect) in all.iter().enumerate() {
        assert!(all[..i].iter().all(|other| other.name != effect.name), "{}", effect.name);
        let wanted = if i < HIDDEN.len() + ALSO.len() { 2 } else { 1 };
        assert_eq!(effect.equations.len(), wanted, "{}", effect.name);
        let is_told = effect.equations.iter().all(|words| !words.is_empty());
        assert!(effect.sentence.ends_with('.') && is_told, "{}", effect.name);
        assert_eq!(by_name(effect.name).map(|found| found.name), Some(effect.name));
    }
}

#[test]
fn both_laws_of_an_effect_differ_and_a_second_one_says_its_source() {
    for effect in HIDDEN {
        let [first, second] = [Laws::First, Laws::Second].map(|laws| effect.equation(laws));
        assert!(first != second && second.contains(": "), "{}", effect.name);
    }
}

#[test]
fn dahl_friction_loses_energy_on_every_closed_path_and_saturates() {
    let rubbed = wall("friction", 0.3);
    let lost = work(&rubbed, &loops());
    assert!(lost > 0.0 && lost < 0.3 * 7.6, "at most the force along the whole path: {lost}");
    let small: Vec<f64> = [0.0, 1e-3, 2e-3, 1e-3, 0.0].repeat(20);
    assert!(work(&rubbed, &small) > 0.0, "in small loops too");
    near(moment(&rubbed, 50.0, 0.0) - 50.0 * rubbed.bending, 0.3, 1e-9);
}

#[test]
fn creep_relaxes_by_the_power_law_and_loses_energy() {
    let slow = wall("creep", 0.25);
    let mut memory = CellMemory::default();
    let mut at = |until: [f64; 2]| {
        slow.remember(1.0, &mut memory, until[1] - until[0]);
        slow.moment(1.0, 0.0, &memory, 0.0) - slow.bending
    };
    let seen = [[0.0, 0.2], [0.2, 1.0], [1.0, 5.0], [5.0, 20.0], [20.0, 100.0]].map(&mut at);
    let law = |t: f64| 0.25 * (1.0 + t / 0.1).powf(-0.2);
    for (i, pair) in [[0.2, 1.0], [1.0, 5.0], [5.0, 20.0], [20.0, 100.0]].into_iter().enumerate() {
        let wanted = law(pair[0]) - law(pair[1]);
        near((seen[i] - seen[i + 1]) / wanted, 1.0, 0.03);
    }
    assert!(work(&slow, &loops()) > 0.0);
}

#[test]
fn a_set_is_the_square_of_the_elastic_bend_and_costs_work() {
    let (bent, scale) = (wall("plastic_set", 0.2), wall("plastic_set", 0.2).scale_per_m);
    let elastic = 1.5 + moment(&bent, 1.5, 0.0) / bent.bending - 1.5;
    near(1.5 - elastic, 0.2 * elastic * elastic / scale, 1e-12);
    assert!(work(&bent, &loops()) > 0.0);
}

#[test]
fn a_yielding_wall_starts_with_all_of_its_stiffness_and_ends_with_the_rest() {
    let soft = wall("softening", 0.6);
    let slope = |k: f64| (moment(&soft, k + 1e-4, 0.0) - moment(&soft, k - 1e-4, 0.0)) / 2e-4 / soft.bending;
    near(slope(0.0), 1.0, 1e-3);
    near(slope(5.0 * soft.scale_per_m), 0.4, 1e-3);
}

#[test]
fn wrinkles_start_at_a_third_of_the_full_moment_without_a_kink() {
    let flat = wall("wrinkling", 0.5);
    let hinge = |k: f64| (moment(&flat, k, 2e3) - flat.bending * k) / (2e3 * flat.hinge_m3);
    near(hinge(0.5), 1.0 / 3.0, 1e-12);
    near(hinge(0.5001) - hinge(0.5), hinge(0.5) - hinge(0.4999), 1e-7);
    assert!(hinge(99.0) > 0.95 && hinge(99.0) < 1.0 && hinge(-0.2) == -hinge(0.2));
}

#[test]
fn a_dragged_tail_pulls_by_the_angle_beyond() {
    let dragged = robot("epam", "tail_tension", 0.4);
    let pull = |i: usize| {
        let wall = &dragged.cells[i].wall;
        moment(wall, 2.0, 2e3) - moment(&CellWall { tail_m3: [0.0; 2], ..*wall }, 2.0, 2e3)
    };
    let apart = dragged.cells[47].start_m - dragged.cells[0].start_m;
    near(pull(0) / pull(47), (0.3 * 2.0 * apart).exp(), 1e-9);
    near(pull(47), 0.4, 0.01);
}

#[test]
fn a_dented_section_keeps_its_slope_and_is_never_more_than_flat() {
    let oval = wall("ovalization", 0.4);
    for k in [-3.0, -0.5, 0.2, 1.0, 20.0] {
        let product = |k: f64| k * oval.arm_factor(k).0;
        near(oval.arm_factor(k).1, (product(k + 1e-5) - product(k - 1e-5)) / 2e-5, 1e-6);
        assert!(oval.arm_factor(k).1 > 0.0 && oval.arm_factor(k).0 > 0.6);
    }
}

#[test]
fn round_folds_touch_at_once_and_press_by_the_power_of_three_halves() {
    let folds = wall("self_contact", 0.1);
    let press = |x: f64| moment(&folds, x * folds.scale_per_m, 0.0) - folds.bending * x * folds.scale_per_m;
    near(press(0.6), 0.0, 1e-12);
    near(press(0.8) / press(0.7), 2f64.powf(1.5), 1e-9);
}

#[test]
fn a_sleeve_stiffens_one_diameter_of_its_own_end() {
    let plain = wall("friction", 0.0).bending;
    for (name, first) in [("base_clamp", true), ("tip_clamp", false)] {
        let clamped = robot("epam", name, 2.0);
        let stiff: Vec<bool> = clamped.cells.iter().map(|cell| cell.wall.bending == 3.0 * plain).collect();
        let length: f64 = clamped.cells.iter().zip(&stiff).filter(|(_, s)| **s).map(|(cell, _)| cell.length_m).sum();
        assert!((length - 0.08).abs() < 0.004 && stiff[0] == first && stiff[47] != first, "{name}: {length}");
    }
}

#[test]
fn a_robot_rolled_up_from_its_tip_is_half_as_bent_at_its_base() {
    let rolled = robot("epam", "initial_curvature", 0.3);
    let rest = |i: usize| rolled.cells[i].wall.rest_per_m;
    near(rest(47), 0.3, 0.006);
    near(rest(0), 0.15, 0.002);
    assert!((1..48).all(|i| rest(i) > rest(i - 1)));
}

/// What the push does along its stroke is P times the volume per length gained: v (1 − β (h/W)²) of a square lens of half angle a.
#[test]
fn bowed_edges_take_the_square_of_the_rise_and_keep_the_balance_of_energy() {
    let edge = drive("epam", "end_constraint", 0.8);
    let volume = |a: f64| {
        let whole = edge.width_m * edge.length_m * (a - a.sin() * a.cos()) / (2.0 * a * a);
        whole * (1.0 - 0.8 * ((1.0 - a.cos()) / a).powi(2))
    };
    let (from, step) = (0.05, 1e-3);
    let done: f64 = (0..1500).map(|i| step * edge.at(from + (f64::from(i) + 0.5) * step, 1.0).push).sum();
    near(done / (volume(1.55) - volume(0.05)), 1.0, 1e-6);
    let push = |beta: f64| drive("fpam", "end_constraint", beta).at(0.1, 1.0).push;
    near(push(0.0) - push(1.0), 2.0 * (push(0.0) - push(0.5)), 1e-12);
    assert!(push(1.0) < push(0.0));
}

#[test]
fn a_bulged_wall_pulls_through_the_centroid_of_its_arc() {
    let arm =
        |a: f64| drive("epam", "arm_growth", 1.0).at(a, 1.0).arm - drive("epam", "arm_growth", 0.0).at(a, 1.0).arm;
    near(arm(0.01), 0.01 / 6.0, 1e-6);
    // Half a circle of length L₀ has the radius L₀/π and its centroid at 2/π of it.
    near(arm(std::f64::consts::FRAC_PI_2), 2.0 / (std::f64::consts::PI * std::f64::consts::PI), 1e-12);
    for a in [0.2, 1.0, 2.2] {
        let state = drive("epam", "arm_growth", 1.0).at(a, 1.0);
        near(state.d_arm, (arm(a + 1e-6) - arm(a - 1e-6)) / 2e-6, 1e-6);
    }
}

#[test]
fn fung_s_fabric_is_twice_as_stiff_at_its_scale_and_pushes_nothing() {
    let fabric = drive("epam", "fabric_stretch", 1e-4);
    let slope = |line: f64| {
        let at = |line: f64| fabric.stretch(line * fabric.width_m);
        (at(line + 0.01) - at(line)) / 0.01
    };
    near(slope(0.0), 1e-4, 1e-8);
    near(slope(300.0), 0.5e-4, 1e-8);
    assert_eq!(fabric.stretch(-5.0), 0.0);
}

#[test]
fn a_hardening_crease_resists_by_the_power_of_its_angle() {
    let resist = |a: f64| {
        drive("epam", "seam_stiffness", 0.0).at(a, 0.0).push - drive("epam", "seam_stiffness", 0.5).at(a, 0.0).push
    };
    near(resist(1.0), 0.5 / 0.06, 1e-9);
    near(resist(0.5) / resist(1.0), 0.5f64.powf(0.4), 1e-12);
}

#[test]
fn a_weave_lets_go_by_halves_and_jams_by_the_cube() {
    let shear = drive("fpam", "shear_stiffness", 40.0);
    near(shear.shear_load(0.15), 0.5 * 40.0 * 0.15, 1e-12);
    near(shear.shear_load(-0.15), -shear.shear_load(0.15), 1e-12);
    let lock = drive("fpam", "shear_lock", 2.0);
    near(lock.shear_load(0.18), 2.0 * 7.0, 1e-12);
    assert!(lock.shear_load(-0.1) == 0.0 && lock.shear_load(0.36) > 1e5);
}

#[test]
fn the_weight_is_w_l_wherever_it_sits_and_a_hose_on_the_table_weighs_nothing() {
    let heavy = robot("epam", "gravity", 1.5);
    let along: f64 = heavy.loads.weight_n_per_m.iter().zip(&heavy.cells).map(|(w, cell)| w * cell.length_m).sum();
    near(along + heavy.loads.cap_n, 1.5 * heavy.length_m, 1e-12);
    near(heavy.loads.cap_n, 0.5 * heavy.length_m, 1e-12);
    let mut hose = robot("epam", "tip_load", 2.0).loads;
    let along_gravity = |loads: &crate::loads::AttachedLoads, height_m: f64| {
        let force = loads.on_tip(loads.down.map(|d| -height_m * d));
        force[0] * loads.down[0] + force[1] * loads.down[1]
    };
    near(along_gravity(&hose, 0.1), 2.0 * 0.4, 1e-12);
    assert_eq!(along_gravity(&hose, -0.5), 0.0);
    hose.down = hose.down.map(|d| -d);
    near(along_gravity(&hose, 0.1), 2.0 * 0.4, 1e-12);
}

#[test]
fn a_supply_loses_with_its_seam_its_spring_and_its_hole() {
    let seam = TrueSupply { loss: [0.0, 0.2], ..TrueSupply::default() };
    near(seam.pressure(30e3, 1.0, 0.0), 0.8 * 30e3, 1e-9);
    near(seam.pressure(7.5e3, 1.0, 0.0), 0.9 * 7.5e3, 1e-9);
    let spring = TrueSupply { dead_band_pa: [0.0, 2e3], ..TrueSupply::default() };
    near(spring.pressure(40e3, 1.0, 0.0), 38e3, 1e-4);
    near(spring.pressure(20.0, 1.0, 0.0), 20.0 * 20.0 / 4e3, 1e-3);
    let hole = TrueSupply { leak_per_s: [0.0, 0.05], ..TrueSupply::default() };
    near((hole.pressure(20e3, 1.0, 1e-3) - 20e3) / 1e-3, -0.05 * 20e3, 1.0);
    assert!(hole.pressure(20e3, 1.0, 39.0) > 0.0 && hole.pressure(20e3, 1.0, 41.0) == 0.0, "empty in a finite time");
}

#[test]
fn pins_are_rigid_and_pixels_a_knock_and_a_grip_leave_what_they_do_not_touch() {
    let seen =
        |camera: Camera, xy: [f64; 2], heading: f64, p: f64| camera.see(&SeenPoint { xy, heading, station_m: 0.1 }, p);
    let camera = Camera { length_m: 0.36, ..Camera::default() };
    let pins = Camera { height_m: [0.0, 0.01], ..camera };
    assert_eq!(seen(pins, [0.1, 0.0], 0.0, 0.0), [0.1, 0.0]);
    // Turned by half a turn, every offset comes out twice.
    let turned = seen(pins, [0.1, 0.0], std::f64::consts::PI, 0.0);
    near((turned[0] - 0.1).hypot(turned[1]), 0.02, 1e-12);
    let pixels = seen(Camera { scale: [0.0, 0.02], ..camera }, [0.2, 0.1], 0.0, 0.0);
    near(pixels[0] / 0.2 - 1.0, 2.0 * (pixels[1] / 0.1 - 1.0), 1e-12);
    let knocked = Camera { roll_rad: [0.0, 0.1], ..camera };
    let middle = seen(knocked, [0.18, 0.0], 0.0, 0.0);
    near((middle[0] - 0.18).hypot(middle[1]), 0.0, 1e-15);
    let grip = Camera { mount_rad: [0.0, 0.03], ..camera };
    assert_eq!(seen(grip, [0.3, 0.0], 0.0, 7.5e3), [0.3, 0.0]);
    near(seen(grip, [0.3, 0.0], 0.0, 30e3)[1], 0.3 * 0.03f64.sin(), 1e-12);
}
