//! Bias extension: a strip at 45° to its yarns must give back the shear curve of its fabric.
//!
//! The mesh is aligned with the yarns: squares whose sides run at ±45° to the strip, halved along its edges. The zones of
//! no, half and whole shear of the closed form then are bounded by sides of elements, and yarns that hardly stretch do
//! not lock.
//!
//! The strip is twice as long as wide, for then alone the uniform zones of the closed form are the state of least energy.
//! In longer strips the yarns of the middle, which no clamp holds, slide along themselves until shear is spread unevenly:
//! least energy then gives 1 to 2 % less force and up to a fifth less shear in the middle, and so does the engine.

use super::setup::*;
use fem::mesh::Part;
use models::fabrics::{BiasExtension, Curve as Table, Woven, Yarn};

pub(super) const CHECK: Check = Check::slow(
    "bias-extension",
    "A strip of woven fabric pulled at 45 degrees to its yarns gives back the shear curve that went in.",
    "Cao et al. 2008, Composites A 39, 1037, eqs. 13 and 18 as corrected in models::fabrics::BiasExtension",
    run,
);

/// The curve that goes in: moment per volume over shear angle \[rad, Pa\].
pub const SHEAR: [[f64; 2]; 5] = [[0.0, 0.0], [0.15, 0.1e6], [0.35, 0.3e6], [0.55, 0.6e6], [0.8, 1.1e6]];
/// Strip of the simulated tests, twice as long as wide.
pub const STRIP: BiasExtension = BiasExtension { length_m: 0.08, width_m: 0.04, thickness_m: THICKNESS_M };
/// Modulus of the yarns \[Pa\]: a hundred thousand times the shear; errors fall with its inverse.
const YARN_PA: f64 = 1e11;
/// Thickness of the fabric in all checks \[m\].
pub const THICKNESS_M: f64 = 5e-5;
/// Half diagonal of an element: an eighth of the width.
const HALF_M: f64 = 5e-3;
const STEP_S: f64 = 8e-3;
const ROWS: usize = 14;
/// Shear angle of the last row \[rad\].
const LAST: f64 = 0.7;

/// Curve of a simulated bias-extension test.
pub struct BiasPull {
    /// Rows displacement \[m\], force \[N\] of the right clamp, the first `[0, 0]`.
    pub rows: Vec<[f64; 2]>,
    /// Shear angle in the middle at every row \[rad\].
    pub seen: Vec<f64>,
    /// Energy residual over external work at the end.
    pub residual: f64,
}

/// Pulls the strip: some ten CPU-seconds.
///
/// # Errors
/// A run that stops, which none does.
pub fn pull() -> Result<BiasPull, FemError> {
    let mut run = start(&Table::table(&SHEAR).map_err(FemError::Problem)?)?;
    let mut pulled = BiasPull { rows: vec![[0.0, 0.0]], seen: vec![0.0], residual: 0.0 };
    for row in 1..=ROWS {
        advance(&mut run, 1.25 * STEP_S * row as f64)?;
        pulled.rows.push([displacement_m(row), pull_n(&run, "right")]);
        pulled.seen.push(angle_in_the_middle(&run.positions()));
    }
    pulled.residual = run.ledger().residual_share();
    Ok(pulled)
}

fn run() -> CheckResult {
    let table = Table::table(&SHEAR).map_err(FemError::Problem)?;
    let BiasPull { rows, seen, residual } = pull()?;
    let found = STRIP.shear(&rows).map_err(FemError::Problem)?;
    let mut outcome = CheckOutcome::default();
    for (row, [angle, moment_pa]) in found.iter().enumerate().skip(1) {
        let exact = table.value(*angle);
        let name = format!("shear moment at {angle:.2} rad [MPa]");
        outcome.lines.push(CheckedNumber::value(&name, moment_pa * 1e-6, exact * 1e-6, 0.01));
        outcome.lines.push(CheckedNumber::value("shear angle in the middle [rad]", seen[row], *angle, 0.01));
    }
    outcome.lines.push(balance(residual));
    let mpa = |row: &[f64; 2]| [row[0], 1e-6 * row[1]];
    let known = FigureCurve::exact("table that went in", SHEAR.iter().map(mpa));
    let curves = vec![known, FigureCurve::engine("engine, reduced", found.iter().map(mpa))];
    let axes = ["shear angle [rad]", "moment per volume [MPa]"];
    outcome.figure = Some(Figure::new("Shear curve from a bias-extension test", axes, curves));
    Ok(outcome)
}

/// Clamp displacement of a row \[m\]: rows are even in shear angle.
fn displacement_m(row: usize) -> f64 {
    STRIP.displacement_m(LAST * row as f64 / ROWS as f64)
}

fn start(table: &Table) -> Result<Simulation, FemError> {
    let yarn = || Yarn::new(Table::linear(YARN_PA), None).map_err(FemError::Problem);
    let fabric = Woven::new([yarn()?, yarn()?], table.clone(), 0.0, THICKNESS_M).map_err(FemError::Problem)?;
    let mut problem = Problem::new("bias", mesh(), vec![section(Arc::new(fabric), 0.0)], vec![]);
    let mut pull = vec![(0.0, 0.0)];
    for row in 1..=ROWS {
        let end = 1.25 * STEP_S * row as f64;
        pull.extend([(end - 0.25 * STEP_S, displacement_m(row)), (end, displacement_m(row))]);
    }
    problem.supports = vec![hold("left", [true; 3]), drive("right", [true; 3], 0, Amplitude::Smooth(pull))];
    problem.settings.mass_damping_1_s = 400.0;
    Simulation::new(&problem)
}

/// Columns and rows of half diagonals.
fn counts() -> [usize; 2] {
    [STRIP.length_m, STRIP.width_m].map(|side| (side / HALF_M).round() as usize)
}

/// Nodes where column + row is even; squares on their corners around the others, triangles at the edges.
fn mesh() -> Mesh {
    let [columns, rows] = counts();
    let mut mesh = Mesh::default();
    let mut part = Part { name: "strip".into(), warp: vec![[1.0, 1.0, 0.0]], ..Part::default() };
    for (i, j) in (0..=rows).flat_map(|j| (0..=columns).map(move |i| (i, j))) {
        if (i + j).is_multiple_of(2) {
            mesh.points.push([i as f64 * HALF_M, j as f64 * HALF_M, 0.0]);
            continue;
        }
        let around = [
            (j > 0, i, j.wrapping_sub(1)),
            (i < columns, i + 1, j),
            (j < rows, i, j + 1),
            (i > 0, i.wrapping_sub(1), j),
        ];
        let corners: Vec<u32> = around.iter().filter(|c| c.0).map(|c| node(c.1, c.2)).collect();
        match corners[..] {
            [a, b, c, d] => part.quads.push([a, b, c, d]),
            [a, b, c] => part.triangles.push([a, b, c]),
            _ => {}
        }
    }
    let column = |i: usize| (0..=rows).filter(|j| (i + j).is_multiple_of(2)).map(|j| node(i, j)).collect();
    mesh.sets.insert("left".into(), column(0));
    mesh.sets.insert("right".into(), column(columns));
    mesh.parts.push(part);
    mesh
}

/// Number of the node at a column and row of even sum; the number of columns is even.
fn node(i: usize, j: usize) -> u32 {
    ((j * (counts()[0] + 1) + i) / 2) as u32
}

/// Shear angle of the element in the middle, from its diagonals.
fn angle_in_the_middle(x: &[[f64; 3]]) -> f64 {
    let [i, j] = counts().map(|n| n / 2);
    let i = i + (i + j + 1) % 2;
    let at = |i: usize, j: usize| x[node(i, j) as usize];
    let along = at(i + 1, j)[0] - at(i - 1, j)[0];
    let across = at(i, j + 1)[1] - at(i, j - 1)[1];
    std::f64::consts::FRAC_PI_2 - 2.0 * (across / along).atan()
}
