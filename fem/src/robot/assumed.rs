//! Unmeasured numbers of the published robots, and numerical settings that move their tips: each with an interval, and a
//! hypercube over all of them.
//!
//! A Latin hypercube of n robots cuts the interval of every number into n parts of equal probability and gives every robot one part of
//! each, in a random order for every number; within its part a number is drawn, too. So n robots cover each number as n
//! values of it would, whatever the others do. Reference: McKay, Beckman, Conover 1979.

use crate::random::Draws;

/// A number that no publication gives, and its plausible interval.
#[derive(Debug, Clone, Copy)]
pub struct Assumed {
    /// Key of the number in [`super::KEYS`].
    pub key: &'static str,
    /// Smallest and largest plausible value, SI.
    pub interval: [f64; 2],
    /// How values are spread over it.
    pub spread: ValueSpacing,
    /// Source of the interval, in a few words.
    pub reason: &'static str,
}

/// How values are spread over an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ValueSpacing {
    /// Equal differences have equal probability, uniform over the interval.
    Even,
    /// Every factor alike, where the ends differ by a factor of five and more.
    Factor,
}

impl Assumed {
    /// The value at a share 0 to 1 of the interval.
    pub fn at(&self, share: f64) -> f64 {
        let [low, high] = self.interval;
        match self.spread {
            ValueSpacing::Even => low + share * (high - low),
            ValueSpacing::Factor => low * (high / low).powf(share),
        }
    }
}

const fn assumed(key: &'static str, interval: [f64; 2], spread: ValueSpacing, reason: &'static str) -> Assumed {
    Assumed { key, interval, spread, reason }
}

/// What the four robots leave open, besides pouch count and marker stations, which are in the scenario. Then numerical settings that move
/// a tip by more than 1 % when they are a third or three times as large (`ibr simulate epam --numerics`).
#[rustfmt::skip]
pub const ASSUMED: &[Assumed] = &[
    assumed("weld_mm", [0.0, 0.008], ValueSpacing::Even, "a line to a wide impulse seal; ultrasonic wheels are a few millimetres wide"),
    assumed("bending_factor", [0.1, 0.5], ValueSpacing::Factor, "droop of a heat-bondable coated nylon, measured by Farrell et al."),
    assumed("wrinkle_length", [0.5, 1.0], ValueSpacing::Even,
        "wrinkles from the strip's edge to the taut line, or half as far; their load follows from it, bending and hoop tension"),
    assumed("bond", [0.0, 1.0], ValueSpacing::Even,
        "plies that slide to plies without slip; shear lag through 0.05 mm of adhesive is about 2 mm"),
    assumed("tape_mm", [2e-5, 2.5e-4], ValueSpacing::Factor, "adhesive transfer tapes are sold from 0.02 to 0.25 mm"),
    assumed("tape_margin_mm", [0.0, 0.015], ValueSpacing::Even, "a sheet cut at its welds to one that is easy to tape"),
    assumed("waviness_mm", [0.0, 2e-4], ValueSpacing::Even, "a perfect pattern to a thickness of the fabric"),
    assumed("glue_mm", [5e-5, 5e-4], ValueSpacing::Factor, "a film spread by hand"),
    assumed("glue_e_mpa", [3e5, 3e6], ValueSpacing::Factor, "silicone adhesives"),
    assumed("nu12", [0.0, 0.4], ValueSpacing::Even, "woven fabrics pulled in one direction; 0 is yarns that do not cross"),
    assumed("density_kg_m3", [700.0, 1300.0], ValueSpacing::Even, "nylon 1140, coats 900 to 1200, air between yarns"),
    assumed("hourglass", [7e-4 / 3.0, 3.0 * 7e-4], ValueSpacing::Factor, "numerical: a third to three times the default"),
    assumed("layer_gap_mm", [1e-5 / 3.0, 3e-5], ValueSpacing::Factor,
        "numerical: a third to three times the published distance of layers"),
    assumed("mass_damping_1_s", [25.0, 230.0], ValueSpacing::Factor, "numerical: a third to three times the default of the ePAM"),
    assumed("layer_friction", [0.0, 0.6], ValueSpacing::Even, "none, as in the paper's model, to dry coated nylon on itself"),
];

/// Shares 0 to 1 of the interval of each of `numbers` numbers for `robots` robots; the same seed gives the same hypercube everywhere.
///
/// ```
/// let mut first: Vec<f64> = fem::robot::hypercube(4, 2, 7).iter().map(|robot| robot[0]).collect();
/// first.sort_by(f64::total_cmp);
/// assert!((0..4).all(|k| (first[k] * 4.0) as usize == k), "one robot in every quarter");
/// ```
pub fn hypercube(robots: usize, numbers: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut draws = Draws(seed);
    latin(robots, numbers, || draws.next()).chunks(numbers.max(1)).map(<[f64]>::to_vec).collect()
}

/// A Latin hypercube from numbers drawn from 0 to below 1: case by case its shares of all axes.
pub fn latin(cases: usize, axes: usize, mut draw: impl FnMut() -> f64) -> Vec<f64> {
    let mut all = vec![0.0; cases * axes];
    for axis in 0..axes {
        let mut parts: Vec<usize> = (0..cases).collect();
        // Fisher and Yates.
        for i in (1..cases).rev() {
            parts.swap(i, (draw() * (i + 1) as f64) as usize);
        }
        for (case, part) in parts.into_iter().enumerate() {
            all[case * axes + axis] = (part as f64 + draw()) / cases as f64;
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_has_one_robot_in_each_part_of_its_interval() {
        let cube = hypercube(30, 5, 7);
        for number in 0..5 {
            let mut parts: Vec<usize> = cube.iter().map(|robot| (robot[number] * 30.0) as usize).collect();
            assert!(parts.windows(2).any(|pair| pair[1] != pair[0] + 1), "each number has its own order");
            parts.sort_unstable();
            assert_eq!(parts, (0..30).collect::<Vec<_>>());
        }
        assert_eq!(cube, hypercube(30, 5, 7));
        assert_ne!(cube, hypercube(30, 5, 8));
    }

    #[test]
    fn shares_reach_both_ends_of_every_interval() {
        for number in ASSUMED {
            for (share, end) in [(0.0, number.interval[0]), (1.0, number.interval[1])] {
                assert!((number.at(share) - end).abs() <= 1e-12 * end, "{}", number.reason);
            }
        }
    }
}
