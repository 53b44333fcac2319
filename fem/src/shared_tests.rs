//! Meshes and problems that several tests of the engine need.

use std::sync::Arc;

use models::fabrics::NeoHookean;

use crate::mesh::Tie;
use crate::mesh::generate::{self, FoldedPouch, folded_pouch};
use crate::problem::{Amplitude, Chamber, Contact, Ply, Pressure, Section};
use crate::vec3::{V3, cross, dot, sub, unit};
use crate::{FemError, Mesh, Problem};

/// Two halves: `b` is twice as fine as `a`, and its left edge follows the right edge of `a`.
pub(crate) fn tied() -> Result<Mesh, FemError> {
    let half = |name: &str, n: usize, shift: f64| -> Result<Mesh, FemError> {
        let mut mesh = generate::plate(0.05, 0.02, 10 * n, 4 * n, None)?;
        mesh.points.iter_mut().for_each(|p| p[0] += shift);
        mesh.parts[0].name = name.into();
        mesh.sets = mesh.sets.into_iter().map(|(set, nodes)| (format!("{set}_{name}"), nodes)).collect();
        Ok(mesh)
    };
    let mut mesh = half("a", 1, 0.0)?;
    mesh.append(half("b", 2, 0.05)?)?;
    let (coarse, fine) = (mesh.sets["right_a"].clone(), mesh.sets["left_b"].clone());
    for (i, node) in fine.into_iter().enumerate() {
        let to = match i % 2 {
            0 => vec![(coarse[i / 2], 1.0)],
            _ => vec![(coarse[i / 2], 0.5), (coarse[i / 2 + 1], 0.5)],
        };
        mesh.ties.push(Tie { node, to });
    }
    Ok(mesh)
}

/// Pouch of 60 by 60 mm with folds of 24 mm in coated nylon, blown up within 30 ms, as in an actuator with side gussets.
/// `element_m` near 3 mm makes 1.4 thousand elements, 1 mm 13 thousand.
///
/// # Errors
/// [`FemError::Mesh`] for an element size that is not positive or far too small.
pub(crate) fn pouch(element_m: f64, peak_pa: f64, contact: bool) -> Result<Problem, FemError> {
    let mesh = folded_pouch(&FoldedPouch {
        length_m: 0.06,
        width_m: 0.06,
        fold_m: 0.024,
        gap_m: 1e-5,
        along: (0.06 / element_m).round() as usize,
        in_fold: (0.024 / element_m).round() as usize,
    })?;
    let fabric = Arc::new(NeoHookean::new(50.3e6, 2e-4));
    let sections = mesh
        .parts
        .iter()
        .map(|_| Section {
            plies: vec![Ply { fabric: fabric.clone(), angle_rad: 0.0 }],
            bonded: true,
            density_kg_m3: 1000.0,
            bending_factor: 0.1,
            rest_curvature: false,
        })
        .collect();
    let pressure = Pressure::Set(Amplitude::Smooth(vec![(0.0, 0.0), (0.03, peak_pa)]));
    let mut problem =
        Problem::new("folded pouch", mesh, sections, vec![Chamber { name: "air".into(), pressure, open_axis: None }]);
    problem.contact = contact.then(|| Contact { edges: true, ..Contact::default() });
    problem.settings.mass_damping_1_s = 100.0;
    problem.settings.end_s = 0.04;
    Ok(problem)
}

/// Number of sides of elements that run through a face.
pub(crate) fn piercings(mesh: &Mesh, x: &[V3]) -> usize {
    let at = |n: u32| x[n as usize];
    let faces = mesh.parts.iter().flat_map(|p| &p.quads).flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]);
    let faces: Vec<[u32; 3]> = faces.collect();
    let sides = mesh.parts.iter().flat_map(|p| &p.quads).flat_map(|q| [0, 1, 2, 3].map(|k| [q[k], q[(k + 1) % 4]]));
    let mut sides: Vec<[u32; 2]> = sides.filter(|s| s[0] < s[1]).collect();
    sides.sort_unstable();
    sides.dedup();
    let through = |side: &[u32; 2], face: &[u32; 3]| {
        let ([p, q], corners) = (side.map(at), face.map(at));
        let apart = |k: usize| {
            let (low, high) = corners.iter().fold((f64::MAX, f64::MIN), |(l, h), c| (l.min(c[k]), h.max(c[k])));
            p[k].max(q[k]) < low || p[k].min(q[k]) > high
        };
        if (0..3).any(apart) || face.iter().any(|n| side.contains(n)) {
            return false;
        }
        let [a, b, c] = corners;
        let Some(n) = unit(cross(sub(b, a), sub(c, a))) else { return false };
        let (hp, hq) = (dot(sub(p, a), n), dot(sub(q, a), n));
        if hp * hq >= 0.0 {
            return false;
        }
        let share = hp / (hp - hq);
        let hit = [0, 1, 2].map(|k| p[k] + share * (q[k] - p[k]));
        [(a, b), (b, c), (c, a)].iter().all(|(s, e)| dot(cross(sub(*e, *s), sub(hit, *s)), n) >= 0.0)
    };
    sides.iter().map(|side| faces.iter().filter(|face| through(side, face)).count()).sum()
}
