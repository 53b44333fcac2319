//! When a robot is at rest at the end of a hold: its tip moves no more, and would not come much further.
//!
//! The tip is read at the ends of windows of equal length. With its movement Δ₁ and Δ₂ in the last two, r = |Δ₂|/|Δ₁|,
//!
//! ```text
//! ahead = |Δ₂| r/(1 − r)                                a decay of rate r goes on (Aitken); |Δ₂| where it swings back
//! at rest: |Δ₂| and ahead ≤ creep · max(|u|, L/10)      in two windows one after the other
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | u | displacement of the tip from the start | m |
//! | L | length of the robot | m |
//!
//! The kinetic share cannot replace this: an overdamped robot creeps with next to no kinetic energy.

use serde::{Deserialize, Serialize};

/// Length of a window \[s\].
const WINDOW_S: f64 = 0.01;

/// The tip during a hold.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Settling {
    /// Waited time of the run at its beginning \[s\].
    from_s: f64,
    /// Displacements at the ends of the windows \[m\].
    tip_m: Vec<[f64; 3]>,
}

/// What a hold waits for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rest {
    /// The next window ends at this waited time of the run \[s\].
    Until(f64),
    /// Nothing: the robot is at rest, or its time is over.
    Over {
        /// Time waited in this hold \[s\].
        waited_s: f64,
        /// How far the tip still goes, by its last movements \[m\].
        ahead_m: f64,
        /// Whether it is at rest.
        is_at_rest: bool,
    },
}

impl Settling {
    /// Waited time of the run at the end of the present window \[s\]; `None` between holds.
    pub fn next_s(&self) -> Option<f64> {
        (!self.tip_m.is_empty()).then_some(self.from_s + self.tip_m.len() as f64 * WINDOW_S)
    }

    /// Judges the tip's displacement \[m\], of which so much may be ahead \[m\], after so much waiting of the run \[s\], of which a hold
    /// may take `longest_s`.
    pub fn look(&mut self, tip_m: [f64; 3], allowed_m: f64, waited_s: f64, longest_s: f64) -> Rest {
        if self.tip_m.is_empty() {
            self.from_s = waited_s;
        }
        self.tip_m.push(tip_m);
        let own_s = waited_s - self.from_s;
        let ahead = |last: usize| self.ahead_m(last);
        let now_m = ahead(self.tip_m.len() - 1);
        let is_at_rest = now_m <= allowed_m && ahead(self.tip_m.len().saturating_sub(2)) <= allowed_m;
        if is_at_rest || own_s + WINDOW_S > longest_s * (1.0 + 1e-9) {
            self.tip_m.clear();
        }
        self.next_s().map_or(Rest::Over { waited_s: own_s, ahead_m: now_m, is_at_rest }, Rest::Until)
    }

    /// How far the tip goes after window `last`; infinite without two windows before.
    fn ahead_m(&self, last: usize) -> f64 {
        let Some([a, b, c]) = last.checked_sub(2).map(|first| [0, 1, 2].map(|k| self.tip_m[first + k])) else {
            return f64::INFINITY;
        };
        let (before, now) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - b[k]));
        let (one, two) = (norm(before), norm(now));
        let swings = (0..3).map(|k| before[k] * now[k]).sum::<f64>() <= 0.0;
        match two / one {
            _ if two == 0.0 => 0.0,
            _ if swings => two,
            rate if rate < 1.0 => two * (rate / (1.0 - rate)).max(1.0),
            _ => f64::INFINITY,
        }
    }
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::policy::{CREEP, moves_no_more_m};

    /// Waits for a tip with this motion; returns the time waited, the estimate of the remaining way and whether it rests.
    fn waited(tip: impl Fn(f64) -> f64, longest_s: f64) -> (f64, f64, bool) {
        let (mut settling, mut time_s) = (Settling::default(), 1.0);
        loop {
            let tip_m = tip(time_s - 1.0);
            match settling.look([0.0, tip_m, 0.0], moves_no_more_m(CREEP, tip_m, 0.36), time_s, longest_s) {
                Rest::Until(next_s) => time_s = next_s,
                Rest::Over { waited_s, ahead_m, is_at_rest } => return (waited_s, ahead_m, is_at_rest),
            }
        }
    }

    #[test]
    fn a_decay_is_waited_for_until_less_is_ahead_than_allowed_and_the_rest_is_foretold() {
        for rate_1_s in [20.0, 60.0] {
            let creeps = |t: f64| 0.04 - 0.01 * (-rate_1_s * t).exp();
            let (waited_s, ahead_m, is_at_rest) = waited(creeps, 2.0);
            let left_m = 0.01 * (-rate_1_s * waited_s).exp();
            assert!(is_at_rest && left_m <= 1.001 * moves_no_more_m(CREEP, 0.04, 0.36), "{rate_1_s}: {left_m}");
            assert!(ahead_m >= 0.999 * left_m, "{ahead_m} {left_m}");
        }
    }

    #[test]
    fn a_tip_that_swings_or_goes_on_is_not_at_rest_however_slow_it_is_at_its_turn() {
        assert!(!waited(|t| 0.04 + 0.002 * (150.0 * t).sin(), 0.5).2);
        let (waited_s, ahead_m, is_at_rest) = waited(|t| 0.02 * t, 0.1);
        assert!(!is_at_rest && ahead_m > 1.0 && (0.089..=0.1001).contains(&waited_s), "{waited_s}");
        assert_eq!(waited(|_| 0.04, 0.0), (0.0, f64::INFINITY, false), "no time to look");
        let (waited_s, ahead_m, is_at_rest) = waited(|_| 0.04, 1.0);
        assert!(is_at_rest && ahead_m == 0.0 && waited_s < 0.05);
    }
}
