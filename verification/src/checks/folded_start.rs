//! A cushion that starts folded, and one whose sheets start apart: the way there leaves no trace in the volume.

use super::setup::*;
use fem::vec3::V3;
use models::fabrics::{Orthotropic, TensionField};

pub(super) const CHECK: Check = Check::slow(
    "folded-start",
    "A cushion folded by 90 degrees, and a flat one whose sheets start 0.5 mm apart, end with the volume of the flat one.",
    "the start shape is not a property of the cushion",
    run,
);

const SIDE_M: f64 = 0.2;
const COUNT: usize = 16;
const GAP_M: f64 = 4e-5;

fn run() -> CheckResult {
    let flat = volume(generate::pillow(SIDE_M, COUNT, 0.0)?, false)?;
    let [mut folded, mut apart] = [generate::pillow(SIDE_M, COUNT, 0.0)?, generate::pillow(SIDE_M, COUNT, 0.0)?];
    folded.start = start(&folded, |x, up| bent(x, up * 0.5 * GAP_M));
    apart.start = start(&apart, |x, up| [x, 0.0, up * 0.25e-3]);
    Ok(vec![
        CheckedNumber::value("folded by 90 degrees: volume [cm³]", 1e6 * volume(folded, true)?, 1e6 * flat, 0.01),
        CheckedNumber::value("0.5 mm apart: volume [cm³]", 1e6 * volume(apart, false)?, 1e6 * flat, 0.01),
    ]
    .into())
}

/// Start places from x and the side of the sheet: 1 and −1 for top and bottom, 0 on the rim.
fn start(mesh: &Mesh, place: impl Fn(f64, f64) -> V3) -> Vec<V3> {
    let mut side = vec![0.0_f64; mesh.points.len()];
    for (part, up) in mesh.parts.iter().zip([1.0, -1.0]) {
        part.quads.iter().flatten().for_each(|n| side[*n as usize] += up);
    }
    let each = |([x, y, _], side): (&V3, &f64)| {
        let up = if side.abs() > 3.5 { side.signum() } else { 0.0 };
        let [a, _, c] = place(x + 0.5 * SIDE_M, up);
        [a, *y, c]
    };
    mesh.points.iter().zip(&side).map(each).collect()
}

/// Along x the sheet turns by 15 degrees from element to element until it is upright.
fn bent(x: f64, height: f64) -> V3 {
    let size = SIDE_M / COUNT as f64;
    let turn = |i: usize| (15.0 * (i as f64 - 4.0)).clamp(0.0, 90.0).to_radians();
    let column = (x / size).round() as usize;
    let (mut at, before) = ([0.0; 2], turn(column.max(1) - 1));
    (0..column).for_each(|i| at = [at[0] + size * turn(i).cos(), at[1] + size * turn(i).sin()]);
    let (sin, cos) = (0.5 * (before + turn(column))).sin_cos();
    [at[0] - height * sin, 0.0, at[1] + height * cos]
}

/// Volume of the cushion at rest under 5 kPa \[m³\].
fn volume(mesh: Mesh, contact: bool) -> Result<f64, FemError> {
    let film = Orthotropic::new(300e6, 300e6, 0.0, 110e6, 2e-4);
    let field = TensionField::new(film, 0.01).map_err(FemError::Problem)?;
    let air = chamber("air", rise(0.1, 5e3));
    let mut problem = problem("cushion", mesh, section(Arc::new(field), 0.1), vec![air]);
    problem.contact = contact.then(|| Contact { edges: true, ..Contact::default() });
    (problem.settings.end_s, problem.settings.mass_damping_1_s) = (0.5, 60.0);
    problem.settings.hourglass = 1e-3;
    Ok(volume_m3(&settle(&problem)?))
}
