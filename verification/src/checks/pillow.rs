//! Square pillow airbag of the literature on wrinkling.
//!
//! Edge and sheet pleat at the scale of the mesh. The node in the middle of an edge is therefore on a ridge or in a valley,
//! up to 14 mm apart and exchanged by n/2 even or odd: it measures the pleat, not the bag. The edge's place is the mean over
//! one pleat, ¼ ½ ¼ over the node and its two neighbours.

use super::setup::*;
use models::fabrics::Orthotropic;

pub(super) const CHECK: Check = Check::slow(
    "square-airbag",
    "Two square sheets welded around are inflated: height of the centre, pull-in of the edges, for five meshes.",
    "band of published membrane calculations",
    run,
);

/// Side of the flat square \[m\]: diagonal 1.2 m, as in "Inflation of a Square Airbag" of the COMSOL application library, which
/// prints the thickness as 6 mm in one sentence.
const SIDE_M: f64 = 0.848_528_137_423_857;
/// Rise of the centre of one sheet above the plane of the rim \[m\], lowest and highest of the published values; second hand, from
/// membrane calculations with and without a wrinkling model.
const CENTRE_M: [f64; 2] = [0.205, 0.217];
/// Inward displacement of the middle of a side \[m\], likewise.
const MID_EDGE_M: [f64; 2] = [0.11, 0.125];
const MESHES: [usize; 5] = [16, 24, 32, 40, 48];

fn run() -> CheckResult {
    let rows = MESHES.into_iter().map(|n| Ok((n, ensemble(n)?))).collect::<Result<Vec<_>, FemError>>()?;
    let mut lines = Vec::new();
    for (n, [centre, edge]) in &rows {
        let ([low, high], [near, far]) = (CENTRE_M, MID_EDGE_M);
        lines.push(CheckedNumber::between(
            format!("height of the centre, {n} per side [m]"),
            *centre,
            0.97 * low,
            1.03 * high,
        ));
        lines.push(CheckedNumber::between(format!("pull-in of the edges, {n} per side [m]"), *edge, near, far));
    }
    for (k, name) in ["height of the centre", "pull-in of the edges"].iter().enumerate() {
        let change = (rows[4].1[k] / rows[2].1[k] - 1.0).abs();
        lines.push(CheckedNumber::at_most(format!("{name}: change from 32 to 48 per side"), change, 0.01));
    }
    let edges = || rows.iter().map(|(_, found)| found[1]);
    let (least, most) = (edges().fold(f64::INFINITY, f64::min), edges().fold(0.0, f64::max));
    let mean = edges().sum::<f64>() / rows.len() as f64;
    let name = "pull-in of the edges: largest less smallest of five meshes, over their mean";
    lines.push(CheckedNumber::at_most(name, (most - least) / mean, 0.05));
    Ok(CheckOutcome::drawn(lines, figure(&rows)))
}

fn figure(rows: &[(usize, [f64; 2])]) -> Figure {
    let engine = |k: usize| rows.iter().map(move |(n, found)| [*n as f64, found[k]]);
    let band = |[low, high]: [f64; 2]| vec![[16.0, low], [48.0, low], [48.0, high], [16.0, high], [16.0, low]];
    let curves = vec![
        FigureCurve::exact("height, published range", band(CENTRE_M)),
        FigureCurve::exact("pull-in of the edges, published range", band(MID_EDGE_M)),
        FigureCurve::engine("height", engine(0)),
        FigureCurve::engine("pull-in", engine(1)),
    ];
    Figure::new("Square airbag: convergence", ["elements per side", "height, pull-in [m]"], curves)
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
    let film = Orthotropic::isotropic(588e6, 0.4, 6e-4);
    let air = chamber("air", rise(0.05, 5e3));
    let mesh = generate::pillow(SIDE_M, n, 0.0)?;
    let mut problem = problem("square airbag", mesh, section(Arc::new(film), 0.01), vec![air]);
    problem.settings.mass_damping_1_s = 100.0;
    problem.settings.imperfection = 0.01;
    problem.settings.seed = seed;
    let mut run = Simulation::new(&problem)?;
    advance(&mut run, 0.15)?;
    let (mesh, x) = (&problem.mesh, run.positions());
    let centre = 0.5 * (mean(mesh, "centre_top", &x, 2) - mean(mesh, "centre_bottom", &x, 2));
    Ok([centre, pull_in(mesh, &x, SIDE_M / n as f64)])
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
