//! Plain-language pieces: lists, pressures, markers, signed lengths.

use crate::fit::numbers::groups;
use crate::residuals::{Deviation, HoldLabel, ResidualMap};
use crate::stats::SMALLEST_P;

/// `a`, `a and b`, `a, b and c`.
pub fn list(words: impl IntoIterator<Item: ToString>) -> String {
    let mut words: Vec<String> = words.into_iter().map(|word| word.to_string()).collect();
    match (words.pop(), words.is_empty()) {
        (None, _) => String::new(),
        (Some(one), true) => one,
        (Some(last), false) => format!("{} and {last}", words.join(", ")),
    }
}

/// The first letter in upper case.
pub fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

pub(crate) fn uncapitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

/// A number with at most one decimal: `20`, `12.5`.
pub fn short(value: f64) -> String {
    let text = format!("{value:.1}");
    let text = text.strip_suffix(".0").map_or(text.clone(), str::to_string);
    if text == "-0" { "0".to_string() } else { text }
}

/// A number with three significant digits, without needless zeros.
pub fn value(v: f64) -> String {
    if v == 0.0 || !v.is_finite() {
        return "0".into();
    }
    let size = v.abs();
    if !(1e-3..1e5).contains(&size) {
        return format!("{v:.2e}");
    }
    let digits = (2 - size.log10().floor() as i32).max(0) as usize;
    let text = format!("{v:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

/// The pressures of some holds: `10, 20 and 30 kPa`; body pressures are named if the data have several.
pub fn pressures(map: &ResidualMap, holds: &[usize]) -> String {
    let body = &map.holds[0].p_body_kpa;
    let several = map.holds.iter().any(|h| (h.p_body_kpa - body).abs() > 0.03 * body.abs().max(0.1));
    let same_body = |a: usize, b: usize| map.holds[a].p_body_kpa == map.holds[b].p_body_kpa;
    let own = |group: Vec<usize>| group.into_iter().map(|i| holds[i]).collect::<Vec<usize>>();
    let groups = groups(holds, |a, b| same_body(**a, **b)).into_iter().map(own);
    list(groups.map(|group| group_words(map, &group, several)))
}

/// The actuator pressures of holds at one body pressure: `10, 20 and 30 kPa at 2 kPa body pressure`.
fn group_words(map: &ResidualMap, group: &[usize], several_bodies: bool) -> String {
    let mut words: Vec<String> = Vec::new();
    for &h in group {
        let word = hold_word(&map.holds[h]);
        if !words.contains(&word) {
            words.push(word);
        }
    }
    let body = short(map.holds[group[0]].p_body_kpa);
    let at = if several_bodies { format!(" at {body} kPa body pressure") } else { String::new() };
    format!("{} kPa{at}", list(&words))
}

/// `outermost marker +38.2 mm at 30 kPa, 41 times the noise`; the pressure is left out if `holds` names only that one.
pub fn evidence(map: &ResidualMap, (hold, marker): (usize, usize), holds: &[usize], deviation: &Deviation) -> String {
    let place =
        if marker == map.tip { "outermost marker".to_string() } else { format!("marker {}", map.markers[marker]) };
    let at = if holds.len() > 1 { format!(" at {}", pressures(map, &[hold])) } else { String::new() };
    format!("{place} {}{at}{}", signed_mm(deviation.mm), times_the_noise(deviation))
}

/// `+38.2 mm`, with a second decimal below 1 mm.
pub fn signed_mm(mm: f64) -> String {
    if mm.abs() < 0.995 { format!("{mm:+.2} mm") } else { format!("{mm:+.1} mm") }
}

/// `, 41 times the noise`, or nothing if the noise is unknown.
pub fn times_the_noise(deviation: &Deviation) -> String {
    match deviation.in_noise.map(f64::abs) {
        None => String::new(),
        Some(z) if z < 9.95 => format!(", {z:.1} times the noise"),
        Some(z) => format!(", {z:.0} times the noise"),
    }
}

/// `p = 0.004`, or `p < 1e-6` at the smallest value reported.
pub fn p_value(p: f64) -> String {
    match p {
        p if p <= SMALLEST_P => "p < 1e-6".to_string(),
        p if p < 1e-3 => format!("p = {p:.0e}"),
        p => format!("p = {p:.3}"),
    }
}

/// Which markers, in words: `, on every marker`, `, from marker P3 to the tip`, `, only at marker P4`, …
pub fn markers(map: &ResidualMap, chosen: &[usize]) -> String {
    let names: Vec<&String> = chosen.iter().map(|m| &map.markers[*m]).collect();
    let all = map.markers.len();
    let to_tip = chosen.first().is_some_and(|&first| chosen.len() == all - first && chosen.len() > 1);
    match chosen {
        [] => String::new(),
        _ if all == 1 => String::new(),
        _ if chosen.len() == all => ", on every marker".to_string(),
        [_] => format!(", only at marker {}", names[0]),
        _ if to_tip => format!(", from marker {} to the tip", names[0]),
        _ => format!(", at markers {}", list(&names)),
    }
}

/// Pressures of the supply channels in kPa: `20`, or `20/10`.
pub fn channels_word(hold: &HoldLabel) -> String {
    match hold.p_act_channels_kpa.as_slice() {
        [] => short(hold.p_act_kpa),
        channels => channels.iter().map(|kpa| short(*kpa)).collect::<Vec<_>>().join("/"),
    }
}

fn hold_word(hold: &HoldLabel) -> String {
    let again = if hold.occurrence > 0 { format!(" (time {})", hold.occurrence + 1) } else { String::new() };
    format!("{}{again}", channels_word(hold))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_three_digits() {
        let shown = [0.0, 0.4463, 12.0, 123.4, 8.1e-5, 0.5, -1.2345].map(value);
        assert_eq!(shown, ["0", "0.446", "12", "123", "8.10e-5", "0.5", "-1.23"]);
    }

    #[test]
    fn lists_and_numbers_read_naturally() {
        let words = ["10", "20", "30"].map(str::to_string);
        assert_eq!(list(&words), "10, 20 and 30");
        assert_eq!(list(&words[..1]), "10");
        assert_eq!([short(20.0), short(12.5), short(-0.01)], ["20", "12.5", "0"]);
        assert_eq!([p_value(1e-6), p_value(2e-4), p_value(0.0042)], ["p < 1e-6", "p = 2e-4", "p = 0.004"]);
        assert_eq!([signed_mm(38.24), signed_mm(-0.4)], ["+38.2 mm", "-0.40 mm"]);
    }
}
