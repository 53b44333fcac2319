//! Chambers that end at planes of symmetry, gas laws in a run, and the warp of parts: each against a whole model or a closed form.

#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use std::fmt::Write;

use fem::case::Case;
use fem::mesh::file::{MeshFile, read};
use fem::{Mesh, Part, Simulation};
use models::RowKind;

const FABRIC: &str = "[fabric.film]\nlaw = \"isotropic\"\ne_MPa = 200\nnu = 0.3\nthickness_mm = 0.3\n\
                      [part.all]\nfabric = \"film\"\ndensity_kg_m3 = 1000\nbending_factor = 0\n";
const SETTINGS: &str = "[settings]\nend_s = 0.01\nmass_damping_1_s = 60\ndt_s = 1.5e-5\n";

/// A lens of 16 by 16 quadrilaterals and two sheets, z = ± 30 (1 − x²)(1 − y²) mm over a square of 200 mm whose middle is moved by
/// `shift` mm, or the part of it with x, y or z from 0 on where that is cut. In mm.
fn lens(cuts: [bool; 3], shift: f64) -> Mesh {
    let span = |cut: bool| if cut { 8..=16 } else { 0..=16 };
    let (mut mesh, mut number) = (Mesh::default(), std::collections::BTreeMap::new());
    let is_rim = |i: i32, j: i32| [i, j].iter().any(|k| *k == 0 || *k == 16);
    let key = |i, j, side| (i, j, if is_rim(i, j) { 1 } else { side });
    let sides = if cuts[2] { vec![1] } else { vec![1, -1] };
    for side in &sides {
        for j in span(cuts[1]) {
            for i in span(cuts[0]) {
                if number.contains_key(&key(i, j, *side)) {
                    continue;
                }
                let node = number.len() as u32;
                number.insert(key(i, j, *side), node);
                let [x, y] = [i, j].map(|k| f64::from(k) / 8.0 - 1.0);
                let z = f64::from(*side) * 30.0 * (1.0 - x * x) * (1.0 - y * y);
                mesh.points.push([100.0 * x + shift, 100.0 * y + shift, z + shift]);
                let of = [i == 8, j == 8, is_rim(i, j), i == 8 && j == 8 && *side == 1];
                for (name, _) in ["plane_x", "plane_y", "rim", "centre"].into_iter().zip(of).filter(|(_, is_in)| *is_in)
                {
                    mesh.sets.entry(name.into()).or_default().push(node);
                }
            }
        }
    }
    for side in sides {
        let mut quads = Vec::new();
        for j in *span(cuts[1]).start()..16 {
            for i in *span(cuts[0]).start()..16 {
                let mut corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
                if side == -1 {
                    corners.reverse();
                }
                quads.push(corners.map(|(i, j)| number[&key(i, j, side)]));
            }
        }
        let name = if side == 1 { "top" } else { "bottom" };
        mesh.parts.push(Part { name: name.into(), quads, ..Part::default() });
    }
    mesh
}

/// The case of a mesh in mm.
fn case(mesh: &Mesh, rest: &str) -> Result<Case, fem::FemError> {
    let text = format!("kind = \"fem\"\n[mesh]\nfile = \"mesh.msh\"\nunit = \"mm\"\n{rest}");
    Case::parse(&text, &mut |_| Ok(MeshFile { mesh: mesh.clone(), format: "test", ..MeshFile::default() }))
}

/// Supports and the opening of a cut lens: the rim rests along z, as it does in the whole by symmetry.
fn cut_lens(cuts: [bool; 3], gas: &str) -> String {
    let letters: String = ["x", "y", "z"].into_iter().zip(cuts).filter(|(_, cut)| *cut).map(|(axis, _)| axis).collect();
    let open = if letters.is_empty() { String::new() } else { format!("open_axis = \"{letters}\"\n") };
    let supports = [("plane_x", "x"), ("plane_y", "y"), ("rim", "z")];
    let held = |(set, axis): (&str, &str)| format!("[[support]]\nset = \"{set}\"\naxes = \"{axis}\"\n");
    format!("{FABRIC}[chamber.air]\n{gas}{open}{}{SETTINGS}", supports.map(held).concat())
}

/// Volume over that of the whole at the start and the end \[m³\], height of the centre \[m\] and work of the gas \[J\].
fn swollen(cuts: [bool; 3], shift: f64, gas: &str) -> [f64; 3] {
    let case = case(&lens(cuts, shift), &cut_lens(cuts, gas)).unwrap();
    let centre = case.problem.mesh.sets["centre"][0] as usize;
    let mut run = Simulation::new(&case.problem).unwrap();
    run.advance_until(0.01, &mut |_| true).unwrap();
    let parts = f64::from(1 << cuts.iter().filter(|cut| **cut).count());
    let ledger = run.ledger();
    assert!(ledger.residual_share() < 1e-3, "{}", ledger.residual_share());
    let height = run.positions()[centre][2] - shift * 1e-3;
    [parts * run.chambers()[0].volume_m3, height, parts * ledger.external_work_j]
}

#[test]
fn half_quarter_and_eighth_of_a_lens_are_the_whole_wherever_the_planes_are() {
    let filling = "smooth_s_kPa = [[0, 0], [0.005, 5]]\n";
    let whole = swollen([false; 3], 0.0, filling);
    assert!(whole[0] > 1.15e-3 && whole[1] > 0.0305, "{whole:?}");
    let (half, quarter, eighth) = ([true, false, false], [true, true, false], [true; 3]);
    for (cuts, shift) in [(half, 0.0), (quarter, 0.0), (eighth, 0.0), (quarter, 70.0), (eighth, 70.0), (eighth, -300.0)]
    {
        let part = swollen(cuts, shift, filling);
        for (found, wanted) in part.iter().zip(whole) {
            // The same steps: other sums round otherwise, and 670 of them at 1e-16 of a coordinate stay below this.
            assert!((found / wanted - 1.0).abs() < 1e-10, "{cuts:?} moved by {shift}: {part:?} for {whole:?}");
        }
    }
}

#[test]
fn a_quarter_takes_a_quarter_of_the_hose_of_the_leak_and_of_the_flow() {
    let gas = |parts: f64| {
        let [dead, leak, flow] = [200.0 / parts, 20.0 / parts, 1500.0 / parts];
        format!(
            "pressure_kPa = 0\nsealed_at_s = 0\npolytropic_exponent = 1.4\ndead_volume_cm3 = {dead}\nleak_l_min_kPa = {leak}\n\
             inflow_l_min = {flow}\n"
        )
    };
    let (whole, quarter) = (swollen([false; 3], 0.0, &gas(1.0)), swollen([true, true, false], 0.0, &gas(4.0)));
    let eighth = swollen([true; 3], 20.0, &gas(8.0));
    assert!(whole[2] > 1e-3, "{whole:?}");
    for part in [quarter, eighth] {
        let close = part.iter().zip(whole).all(|(found, wanted)| (found / wanted - 1.0).abs() < 1e-9);
        assert!(close, "{part:?} for {whole:?}");
    }
}

#[test]
fn planes_that_are_not_named_or_not_held_are_refused_with_what_to_type() {
    let quarter = [true, true, false];
    let (mesh, good) = (lens(quarter, 0.0), cut_lens(quarter, "pressure_kPa = 1\n"));
    let refused = |from: &str, to: &str| {
        assert!(good.contains(from), "{from}");
        match case(&mesh, &good.replace(from, to)) {
            Ok(case) => case.problem.check().unwrap_err().to_string(),
            Err(error) => error.to_string(),
        }
    };
    let one = refused("open_axis = \"xy\"", "open_axis = \"x\"");
    assert!(one.contains("along y and held there too. Try: open_axis = \"xy\""), "{one}");
    let none = refused("open_axis = \"xy\"\n", "");
    assert!(none.contains("write open_axis = \"xy\" in [chamber.air]"), "{none}");
    let free = refused("set = \"plane_y\"\naxes = \"y\"", "set = \"plane_y\"\naxes = \"z\"");
    assert!(free.contains("is not held along y") && free.contains("plane_y"), "{free}");
    let moved = refused("axes = \"y\"", "axes = \"y\"\nsmooth_s_mm = [[0, 0, 0, 0], [1, 0, 5, 0]]");
    assert!(moved.contains("is not held along y"), "{moved}");
    for letters in ["", "q", "xx"] {
        let wrong = refused("\"xy\"", &format!("\"{letters}\""));
        assert!(wrong.contains("open_axis = ") && wrong.contains("is not understood"), "{wrong}");
    }
}

/// A balloon with this gas after some time: mean P (V + V_d)ⁿ over its value at 0.01 s, and the largest residual.
fn balloon(gas: &str, dead_m3: f64, exponent: f64) -> Vec<(f64, f64, f64)> {
    let text = format!(
        "kind = \"fem\"\n[mesh]\ngenerator = \"sphere\"\ndiameter_mm = 100\nelements = 6\n{FABRIC}[chamber.air]\n{gas}\
         [[support]]\nset = \"bottom\"\n[[force]]\nset = \"top\"\ntotal_n = [0, 0, -20]\nsmooth_s = [[0.01, 0], [0.04, 1]]\n\
         [settings]\nend_s = 0.05\nmass_damping_1_s = 300\n"
    );
    let case = Case::parse(&text, &mut |_| unreachable!()).unwrap();
    let mut run = Simulation::new(&case.problem).unwrap();
    let state = |k: u32| {
        run.advance_until(0.01 + 0.002 * f64::from(k), &mut |_| true).unwrap();
        let (air, ledger) = (run.chambers()[0].clone(), run.ledger());
        assert!(ledger.residual_share() < 5e-3, "{gas}: {}", ledger.residual_share());
        assert!(ledger.rows.iter().any(|row| row.kind == RowKind::Supplied && row.energy_j != 0.0));
        let kept = (air.pressure_pa + 101_325.0) * (air.volume_m3 + dead_m3).powf(exponent);
        (run.time_s(), kept, air.pressure_pa)
    };
    (0..20).map(state).collect()
}

#[test]
fn a_squeezed_balloon_keeps_its_gas_and_a_leaking_one_loses_it_by_the_law() {
    let sealed = "smooth_s_kPa = [[0, 0], [0.005, 20]]\nsealed_at_s = 0.008\n";
    for (dead_m3, exponent) in [(0.0, 1.0), (1e-4, 1.4)] {
        let keys = format!("{sealed}dead_volume_cm3 = {}\npolytropic_exponent = {exponent}\n", dead_m3 * 1e6);
        let states = balloon(&keys, dead_m3, exponent);
        for (t, kept, _) in &states {
            assert!((kept / states[0].1 - 1.0).abs() < 1e-12, "n = {exponent}, t = {t}");
        }
        assert!(states[19].2 > states[0].2 + 100.0, "squeezed: {states:?}");
    }
    // Isothermal: the gas lost is p_atm C ∫ p dt, by Simpson's rule over the states.
    let states = balloon(&format!("{sealed}leak_l_min_kPa = 10\n"), 0.0, 1.0);
    let p: Vec<f64> = states.iter().map(|state| state.2).collect();
    let simpson = |i: usize| (p[i] + 4.0 * p[i + 1] + p[i + 2]) * 0.002 / 3.0;
    let lost: f64 = (0..18).step_by(2).map(simpson).sum::<f64>() * 101_325.0 * 10.0 * 1e-6 / 60.0;
    assert!(((states[0].1 - states[18].1) / lost - 1.0).abs() < 2e-3, "{} {lost}", states[0].1 - states[18].1);
}

#[test]
fn a_flat_pouch_with_a_hose_is_blown_up_by_a_flow() {
    let text = format!(
        "kind = \"fem\"\n[mesh]\ngenerator = \"pillow\"\nside_mm = 100\nelements = 8\n{FABRIC}[chamber.air]\npressure_kPa = 0\n\
         sealed_at_s = 0\ndead_volume_cm3 = 20\ninflow_l_min = 120\n[settings]\nend_s = 0.05\nmass_damping_1_s = 200\n"
    );
    let case = Case::parse(&text, &mut |_| unreachable!()).unwrap();
    let mut run = Simulation::new(&case.problem).unwrap();
    run.advance_until(0.05, &mut |_| true).unwrap();
    let air = run.chambers()[0].clone();
    // P (V + V_d) = p_atm (V_d + q t).
    let (held, given) =
        ((air.pressure_pa + 101_325.0) * (air.volume_m3 + 2e-5), 101_325.0 * (2e-5 + 2e-3 * run.time_s()));
    assert!((held / given - 1.0).abs() < 1e-3, "{held} {given}");
    assert!(air.volume_m3 > 5e-5 && run.ledger().residual_share() < 5e-3, "{air:?}");
    let flat = Case::parse(&text.replace("dead_volume_cm3 = 20", "dead_volume_cm3 = 0"), &mut |_| unreachable!());
    let refused = flat.unwrap().problem.check().unwrap_err().to_string();
    assert!(refused.contains("holds no gas") && refused.contains("dead_volume_cm3"), "{refused}");
}

/// A strip of 100 by 50 mm in the plane of the axes `along` and `across`. In mm.
fn strip(along: [f64; 3], across: [f64; 3]) -> Mesh {
    let place = |i: u32, j: u32| [0, 1, 2].map(|k| 10.0 * (f64::from(i) * along[k] + f64::from(j) * across[k]));
    let quad = |i: u32, j: u32| [0, 6, 7, 1].map(|k| 6 * i + j + k);
    let quads = (0..10).flat_map(|i| (0..5).map(move |j| quad(i, j))).collect();
    Mesh {
        points: (0..=10).flat_map(|i| (0..=5).map(move |j| place(i, j))).collect(),
        parts: vec![Part { name: "cloth".into(), quads, ..Part::default() }],
        sets: [("near", 0), ("far", 60)].map(|(name, first)| (name.into(), (first..first + 6).collect())).into(),
        ..Mesh::default()
    }
}

const WEAVE: &str =
    "[fabric.weave]\nlaw = \"orthotropic\"\ne0_MPa = 400\ne90_MPa = 100\ng_MPa = 10\nthickness_mm = 0.2\n";

/// Force that pulls a strip 1 mm longer \[N\].
fn pull(mesh: &Mesh, along: [f64; 3], warp: &str) -> f64 {
    let [x, y, z] = along;
    let rest = format!(
        "{WEAVE}[part.all]\nfabric = \"weave\"\ndensity_kg_m3 = 1000\n{warp}[[support]]\nset = \"near\"\n[[support]]\nset = \"far\"\n\
         smooth_s_mm = [[0, 0, 0, 0], [0.02, {x}, {y}, {z}]]\n[settings]\nend_s = 0.04\nmass_damping_1_s = 1000\n"
    );
    let mut run = Simulation::new(&case(mesh, &rest).unwrap().problem).unwrap();
    run.advance_until(0.04, &mut |_| true).unwrap();
    let force = run.reaction_n("far").unwrap();
    (0..3).map(|k| force[k] * along[k]).sum()
}

#[test]
fn the_warp_of_a_part_lies_as_its_key_says_on_any_plane() {
    let ([x, y, z], root) = ([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], 0.5_f64.sqrt());
    // E w t/L · 1 mm with ν = 0: 40 N along a warp of 400 MPa, 10 N across; large strains and the ends add 1.5 %.
    let close = |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 0.02, "{found} for {wanted}");
    for (along, across, warp, wanted) in [
        (x, y, "", 40.0),
        (y, z, "warp = \"y\"\n", 40.0),
        (y, z, "warp = \"z\"\n", 10.0),
        (z, y, "warp = [0, 0, 2]\n", 40.0),
        (y, [-1.0, 0.0, 0.0], "warp = [0.3, 0, 5]\nangle_deg = 90\n", 40.0),
        ([root, root, 0.0], z, "warp = \"y\"\n", 40.0),
        ([root, root, 0.0], z, "warp = \"z\"\n", 10.0),
    ] {
        close(pull(&strip(along, across), along, warp), wanted);
    }
}

#[test]
fn a_warp_along_the_normal_is_refused_with_the_axes_that_lie_in_the_sheet() {
    let refused = |mesh: &Mesh, warp: &str| {
        let part = format!("{WEAVE}[part.all]\nfabric = \"weave\"\ndensity_kg_m3 = 1000\n{warp}");
        case(mesh, &part).map(|case| case.problem.check()).unwrap_err().to_string()
    };
    let tilted = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        strip([0.0, 1.0, 0.0], [sin, 0.0, cos])
    };
    let silent = refused(&tilted(0.0), "");
    assert!(silent.contains("part `cloth` onto element 1 ") && silent.contains("without the key warp"), "{silent}");
    assert!(silent.contains("try warp = \"y\" or warp = \"z\" in [part.cloth]"), "{silent}");
    assert!(refused(&tilted(0.5), "").contains("along the normal"));
    assert!(refused(&tilted(0.0), "warp = \"x\"\n").contains("its direction (1, 0, 0) is along the normal"));
    for (warp, word) in
        [("\"q\"", "\"q\" is not understood"), ("[0, 1]", "not understood"), ("[0, 0, 0]", "no direction")]
    {
        let message = refused(&tilted(0.0), &format!("warp = {warp}\n"));
        assert!(message.contains(word), "{message}");
    }
    // Where no axis lies in all elements, sheets have to be named; without directions it does not matter.
    let part = format!("{FABRIC}warp = \"z\"\n[chamber.air]\npressure_kPa = 0\n");
    let sphere = |part: &str| {
        let text = "kind = \"fem\"\n[mesh]\ngenerator = \"sphere\"\ndiameter_mm = 100\nelements = 5\n";
        Case::parse(&format!("{text}{part}"), &mut |_| unreachable!()).map(|_| ())
    };
    let round = sphere(&part).unwrap_err().to_string();
    assert!(round.contains("warp = [x, y, z]"), "{round}");
    assert!(sphere(&part.replace("warp = \"z\"\n", "")).is_ok());
}

/// A strip along y as Abaqus input, with an orientation.
fn oriented(orientation: &str) -> String {
    let mut text = String::from("*NODE\n");
    for (i, j) in (0..=10).flat_map(|i| (0..=5).map(move |j| (i, j))) {
        writeln!(text, "{}, {}, {}, 0.", 6 * i + j + 1, -10 * j, 10 * i).unwrap();
    }
    text += "*ELEMENT, TYPE=S4R, ELSET=CLOTH\n";
    for (i, j) in (0..10).flat_map(|i| (0..5).map(move |j| (i, j))) {
        let n = 6 * i + j + 1;
        writeln!(text, "{}, {n}, {}, {}, {}", 5 * i + j + 1, n + 6, n + 7, n + 1).unwrap();
    }
    text += "*NSET, NSET=near\n1, 2, 3, 4, 5, 6\n*NSET, NSET=far\n61, 62, 63, 64, 65, 66\n";
    format!("{text}{orientation}*SHELL SECTION, ELSET=CLOTH, MATERIAL=WEAVE, ORIENTATION=LAY\n0.2,\n")
}

fn abaqus(text: &str, warp: &str) -> Result<Case, fem::FemError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("strip.inp");
    std::fs::write(&path, text).unwrap();
    let part = format!("{WEAVE}[part.all]\nfabric = \"weave\"\ndensity_kg_m3 = 1000\n{warp}");
    let text = format!("kind = \"fem\"\n[mesh]\nfile = \"strip.inp\"\nunit = \"mm\"\n{part}");
    Case::parse(&text, &mut |_| read(&path))
}

#[test]
fn rectangular_orientations_of_abaqus_are_the_warp_and_others_are_named() {
    let kept = |rows: &str, [x, y, z]: [f64; 3]| {
        let case = abaqus(&oriented(&format!("*ORIENTATION, NAME=Lay\n{rows}")), "").unwrap();
        let found = case.problem.mesh.parts[0].warp[0];
        assert!(found.iter().zip([x, y, z]).all(|(a, b)| (a - b).abs() < 1e-12), "{rows}: {found:?}");
        assert!(case.notices.iter().any(|told| told.contains("the warp of part `CLOTH`")), "{:?}", case.notices);
    };
    let half = 0.5_f64.sqrt();
    kept("0., 1., 0., -1., 0., 0.\n3, 0.\n", [0.0, 1.0, 0.0]);
    kept("0., 1., 0., -1., 0., 0.\n3, 45.\n", [-half, half, 0.0]);
    // Without a second row the axis is 1, which is normal to the sheet then; y' is the warp.
    kept("0., 0., 1., 0., 2., 3.\n", [0.0, 1.0, 0.0]);
    kept("1., 0., 0., 0., 0., 2.\n2, 90.\n", [1.0, 0.0, 0.0]);
    // From another origin.
    kept("5., 6., 0., 4., 5., 0., 5., 5., 0.\n3, 0.\n", [0.0, 1.0, 0.0]);
    let refused = |rows: &str| abaqus(&oriented(rows), "").unwrap_err().to_string();
    for (kind, word) in [("SYSTEM=CYLINDRICAL", "CYLINDRICAL"), ("DEFINITION=NODES", "NODES")] {
        let rows = format!("*ORIENTATION, NAME=LAY, {kind}\n0., 0., 0., 0., 0., 1.\n3, 0.\n");
        let message = refused(&rows);
        assert!(message.contains(word) && message.contains("write warp = \"x\""), "{message}");
        assert!(abaqus(&oriented(&rows), "warp = \"y\"\n").is_ok());
    }
    assert!(refused("*ORIENTATION, NAME=LAY\nby_element\n3, 0.\n").contains("DISTRIBUTION"));
    assert!(refused("").contains("unknown *ORIENTATION `LAY`"));
    assert!(refused("*ORIENTATION, NAME=LAY\n0., 1., 0., 0., 2., 0.\n").contains("are on one line"));
    assert!(refused("*ORIENTATION, NAME=LAY\n0., 1., 0.\n").contains("expected 6 or 9 numbers"));
    assert!(refused("*ORIENTATION, NAME=LAY\n0., 1., 0., -1., 0., 0.\n4, 0.\n").contains("an axis (1, 2 or 3)"));
    let mut along =
        abaqus(&oriented("*ORIENTATION, NAME=LAY\n0., 1., 0., -1., 0., 0.\n3, 0.\n"), "").unwrap().problem.mesh;
    along.points.iter_mut().flatten().for_each(|x| *x *= 1e3);
    assert!((pull(&along, [0.0, 1.0, 0.0], "") / 40.0 - 1.0).abs() < 0.02);
}

#[test]
fn a_vacuum_shrinks_a_ball_as_pressure_swells_it_and_turns_no_pillow_inside_out() {
    let ball = |kpa: f64| {
        let text = format!(
            "kind = \"fem\"\n[mesh]\ngenerator = \"sphere\"\ndiameter_mm = 100\nelements = 8\n{}[chamber.air]\n\
             smooth_s_kPa = [[0, 0], [0.02, {kpa}]]\n[settings]\nend_s = 0.04\nmass_damping_1_s = 1000\n",
            FABRIC.replace("bending_factor = 0", "bending_factor = 1\nrest_curvature = true")
        );
        let mut run = Simulation::new(&Case::parse(&text, &mut |_| unreachable!()).unwrap().problem).unwrap();
        run.advance_until(1e-5, &mut |_| true).unwrap();
        let before = run.chambers()[0].volume_m3;
        run.advance_until(0.04, &mut |_| true).unwrap();
        assert!(run.ledger().residual_share() < 1e-2 && run.chambers()[0].pressure_pa == 1e3 * kpa);
        run.chambers()[0].volume_m3 / before - 1.0
    };
    // Thin sphere: 3 p R (1 − ν)/(2 E t), far below its buckling pressure of 8.7 kPa.
    let (low, high, exact) = (ball(-0.2), ball(0.2), 3.0 * 200.0 * 0.05 * 0.7 / (2.0 * 200e6 * 3e-4));
    assert!((low / -exact - 1.0).abs() < 0.05 && (low / -high - 1.0).abs() < 0.01, "{low} {high} {exact}");
    let pillow = |low: f64| {
        let text = format!(
            "kind = \"fem\"\n[mesh]\ngenerator = \"pillow\"\nside_mm = 100\nelements = 8\n{FABRIC}[chamber.air]\n\
             linear_s_kPa = [[0, 0], [0.01, 5], [0.02, 5], [0.04, {low}]]\n[settings]\nend_s = 0.06\nmass_damping_1_s = 300\n"
        );
        Case::parse(&text, &mut |_| unreachable!())
    };
    let case = pillow(-5.0).unwrap();
    assert!(case.notices.iter().any(|line| line.contains("without [contact]")), "{:?}", case.notices);
    let stopped = Simulation::new(&case.problem).unwrap().advance_until(0.06, &mut |_| true).unwrap_err().to_string();
    assert!(stopped.contains("inside out") && stopped.contains("[contact]"), "{stopped}");
    let below = pillow(-102.0).unwrap_err().to_string();
    assert!(below.contains("a vacuum is -101.325 kPa"), "{below}");
}
