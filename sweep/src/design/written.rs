//! The text of a designed robot.

use crate::axis::channel;

/// The text with a comment of its own at every chosen value: that of the robot it began with says where another value is from.
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
    let head = "# Chosen for a wish: the values marked so. Comments and notes about other values are those of the robot it began with.\n";
    text.lines().map(line).fold(head.to_string(), |all, line| all + &line)
}
