//! What became of a wanted place of the tip.

use models::{End, Steered};
use serde_json::{Value, json};

/// A tip that is nearer than this is where it is wanted \[m\].
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

/// As JSON.
pub fn nearest_json(place_m: [f64; 2], found: &Steered) -> Value {
    let held: Vec<Value> =
        held(found).map(|(channel, limit, kpa)| json!({"channel": channel, "limit": limit, "p_kpa": kpa})).collect();
    json!({"x_mm": place_m[0] * 1e3, "y_mm": place_m[1] * 1e3, "miss_mm": found.miss_m * 1e3, "held_back": held})
}

/// A warning where it is not reached.
pub fn nearest_words(place_m: [f64; 2], found: &Steered) -> Option<String> {
    let words: Vec<String> = held(found)
        .map(|(channel, limit, kpa)| format!("channel {channel} is at its {limit} pressure, {kpa} kPa"))
        .collect();
    let why = if words.is_empty() { "no pressures bring it nearer".to_string() } else { words.join("; ") };
    let [x, y] = place_m.map(|m| m * 1e3);
    (found.miss_m > MET_M).then(|| {
        format!("warning: the tip stays {:.2} mm from the wanted place {x}, {y} mm: {why}", found.miss_m * 1e3)
    })
}
