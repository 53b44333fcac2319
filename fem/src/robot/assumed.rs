//! What nobody measured about the published robots, and the numerical settings that their tips feel: numbers with intervals, and a
//! hypercube over all of them.
//!
//! A Latin hypercube of n robots cuts the interval of every number into n parts of equal probability and gives every robot one part of
//! each, in an order that is drawn for every number anew; within its part a number is drawn, too. So n robots say about each number what n
//! values say, whatever the others do. Reference: McKay, Beckman, Conover 1979.

use super::RobotSettings;
use crate::random::Draws;

/// A number that nobody printed, and the interval it may lie in.
#[derive(Debug, Clone, Copy)]
pub struct Assumed {
    /// Smallest and largest plausible value, SI.
    pub interval: [f64; 2],
    /// How values are spread over it.
    pub spread: Spread,
    /// Where the interval comes from.
    pub reason: &'static str,
    /// Writes a value.
    pub set: fn(&mut RobotSettings, f64),
}

/// How values are spread over an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spread {
    /// Every difference alike.
    Even,
    /// Every factor alike, where the ends differ by a factor of five and more.
    Factor,
}

impl Assumed {
    /// The value at a share 0 to 1 of the interval.
    pub fn at(&self, share: f64) -> f64 {
        let [low, high] = self.interval;
        match self.spread {
            Spread::Even => low + share * (high - low),
            Spread::Factor => low * (high / low).powf(share),
        }
    }
}

/// What the four robots leave open, besides pouch count and marker stations, which are in the scenario.
pub const ASSUMED: &[Assumed] = &[
    Assumed {
        interval: [0.0, 0.008],
        spread: Spread::Even,
        reason: "a line to a wide impulse seal; ultrasonic wheels are a few millimetres wide",
        set: |s, v| s.weld_m = v,
    },
    Assumed {
        interval: [0.1, 0.5],
        spread: Spread::Factor,
        reason: "droop of a heat-bondable coated nylon, measured by Farrell et al.",
        set: |s, v| s.bending_factor = v,
    },
    Assumed {
        interval: [0.5, 1.0],
        spread: Spread::Even,
        reason: "wrinkles from the strip's edge to the taut line, or half as far; their load follows from it, bending and hoop tension",
        set: |s, v| s.wrinkle_length = Some(v),
    },
    Assumed {
        interval: [0.0, 1.0],
        spread: Spread::Even,
        reason: "plies that slide to plies without slip; shear lag through 0.05 mm of adhesive is about 2 mm",
        set: |s, v| s.bond = v,
    },
    Assumed {
        interval: [2e-5, 2.5e-4],
        spread: Spread::Factor,
        reason: "adhesive transfer tapes are sold from 0.02 to 0.25 mm",
        set: |s, v| s.tape_m = v,
    },
    Assumed {
        interval: [0.0, 0.015],
        spread: Spread::Even,
        reason: "a sheet cut at its welds to one that is easy to tape",
        set: |s, v| s.tape_margin_m = v,
    },
    Assumed {
        interval: [0.0, 2e-4],
        spread: Spread::Even,
        reason: "a perfect pattern to a thickness of the fabric",
        set: |s, v| s.waviness_m = v,
    },
    Assumed {
        interval: [5e-5, 5e-4],
        spread: Spread::Factor,
        reason: "a film spread by hand",
        set: |s, v| s.glue_m = v,
    },
    Assumed { interval: [3e5, 3e6], spread: Spread::Factor, reason: "silicone adhesives", set: |s, v| s.glue_e_pa = v },
    Assumed {
        interval: [0.0, 0.4],
        spread: Spread::Even,
        reason: "woven fabrics pulled in one direction; 0 is yarns that do not cross",
        set: |s, v| s.nu12 = Some(v),
    },
    Assumed {
        interval: [700.0, 1300.0],
        spread: Spread::Even,
        reason: "nylon 1140, coats 900 to 1200, air between yarns",
        set: |s, v| s.density_kg_m3 = v,
    },
    // Numerical settings that move a tip by more than 1 % when they are a third or three times as large (`ibr simulate epam --numerics`).
    Assumed {
        interval: [7e-4 / 3.0, 3.0 * 7e-4],
        spread: Spread::Factor,
        reason: "numerical: a third to three times the default",
        set: |s, v| s.hourglass = v,
    },
    Assumed {
        interval: [1e-5 / 3.0, 3e-5],
        spread: Spread::Factor,
        reason: "numerical: a third to three times the published distance of layers",
        set: |s, v| s.layer_gap_m = v,
    },
    Assumed {
        interval: [25.0, 230.0],
        spread: Spread::Factor,
        reason: "numerical: a third to three times the default of the ePAM",
        set: |s, v| s.mass_damping_1_s = Some(v),
    },
];

/// Shares 0 to 1 of the interval of each of `numbers` numbers for `robots` robots; the same seed gives the same hypercube everywhere.
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
            assert!(parts.windows(2).any(|pair| pair[1] != pair[0] + 1), "in an order of its own");
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
