//! Cases that can be read and contradict themselves: refused before the first step.

#![allow(clippy::unwrap_used)] // a test that cannot be set up must fail

use std::path::Path;

use super::tests::{parse, refused};
use super::*;
use crate::Mesh;

const STRIP: &str = r#"kind = "fem"
name = "strip"
[mesh]
generator = "long_pouch"
length_mm = 60
width_mm = 10
elements_along = 12
elements_across = 2
[fabric.film]
law = "isotropic"
e_MPa = 2000
nu = 0
thickness_mm = 0.1
[part.all]
fabric = "film"
density_kg_m3 = 1000
[chamber.air]
open_axis = "y"
pressure_kPa = 1
[[support]]
set = "left"
axes = "xyz"
[[support]]
set = "open_0"
axes = "y"
[[support]]
set = "open_1"
axes = "y"
[settings]
end_s = 0.1
"#;

/// What refuses the start of a case that can be read.
fn refused_start(text: &str) -> String {
    parse(text).unwrap().problem.check().unwrap_err().to_string()
}

#[test]
fn edges_of_an_open_chamber_are_held_along_its_axis_whatever_their_sets_are_called() {
    assert!(parse(STRIP).unwrap().problem.check().is_ok());
    let (without_axis, _) = refused(&STRIP.replace("open_axis = \"y\"", ""));
    assert!(without_axis.contains("write open_axis = \"y\" in [chamber.air]"), "{without_axis}");
    let free = refused_start(&STRIP.replace("set = \"open_1\"\naxes = \"y\"", "set = \"open_1\"\naxes = \"x\""));
    assert!(free.contains("is not held along y") && free.contains("open_1"), "{free}");
    let mesh = parse(STRIP).unwrap().problem.mesh;
    let renamed = |name: &String| name.replace("open_", "end_");
    let mesh = Mesh { sets: mesh.sets.iter().map(|(name, nodes)| (renamed(name), nodes.clone())).collect(), ..mesh };
    let (from, to) = (STRIP.find("generator").unwrap(), STRIP.find("[fabric").unwrap());
    let text = format!(
        "{}file = \"own.msh\"\nunit = \"m\"\n{}",
        &STRIP[..from],
        STRIP[to..].replace("open_0", "end_0").replace("open_1", "end_1")
    );
    let own = Case::parse(&text, &mut |_: &Path| Ok(mesh.clone().into())).unwrap();
    assert!(own.problem.check().is_ok());
    let large = Mesh { points: mesh.points.iter().map(|p| p.map(|c| 1e3 * c)).collect(), ..mesh };
    let millimetres = Case::parse(&text, &mut |_: &Path| Ok(large.clone().into())).unwrap_err().to_string();
    assert!(millimetres.contains("looks like millimetres"), "{millimetres}");
}

#[test]
fn supports_that_contradict_and_obstacles_on_top_of_nodes_are_refused_before_the_first_step() {
    let moved = |rows: &str| format!("{STRIP}[[support]]\nset = \"right\"\nsmooth_s_mm = {rows}\n");
    assert!(
        parse(&moved("[[0, 0, 0, 0], [1, -9, 0, 0]]")).unwrap().problem.check().is_ok(),
        "held and moved by nothing"
    );
    let both = refused_start(&moved("[[0, 0, 0, 0], [1, -9, 2, 0]]"));
    assert!(both.contains("`open_0` holds node") && both.contains("along y and `right` moves it"), "{both}");
    let plane =
        |z: f64| format!("{STRIP}[[obstacle]]\nshape = \"plane\"\npoint_mm = [0, 0, {z}]\nnormal = [0, 0, 1]\n");
    assert!(parse(&plane(-1.0)).unwrap().problem.check().is_ok());
    let inside = refused_start(&plane(0.5));
    assert!(inside.contains("[[obstacle]] 1: node") && inside.contains("0.500 mm inside"), "{inside}");
}
