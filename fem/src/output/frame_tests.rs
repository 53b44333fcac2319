//! Frames for the tests of the writers.

use super::*;
use crate::Part;

/// Two parts: a quad and a triangle sharing an edge, then one more triangle.
pub(crate) fn mesh() -> Mesh {
    let points = vec![[0., 0., 0.], [0.1, 0., 0.], [0.1, 0.1, 0.], [0., 0.1, 0.], [0.2, 0.05, 0.], [0., 0.2, 0.03]];
    let body = Part { name: "body".into(), quads: vec![[0, 1, 2, 3]], triangles: vec![[1, 4, 2]], ..Part::default() };
    let cap = Part { name: "cap".into(), triangles: vec![[3, 2, 5]], ..Part::default() };
    Mesh { points, parts: vec![body, cap], ..Mesh::default() }
}

/// Numbers without pattern or round values.
pub(crate) fn frame(time_s: f64) -> MeshFrame {
    let mesh = mesh();
    let noise = |i: usize, k: usize| ((i * 7 + k * 13 + 1) as f64 * 0.7 + time_s).sin();
    let triple = |i: usize| [noise(i, 0), noise(i, 1), noise(i, 2)];
    let scalar = |k: usize| (0..3).map(|i| noise(i, k)).collect::<Vec<_>>();
    let pair = |k: usize| (0..3).map(|i| [noise(i, k), noise(i, k + 1)]).collect::<Vec<_>>();
    MeshFrame {
        step: 10,
        time_s,
        positions: (0..mesh.points.len()).map(triple).collect(),
        velocities: (0..mesh.points.len()).map(|i| triple(i + 50)).collect(),
        fields: ElementFields {
            von_mises_pa: scalar(3),
            principal_stress_pa: pair(4),
            principal_direction: (0..3).map(|i| [triple(i + 20), triple(i + 30)]).collect(),
            principal_strain: pair(6),
            thickness_m: scalar(8),
            wrinkle_state: vec![0, 2, 1],
        },
        contact_pressure_pa: (0..mesh.points.len()).map(|i| noise(i, 9)).collect(),
        chambers: [("body", 2e3), ("Aktor ü", -7e3)]
            .map(|(name, pressure_pa)| ChamberState { name: name.into(), pressure_pa, volume_m3: 1e-3 / 3.0 })
            .to_vec(),
        hold_pa: Some(10e3),
    }
}

/// Every way in which one number of a frame is not finite, or one value too many.
pub(crate) fn spoilt() -> Vec<(&'static str, MeshFrame)> {
    let mut all: Vec<(&'static str, MeshFrame)> = Vec::new();
    let mut add = |name: &'static str, change: &dyn Fn(&mut MeshFrame)| {
        let mut bad = frame(0.5);
        change(&mut bad);
        all.push((name, bad));
    };
    add("position of node 3", &|f| f.positions[2][1] = f64::NAN);
    add("velocity of node 6", &|f| f.velocities[5][2] = f64::INFINITY);
    add("von Mises stress of element 2", &|f| f.fields.von_mises_pa[1] = f64::NAN);
    add("principal stress of element 3", &|f| f.fields.principal_stress_pa[2][1] = f64::NEG_INFINITY);
    add("strain of element 1", &|f| f.fields.principal_strain[0][0] = f64::NAN);
    add("thickness of element 1", &|f| f.fields.thickness_m[0] = f64::NAN);
    add("contact pressure of node 1", &|f| f.contact_pressure_pa[0] = f64::NAN);
    add("pressure or volume of chamber 2", &|f| f.chambers[1].volume_m3 = f64::NAN);
    add("principal direction of element 2", &|f| f.fields.principal_direction[1][1][0] = f64::NAN);
    add("time of run 1", &|f| f.time_s = f64::NAN);
    add("7 values of position for 6 nodes", &|f| f.positions.push([0.0; 3]));
    add("4 values of wrinkle state for 3 elements", &|f| f.fields.wrinkle_state.push(0));
    all
}

#[test]
fn a_number_that_is_not_finite_is_named_by_quantity_and_place() {
    frame(0.5).check(&mesh()).unwrap();
    for (message, bad) in spoilt() {
        let error = bad.check(&mesh()).unwrap_err().to_string();
        assert!(error.contains(message), "{error} does not say {message}");
    }
}
