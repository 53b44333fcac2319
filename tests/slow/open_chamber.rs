//! Chambers that are open along an axis, from a case to the numbers of the run.

use crate::alone;
use crate::support::Folder;
use serde_json::Value;
use verification::exact::elastic_pouch::{PouchFilm, contraction, force_n};
use verification::exact::pouch::Pouch;

const POUCH: Pouch = Pouch { length_m: 0.06, width_m: 0.01 };
const FILM: PouchFilm = PouchFilm::Linear(2e9 * 1e-4);
const PRESSURE_PA: f64 = 20e3;

fn strip(right: &str) -> String {
    format!(
        r#"
kind = "fem"
name = "Pouch strip between smooth walls"
[mesh]
generator = "long_pouch"
length_mm = 60
width_mm = 10
elements_along = 48
elements_across = 4
[fabric.film]
law = "isotropic"
e_MPa = 2000
nu = 0.0
thickness_mm = 0.1
[part.all]
fabric = "film"
density_kg_m3 = 1000
bending_factor = 0
[chamber.air]
open_axis = "y"
smooth_s_kPa = [[0, 0], [0.04, 20]]
[[support]]
set = "left"
axes = "xyz"
[[support]]
set = "open_0"
axes = "y"
[[support]]
set = "open_1"
axes = "y"
{right}
[settings]
end_s = 0.2
mass_damping_1_s = 120
[output]
probes = ["right"]
frames = false
"#
    )
}

fn summary(case: String, mesh: Option<String>) -> Value {
    let folder = Folder::new();
    folder.write("my.toml", case);
    mesh.into_iter().for_each(|mesh| folder.write("tube.msh", mesh));
    let ran = folder.run(&["simulate", "my.toml", "--out", "run", "--quiet"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    serde_json::from_slice(&std::fs::read(folder.path("run/summary.json")).unwrap()).unwrap()
}

/// The half angle at which a falling or rising quantity has a value.
fn angle_where(wanted: f64, of: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (1e-3, std::f64::consts::FRAC_PI_2);
    let rises = of(high) > of(low);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if (of(middle) < wanted) == rises { low = middle } else { high = middle }
    }
    low
}

#[test]
fn a_strip_held_at_a_stroke_says_its_force() {
    let _alone = alone();
    let stroke = "[[support]]\nset = \"right\"\nsmooth_s_mm = [[0, 0, 0, 0], [0.04, -9.5, 0, 0]]";
    let summary = summary(strip(stroke), None);
    let angle = angle_where(9.5 / 60.0, |angle| contraction(&POUCH, FILM, angle, PRESSURE_PA));
    let exact_n = force_n(&POUCH, FILM, angle, PRESSURE_PA);
    let reactions = summary["reactions"].as_array().unwrap();
    let right = reactions.iter().find(|reaction| reaction["set"] == "right").unwrap();
    let found_n = right["force_n"][0].as_f64().unwrap();
    assert!((found_n / exact_n - 1.0).abs() < 0.01, "{found_n} N, exact {exact_n}");
}

/// A round tube that is a little wavy, its end sets under any name.
fn tube(ends: [&str; 2]) -> String {
    let place = |ring: usize, i: usize| {
        let angle = std::f64::consts::TAU * i as f64 / 24.0;
        let radius = 0.05 + 3e-4 * (6.0 * angle).cos();
        format!("{} {} {}", 0.01 * ring as f64, radius * angle.cos(), radius * angle.sin())
    };
    let node = |ring: usize, i: usize| 24 * ring + i % 24 + 1;
    let line =
        |group: usize, ring: usize, i: usize| format!("1 2 {group} {group} {} {}", node(ring, i), node(ring, i + 1));
    let quad = |ring: usize, i: usize| {
        let corners = [node(ring, i), node(ring, i + 1), node(ring + 1, i + 1), node(ring + 1, i)];
        format!("3 2 1 1 {}", corners.map(|n| n.to_string()).join(" "))
    };
    let nodes = (0..264).map(|n| place(n / 24, n % 24)).collect();
    let quads = (0..240).map(|n| quad(n / 24, n % 24));
    let lines = (0..48).map(|n| line(1 + n / 24, 10 * (n / 24), n % 24));
    let numbered = |rows: Vec<String>| -> String {
        rows.iter().enumerate().map(|(k, row)| format!("{} {row}\n", k + 1)).collect()
    };
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n2 1 \"wall\"\n1 1 \"{}\"\n1 2 \"{}\"\n$EndPhysicalNames\n\
         $Nodes\n264\n{}$EndNodes\n$Elements\n288\n{}$EndElements\n",
        ends[0],
        ends[1],
        numbered(nodes),
        numbered(quads.chain(lines).collect())
    )
}

#[test]
fn an_open_tube_of_ones_own_mesh_grows_as_the_hoop_says_whatever_its_sets_are_called() {
    let _alone = alone();
    let case = |[near, far]: [&str; 2]| {
        format!(
            r#"
kind = "fem"
name = "Endless tube, slightly wavy"
[mesh]
file = "tube.msh"
unit = "m"
[fabric.film]
law = "isotropic"
e_MPa = 588
nu = 0.4
thickness_mm = 0.3
[part.all]
fabric = "film"
density_kg_m3 = 1000
rest_curvature = true
[chamber.air]
open_axis = "x"
smooth_s_kPa = [[0, 0], [0.01, 20]]
[[support]]
set = "{near}"
axes = "x"
[[support]]
set = "{far}"
axes = "x"
[settings]
end_s = 0.04
mass_damping_1_s = 600
[output]
frames = false
"#
        )
    };
    let volume_cm3 = |ends| summary(case(ends), Some(tube(ends)))["chambers"][0]["volume_cm3"].as_f64().unwrap();
    let (named, other) = (volume_cm3(["open_0", "open_1"]), volume_cm3(["front", "rear"]));
    assert_eq!(named, other);
    // Plane strain along x: u = p R² (1 − ν²)/(E t); the section is a polygon of 24 sides.
    let radius = 0.05 + PRESSURE_PA * 0.05f64.powi(2) * (1.0 - 0.4f64.powi(2)) / (588e6 * 3e-4);
    let exact_cm3 = 1e6 * 0.1 * 12.0 * radius.powi(2) * (std::f64::consts::TAU / 24.0).sin();
    assert!((named / exact_cm3 - 1.0).abs() < 1e-3, "{named} cm³, exact {exact_cm3}");
}
