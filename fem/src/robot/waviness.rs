//! Robots that are not quite their pattern: a smooth random departure of the shape that is free of membrane stress.
//!
//! A buckling robot ends in one of several folds, and which one a perfect mesh takes is the mesh's choice. Departures that are
//! the same on every mesh let an ensemble visit them all, so that its mean can be compared between meshes.

use std::array::from_fn;
use std::f64::consts::TAU;

use crate::random::gaussian;
use crate::vec3::V3;

/// Shortest and longest wave \[m\]: from half a pouch to two.
const WAVES_M: [f64; 2] = [0.03, 0.12];
const COUNT: usize = 64;

/// The points moved by u = rms √(1/n) Σₖ (aₖ cos kₖ·x + bₖ sin kₖ·x) with standard normal aₖ, bₖ, kₖ in all directions and lengths
/// 2π/|kₖ| evenly spread in their logarithm, so that each component of u has the root mean square `rms_m` over many seeds. The base
/// at x = 0 stays in its plane. Empty for `rms_m` = 0.
///
/// Layers 0.01 mm apart move together: waves of 30 mm change their gap by 2π rms/30 mm, 4 % for 0.2 mm, which is also the order of
/// the strains between this shape and the pattern.
pub(super) fn wavy(points: &[V3], rms_m: f64, seed: u64) -> Vec<V3> {
    if rms_m == 0.0 {
        return Vec::new();
    }
    let waves: Vec<Wave> = (0..COUNT).map(|k| Wave::of(k, rms_m, seed)).collect();
    let moved = |x: &[f64; 3]| {
        let mut point = *x;
        let beyond_base = 1.0 - (-(x[0] / WAVES_M[0]).powi(2)).exp();
        for wave in &waves {
            let (sin, cos) = (wave.k[0] * x[0] + wave.k[1] * x[1] + wave.k[2] * x[2]).sin_cos();
            for (i, at) in point.iter_mut().enumerate() {
                *at += beyond_base * (wave.a[i] * cos + wave.b[i] * sin);
            }
        }
        point
    };
    points.iter().map(moved).collect()
}

/// One wave: wave vector \[1/m\] and amplitudes \[m\].
struct Wave {
    k: [f64; 3],
    a: [f64; 3],
    b: [f64; 3],
}

impl Wave {
    fn of(number: usize, rms_m: f64, seed: u64) -> Wave {
        let draw = |place: usize| gaussian(seed, (9 * number + place) as u64);
        let direction: [f64; 3] = from_fn(draw);
        let length = direction.iter().map(|d| d * d).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
        let [short, long] = WAVES_M;
        let wave_m = short * (long / short).powf((number as f64 + 0.5) / COUNT as f64);
        let size = rms_m / (COUNT as f64).sqrt();
        Wave {
            k: direction.map(|d| TAU / wave_m * d / length),
            a: from_fn(|i| size * draw(3 + i)),
            b: from_fn(|i| size * draw(6 + i)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moved(before: Vec<[f64; 3]>, seed: u64) -> Vec<[f64; 3]> {
        let points = wavy(&before, 2e-4, seed);
        points.iter().zip(&before).map(|(p, b)| from_fn(|i| p[i] - b[i])).collect()
    }

    fn size(v: [f64; 3]) -> f64 {
        v.iter().map(|c| c * c).sum::<f64>().sqrt()
    }

    #[test]
    fn its_root_mean_square_is_what_was_asked_for_along_each_axis() {
        let far = vec![[0.2, 0.04, 0.0], [0.3, 0.0, -0.04], [0.15, -0.03, 0.03]];
        let all: Vec<[f64; 3]> = (0..400).flat_map(|seed| moved(far.clone(), seed)).collect();
        for i in 0..3 {
            let rms = (all.iter().map(|u| u[i] * u[i]).sum::<f64>() / all.len() as f64).sqrt();
            // 1200 draws, alike within one seed: 400 free ones give 3.5 %.
            assert!((rms / 2e-4 - 1.0).abs() < 0.12, "axis {i}: {rms}");
        }
    }

    #[test]
    fn layers_move_together_the_base_stays_in_its_plane_and_a_place_moves_alike_in_every_list() {
        for seed in 0..20 {
            let u = moved(vec![[0.2, 0.04, 0.01], [0.2, 0.040_01, 0.01], [0.0, 0.04, 0.0], [0.1, 0.0, 0.04]], seed);
            let gap = size(from_fn(|i| u[1][i] - u[0][i]));
            assert!(gap < 0.2 * 1e-5, "seed {seed}: layers part by {gap} m");
            assert_eq!(u[2], [0.0; 3]);
            assert_eq!(moved(vec![[0.1, 0.0, 0.04]], seed)[0], u[3]);
            assert_ne!(moved(vec![[0.1, 0.0, 0.04]], seed + 1)[0], u[3]);
        }
    }
}
