//! The text of a designed robot.

use crate::axis::channel;

/// The text with a comment at every chosen value. Other comments of the original robot stay: they name the sources of its values.
pub(super) fn commented(text: &str, chosen: &[(String, String)]) -> String {
    let key = |place: &str| place.rsplit('.').next().unwrap_or(place).to_string();
    let is_chosen = |line: &str| {
        let (name, value) = line.split_once('=').map_or(("", ""), |(name, value)| (name.trim(), value.trim()));
        let own =
            chosen.iter().any(|(place, chosen)| channel(place).is_none() && key(place) == name && value == chosen);
        own || name == "pressures_kpa" && chosen.iter().any(|(place, _)| channel(place).is_some())
    };
    let line = |line: &str| {
        let bare = line.split('#').next().unwrap_or_default().trim_end();
        if is_chosen(bare) { format!("{bare} # chosen\n") } else { format!("{line}\n") }
    };
    let head = "# Values marked `chosen` were chosen for a wish. Comments and notes about other values come from the original robot.\n";
    text.lines().map(line).fold(head.to_string(), |all, line| all + &line)
}
