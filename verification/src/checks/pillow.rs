//! Square pillow airbag of the literature on wrinkling.
//!
//! Edge and sheet pleat at the scale of the mesh. The node in the middle of an edge therefore lies on a ridge or in a valley,
//! up to 14 mm apart and exchanged by n/2 even or odd: it measures the pleat, not the bag. The edge's place is the mean over
//! one pleat, ¼ ½ ¼ over the node and its two neighbours. Measured, mean of 4 edges (three seeds differ by less than .0001):
//!
//! | elements per side | centre \[m\] | middle node \[m\] | mean over the pleat \[m\] |
//! |---|---|---|---|
//! | 16 | .2129 | .1319 | .1180 |
//! | 32 | .2159 | .1276 | .1205 |
//! | 34 | .2160 | .1140 | .1204 |
//! | 48 | .2161 | .1254 | .1205 |
//! | 64 | .2162 | .1254 | .1215 |
//! | 96 | .2169 | .1238 | .1239, edges .118 to .127 |
//!
//! At 32: bending factor 0 to 1 moves the mean by −.0009, hourglass .001 to .03 by ±.0006 (middle node), imperfection .001 to .1
//! not at all. At 96
//! pleats join to one deep fold beside the middle of each edge; three nodes no longer span it, and single edges scatter by 4 %.

use std::sync::Arc;

use crate::exact::pillow::{AIRBAG, AIRBAG_CENTRE_M, AIRBAG_MID_EDGE_M};
use models::fabrics::Orthotropic;

use super::inflated::{advance, chamber, mean, nodes, section};
use super::{Check, Curve, Figure, Line, Outcome};
use fem::mesh::generate;
use fem::{FemError, Mesh, Problem, Simulation};

/// Entry of the list.
pub const CHECK: Check = Check {
    name: "square-airbag",
    sentence: "Two square sheets welded around are inflated: height of the centre, pull-in of the edges, for five meshes.",
    source: "band of published membrane calculations, collected in verification::exact::pillow",
    slow: true,
    run,
};

/// Elements per side.
const MESHES: [usize; 5] = [16, 24, 32, 40, 48];

fn run() -> Result<Outcome, FemError> {
    let rows = MESHES.into_iter().map(|n| Ok((n, ensemble(n)?))).collect::<Result<Vec<_>, FemError>>()?;
    let mut lines = Vec::new();
    for (n, [centre, edge]) in &rows {
        let ([low, high], [near, far]) = (AIRBAG_CENTRE_M, AIRBAG_MID_EDGE_M);
        lines.push(Line::between(&format!("height of the centre, {n} per side [m]"), *centre, 0.97 * low, 1.03 * high));
        lines.push(Line::between(&format!("pull-in of the edges, {n} per side [m]"), *edge, near, far));
    }
    for (k, name) in ["height of the centre", "pull-in of the edges"].iter().enumerate() {
        let change = (rows[4].1[k] / rows[2].1[k] - 1.0).abs();
        lines.push(Line::at_most(&format!("{name}: change from 32 to 48 per side"), change, 0.01));
    }
    let edges = || rows.iter().map(|(_, found)| found[1]);
    let (least, most) = (edges().fold(f64::INFINITY, f64::min), edges().fold(0.0, f64::max));
    let mean = edges().sum::<f64>() / rows.len() as f64;
    lines.push(Line::at_most(
        "pull-in of the edges: largest less smallest of five meshes, over their mean",
        (most - least) / mean,
        0.05,
    ));
    Ok(Outcome { lines, figure: Some(figure(&rows)) })
}

fn figure(rows: &[(usize, [f64; 2])]) -> Figure {
    let engine = |k: usize| rows.iter().map(|(n, found)| [*n as f64, found[k]]).collect();
    let curve = |label: &str, points, exact| Curve { label: label.into(), points, exact };
    let band = |[low, high]: [f64; 2]| vec![[16.0, low], [48.0, low], [48.0, high], [16.0, high], [16.0, low]];
    Figure {
        title: "Square airbag: convergence".into(),
        x: "elements per side".into(),
        y: "height, pull-in [m]".into(),
        curves: vec![
            curve("height, published range", band(AIRBAG_CENTRE_M), true),
            curve("pull-in of the edges, published range", band(AIRBAG_MID_EDGE_M), true),
            curve("height", engine(0), false),
            curve("pull-in", engine(1), false),
        ],
    }
}

/// Height of the centre and pull-in of the edges \[m\], mean over three seeds of the imperfection.
fn ensemble(n: usize) -> Result<[f64; 2], FemError> {
    let mut sum = [0.0; 2];
    for seed in 1..=3 {
        let found = inflate(n, seed)?;
        (0..2).for_each(|k| sum[k] += found[k] / 3.0);
    }
    Ok(sum)
}

fn inflate(n: usize, seed: u64) -> Result<[f64; 2], FemError> {
    let film = Orthotropic::isotropic(AIRBAG.young_pa, AIRBAG.poisson, AIRBAG.thickness_m);
    let sheet = section(Arc::new(film), 0.01);
    let air = chamber("air", vec![(0.0, 0.0), (0.05, AIRBAG.pressure_pa)]);
    let mesh = generate::pillow(AIRBAG.side_m, n, 0.0)?;
    let mut problem = Problem::new("square airbag", mesh, vec![sheet.clone(), sheet], vec![air]);
    problem.settings.mass_damping_1_s = 100.0;
    problem.settings.imperfection = 0.01;
    problem.settings.seed = seed;
    let mut run = Simulation::new(&problem)?;
    advance(&mut run, 0.15)?;
    let (mesh, x) = (&problem.mesh, run.positions());
    let centre = 0.5 * (mean(mesh, "centre_top", &x, 2) - mean(mesh, "centre_bottom", &x, 2));
    Ok([centre, pull_in(mesh, &x, AIRBAG.side_m / n as f64)])
}

/// Mean way inwards of the middles of the edges, each averaged over a pleat.
fn pull_in(mesh: &Mesh, x: &[[f64; 3]], h: f64) -> f64 {
    let middles = nodes(mesh, "mid_edges");
    let one = |middle: &u32| {
        let at = mesh.points[*middle as usize];
        let out = if at[0].abs() > at[1].abs() { 0 } else { 1 };
        let way = |n: u32| mesh.points[n as usize][out].abs() - x[n as usize][out].abs();
        let near = |n: &&u32| {
            let p = mesh.points[**n as usize];
            let distance = (p[0] - at[0]).hypot(p[1] - at[1]);
            distance > 0.5 * h && distance < 1.5 * h
        };
        let beside: f64 = nodes(mesh, "rim").iter().filter(near).map(|n| way(*n)).sum();
        0.5 * way(*middle) + 0.25 * beside
    };
    middles.iter().map(one).sum::<f64>() / middles.len() as f64
}
