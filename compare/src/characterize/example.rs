//! Made-up tests of a fabric whose truth is known: to learn the formats, and to test the reduction.

use data::Direction;
use models::fabrics::{BiasExtension, Curve, Woven, Yarn};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{RngCore, SeedableRng};
use std::fmt::Write as _;

/// How many specimens each direction has.
pub const SPECIMENS: usize = 5;
/// Thickness of the fabric in every test \[m\].
pub const THICKNESS_M: f64 = 5e-5;
/// Strip of all directions, as in the paper.
pub const STRIP: BiasExtension = BiasExtension { length_m: 0.25, width_m: 0.02, thickness_m: THICKNESS_M };
/// Nominal strain and stress \[Pa\] along warp; the first slope is E0 = 96.5 MPa.
pub const WARP: [[f64; 2]; 4] = [[0.0, 0.0], [0.05, 4.825e6], [0.15, 13e6], [0.25, 19e6]];
/// The same along fill; E90 = 120 MPa.
pub const FILL: [[f64; 2]; 4] = [[0.0, 0.0], [0.05, 6e6], [0.15, 16e6], [0.25, 23e6]];
/// Shear angle \[rad\] and moment per volume \[Pa\]: G12 = 1.03 MPa, steeper from 45° (0.785 rad) on.
pub const SHEAR: [[f64; 2]; 4] = [[0.0, 0.0], [0.4, 0.412e6], [0.785, 0.7e6], [0.95, 1.9e6]];

/// Share by which the stiffness of specimens scatters (standard deviation).
const SCATTER: f64 = 0.04;
/// Noise of the load cell over the largest force.
const NOISE: f64 = 0.001;
const ROWS: usize = 250;

/// File names and contents: one file per direction.
///
/// Synthetic: curves of the tables above, stiffness of each specimen scattered by 4 %, load noise of 0.1 %.
pub fn example(seed: u64) -> Vec<(String, String)> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    [Direction::Warp, Direction::Bias, Direction::Fill].map(|d| file(d, &mut random)).to_vec()
}

fn file(direction: Direction, random: &mut ChaCha8Rng) -> (String, String) {
    let bias = direction == Direction::Bias;
    let mut text = format!(
        "# Made-up test of a silicone-coated nylon, pulled at {} degrees\n# provenance: synthetic\n# direction_deg: {}\n\
         # width_mm: 20\n# length_mm: 250\n# thickness_mm: 0.05\n",
        direction.degrees(),
        direction.degrees()
    );
    text.push_str(if bias { "specimen,displacement_mm,force_n\n" } else { "specimen,strain_pct,stress_mpa\n" });
    for k in 1..=SPECIMENS {
        let factor = 1.0 + SCATTER * normal(random);
        let last = if bias { 0.9 } else { 0.25 } * (1.0 + 0.02 * normal(random));
        for row in 0..=ROWS {
            let [x, y] = point(direction, last * row as f64 / ROWS as f64, factor);
            let noise = if row == 0 { 0.0 } else { NOISE * largest(direction) * normal(random) };
            // Writing into a String cannot fail.
            let _ = writeln!(text, "{}{k},{x:.5},{:.5}", direction.word(), y + noise);
        }
    }
    (format!("{}.csv", direction.word()), text)
}

/// One row in the units of the file, at a strain, or at a shear angle for the bias test.
fn point(direction: Direction, at: f64, factor: f64) -> [f64; 2] {
    // The tables above are right by a test.
    let table = |rows: &[[f64; 2]], x: f64| Curve::table(rows).map_or(f64::NAN, |curve| factor * curve.value(x));
    match direction {
        Direction::Warp => [100.0 * at, 1e-6 * table(&WARP, at)],
        Direction::Fill => [100.0 * at, 1e-6 * table(&FILL, at)],
        Direction::Bias | Direction::Between(_) => {
            let law = |angle: f64| table(&SHEAR, angle) * THICKNESS_M / angle.cos();
            let [d, f] = STRIP.pulled(at, law, yarns().as_ref().map(|y| y as _));
            [1e3 * d, f]
        }
    }
}

fn yarns() -> Option<Woven> {
    let yarn = |rows: &[[f64; 2]]| Yarn::new(Curve::table(rows).ok()?, None).ok();
    Woven::new([yarn(&WARP)?, yarn(&FILL)?], Curve::linear(1e6), 0.0, THICKNESS_M).ok()
}

fn largest(direction: Direction) -> f64 {
    point(direction, if direction == Direction::Bias { 0.9 } else { 0.25 }, 1.0)[1]
}

/// Standard normal number (Box and Muller).
fn normal(random: &mut ChaCha8Rng) -> f64 {
    let mut uniform = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
    let (radius, turn) = ((-2.0 * (1.0 - uniform()).ln()).sqrt(), uniform());
    radius * (std::f64::consts::TAU * turn).cos()
}
