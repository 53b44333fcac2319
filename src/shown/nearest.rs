//! What became of a target place of the tip.

use crate::prelude::*;
use models::{End, Steered};

/// A tip that is nearer than this is on target \[m\].
const MET_M: f64 = 1e-6;

/// What keeps the tip away, channel by channel.
fn held(found: &Steered) -> impl Iterator<Item = (usize, &'static str, f64)> + '_ {
    found.held.iter().enumerate().filter_map(|(channel, end)| {
        let word = match (*end)? {
            End::Least => "least",
            End::Most => "largest",
        };
        Some((channel, word, found.loads.actuator_pa[channel] / 1e3))
    })
}

/// What became of the target place of the tip.
#[derive(Serialize)]
pub struct NearestPlace {
    /// Target
    pub x_mm: f64,
    /// Target
    pub y_mm: f64,
    /// Distance of the tip from the place
    pub miss_mm: f64,
    /// Channels whose limit keeps the tip away
    pub held_back: Vec<ChannelLimit>,
}

/// A channel at a limit.
#[derive(Serialize)]
pub struct ChannelLimit {
    /// Supply channel
    pub channel: usize,
    /// `least` or `largest`
    pub limit: &'static str,
    /// Its pressure
    pub p_kpa: f64,
}

impl NearestPlace {
    /// Of a place \[m\].
    pub fn of(place_m: [f64; 2], found: &Steered) -> NearestPlace {
        let [x_mm, y_mm] = place_m.map(|m| m * 1e3);
        let held_back = held(found).map(|(channel, limit, p_kpa)| ChannelLimit { channel, limit, p_kpa }).collect();
        NearestPlace { x_mm, y_mm, miss_mm: found.miss_m * 1e3, held_back }
    }
}

/// A warning where it is not reached.
pub(crate) fn nearest_words(place_m: [f64; 2], found: &Steered) -> Option<String> {
    let words: Vec<String> = held(found)
        .map(|(channel, limit, kpa)| format!("channel {channel} is at its {limit} pressure, {kpa} kPa"))
        .collect();
    let why = if words.is_empty() { "no pressures bring it nearer".to_string() } else { words.join("; ") };
    let [x, y] = place_m.map(|m| m * 1e3);
    (found.miss_m > MET_M).then(|| {
        format!("warning: the tip stays {:.2} mm from the wanted place {x}, {y} mm: {why}", found.miss_m * 1e3)
    })
}
