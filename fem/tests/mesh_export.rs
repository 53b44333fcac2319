//! Robots and cases written for other programs.

#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use fem::Mesh;
use fem::mesh::file::read;
use fem::session::{RunSource, Solver, export};

const FILM: &str = "[fabric.film]\nlaw = \"isotropic\"\ne_MPa = 588\nnu = 0.4\nthickness_mm = 0.3\n\
                    [part.all]\nfabric = \"film\"\ndensity_kg_m3 = 1000\n";

#[test]
fn an_exported_robot_is_read_back_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["epam", "fpam"] {
        let robot = RunSource::new(name, models::shipped(name).unwrap());
        let mesh = robot.load().unwrap().case.problem.mesh;
        let path = folder.path().join(format!("{name}.inp"));
        let export = export(&robot, &path, Solver::Abaqus).unwrap();
        assert_eq!((export.nodes, export.elements), (mesh.points.len(), mesh.elements()));
        let back = read(&path).unwrap();
        let starts: Vec<[f64; 3]> = (0..mesh.points.len()).map(|i| mesh.start_of(i)).collect();
        let offset = |(a, b): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
        let largest = back.mesh.points.iter().zip(&starts).map(offset).fold(0.0, f64::max);
        assert!(largest < 1e-12 && back.mesh.sets == mesh.sets, "{name}: {largest} m off");
        let sheets = |mesh: &Mesh| -> Vec<_> {
            mesh.parts.iter().map(|p| (p.name.clone(), p.quads.clone(), p.triangles.clone())).collect()
        };
        assert!(sheets(&back.mesh) == sheets(&mesh), "{name}");
        for surface in &back.surfaces {
            let side = |back: bool| move |p: &&fem::Part| if back { p.back.clone() } else { p.front.clone() };
            let faces = |is_back: bool| surface.faces.iter().filter(|(_, back)| *back == is_back).count();
            let facing = |is_back: bool| {
                let other = side(!is_back);
                let here = side(is_back);
                mesh.parts.iter().filter(|p| here(p).as_ref() == Some(&surface.name) && other(p) != here(p)).count()
            };
            assert_eq!([faces(false), faces(true)], [facing(false), facing(true)], "{}", surface.name);
            assert!(surface.is_pressed && surface.fault.is_none(), "{surface:?}");
        }
        assert_eq!(back.surfaces.len(), 2, "{name}: body and actuator");
    }
}

/// Numbers in the line after the one that begins like this.
fn after(text: &str, begin: &str) -> Vec<f64> {
    let row = text.lines().skip_while(|line| !line.starts_with(begin)).nth(1).unwrap();
    row.split(',').filter_map(|cell| cell.trim().parse().ok()).collect()
}

#[test]
fn an_exported_part_is_the_plate_of_the_same_stiffness() {
    let folder = tempfile::tempdir().unwrap();
    let close = |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a / b - 1.0).abs() < 1e-9);
    // E t and ρ t are kept, and E t³ is the given share of the film's: t is its root.
    for share in [1.0_f64, 0.25] {
        let film = FILM.replace("[part.all]\n", &format!("[part.all]\nbending_factor = {share}\n"));
        let mesh = "kind = \"fem\"\n[mesh]\ngenerator = \"pillow\"\nside_mm = 300\nelements = 4\n";
        let pressure =
            "[chamber.air]\nsmooth_s_kPa = [[0, 0], [0.05, 5]]\n[[support]]\nset = \"centre_top\"\naxes = \"xy\"\n";
        let source = RunSource::new("pillow", &format!("{mesh}{film}{pressure}"));
        let path = folder.path().join(format!("{share}.inp"));
        export(&source, &path, Solver::Abaqus).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        let root = share.sqrt();
        let (e, g) = (588e6 / root, 588e6 / 2.8 / root);
        assert!(close(&after(&text, "*ELASTIC, TYPE=LAMINA"), &[e, e, 0.4, g, g, g]), "{text}");
        assert!(close(&after(&text, "*SHELL SECTION"), &[3e-4 * root]), "{text}");
        assert!(close(&after(&text, "*DENSITY"), &[1000.0 / root]), "{text}");
        let pressed = "*AMPLITUDE, NAME=pressure_1, DEFINITION=SMOOTH STEP\n0.0, 0.0\n0.05, 5000.0\n";
        for words in [pressed, "*BOUNDARY\ncentre_top, 1, 1\n", "*DSLOAD, AMPLITUDE=pressure_1\nair, P, 1.\n"] {
            assert!(text.contains(words), "{words}");
        }
        let wrong = export(&source, &folder.path().join("a.foo"), Solver::Abaqus).unwrap_err();
        let told = format!("{wrong}\n{}", wrong.help().unwrap_or_default());
        assert!(told.contains("end it with .inp"), "{told}");
    }
}

#[test]
fn calculix_gets_short_numbers_middles_of_sides_and_hinges_between_sheets() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("deck.inp");
    let deck = |source: &RunSource, solver| {
        let export = export(source, &path, solver).unwrap();
        (std::fs::read_to_string(&path).unwrap(), export.left_out)
    };
    // The end of the ePAM has coordinates of 1e-18 m and of 17 digits.
    let robot = RunSource::new("epam", models::shipped("epam").unwrap());
    for solver in [Solver::Abaqus, Solver::CalculiX] {
        let (text, _) = deck(&robot, solver);
        let rows = text.lines().filter(|line| !line.starts_with('*') && line.contains(','));
        let longest = rows.flat_map(|line| line.split(',').map(|cell| cell.trim().len())).max();
        assert!(longest <= Some(20) && !text.contains("e-18"), "{longest:?}");
        // Its films keep their volume, and CalculiX refuses that of an isotropic law.
        assert!(!text.contains("*ELASTIC\n"));
    }
    let film = format!("{FILM}bending_factor = 1\n");
    let mesh = "kind = \"fem\"\n[mesh]\ngenerator = \"pillow\"\nside_mm = 300\nelements = 4\n";
    let loads = "[chamber.air]\nsmooth_s_kPa = [[0, 0], [0.05, 5]]\n[[support]]\nset = \"rim\"\naxes = \"z\"\n";
    let source = RunSource::new("pillow", &format!("{mesh}{film}{loads}[contact]\n"));
    let (text, left_out) = deck(&source, Solver::CalculiX);
    let block = |begin: &str| -> Vec<Vec<f64>> {
        let rows = text.lines().skip_while(|line| !line.starts_with(begin)).skip(1);
        rows.take_while(|line| !line.starts_with('*')).map(|line| after(&format!("x\n{line}"), "x")).collect()
    };
    // 25 + 9 nodes; 40 sides of the upper sheet; the lower one has 16 corners, 40 middles of its own.
    let nodes = block("*NODE");
    assert_eq!((nodes.len(), nodes.last().unwrap()[0] as usize), (34 + 40 + 16 + 40, 130));
    let (top, bottom) = (block("*ELEMENT, TYPE=S8R, ELSET=top"), block("*ELEMENT, TYPE=S8R, ELSET=bottom"));
    assert_eq!((top.len(), bottom.len()), (16, 16));
    let numbers = |rows: &[Vec<f64>]| -> std::collections::BTreeSet<usize> {
        rows.iter().flat_map(|row| row[1..].iter().map(|n| *n as usize)).collect()
    };
    assert_eq!(numbers(&top).intersection(&numbers(&bottom)).count(), 0, "a node of both sheets clamps them");
    let at = |n: f64| &nodes[n as usize - 1][1..];
    for row in top.iter().chain(&bottom) {
        for (k, middle) in row[5..].iter().enumerate() {
            let (a, b) = (at(row[1 + k]), at(row[1 + (k + 1) % 4]));
            (0..3).for_each(|i| assert!((at(*middle)[i] - 0.5 * (a[i] + b[i])).abs() < 1e-15, "{row:?}"));
        }
    }
    // 16 corners and 16 middles of the rim follow those of the upper sheet along x, y and z.
    assert_eq!(text.matches("*EQUATION\n2\n").count(), 3 * 32);
    let held = block("*NSET, NSET=ibr_support_1").concat();
    assert_eq!((held.len(), block("*NSET, NSET=ibr_reaction_1").concat().len()), (32, 64));
    let curve = block("*AMPLITUDE, NAME=pressure_1");
    let half = curve.iter().find(|row| (row[0] - 0.025).abs() < 1e-12).unwrap();
    assert!(curve.len() == 41 && (half[1] - 2500.0).abs() < 1e-9, "{curve:?}");
    let elastic = after(&text, "*ELASTIC");
    assert!((elastic[0] / 588e6 - 1.0).abs() < 1e-9 && (elastic[1] - 0.4).abs() < 1e-9, "{elastic:?}");
    for words in ["bottom, SNEG\n", "*DYNAMIC, ALPHA=-0.3\n", "air, P, 1.\n"] {
        assert!(text.contains(words), "{words}");
    }
    assert!(left_out.iter().any(|what| what.starts_with("contact")), "{left_out:?}");
}

#[test]
fn calculix_gets_directions_of_its_own_for_every_element_of_a_curved_fabric() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("deck.inp");
    let mesh = "kind = \"fem\"\n[mesh]\ngenerator = \"tube\"\ndiameter_mm = 80\nlength_mm = 100\nelements_around = 12\n\
                elements_along = 5\nwarp_deg = 30\nbase_cap = \"quads\"\n";
    let cloth = "[fabric.\"my cloth\"]\nlaw = \"orthotropic\"\ne0_MPa = 400\ne90_MPa = 100\ng_MPa = 40\nnu12 = 0.2\n\
                 thickness_mm = 0.2\n[part.all]\nfabric = \"my cloth\"\ndensity_kg_m3 = 1000\nbending_factor = 1\n\
                 [chamber.body]\npressure_kPa = 5\n";
    let export = export(&RunSource::new("tube", &format!("{mesh}{cloth}")), &path, Solver::CalculiX).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(export.left_out.iter().any(|what| what.contains("want to be flat")), "{:?}", export.left_out);
    let constants = after(&text, "*ELASTIC, TYPE=ENGINEERING CONSTANTS");
    let t = after(&text, "*SHELL SECTION")[0] / 2e-4;
    let wanted = [400e6, 100e6, 200e6, 0.2, 0.0, 0.0, 40e6, 100e6].map(|e| if e > 1.0 { e / t } else { e });
    assert!(constants.iter().zip(wanted).all(|(a, b)| (a - b).abs() <= 1e-9 * b), "{constants:?}");
    let axes: Vec<Vec<f64>> = text
        .lines()
        .enumerate()
        .filter(|(_, line)| line.starts_with("*ORIENTATION, NAME=ibr_warp_1_"))
        .map(|(k, _)| after(&format!("x\n{}", text.lines().nth(k + 1).unwrap()), "x"))
        .collect();
    // One direction for each of the 12 strips of the wall, 30 degrees from the axis and across the radius.
    assert_eq!(axes.len(), 12, "{axes:?}");
    for a in &axes {
        let (warp, fill) = a.split_at(3);
        let across: f64 = warp.iter().zip(fill).map(|(a, b)| a * b).sum();
        assert!((warp[0] - 0.75_f64.sqrt()).abs() < 1e-8 && across.abs() < 1e-8, "{a:?}");
    }
}
