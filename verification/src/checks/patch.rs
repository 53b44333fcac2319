//! Patch tests: states that the elements must hold exactly on any mesh, and bending to a cylinder.

use super::setup::*;
use fem::mesh::Part;
use fem::mesh::generate::{Distortion, plate};
use fem::sheet::bending::{BendingMatrix, curvature_rows};
use fem::sheet::reference::bending_stiffness;
use fem::terms::Folds;
use models::fabrics::{FABRICS, NeoHookean, Orthotropic};
use models::{Fabric, Pose, Term};

pub(super) const UNIFORM: Check = Check::quick(
    "patch-uniform",
    "A sheet of distorted elements, stretched and sheared: stress is uniform, inner nodes are free of force.",
    "homogeneous deformation; the fabric's own law",
    uniform,
);

pub(super) const BENDING: Check = Check::quick(
    "patch-bending",
    "A plate rolled to a cylinder stores ½ D κ² per area, edges included.",
    "ibr: closed form; the chords of an arc lack (h/R)²/12",
    bending,
);

pub(super) const TWO: Check = Check::quick(
    "patch-two-thicknesses",
    "A plate of two thicknesses side by side, rolled across and along the line between them, stores ½ D κ² of each.",
    "ibr: closed form; one moment across the line, one curvature along it",
    two_thicknesses,
);

pub(super) const RIGID: Check = Check::quick(
    "rigid-turn",
    "A sheet turned by one radian has no stress and no force, whatever its fabric.",
    "objectivity",
    rigid,
);

const SIDES_M: [f64; 2] = [0.2, 0.1];
/// Deformation gradients, columns of the images of x and y.
const STATES: [(&str, [[f64; 2]; 2]); 3] = [
    ("stretch along", [[1.06, 0.0], [0.0, 1.0]]),
    ("stretch both ways", [[1.04, 0.0], [0.0, 1.09]]),
    ("shear", [[1.02, 0.05], [-0.03, 1.03]]),
];

fn distorted(triangles: bool) -> Result<Mesh, FemError> {
    let mut mesh = plate(SIDES_M[0], SIDES_M[1], 8, 6, Some(Distortion { share: 0.2, seed: 1 }))?;
    if triangles {
        for part in &mut mesh.parts {
            part.triangles = part.quads.drain(..).flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        }
    }
    Ok(mesh)
}

fn uniform() -> CheckResult {
    let fabric = NeoHookean::new(50.3e6, 2e-4);
    let mut lines = Vec::new();
    for (kind, triangles) in [("quads", false), ("triangles", true)] {
        let problem = Problem::new("patch", distorted(triangles)?, vec![section(Arc::new(fabric), 1.0)], vec![]);
        let (sheet, mesh, _) = shells(&problem)?;
        for (name, [f1, f2]) in STATES {
            let q = placed(&mesh.points, |p| [f1[0] * p[0] + f2[0] * p[1], f1[1] * p[0] + f2[1] * p[1], 0.0]);
            let mut force = vec![0.0; q.len()];
            sheet.add(&Pose::nodes(&q), &mut force);
            let inner = |p: &[f64; 3]| (0..2).all(|k| p[k] > 1e-9 && p[k] < SIDES_M[k] - 1e-9);
            let inside = mesh.points.iter().zip(force.as_chunks::<4>().0).filter(|(p, _)| inner(p));
            let rest = inside.map(|(_, f)| largest(f)).fold(0.0, f64::max);
            lines.push(CheckedNumber::at_most(
                format!("{kind}, {name}: force inside/at the edge"),
                rest / largest(&force),
                1e-12,
            ));
            let exact = principal_stress(&fabric, f1, f2);
            let stress = sheet.fields(&q).principal_stress_pa;
            let error =
                stress.iter().flat_map(|s| [s[0] / exact[0] - 1.0, s[1] / exact[1] - 1.0]).collect::<Vec<f64>>();
            lines.push(CheckedNumber::at_most(format!("{kind}, {name}: error of stress"), largest(&error), 1e-12));
        }
    }
    Ok(lines.into())
}

/// Principal Cauchy stresses of the sheet with F = [f1 f2]: eigenvalues of F S Fᵀ/t, larger first.
fn principal_stress(fabric: &NeoHookean, f1: [f64; 2], f2: [f64; 2]) -> [f64; 2] {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let e = [0.5 * (dot(f1, f1) - 1.0), 0.5 * (dot(f2, f2) - 1.0), dot(f1, f2)];
    let s = fabric.tension(e, &[0.0; 2]);
    let at = |i: usize, j: usize| {
        (f1[i] * f1[j] * s[0] + f2[i] * f2[j] * s[1] + (f1[i] * f2[j] + f2[i] * f1[j]) * s[2]) / fabric.thickness_m
    };
    let (mean, half) = (0.5 * (at(0, 0) + at(1, 1)), 0.5 * (at(0, 0) - at(1, 1)));
    let radius = (half * half + at(0, 1) * at(0, 1)).sqrt();
    [mean + radius, mean - radius]
}

fn bending() -> CheckResult {
    let (d, radius) = (1e-4, 0.05);
    let stored = |mesh: &Mesh, triangles_edge: f64| {
        let q =
            placed(&mesh.points, |p| [radius * (p[0] / radius).sin(), p[1], radius * (1.0 - (p[0] / radius).cos())]);
        let matrix = BendingMatrix::new(mesh.points.len(), &curvature_rows(mesh, &[d]));
        let energy = matrix.add(q.as_chunks().0, vec![[0.0; 4]; mesh.points.len()].as_mut_slice());
        // The ends of the roll carry no moment: half an element each.
        let area = (SIDES_M[0] - triangles_edge) * SIDES_M[1];
        energy / (0.5 * d / (radius * radius) * area)
    };
    let mut errors = Vec::new();
    for n in [1, 2, 4] {
        errors.push(stored(&plate(SIDES_M[0], SIDES_M[1], 10 * n, 5 * n, None)?, SIDES_M[0] / (10 * n) as f64) - 1.0);
    }
    let theory = (SIDES_M[0] / 40.0 / radius).powi(2) / 6.0;
    let fine = plate(SIDES_M[0], SIDES_M[1], 40, 20, Some(Distortion { share: 0.1, seed: 1 }))?;
    Ok(vec![
        CheckedNumber::value("energy over ½ D κ² A, 40 elements", 1.0 + errors[2], 1.0, 2e-3),
        CheckedNumber::value("what it lacks over (h/R)²/6", -errors[2] / theory, 1.0, 0.01),
        CheckedNumber::at_least("rate", rate(errors[1], errors[2], 2.0), 1.95),
        CheckedNumber::value("the same, elements distorted by 10 %", stored(&fine, SIDES_M[0] / 40.0), 1.0, 0.05),
    ]
    .into())
}

fn two_thicknesses() -> CheckResult {
    let thick = 2.0;
    let fabric = |scale: f64| Orthotropic::isotropic(1e8, 0.3, scale * 2e-4);
    let radius = 0.05;
    let mut lines = Vec::new();
    for (across, name) in [(0, "rolled across the line"), (1, "rolled along the line")] {
        let mut mesh = plate(SIDES_M[0], SIDES_M[1], 40, 20, None)?;
        let left = |quad: &[u32; 4]| quad.iter().map(|n| mesh.points[*n as usize][0]).sum::<f64>() < 2.0 * SIDES_M[0];
        let (thin, rest): (Vec<_>, Vec<_>) = mesh.parts[0].quads.iter().partition(|quad| left(quad));
        let part = |name: &str, quads| Part { name: name.into(), quads, ..Part::default() };
        mesh.parts = vec![part("thin", thin), part("thick", rest)];
        let sections = vec![section(Arc::new(fabric(1.0)), 1.0), section(Arc::new(fabric(thick)), 1.0)];
        let stiffness: Vec<f64> = sections.iter().map(bending_stiffness).collect();
        let (sheet, mesh, _) = shells(&Problem::new("two thicknesses", mesh, sections, vec![]))?;
        let q = placed(&mesh.points, |p| {
            // Across the line both sides carry one moment, so that the thick one bends less.
            let mut turned = p;
            let middle = 0.5 * SIDES_M[0];
            let r = if across == 0 && p[0] > middle { radius * stiffness[1] / stiffness[0] } else { radius };
            let s = if across == 0 { p[0] - middle } else { p[1] };
            turned[across] = r * (s / r).sin();
            turned[2] = r * (1.0 - (s / r).cos());
            turned
        });
        let pose = Pose::nodes(&q);
        let mut unused = vec![0.0; q.len()];
        let rows = BendingMatrix::new(mesh.points.len(), &curvature_rows(&mesh, &stiffness));
        let folds = Folds::new(&mesh, &sheet, &stiffness).add(&pose, &mut unused);
        let stored = rows.add(q.as_chunks().0, unused.as_chunks_mut().0) + folds;
        let half = 0.5 * SIDES_M[0] * SIDES_M[1] * 0.5 / (radius * radius);
        // Rows at free edges bend along them only: half an element each where the roll ends there.
        let exact = match across {
            0 => {
                (half - 0.25 * SIDES_M[1] * SIDES_M[0] / 40.0 / (radius * radius))
                    * stiffness[0]
                    * (1.0 + stiffness[0] / stiffness[1])
            }
            _ => {
                (half - 0.5 * SIDES_M[0] * 0.5 * SIDES_M[1] / 20.0 / (radius * radius)) * (stiffness[0] + stiffness[1])
            }
        };
        lines.push(CheckedNumber::value(format!("{name}: energy over ½ ∫ D κ²"), stored / exact, 1.0, 2e-3));
    }
    Ok(lines.into())
}

fn rigid() -> CheckResult {
    let mut lines = Vec::new();
    let (s, c) = 1.0_f64.sin_cos();
    for law in FABRICS {
        let fabric = (law.make)(&(law.example)()).map_err(|e| FemError::Problem(e.to_string()))?;
        let stiff = fabric.tangent([0.0; 3], &[0.0; 2])[0][0];
        let own = Section {
            plies: vec![Ply { fabric: fabric.clone(), angle_rad: 0.3 }],
            ..section(Arc::new(Orthotropic::isotropic(1e8, 0.3, 1e-4)), 1.0)
        };
        let (sheet, mesh, _) = shells(&Problem::new("turn", distorted(false)?, vec![own], vec![]))?;
        let q = placed(&mesh.points, |p| [c * p[0] - s * p[2] + 0.3, p[1] - 0.2, s * p[0] + c * p[2]]);
        let mut force = vec![0.0; q.len()];
        sheet.add(&Pose::nodes(&q), &mut force);
        let tension = largest(&sheet.fields(&q).von_mises_pa) * fabric.thickness_m();
        lines.push(CheckedNumber::at_most(format!("{}: tension over stiffness", law.name), tension / stiff, 1e-12));
        lines.push(CheckedNumber::at_most(
            format!("{}: force over stiffness [m]", law.name),
            largest(&force) / stiff,
            1e-13,
        ));
    }
    Ok(lines.into())
}
