//! What cannot be simulated is refused with its place; what cannot be trusted is stopped before it is written.

#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use std::sync::Arc;

use fem::case::Case;
use fem::mesh::generate;
use fem::problem::{
    Amplitude, Chamber, Contact, MassScaling, NodalForce, Obstacle, ObstacleShape, Pressure, Section, Support,
};
use fem::{FemError, Mesh, Problem, Simulation};
use models::Fabric;
use models::fabrics::{Curve, NeoHookean, Orthotropic, Woven, Yarn};

fn section(fabric: Arc<dyn Fabric>) -> Section {
    Section::of(fabric, 0.1)
}

fn nylon() -> Section {
    section(Arc::new(NeoHookean::new(50.3e6, 2e-4)))
}

fn problem(mesh: Mesh, pa: Amplitude) -> Problem {
    let sections = mesh.parts.iter().map(|_| nylon()).collect();
    let closed = mesh.parts.iter().any(|p| p.back.is_some());
    let air = Chamber { name: "air".into(), pressure: Pressure::Set(pa), open_axis: None };
    Problem::new("guarded", mesh, sections, if closed { vec![air] } else { vec![] })
}

fn pillow(pa: f64) -> Problem {
    problem(generate::pillow(0.2, 10, 1e-3).unwrap(), Amplitude::Smooth(vec![(0.0, 0.0), (0.01, pa)]))
}

fn plate() -> Problem {
    problem(generate::plate(0.1, 0.1, 5, 5, None).unwrap(), Amplitude::Constant(0.0))
}

/// Why the run stopped; what is left of it must hold numbers.
fn stopped(problem: &Problem, end_s: f64, velocities: Option<Vec<[f64; 3]>>) -> String {
    let mut run = Simulation::new(problem).unwrap();
    velocities.into_iter().for_each(|v| run.set_velocities(&v));
    match run.advance_until(end_s, &mut |_| true) {
        Err(FemError::Stopped { step, time_s, reason }) => {
            assert!(step > 0 && step == run.step() && time_s == run.time_s(), "{step} {time_s}");
            reason
        }
        other => panic!("not stopped: {other:?}"),
    }
}

fn refused(problem: &Problem) -> String {
    match Simulation::new(problem) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("not refused"),
    }
}

#[track_caller]
fn says(message: &str, wanted: &[&str]) {
    for word in wanted {
        assert!(message.contains(word), "`{word}` is not in: {message}");
    }
}

#[test]
fn a_forced_step_that_is_not_stable_is_refused_at_once() {
    let mut problem = pillow(1e3);
    let free_s = Simulation::new(&problem).unwrap().dt_s();
    problem.settings.dt_s = Some(1.2 * free_s);
    says(&refused(&problem), &["time step", "not stable", "allows"]);
    for wrong in [f64::NAN, -1e-6, 0.0, f64::INFINITY] {
        problem.settings.dt_s = Some(wrong);
        says(&refused(&problem), &["step"]);
    }
}

#[test]
fn a_run_of_so_few_steps_that_no_guard_looks_is_refused() {
    let mut problem = plate();
    problem.settings.mass_scaling = MassScaling::Fixed(1e6);
    problem.settings.end_s = 0.1;
    says(&refused(&problem), &["cannot follow a motion in ", "64 steps", "mass_scaling"]);
    problem.settings.mass_scaling = MassScaling::Fixed(1e3);
    assert!(Simulation::new(&problem).is_ok());
}

#[test]
fn a_run_that_has_not_begun_misses_nothing_whatever_it_starts_with() {
    let mut problem = plate();
    problem.sections[0].rest_curvature = true;
    let bump = |[x, y, _]: [f64; 3]| [x, y, 0.1 * x * x];
    problem.mesh.start = std::mem::take(&mut problem.mesh.points);
    problem.mesh.points = problem.mesh.start.iter().map(|p| bump(*p)).collect();
    let ledger = Simulation::new(&problem).unwrap().ledger();
    let stored: f64 = ledger.rows.iter().map(|row| row.energy_j).sum();
    assert!(stored > 0.0 && ledger.residual_j == 0.0, "{ledger:?}");
}

#[test]
fn a_forced_step_that_becomes_unstable_stops_the_run() {
    // The yarns get five times stiffer at 1 % strain: the step must fall with it.
    let yarn = || Yarn::new(Curve::table(&[[0.0, 0.0], [0.03, 3e6], [0.06, 18e6]]).unwrap(), None).unwrap();
    let fabric = Woven::new([yarn(), yarn()], Curve::linear(1e7), 0.0, 2e-4).unwrap();
    let mut problem = plate();
    problem.sections = vec![section(Arc::new(fabric))];
    let pull = [Amplitude::Linear(vec![(0.0, 0.0), (0.05, 5e-3)]), Amplitude::Constant(0.0), Amplitude::Constant(0.0)];
    problem.supports = vec![
        Support { set: "left".into(), axes: [true; 3], motion: None },
        Support { set: "right".into(), axes: [true; 3], motion: Some(pull) },
    ];
    problem.settings.dt_s = Some(Simulation::new(&problem).unwrap().dt_s());
    says(&stopped(&problem, 0.05, None), &["forced step", "not stable any more", "Leave the step out"]);
    problem.settings.dt_s = None;
    let mut free = Simulation::new(&problem).unwrap();
    free.advance_until(0.05, &mut |_| true).unwrap();
}

#[test]
fn a_load_that_is_not_a_number_stops_the_run_with_its_node() {
    let mut problem = plate();
    let amplitude = Amplitude::Linear(vec![(0.0, 0.0), (1e-3, f64::NAN)]);
    problem.forces = vec![NodalForce { set: "centre".into(), total_n: [0.0, 0.0, 1.0], amplitude }];
    let told = match Simulation::new(&problem) {
        Err(error) => error.to_string(),
        Ok(_) => stopped(&problem, 0.01, None),
    };
    assert!(told.contains("force") || told.contains("node 15 ") || told.contains("node"), "{told}");
    assert!(told.contains("number") || told.contains("finite"), "{told}");
}

#[test]
fn absurd_speed_stops_the_run_with_its_node() {
    let problem = plate();
    let v = vec![[0.0, 0.0, 5e3]; problem.mesh.points.len()];
    says(&stopped(&problem, 0.01, Some(v)), &["node ", "moves at 5000 m/s", "sound", "634 m/s"]);
}

#[test]
fn an_element_that_turns_inside_out_stops_the_run_with_its_number() {
    let mut problem = plate();
    problem.settings.guards.speed_m_s = 1e9;
    problem.settings.guards.residual = 1e9;
    // One node driven across the sheet, over its neighbours.
    problem.mesh.sets.insert("driven".into(), vec![14]);
    let motion =
        [Amplitude::Linear(vec![(0.0, 0.0), (0.02, 0.05)]), Amplitude::Constant(0.0), Amplitude::Constant(0.0)];
    problem.supports = vec![
        Support { set: "left".into(), axes: [true; 3], motion: None },
        Support { set: "right".into(), axes: [true; 3], motion: None },
        Support { set: "bottom".into(), axes: [true; 3], motion: None },
        Support { set: "top".into(), axes: [true; 3], motion: None },
        Support { set: "driven".into(), axes: [true; 3], motion: Some(motion) },
    ];
    let told = stopped(&problem, 0.02, None);
    assert!(told.contains("inside out") || told.contains("lost its area"), "{told}");
    says(&told, &["element", "plate"]);
}

#[test]
fn energy_out_of_nothing_stops_the_run() {
    // A jump of 3 mm in one step does work that no step resolves.
    let mut problem = plate();
    problem.settings.guards.speed_m_s = 1e9;
    problem.settings.guards.inverted = false;
    problem.settings.cfl = 0.8;
    problem.settings.viscosity = 0.0;
    let jump =
        Amplitude::Linear((0..400).map(|i| (f64::from(i) * 2.5e-5, if i % 2 == 0 { 0.0 } else { 0.012 })).collect());
    let motion = [jump, Amplitude::Constant(0.0), Amplitude::Constant(0.0)];
    problem.supports = vec![
        Support { set: "left".into(), axes: [true; 3], motion: None },
        Support { set: "right".into(), axes: [true; 3], motion: Some(motion) },
    ];
    says(&stopped(&problem, 0.01, None), &["energy balance", "limit 2 %"]);
}

#[test]
fn a_shape_that_is_that_of_hourglass_control_is_no_result_unless_it_is_allowed() {
    let judged = |hourglass: f64, limit: Option<f64>| {
        let mut problem = pillow(1e3);
        (problem.settings.mass_damping_1_s, problem.settings.hourglass) = (300.0, hourglass);
        limit.into_iter().for_each(|limit| problem.settings.guards.hourglass = limit);
        let mut run = Simulation::new(&problem).unwrap();
        run.advance_until(0.03, &mut |_| true).unwrap();
        (run.ledger().hourglass_share(), run.judge_end())
    };
    let (much, Err(error)) = judged(0.1, None) else { panic!("not stopped") };
    says(
        &error.to_string(),
        &[
            &format!("{:.0} % of the stored energy", 100.0 * much),
            "allowed up to 15 %",
            "tension-field",
            "guard_hourglass",
        ],
    );
    assert!(judged(0.1, Some(1.0)).1.is_ok());
    let (little, fine) = judged(0.0, None);
    assert!(fine.is_ok() && little == 0.0 && much > 0.15, "{little} {much}");
}

#[test]
fn meshes_that_cannot_be_simulated_are_refused_with_their_element() {
    let faulty = |change: &dyn Fn(&mut Mesh)| {
        let mut problem = pillow(1e3);
        change(&mut problem.mesh);
        refused(&problem)
    };
    let flat = |mesh: &mut Mesh| {
        let [a, b, ..] = mesh.parts[0].quads[44];
        let moved = mesh.points[a as usize];
        mesh.points[b as usize] = moved;
        let [.., c, d] = mesh.parts[0].quads[44];
        mesh.points[c as usize] = moved;
        mesh.points[d as usize] = moved;
    };
    says(&faulty(&flat), &["element", "part `top`"]);
    // A corner pushed over the diagonal.
    let dent = |mesh: &mut Mesh| {
        let [a, b, _, d] = mesh.parts[0].quads[44].map(|n| mesh.points[n as usize]);
        let corner = mesh.parts[0].quads[44][2] as usize;
        mesh.points[corner] = [0, 1, 2].map(|k| 0.4 * a[k] + 0.3 * b[k] + 0.3 * d[k]);
    };
    says(&faulty(&|mesh| mesh.points[30][1] = f64::NAN), &["node 31", "not a number"]);
    says(&faulty(&|mesh| dent(mesh)), &["element 45", "inverted"]);
    says(&faulty(&|mesh| mesh.parts[0].quads[4][1] = 1_000_000), &["element 5", "only"]);
    says(
        &faulty(&|mesh| {
            mesh.points.push([0.0; 3]);
            mesh.start.push([0.0; 3])
        }),
        &["belongs to no element"],
    );
    says(&faulty(&|mesh| mesh.parts[1].quads.truncate(99)), &["chamber `air` is open", "element"]);
    says(&faulty(&|mesh| mesh.parts[1].quads[12].reverse()), &["element 13", "turned over"]);
    let third = |mesh: &mut Mesh| {
        let mut fin = mesh.parts[1].clone();
        (fin.name, fin.quads) = ("fin".into(), vec![mesh.parts[1].quads[0]]);
        mesh.parts.push(fin);
    };
    let mut problem = pillow(1e3);
    third(&mut problem.mesh);
    problem.sections.push(nylon());
    says(&refused(&problem), &["chamber `air`", "fin"]);
    says(&faulty(&|mesh| mesh.parts[0].back = Some("aire".into())), &["aire", "did you mean `air`"]);
}

#[test]
fn sections_and_settings_out_of_range_are_refused() {
    let mut problem = plate();
    problem.sections[0].density_kg_m3 = -1.0;
    says(&refused(&problem), &["part `plate`", "density"]);
    for thickness_m in [0.0, -1e-4, f64::NAN] {
        let mut problem = plate();
        problem.sections = vec![section(Arc::new(NeoHookean::new(1e6, thickness_m)))];
        says(&refused(&problem), &["part `plate`", "thickness"]);
    }
    for modulus in [-1e8, 0.0, f64::NAN] {
        let mut problem = plate();
        problem.sections = vec![section(Arc::new(Orthotropic::isotropic(modulus, 0.3, 1e-4)))];
        says(&refused(&problem), &["part `plate`", "stiff"]);
    }
    let wrong: [fn(&mut Problem); 5] = [
        |p| p.settings.end_s = f64::NAN,
        |p| p.settings.cfl = 1.5,
        |p| p.settings.viscosity = -0.1,
        |p| p.settings.hourglass = f64::INFINITY,
        |p| p.settings.output_every_s = 0.0,
    ];
    for (change, name) in wrong.iter().zip(["end_s", "cfl", "viscosity", "hourglass", "output_every_s"]) {
        let mut problem = plate();
        change(&mut problem);
        says(&refused(&problem), &["settings", name]);
    }
}

#[test]
fn loads_and_supports_that_point_nowhere_are_refused() {
    let mut lost = plate();
    lost.supports = vec![Support { set: "rihgt".into(), axes: [true; 3], motion: None }];
    says(&refused(&lost), &["support", "`rihgt`", "right"]);
    let mut blunt = plate();
    let shape = ObstacleShape::Plane { point: [0.0; 3], normal: [0.0; 3] };
    blunt.obstacles = vec![Obstacle { shape, friction: 0.1, motion: None }];
    says(&refused(&blunt), &["obstacle 1", "normal"]);
}

#[test]
fn layers_that_start_inside_each_other_are_refused() {
    let mut problem = problem(generate::crossed_sheets(0.12, 0.04, 8, 1e-3).unwrap(), Amplitude::Constant(0.0));
    let upper: Vec<usize> = problem.mesh.sets["upper"].iter().map(|n| *n as usize).collect();
    // Tilted, so that one end of the upper strip passes through the lower one.
    upper.iter().for_each(|n| problem.mesh.points[*n][2] += 0.1 * problem.mesh.points[*n][1]);
    problem.contact = Some(Contact::default());
    says(&refused(&problem), &["node", "deep behind", "element"]);
}

#[test]
fn fabrics_of_a_case_out_of_range_are_refused_with_their_line() {
    let case = |fabric: &str| {
        format!(
            "kind = \"fem\"\nname = \"x\"\n[mesh]\ngenerator = \"pillow\"\nside_mm = 200\nelements = 4\n[fabric.film]\n{fabric}\n\
             [part.all]\nfabric = \"film\"\ndensity_kg_m3 = 1000\n[chamber.air]\npressure_kPa = 1\n[settings]\nend_s = 0.1\n"
        )
    };
    let film = "law = \"isotropic\"\ne_MPa = 588\nnu = 0.4\nthickness_mm = 0.6";
    let woven = "law = \"woven\"\nwarp = [[0, 0], [1, 2], [2, 1]]\ne90_MPa = 100\ng_MPa = 1\nthickness_mm = 0.1";
    let wrong = [
        (film.replace("588", "-588"), "e_MPa", "-588"),
        (film.replace("0.4", "0.51"), "nu", "0.51"),
        (film.replace("0.6", "-0.6"), "thickness_mm", "-0.6"),
        (woven.to_string(), "row 3", "warp"),
    ];
    for (fabric, word, place) in wrong {
        let text = case(&fabric);
        match Case::parse(&text, &mut |_| Err(FemError::Mesh("no file".into()))) {
            Err(FemError::Case { message, span: Some(span) }) => {
                says(&message, &[word]);
                let line = text[..span.start].lines().count().max(1) - 1;
                let near = text.lines().skip(line.saturating_sub(1)).take(5).any(|l| l.contains(place));
                assert!(near, "{message} points at line {}", line + 1);
            }
            other => panic!("{word}: {other:?}"),
        }
    }
}

#[test]
fn layers_that_pass_through_each_other_stop_the_run_with_the_place_and_the_option_that_holds_them() {
    let (mut mesh, upper) =
        (generate::plate(0.1, 0.1, 10, 10, None).unwrap(), generate::plate(0.1, 0.1, 9, 9, None).unwrap());
    let first = mesh.points.len() as u32;
    mesh.points.extend(upper.points.iter().map(|[x, y, _]| [*x, *y, 2e-3]));
    let quads = upper.parts[0].quads.iter().map(|q| q.map(|n| n + first)).collect();
    mesh.parts.push(fem::mesh::Part { name: "upper".into(), layer: 1, quads, ..upper.parts[0].clone() });
    let mut thrown = problem(mesh, Amplitude::Constant(0.0));
    thrown.contact = Some(Contact::default());
    let speed = |n: usize| if n < first as usize { [0.0; 3] } else { [0.0, 0.0, -400.0] };
    let velocities: Vec<_> = (0..thrown.mesh.points.len()).map(speed).collect();
    let reason = stopped(&thrown, 1e-2, Some(velocities.clone()));
    says(&reason, &["changed side of a layer", "node ", "part `", "mm", "edges = true", "guard_sides"]);
    thrown.settings.guards.sides = 1.0;
    thrown.settings.guards.residual = 1.0;
    let mut run = Simulation::new(&thrown).unwrap();
    run.set_velocities(&velocities);
    run.advance_until(64.0 * run.dt_s(), &mut |_| true).unwrap();
    let changed = run.changed_sides().unwrap();
    assert!(changed.nodes > 100 && changed.share > 0.5 && changed.first.is_some(), "{changed:?}");
}
