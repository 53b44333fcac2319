//! Robots and cases written for other programs.

#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use fem::Mesh;
use fem::mesh::file::read;
use fem::session::{Solver, Source, export};

const FILM: &str = "[fabric.film]\nlaw = \"isotropic\"\ne_MPa = 588\nnu = 0.4\nthickness_mm = 0.3\n\
                    [part.all]\nfabric = \"film\"\ndensity_kg_m3 = 1000\n";

#[test]
fn an_exported_robot_is_read_back_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["epam", "fpam"] {
        let robot = Source::new(name, models::shipped(name).unwrap());
        let mesh = robot.load().unwrap().case.problem.mesh;
        let path = folder.path().join(format!("{name}.inp"));
        let export = export(&robot, &path, Solver::Abaqus).unwrap();
        assert_eq!((export.nodes, export.elements), (mesh.points.len(), mesh.elements()));
        let back = read(&path).unwrap();
        let starts: Vec<[f64; 3]> = (0..mesh.points.len()).map(|i| mesh.start_of(i)).collect();
        assert!(back.mesh.points == starts && back.mesh.sets == mesh.sets, "{name}");
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
        let source = Source::new("pillow", &format!("{mesh}{film}{pressure}"));
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
