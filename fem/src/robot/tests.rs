use super::*;
use crate::Simulation;
use crate::mesh::check::Quality;
use models::scenario::SHIPPED;

fn shipped(name: &str) -> Scenario {
    Scenario::parse(models::shipped(name).unwrap()).unwrap()
}

/// Welds are lines and nothing is wavy, so that areas and volumes are those of the pattern.
pub(super) fn coarse() -> RobotSettings {
    let exact = RobotSettings { weld_m: 0.0, waviness_m: 0.0, ..RobotSettings::default() };
    RobotSettings { body_size_m: 8e-3, actuator_size_m: 6e-3, ..exact }
}

fn robot(name: &str, settings: &RobotSettings) -> Problem {
    problem(&shipped(name), settings).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn refused(name: &str, change: impl Fn(&mut Scenario, &mut RobotSettings)) -> String {
    let (mut scenario, mut settings) = (shipped(name), coarse());
    change(&mut scenario, &mut settings);
    problem(&scenario, &settings).unwrap_err().to_string()
}

/// Area of the parts that `wanted` picks; quads are planar here.
pub(super) fn area_m2(mesh: &Mesh, wanted: impl Fn(&str) -> bool) -> f64 {
    let mut sum = 0.0;
    for quad in mesh.parts.iter().filter(|p| wanted(&p.name)).flat_map(|p| &p.quads) {
        let x = quad.map(|n| mesh.points[n as usize]);
        let side = |a: usize, b: usize| [0, 1, 2].map(|k| x[b][k] - x[a][k]);
        let (d, e) = (side(0, 2), side(1, 3));
        let cross = [d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]];
        sum += 0.5 * cross.iter().map(|c| c * c).sum::<f64>().sqrt();
    }
    sum
}

fn quality(problem: &Problem) -> Quality {
    check_open(&problem.mesh, &[sew::BODY, sew::ACTUATOR], &[sew::BASE]).unwrap()
}

pub(super) fn volume_m3(problem: &Problem, chamber: &str) -> f64 {
    quality(problem).volumes_m3.iter().find(|v| v.0 == chamber).unwrap().1
}

pub(super) fn radius_m(mesh: &Mesh, node: u32) -> f64 {
    let p = mesh.points[node as usize];
    p[1].hypot(p[2])
}

#[test]
fn every_shipped_robot_meshes_and_starts() {
    for (name, _) in SHIPPED {
        for settings in [coarse(), RobotSettings { weld_m: 5e-3, ..coarse() }] {
            let problem = robot(name, &settings);
            for set in ["base", "tip", "far_generator", "marker_1", "marker_6"] {
                assert!(!problem.mesh.sets[set].is_empty(), "{name} {set}");
            }
            let mut run = Simulation::new(&problem).unwrap_or_else(|e| panic!("{name}: {e}"));
            run.advance_until(20.0 * run.dt_s(), &mut |_| true).unwrap_or_else(|e| panic!("{name}: {e}"));
        }
    }
}

#[test]
fn fine_actuators_on_coarse_bodies_mesh_without_thin_elements() {
    for (name, _) in SHIPPED {
        let exact = RobotSettings { waviness_m: 0.0, ..RobotSettings::default() };
        let problem = robot(name, &RobotSettings { body_size_m: 4e-3, actuator_size_m: 2e-3, ..exact });
        let quality = quality(&problem);
        // A weld of 3 mm is two rows here.
        assert!(quality.side_m.min > 1.49e-3 && quality.aspect < 4.0, "{name}: {quality:?}");
    }
}

#[test]
fn areas_are_those_of_the_pattern_and_the_folded_sheet_is_2_60_times_the_flat_one() {
    let sheet = |name: &str| {
        let problem = robot(name, &coarse());
        let panels = (shipped(name).actuator.kind.pattern)(&shipped(name).actuator.shape).panels;
        area_m2(&problem.mesh, |part| panels.iter().any(|p| p.name == part))
    };
    let (flat, folded) = (sheet("epam"), sheet("cpam"));
    // Chords of 6 mm on a radius of 40 mm are 0.1 % short of their arcs.
    assert!((flat / (0.36 * 0.06) - 1.0).abs() < 1.5e-3, "{flat}");
    assert!((folded / flat - 2.60).abs() < 2e-3, "{}", folded / flat);
    assert!((sheet("fpam") / (0.3 * 0.06) - 1.0).abs() < 1.5e-3);
}

/// D = 0.2 · 4/3 E t³/12 of a sheet with E = 6 · 50.3 MPa and t = 0.2 mm, T = 2 kPa · 40 mm; between its side welds a
/// pouch is 57 mm wide, so ℓ = 97.2 mm in the wall and 28.5 mm in a pouch.
#[test]
fn compressed_sheets_of_the_epam_carry_the_load_of_their_wrinkles_and_those_of_the_papers_model_all() {
    let bending_nm: f64 = 0.2 * 4.0 / 3.0 * 6.0 * 50.3e6 * 8e-12 / 12.0;
    let of = |length_m: f64| 2.0 * std::f64::consts::PI * (bending_nm * 80.0).sqrt() / length_m;
    let load = |settings: &RobotSettings, part: &str| {
        let (_, problem) = crate::robot::shipped("epam", settings).unwrap();
        let at = problem.mesh.parts.iter().position(|p| p.name == part).unwrap();
        match problem.sections[at].plies[0].fabric.kind() {
            models::fabrics::InlinedFabric::WrinklingFilm(film) => Some(film.load_n_per_m),
            _ => None,
        }
    };
    let own = RobotSettings::default();
    for (part, n_per_m, length_m) in [("wall", 4.24, 0.09716), ("top", 14.44, 0.0285)] {
        let found = load(&own, part).unwrap();
        assert!((found / of(length_m) - 1.0).abs() < 1e-3 && (found - n_per_m).abs() < 0.05, "{part}: {found}");
        let twice = RobotSettings { wrinkle_length: Some(2.0), ..own.clone() };
        assert!((load(&twice, part).unwrap() / found - 0.5).abs() < 1e-12);
        assert_eq!(load(&RobotSettings::paper(), part), None);
    }
}

#[test]
fn the_body_holds_the_prism_of_its_section_and_the_pouches_what_lies_between_the_layers() {
    let settings = coarse();
    let scenario = shipped("epam");
    let pattern = (scenario.actuator.kind.pattern)(&scenario.actuator.shape);
    let problem = robot("epam", &settings);
    let lines = GridLines::of(&scenario, &[pattern], &settings).unwrap();
    let turn = lines.angles[0] + std::f64::consts::TAU;
    let next = lines.angles.iter().skip(1).chain(std::iter::once(&turn));
    let section: f64 = lines.angles.iter().zip(next).map(|(a, b)| 0.5 * 0.04f64.powi(2) * (b - a).sin()).sum();
    let body = volume_m3(&problem, "body");
    assert!((body / (section * 0.36) - 1.0).abs() < 1e-9, "{body}");
    // Between two facets R and R + g from the axis: g R sin δ per column. Sheet and wall meet at all edges of a pouch, where
    // half a row and half a column are lost.
    let row = lines.x_m[1] - lines.x_m[0];
    let (columns, delta) = (lines.strips[0].s_m.len() - 1, (lines.strips[0].s_m[1] - lines.strips[0].s_m[0]) / 0.04);
    let exact = 6.0 * (0.06 - row) * (columns - 1) as f64 * 1e-5 * 0.04 * delta.sin();
    let found = volume_m3(&problem, "actuator");
    assert!((found / exact - 1.0).abs() < 2e-4, "{found} {exact}");
}

#[test]
fn layers_of_a_fold_lie_in_order_one_gap_apart() {
    let problem = robot("cpam", &coarse());
    let mesh = &problem.mesh;
    let part = |name: &str| mesh.parts.iter().find(|p| p.name == name).unwrap();
    // In the first unit, a quad in the middle of the left fold, of each layer.
    let radius = |name: &str| {
        let inside = |q: &&[u32; 4]| {
            q.iter().all(|n| {
                let p = mesh.points[*n as usize];
                (p[2].atan2(p[1]) * 0.04 + 0.018).abs() < 0.0061 && (p[0] - 0.03).abs() < 0.02
            })
        };
        let quad = part(name).quads.iter().find(inside).unwrap();
        radius_m(mesh, quad[0])
    };
    for (level, name) in ["face", "gusset_1_left", "gusset_2_left", "top"].iter().enumerate() {
        assert!((radius(name) - 0.04 - level as f64 * 1e-5).abs() < 1e-12, "{name}: {}", radius(name));
    }
    let layers: std::collections::BTreeSet<u32> = mesh.parts.iter().map(|p| p.layer).collect();
    assert_eq!(layers.len(), 6, "each panel and the body");
    assert!(problem.contact.is_some() && robot("epam", &coarse()).contact.is_none());
}

#[test]
fn seams_with_a_width_have_the_layers_of_the_pattern() {
    let wide = RobotSettings { weld_m: 5e-3, ..coarse() };
    let plies = |name: &str, part: &str| {
        let problem = robot(name, &wide);
        let at = problem.mesh.parts.iter().position(|p| p.name == part).unwrap_or_else(|| panic!("{name} {part}"));
        (problem.sections[at].plies.len(), problem.sections[at].bonded)
    };
    assert_eq!(plies("cpam", "seam_4"), (4, true));
    assert_eq!(plies("cpam", "seam_2"), (2, true));
    assert_eq!(plies("spam", "seam_3"), (4, true), "wall, tape, bottom, top");
    assert_eq!(plies("spam", "face"), (3, true));
    assert_eq!(plies("epam", "wall"), (2, false));
    // Half a weld at both ends, whole ones between: 6 widths of 60 mm; and along both sides.
    let area = area_m2(&robot("epam", &wide).mesh, |part| part == "seam_2");
    assert!((area / (6.0 * 5e-3 * 0.055 + 2.0 * 5e-3 * 0.36) - 1.0).abs() < 2e-3, "{area}");
    // Between the welds' middles 60 x 60 mm, inside of them 55 x 55.
    let top = area_m2(&robot("epam", &wide).mesh, |part| part == "top");
    assert!((top / (6.0 * 0.055 * 0.055) - 1.0).abs() < 2e-3, "{top}");
}

#[test]
fn a_tube_that_is_glued_on_has_no_weld_along_it() {
    let wide = RobotSettings { weld_m: 5e-3, tape_margin_m: 5e-3, ..coarse() };
    let strip = |name: &str| {
        let mesh = robot(name, &wide).mesh;
        area_m2(&mesh, |part| part.starts_with("seam")) / (5e-3 * 0.06)
    };
    // Half a weld at the base, a whole one at its other end.
    assert!((strip("fpam") - 1.5).abs() < 2e-3, "{}", strip("fpam"));
    assert!(robot("epam", &wide).mesh.parts.iter().all(|p| p.name != "margin"), "an ePAM is not taped");
    let margin = area_m2(&robot("spam", &wide).mesh, |part| part == "margin");
    assert!((margin / (2.0 * 5e-3 * 0.36) - 1.0).abs() < 2e-3, "{margin}");
    assert!((strip("spam") - 6.0 * 55.0 / 60.0 - 12.0).abs() < 0.05, "{}", strip("spam"));
}

#[test]
fn the_bias_tube_winds_one_way_round() {
    let problem = robot("fpam", &coarse());
    let angle = |part: &str| {
        let at = problem.mesh.parts.iter().position(|p| p.name == part).unwrap();
        problem.sections[at].plies.last().unwrap().angle_rad.to_degrees()
    };
    assert!((angle("top") - 45.0).abs() < 1e-12 && (angle("face") + 45.0).abs() < 1e-12);
}

#[test]
fn rings_of_markers_are_at_their_stations() {
    let (scenario, problem) = (shipped("epam"), robot("epam", &coarse()));
    for (k, s) in scenario.markers_m.iter().enumerate() {
        let ring = &problem.mesh.sets[&format!("marker_{}", k + 1)];
        assert!(ring.iter().all(|n| (problem.mesh.points[*n as usize][0] - s).abs() < 1e-12), "marker {k}");
    }
    let line = sections(&problem.mesh, &[0.03, 0.36]).unwrap().at(&problem.mesh.points).unwrap();
    assert!(line.iter().all(|c| c[1].abs() < 1e-3 && c[2].abs() < 1e-12), "{line:?}");
    assert!(problem.mesh.sets["far_generator"].iter().all(|n| problem.mesh.points[*n as usize][1] < -0.0399));
}

#[test]
fn what_cannot_be_built_or_run_is_refused_with_its_number() {
    let wide = refused("epam", |s, _| s.actuator.shape.width_m = 0.15);
    assert!(wide.contains("a pouch of 150 mm is wider than half of the body, 125.664 mm"), "{wide}");
    let weld = refused("epam", |_, s| s.weld_m = 0.06);
    assert!(weld.contains("welds of 60 mm every 60 mm overlap"), "{weld}");
    let margin = refused("spam", |_, s| s.tape_margin_m = 0.1);
    assert!(margin.contains("130.0 mm from the middle of the strip and meet behind the body, at 125.7 mm"), "{margin}");
    let fold = refused("cpam", |s, _| s.actuator.shape.fold_m = 0.035);
    assert!(fold.contains("by 10 mm at level"), "{fold}");
    let flat = refused("epam", |_, s| s.actuator_pa = 1e3);
    assert!(flat.contains("an actuator at 1 kPa in a body at 2 kPa"), "{flat}");
    let marker = refused("epam", |s, _| s.markers_m.push(0.4));
    assert!(marker.contains("a marker at 400 mm is off the body of 360 mm"), "{marker}");
    let long = refused("epam", |s, _| s.actuator.count = 7);
    assert!(long.contains("7 units that end at 420.0 mm"), "{long}");
    let large = refused("epam", |_, s| s.actuator_size_m = 0.05);
    assert!(large.contains("lower actuator_mesh_mm from 50 or"), "{large}");
    let nan = refused("epam", |_, s| s.bond = f64::NAN);
    assert!(nan.contains("bond is NaN; write a number from 0 to 1"), "{nan}");
    let coupling = refused("fpam", |_, s| s.nu12 = Some(0.95));
    assert!(coupling.contains("nu12"), "{coupling}");
    let braid = refused("fpam", |s, _| s.actuator.shape.bias_rad = 0.7);
    assert!(braid.contains("yarns at +40.1 and -40.1 degrees") && braid.contains("bias_deg = 45"), "{braid}");
}

#[test]
fn every_assumed_number_may_take_both_ends_of_its_interval() {
    for unknown in ASSUMED {
        let mut changed = 0;
        for value in unknown.interval {
            let mut settings = coarse();
            let key = KEYS.iter().find(|key| key.name == unknown.key).unwrap();
            (key.set)(&mut settings, value);
            settings.check().unwrap_or_else(|e| panic!("{}: {e}", unknown.reason));
            changed += usize::from(settings != coarse());
        }
        assert!(changed > 0, "{} changes nothing", unknown.reason);
    }
}

#[test]
fn a_weld_far_narrower_than_an_element_is_a_line() {
    let seams = |weld_m: f64| {
        let problem = robot("epam", &RobotSettings { weld_m, ..coarse() });
        problem.mesh.parts.iter().filter(|p| p.name.starts_with("seam")).count()
    };
    assert!(seams(2.9e-3) == 0 && seams(3e-3) > 0);
}

#[test]
fn a_wavy_robot_starts_without_membrane_stress_and_holds_what_the_pattern_holds() {
    for (name, _) in SHIPPED {
        let flat = robot(name, &RobotSettings { imperfection: 0.0, ..coarse() });
        let wavy = robot(name, &RobotSettings { imperfection: 0.0, waviness_m: 2e-4, ..coarse() });
        let differs = |n: &u32| wavy.mesh.free_of(*n as usize) != flat.mesh.free_of(*n as usize);
        let moved = |set: &str| wavy.mesh.sets[set].iter().any(differs);
        assert!(moved("tip") && !moved("base"), "{name}");
        assert!((volume_m3(&wavy, "body") / volume_m3(&flat, "body") - 1.0).abs() < 0.01, "{name}");
        let mut run = Simulation::new(&wavy).unwrap();
        run.advance_until(run.dt_s(), &mut |_| true).unwrap();
        let ledger = run.ledger();
        let membrane = ledger.rows.iter().find(|r| r.name == "membrane").unwrap();
        // A millionth of what 0.2 mm in waves of 60 mm would store, were the pattern stress-free: ½ E t ε² A with 2 %.
        assert!(membrane.energy_j < 1e-6, "{name}: {ledger:?}");
    }
}

#[test]
fn rows_beside_the_welds_of_a_folded_sheet_are_two_thirds_of_a_weld_and_grow_by_a_quarter() {
    let of = |scenario: &Scenario, settings: &RobotSettings| {
        let pattern = (scenario.actuator.kind.pattern)(&scenario.actuator.shape);
        GridLines::of(scenario, &[pattern.between_welds(lines::weld_m(settings))], settings).unwrap()
    };
    let lines = |name: &str, settings: &RobotSettings| of(&shipped(name), settings);
    let check = |lines: &GridLines, first_m: f64, row_m: f64| {
        for pair in lines.strips[0].welds.windows(2) {
            let rows: Vec<f64> = lines.x_m[pair[0][1]..=pair[1][0]].windows(2).map(|x| x[1] - x[0]).collect();
            let n = rows.len();
            let ends = [rows[0], rows[n - 1]];
            assert!(ends.iter().all(|row| (row / first_m - 1.0).abs() < 0.1), "{rows:?}");
            assert!(rows.windows(2).all(|r| (0.79..1.26).contains(&(r[1] / r[0]))), "{rows:?}");
            assert!((rows[n / 2] / row_m - 1.0).abs() < 0.1, "{rows:?}");
        }
    };
    let four = RobotSettings::default();
    check(&lines("cpam", &four), 2e-3, 4e-3);
    check(&lines("epam", &four), 4e-3, 4e-3);
    check(&lines("epam", &RobotSettings { seam_row_m: Some(1.5e-3), ..four.clone() }), 1.5e-3, 4e-3);
    // Shorter elements than these rows stay as they are, and so do those beside a weld without width.
    check(&lines("cpam", &RobotSettings { actuator_size_m: 1e-3, ..four.clone() }), 1e-3, 1e-3);
    check(&lines("cpam", &RobotSettings { weld_m: 0.0, ..four.clone() }), 4e-3, 4e-3);
    // Without a marker in the middle rows grow from both welds all the same.
    let mut scenario = shipped("cpam");
    scenario.markers_m = vec![scenario.length_m];
    let (bare, marked) = (of(&scenario, &four).x_m, lines("cpam", &four).x_m);
    assert_eq!(bare.len(), marked.len());
    assert!(bare.iter().zip(&marked).all(|(a, b)| (a - b).abs() < 1e-12), "{bare:?}");
}
