//! When a robot is at rest at the end of a hold: its tip moves no more, swings no more, and would not come much further.
//!
//! The tip is read at the ends of windows of equal length. With its movement Δ₁ and Δ₂ in the last two, r = |Δ₂|/|Δ₁|,
//!
//! ```text
//! ahead = |Δ₂| r/(1 − r)                                a decay of rate r goes on (Aitken); |Δ₂| where it swings back
//! at rest: ahead ≤ a, and the tip was within a of where it is at the ends of the last four windows     a = creep · max(|u|, L/10)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | u | displacement of the tip from the start | m |
//! | L | length of the robot | m |
//! | ω | estimate of the tip's lowest frequency: a quarter of the fabric's mass m at the end of a taut body, ω² = 4 p_b πR²/(m L) | 1/s |
//!
//! A window lasts 0.64/ω, so that four of them are more than half a swing: at its turning point a tip is slow and not at rest.
//! The kinetic share cannot replace this: an overdamped robot creeps with next to no kinetic energy. **Validity**: ω decides how long a hold lasts,
//! and the damping. A third of it and three times as much move the ePAM by up to 1.5 and the cPAM by up to 2.2 % (`docs/robots.md`). The frequency of the ePAM at 5 and 10 kPa is 1.4 ω.

use serde::{Deserialize, Serialize};

use crate::problem::Patience;
use crate::vec3::{V3, dot, norm, sub};

/// Length of a window times ω.
pub(super) const WINDOW: f64 = 0.64;
/// Windows at whose ends the tip is where it is now.
const STILL: usize = 4;

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Settling {
    /// Waited time of the run at its beginning \[s\].
    from_s: f64,
    window_s: f64,
    /// Displacements at the ends of the windows \[m\].
    tip_m: Vec<[f64; 3]>,
}

/// Next window of a hold, or its end and the tip's state there.
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
        /// True if the tip came to rest before the hold's time was over.
        is_at_rest: bool,
    },
}

impl Settling {
    /// Waited time of the run at the end of the present window \[s\]; `None` between holds.
    pub(crate) fn next_s(&self) -> Option<f64> {
        (!self.tip_m.is_empty()).then_some(self.from_s + self.tip_m.len() as f64 * self.window_s)
    }

    /// Judges the tip's displacement \[m\], of which so much may be ahead \[m\], after so much waiting of the run \[s\].
    pub(crate) fn look(&mut self, tip_m: V3, allowed_m: f64, waited_s: f64, patience: Patience) -> Rest {
        if self.tip_m.is_empty() {
            (self.from_s, self.window_s) = (waited_s, patience.window_s);
        }
        self.tip_m.push(tip_m);
        let (own_s, ahead_m) = (waited_s - self.from_s, self.ahead_m());
        let before = self.tip_m.iter().rev().skip(1).take(STILL);
        let is_still = self.tip_m.len() > STILL && before.into_iter().all(|then| norm(sub(*then, tip_m)) <= allowed_m);
        let is_at_rest = is_still && ahead_m <= allowed_m;
        if is_at_rest || own_s + self.window_s > patience.longest_s * (1.0 + 1e-9) {
            self.tip_m.clear();
        }
        self.next_s().map_or(Rest::Over { waited_s: own_s, ahead_m, is_at_rest }, Rest::Until)
    }

    /// How far the tip still goes; infinite without two windows.
    fn ahead_m(&self) -> f64 {
        let [.., a, b, c] = self.tip_m[..] else { return f64::INFINITY };
        let (before, now) = (sub(b, a), sub(c, b));
        let (one, two) = (norm(before), norm(now));
        match two / one {
            _ if two == 0.0 => 0.0,
            _ if dot(before, now) <= 0.0 => two,
            rate if rate < 1.0 => two * (rate / (1.0 - rate)).max(1.0),
            _ => f64::INFINITY,
        }
    }
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
            let patience = Patience { creep: CREEP, longest_s, window_s: 0.01 };
            match settling.look([0.0, tip_m, 0.0], moves_no_more_m(CREEP, tip_m, 0.36), time_s, patience) {
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

    /// A swing of 90 rad/s about 90 mm that dies out, of which the hold sees any part first.
    #[test]
    fn a_swing_is_waited_for_until_it_stays_within_what_is_allowed_wherever_the_hold_begins() {
        for begins in 0..24 {
            let swings = |t: f64| 0.09 + 0.005 * (-20.0 * t).exp() * (90.0 * t + f64::from(begins) * 0.262).sin();
            let (waited_s, _, is_at_rest) = waited(swings, 2.0);
            let off_m = (0..80).map(|k| (swings(waited_s + 1e-3 * f64::from(k)) - 0.09).abs()).fold(0.0, f64::max);
            assert!(is_at_rest && off_m <= 1.05 * moves_no_more_m(CREEP, 0.09, 0.36), "{begins}: {off_m} {waited_s}");
        }
    }
}
