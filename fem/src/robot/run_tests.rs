//! A robot's run from the text of its scenario: settings, loads, readings.

use super::*;
use crate::problem::{Amplitude, ObstacleShape, Pressure};
use crate::robot::RobotGauge;
use models::CHANNELS;

fn text(more: &str) -> String {
    format!("{}\n[fem]\n{more}\n", models::shipped("epam").unwrap())
}

fn parsed(more: &str) -> Result<(Scenario, RobotRun), FemError> {
    let scenario = Scenario::parse(&text(more)).unwrap();
    RobotRun::parse(&text(more), &scenario).map(|run| (scenario, run))
}

fn refused(more: &str) -> (String, String) {
    match parsed(more).unwrap_err() {
        FemError::Case { message, span } => (message, span.map_or(String::new(), |span| text(more)[span].to_string())),
        other => panic!("{other}"),
    }
}

#[test]
fn keys_of_the_table_become_settings_in_si_over_the_preset() {
    let (_, run) = parsed(
        "actuator_mesh_mm = 3\nmesh_mm = 5\nmodel = \"paper\"\nbond = 0.25\nseed = 7\nnu12 = 0.1\ncontact = true\nselective_mass = true",
    )
    .unwrap();
    let s = &run.settings;
    assert_eq!((s.body_size_m, s.actuator_size_m, s.bond, s.seed), (5e-3, 3e-3, 0.25, 7));
    assert_eq!((s.nu12, s.contact, s.selective_mass, s.actuator_ramp_s), (Some(0.1), Some(true), true, 1.0));
    assert_eq!(run.pressures_pa, [10e3, 20e3, 30e3].map(|pa| [pa; CHANNELS]), "those that the scenario predicts at");
    let (_, plain) = parsed("").unwrap();
    assert_eq!(plain.settings, RobotSettings::default());
}

#[test]
fn every_key_is_read_back_as_written_and_within_its_bounds() {
    let defaults = RobotSettings::default();
    for key in KEYS {
        let value = (key.get)(&defaults).map(|value| value / key.si);
        assert!(value.is_none_or(|v| (key.bounds[0]..=key.bounds[1]).contains(&v)), "{}: {value:?}", key.name);
        let middle = if key.name == "seed" { 3.0 } else { 0.5 * (key.bounds[0] + key.bounds[1]) };
        let (_, run) = parsed(&format!("{} = {middle}", key.name)).unwrap();
        assert!(((key.get)(&run.settings).unwrap() / (middle * key.si) - 1.0).abs() < 1e-12, "{}", key.name);
    }
}

#[test]
fn faults_of_the_table_are_refused_with_their_place() {
    for (more, words, place) in [
        ("hourglas = 0.1", "did you mean `hourglass`?", "hourglas"),
        ("weld_m = 0.001", "did you mean `weld_mm`?", "weld_m"),
        ("mesh_mm = 0.004", "mesh_mm must be from 0.5 to 50, not 0.004", "0.004"),
        ("bond = \"all\"", "bond must be a number", "\"all\""),
        ("model = \"fast\"", "known here: recommended, paper", "\"fast\""),
        ("base = \"glued\"", "known here: pinned, encastre", "\"glued\""),
        ("separate = 1", "separate must be true or false", "1"),
        ("pressures_kpa = [10, 1]", "an actuator at 1 kPa in a body at 2 kPa stays flat", "[10, 1]"),
        ("pressures_kpa = [10000]", "looks like pascals", "[10000]"),
        ("pressures_kpa = []", "[10, 20, 30]", "[]"),
        ("seed = 1.5", "whole number", "1.5"),
        ("meshes_mm = [4]", "two meshes or more", "[4]"),
        ("meshes_mm = [[8, 4], [8]]", "needs two sizes", "[[8, 4], [8]]"),
        ("meshes_mm = [[8, 4], [8, 0.004]]", "meshes_mm must be from 0.5 to 50, not 0.004", "[[8, 4], [8, 0.004]]"),
        ("meshes_mm = [[8, 4], [8, 4]]", "twice", "[[8, 4], [8, 4]]"),
        ("selective_mass = 1", "selective_mass must be true or false", "1"),
        ("mass_passes = 3", "mass_passes cannot be 3", "3"),
        ("contact = \"yes\"", "leave it out: where the pattern folds", "\"yes\""),
        ("tip_force_n = [1, 2]", "three numbers", "[1, 2]"),
        ("obstacle_friction = 0.2", "add obstacle_mm", "obstacle_friction"),
        ("obstacle_moves_mm = [[0, 0, 0]]", "obstacle_moves_mm without an obstacle", "obstacle_moves_mm"),
        ("obstacle_mm = [200, 80, 25]\nobstacle_moves_mm = [0, 1, 0]", "is not a list", "[0, 1, 0]"),
        ("gravity_m_s2 = 9.81", "must be a list", "9.81"),
        ("tip_force_n = [[0, 0, 0], [0, 1, 0]]", "2 entries and pressures_kpa 3", "[[0, 0, 0], [0, 1, 0]]"),
        ("pressures_kpa = [20, 20]", "differ one by one, or loads that do", "[20, 20]"),
        ("separate = true\npressures_kpa = [20]\ntip_force_n = [[0, 1, 0]]", "write separate = false", "[[0, 1, 0]]"),
    ] {
        let (message, found) = refused(more);
        assert!(message.contains(words) && found == place, "{more}: {message} at {found}");
    }
}

#[test]
fn a_study_of_the_mesh_names_its_meshes_and_one_of_them_takes_their_place() {
    let (_, run) = parsed("meshes_mm = [[8, 4], [4, 1]]").unwrap();
    assert_eq!(run.meshes_m, [[8e-3, 4e-3], [4e-3, 1e-3]]);
    assert_eq!(run.settings, RobotSettings::default());
    let one = with_fem(&text("meshes_mm = [[8, 4], [4, 1]]"), &[("body_mesh_mm", "8"), ("actuator_mesh_mm", "4")]);
    let one = RobotRun::parse(&one.unwrap(), &Scenario::parse(&text("")).unwrap()).unwrap();
    assert_eq!((one.meshes_m, one.settings.actuator_size_m), (Vec::new(), 4e-3));
}

#[test]
fn a_run_that_waits_otherwise_is_another_one_and_goes_on_from_the_same_ends() {
    let of = |more: &str| {
        let (scenario, run) = parsed(&format!("mesh_mm = 16\n{more}")).unwrap();
        run.problem(&scenario).unwrap()
    };
    let [usual, others @ ..] = ["", "creep = 0.001", "rest_s = 0.1"].map(of);
    for other in others {
        assert_ne!(other.fingerprint(), usual.fingerprint());
        assert_eq!(other.fingerprint_of_structure(), usual.fingerprint_of_structure());
    }
}

/// Mass damping of a robot whose tip swings with 64 rad/s.
fn usual_damping(mass_damping_1_s: Option<f64>) -> f64 {
    let (scenario, mut run) = parsed("mesh_mm = 16").unwrap();
    run.settings.mass_damping_1_s = mass_damping_1_s;
    numerics(&run.problem(&scenario).unwrap(), &run.settings, 64.0).mass_damping_1_s
}

/// Elements below 1.5 mm take six passes and half the steps; what is said holds on every mesh.
#[test]
fn fine_meshes_take_more_passes_of_selective_masses_and_fewer_steps() {
    let (scenario, coarse) = parsed("mesh_mm = 16").unwrap();
    let problem = coarse.problem(&scenario).unwrap();
    let of = |more: &str| {
        let settings = numerics(&problem, &parsed(&format!("mesh_mm = 16\n{more}")).unwrap().1.settings, 64.0);
        let MassScaling::TargetStep(step_s) = settings.mass_scaling else { panic!("no step") };
        (settings.mass_passes, step_s)
    };
    let [usual, fine, said, more] = [
        "actuator_mesh_mm = 8",
        "actuator_mesh_mm = 1.4",
        "actuator_mesh_mm = 1.4\nmass_passes = 2",
        "mass_passes = 6",
    ]
    .map(of);
    let (longer, same) = (fine.1 / said.1, usual.1 / 8.0 * 1.4 / said.1);
    assert_eq!([usual.0, fine.0, said.0, more.0], [2, 6, 2, 6]);
    assert!((1.8..1.9).contains(&longer) && (same - 1.0).abs() < 1e-12, "{longer} {same}");
    // Where layers of such elements touch, masses are raised less; one says how far.
    for (more, size_mm, raised) in [
        ("contact = true", 1.4, 1.0),
        ("contact = true", 8.0, 1.0 / 1.5),
        ("contact = true\nmass_factor = 7.2", 8.0, 2.0),
    ] {
        let (scenario, run) = parsed(&format!("mesh_mm = 16\n{more}")).unwrap();
        let settings = RobotSettings { actuator_size_m: size_mm * 1e-3, ..run.settings.clone() };
        let chosen = numerics(&run.problem(&scenario).unwrap(), &settings, 64.0);
        let MassScaling::TargetStep(step_s) = chosen.mass_scaling else { panic!("no step") };
        let free_s = if size_mm < 1.5 { fine.1 } else { usual.1 };
        assert!(((step_s / free_s).powi(2) / raised - 1.0).abs() < 1e-9, "{more}: {step_s} {free_s}");
    }
    assert_eq!((usual_damping(None), usual_damping(Some(40.0))), (1.4 * 64.0, 40.0));
    let said = parsed("selective_mass = false\nmass_passes = 6").unwrap().1.settings;
    assert_eq!((said.selective_mass, said.mass_passes), (false, Some(6)));
}

#[test]
fn one_ramp_leads_through_all_pressures_at_one_rate_and_rests_at_each() {
    let (scenario, run) = parsed("pressures_kpa = [10, 25, 30]\nhold_s = 0.03\nmesh_mm = 8").unwrap();
    let problem = run.problem(&scenario).unwrap();
    let Pressure::Set(amplitude @ Amplitude::Growing { .. }) = &problem.chambers[1].pressure else { panic!("not set") };
    let holds = run.holds();
    let (filled, ramp) = (run.settings.body_ramp_s, run.settings.actuator_ramp_s);
    // Above a floor of 2 kPa, 0 to 10 of 30 kPa is ln 6 of ln 16; 25 to 30 is less than a sixth.
    let [first, second] = [6_f64, 27.0 / 12.0].map(|factor| ramp * factor.ln() / 16_f64.ln());
    let ends = [0.0, first, first + second, first + second + ramp / 6.0];
    for (at, (hold, pressure_pa)) in holds.iter().zip([0.0, 10e3, 25e3, 30e3]).enumerate() {
        let time_s = filled + ends[at] + 0.03 * at as f64;
        assert!((hold.time_s - time_s).abs() < 1e-12 && hold.highest_pa() == pressure_pa, "{holds:?}");
        assert!((amplitude.at(time_s) - pressure_pa).abs() < 1e-9 * 30e3);
        assert!((amplitude.at(time_s - 0.029) - pressure_pa).abs() < 1e-9 * 30e3 || pressure_pa == 0.0);
    }
    assert_eq!((holds.len(), problem.settings.end_s), (4, holds[3].time_s));
}

#[test]
fn the_papers_model_sets_its_modelling_choices_and_other_keys_override_them() {
    let (_, run) = parsed("model = \"paper\"").unwrap();
    let s = &run.settings;
    assert_eq!((run.model, run.separate, run.pressures_pa.len()), (Preset::Paper, true, 3));
    assert_eq!([s.body_size_m, s.actuator_size_m, s.layer_gap_m], [4e-3, 4e-3, 1e-5]);
    assert_eq!(([s.bending_factor, s.bond], s.wrinkle_length), ([1.0, 1.0], None));
    assert_eq!([s.weld_m, s.tape_m, s.tape_margin_m, s.waviness_m], [0.0, 1e-6, 0.0, 0.0]);
    assert_eq!([s.body_ramp_s, s.actuator_ramp_s, s.hold_s], [0.1, 1.0, 0.0]);
    assert_eq!((s.nu12, s.ring_spacing, s.ramp_floor_pa), (Some(0.0), Some(1.0), None));
    assert_eq!((s.selective_mass, s.mass_factor, s.encastre), (true, None, false));
    let (_, run) = parsed("bending_factor = 0.5\nmodel = \"paper\"\nbase = \"encastre\"").unwrap();
    assert_eq!(run.settings, RobotSettings { bending_factor: 0.5, encastre: true, ..RobotSettings::paper() });
    let mut keys = run.set.clone();
    keys.sort();
    assert_eq!(keys, ["base", "bending_factor"]);
}

#[test]
fn the_papers_pressures_are_runs_of_their_own_in_its_smooth_steps() {
    let (scenario, run) = parsed("model = \"paper\"\nmesh_mm = 8\npressures_kpa = [20]").unwrap();
    let problem = run.problem(&scenario).unwrap();
    let Pressure::Set(Amplitude::Smooth(points)) = &problem.chambers[1].pressure else { panic!("no smooth step") };
    assert_eq!(points[..], [(0.1, 0.0), (1.1, 20e3)]);
    assert_eq!(problem.settings.end_s, 1.1);
    let (_, several) = parsed("model = \"paper\"\nmesh_mm = 8").unwrap();
    let told = several.problem(&scenario).unwrap_err().to_string();
    assert!(told.contains("write separate = false"), "{told}");
    let (_, one) = parsed("model = \"paper\"\nmesh_mm = 8\nseparate = false").unwrap();
    assert_eq!(one.problem(&scenario).unwrap().settings.end_s, one.holds()[3].time_s);
}

#[test]
fn an_encastre_base_holds_the_row_beside_its_ring() {
    let held = |base: &str| {
        let (scenario, run) = parsed(&format!("mesh_mm = 8\nbody_ramp_s = 0.2\nbase = \"{base}\"")).unwrap();
        let problem = run.problem(&scenario).unwrap();
        let nodes = &problem.mesh.sets[&problem.supports[0].set];
        let wall =
            |n: &&u32| problem.mesh.points[**n as usize][1..].iter().map(|x| x * x).sum::<f64>().sqrt() < 0.040_001;
        let furthest = nodes.iter().map(|n| problem.mesh.points[*n as usize][0]).fold(0.0, f64::max);
        (nodes.iter().filter(wall).count(), furthest)
    };
    let ((ring, at_base), (rows, beside)) = (held("pinned"), held("encastre"));
    assert!(rows == 2 * ring && at_base == 0.0 && (0.004..0.009).contains(&beside), "{ring} {rows} {beside}");
}

/// The body is open at its base: filled, it pulls on what holds it with p π R².
#[test]
fn the_base_holds_the_filled_body_however_it_is_held() {
    for base in ["pinned", "encastre"] {
        let (scenario, run) = parsed(&format!("mesh_mm = 8\nbody_ramp_s = 0.2\nbase = \"{base}\"")).unwrap();
        let problem = run.problem(&scenario).unwrap();
        let gauge = crate::robot::RobotGauge::new(&scenario, &problem).unwrap();
        let mut body = crate::Simulation::new(&problem).unwrap();
        body.advance_until(run.holds()[0].time_s, &mut |_| true).unwrap();
        let reading = gauge.read(&body, Rest::Until(0.0)).unwrap();
        let pull = scenario.p_body_pa * std::f64::consts::PI * scenario.radius_m.powi(2);
        assert!((reading.base_n[0] / -pull - 1.0).abs() < 0.05, "{base}: {:?}, {pull}", reading.base_n);
        assert!(reading.base_n[1].hypot(reading.base_n[2]) < 0.05 * pull, "{base}: {:?}", reading.base_n);
    }
}

#[test]
fn loads_of_the_outlook_reach_the_problem() {
    let (scenario, run) =
        parsed("tip_force_n = [0, -1, 0]\nobstacle_mm = [200, 80, 25]\nobstacle_friction = 0.2\nmesh_mm = 8").unwrap();
    let problem = run.problem(&scenario).unwrap();
    assert_eq!((problem.forces[0].set.as_str(), problem.forces[0].total_n), ("tip", [0.0, -1.0, 0.0]));
    let ObstacleShape::Cylinder { point, radius_m, .. } = problem.obstacles[0].shape else { panic!("no cylinder") };
    assert!((point[0] - 0.2).abs() < 1e-12 && (radius_m - 0.025).abs() < 1e-12 && problem.obstacles[0].friction == 0.2);
}

#[test]
fn a_load_with_an_entry_for_every_pressure_comes_on_with_it() {
    let (scenario, run) = parsed(
        "pressures_kpa = [20, 20, 10]\nmesh_mm = 8\ntip_force_n = [[0, 0, 0], [0, -1, 0], [0, -1, 1]]\n\
         gravity_m_s2 = [[0, 0, 0], [0, -4, 0], [0, -8, 0]]\nobstacle_mm = [200, 120, 25]\n\
         obstacle_moves_mm = [[0, 0, 0], [0, -20, 0], [5, -20, 0]]",
    )
    .unwrap();
    let problem = run.problem(&scenario).unwrap();
    let holds = run.holds();
    let at = |hold: usize| problem.loads_at(holds[hold].time_s);
    let close = |found: [f64; 3], wanted: [f64; 3]| (0..3).all(|k| (found[k] - wanted[k]).abs() < 1e-9);
    let expected = [
        ([0.0; 3], [0.0; 3], [0.0; 3]),
        ([0.0; 3], [0.0; 3], [0.0; 3]),
        ([0.0, -1.0, 0.0], [0.0, -4.0, 0.0], [0.0, -0.02, 0.0]),
        ([0.0, -1.0, 1.0], [0.0, -8.0, 0.0], [0.005, -0.02, 0.0]),
    ];
    for (hold, (force, gravity, moved)) in expected.into_iter().enumerate() {
        let loads = at(hold);
        assert!(
            close(loads["force on `tip` [N]"], force) && close(loads["gravity [m/s²]"], gravity),
            "{hold}: {loads:?}"
        );
        assert!(close(loads["motion of obstacle 1 [m]"], moved), "{hold}: {loads:?}");
    }
    let turning = parsed("pressures_kpa = [20, 20]\nmesh_mm = 8\ngravity_m_s2 = [[0, -4, 0], [-4, 0, 0]]").unwrap().1;
    assert!(turning.problem(&scenario).unwrap_err().to_string().contains("one direction"));
}

#[test]
fn a_run_that_goes_on_begins_with_the_loads_of_the_end_before() {
    let (scenario, first) = parsed("pressures_kpa = [20]\nmesh_mm = 8\ntip_force_n = [0, -1, 0]").unwrap();
    let end_s = first.holds()[1].time_s;
    let loads = first.problem(&scenario).unwrap().loads_at(end_s);
    let (_, mut second) = parsed("pressures_kpa = [5]\nmesh_mm = 8\ngravity_m_s2 = [0, -9.81, 0]").unwrap();
    second.start = Some(RobotStart::of(&scenario, end_s, &loads));
    let problem = second.problem(&scenario).unwrap();
    let (begin, end) = (problem.loads_at(end_s), problem.loads_at(second.holds()[1].time_s));
    let of = |loads: &crate::problem::PrintedLoads, what: &str| loads.get(what).copied().unwrap_or_default();
    for what in loads.keys() {
        let (before, now) = (of(&loads, what), of(&begin, what));
        assert!(
            (0..3).all(|k| (before[k] - now[k]).abs() < 1e-6 * before[k].abs().max(1.0)),
            "{what}: {before:?} {now:?}"
        );
    }
    let pressure = |chamber: &str| of(&end, &crate::problem::pressure_of(chamber))[0];
    assert!((pressure("actuator") - 5e3).abs() < 1e-6 && (pressure("body") - scenario.p_body_pa).abs() < 1e-6);
    assert_eq!((of(&end, "force on `tip` [N]"), of(&end, "gravity [m/s²]")), ([0.0; 3], [0.0, -9.81, 0.0]));
    assert!(
        problem.settings.end_s > end_s
            && problem.fingerprint_of_structure() == first.problem(&scenario).unwrap().fingerprint_of_structure()
    );
}

/// A filled body is a beam on its base ring: the base carries its weight W, and the moment W L/2.
#[test]
fn gravity_weighs_on_the_base_of_a_filled_body_and_its_tip_hangs() {
    let (scenario, run) =
        parsed("mesh_mm = 8\nbody_ramp_s = 0.5\nmass_damping_1_s = 200\ngravity_m_s2 = [0, -9.81, 0]").unwrap();
    let problem = run.problem(&scenario).unwrap();
    let gauge = RobotGauge::new(&scenario, &problem).unwrap();
    let mut body = crate::Simulation::new(&problem).unwrap();
    let filled_s = run.holds()[0].time_s;
    body.advance_until(filled_s, &mut |_| true).unwrap();
    let (reading, loads) = (gauge.read(&body, Rest::Until(0.0)).unwrap(), problem.loads_at(filled_s));
    // Weight, and its moment about the base.
    let mut expected = [0.0; 2];
    for (part, section) in problem.mesh.parts.iter().zip(&problem.sections) {
        let thickness_m: f64 = section.plies.iter().map(|ply| ply.fabric.thickness_m()).sum();
        for i in 0..part.len() {
            let corners: Vec<_> = part.nodes(i).iter().map(|n| problem.mesh.points[*n as usize]).collect();
            let area_m2 = crate::vec3::norm(crate::vec3::area(&corners));
            let weight_n = 9.81 * section.density_kg_m3 * thickness_m * area_m2;
            expected[0] += weight_n;
            expected[1] += weight_n * crate::vec3::centre(&corners)[0];
        }
    }
    // The moment is about the mean of the base's nodes, and the gas pulls along the axis.
    let base = &problem.mesh.sets[&problem.supports[0].set];
    let mean_m = base.iter().map(|n| problem.mesh.points[*n as usize][1]).sum::<f64>() / base.len() as f64;
    expected[1] += reading.base_n[0] * mean_m;
    let found = [reading.base_n[1], reading.base_nm[2]];
    assert_eq!(loads["gravity [m/s²]"], [0.0, -9.81, 0.0]);
    assert!((0..2).all(|k| (found[k] / expected[k] - 1.0).abs() < 0.01), "{found:?} for {expected:?}");
    // The further from the base, the lower.
    let heights: Vec<f64> = reading.moved_m.iter().map(|moved| moved[1]).collect();
    assert!(heights[..6].windows(2).all(|pair| pair[1] < pair[0]) && heights[5] < -5e-5, "{heights:?}");
}

#[test]
fn sheets_take_another_thickness_and_modulus_and_woven_ones_refuse_the_modulus() {
    let more = "mesh_mm = 8\nsheet_mm = 0.1\nsheet_e_mpa = 120\nbody_sheet_mm = 0.3";
    let (scenario, run) = parsed(more).unwrap();
    let problem = run.problem(&scenario).unwrap();
    let fabric_of = |part: &str| {
        let at = problem.mesh.parts.iter().position(|p| p.name == part).unwrap();
        std::sync::Arc::clone(&problem.sections[at].plies[0].fabric)
    };
    // Pulled along one axis a sheet has the tension E t per strain.
    let pulled = |part: &str| {
        let a = fabric_of(part).tangent([1e-9, 0.0, 0.0], &[0.0; 2]);
        (fabric_of(part).thickness_m(), a[0][0] - a[0][1] * a[1][0] / a[1][1])
    };
    let (top, wall) = (pulled("top"), pulled("wall"));
    assert!((top.0 - 1e-4).abs() < 1e-12 && (wall.0 - 3e-4).abs() < 1e-12, "{top:?} {wall:?}");
    assert!((top.1 / (120e6 * 1e-4) - 1.0).abs() < 1e-3, "{top:?}");
    let woven = format!("{}\n[fem]\nmesh_mm = 8\nsheet_e_mpa = 100\n", models::shipped("fpam").unwrap());
    let scenario = Scenario::parse(&woven).unwrap();
    let refused = RobotRun::parse(&woven, &scenario).unwrap().problem(&scenario).unwrap_err().to_string();
    assert!(refused.contains("sheet_e_mpa = 100") && refused.contains("Leave sheet_e_mpa out"), "{refused}");
}

#[test]
fn a_turn_of_the_whole_robot_is_read_as_the_turn_of_its_tip() {
    let (scenario, run) = parsed("mesh_mm = 8").unwrap();
    let problem = run.problem(&scenario).unwrap();
    let gauge = RobotGauge::new(&scenario, &problem).unwrap();
    for angle in [-0.7_f64, 0.0, 0.4, 2.5] {
        let (s, c) = angle.sin_cos();
        let turned = |p: &[f64; 3]| [c * p[0] - s * p[1] + 0.3, s * p[0] + c * p[1], p[2]];
        let start = (0..problem.mesh.points.len()).map(|node| problem.mesh.start_of(node));
        let turned: Vec<[f64; 3]> = start.map(|p| turned(&p)).collect();
        assert!((gauge.turn_rad(&turned) - angle).abs() < 1e-9, "{angle}");
    }
}

#[test]
fn welds_are_where_three_sheets_meet_and_pull_with_their_tension() {
    let (scenario, run) = parsed("mesh_mm = 8\nweld_mm = 0").unwrap();
    let problem = run.problem(&scenario).unwrap();
    let seams = Seams::of(&problem.mesh);
    let gauge = RobotGauge::new(&scenario, &problem).unwrap();
    // All edges of six pouches of 60 x 60 mm: weld elements are on the strip or beside it.
    for element in seams.elements() {
        let (part, x) = gauge.place(*element);
        assert!(
            ["wall", "face", "top", "tip_cap"].contains(&part.as_str()) && (0.0..0.3601).contains(&x),
            "{part} {x}"
        );
    }
    let count = problem.mesh.elements();
    let mut fields = crate::run::ElementFields {
        principal_stress_pa: vec![[1e9, 0.0]; count],
        thickness_m: vec![2e-4; count],
        ..crate::run::ElementFields::default()
    };
    for element in seams.elements() {
        fields.principal_stress_pa[*element] = [1e6, 0.0];
    }
    let one = seams.elements()[3];
    fields.principal_stress_pa[one] = [5e6, 1e6];
    let found = seams.largest(&fields).unwrap();
    assert!(found.element == one && (found.n_per_m - 1000.0).abs() < 1e-9, "{found:?}");
}
