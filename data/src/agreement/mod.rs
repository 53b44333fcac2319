//! Whether a recording agrees with itself, before it becomes a dataset and when a table is checked.
//!
//! Every check is one file and one line of [`CHECKS`], with its smallest input as a test. A check is a statement on geometry, times or pressures
//! that holds for every robot that bends from a fixed base; none asks a model.

mod background;
mod base;
mod body;
mod copies;
mod exchanged;
mod frozen;
mod jump;
mod knock;
mod log;
mod mirrored;
mod rest;
mod seen;
mod stations;
mod stuck;
mod swapped;
#[cfg(test)]
mod tests;
mod unsteady;
mod zoom;

pub(crate) use background::still_inside;
pub(crate) use frozen::stands_still;
pub(crate) use log::longest_step_s;
pub(crate) use seen::{Doubt, LogSeen, Seen};

/// A check: the first contradiction that it finds.
type AgreementCheck = fn(&Seen) -> Option<Doubt>;

/// All checks; earlier ones explain what later ones would find.
const CHECKS: [AgreementCheck; 16] = [
    log::log,
    exchanged::exchanged,
    base::base,
    copies::copies,
    frozen::frozen,
    swapped::swapped,
    mirrored::mirrored,
    background::background,
    stuck::stuck,
    unsteady::unsteady,
    zoom::zoom,
    knock::knock,
    jump::jump,
    rest::rest,
    stations::stations,
    body::body,
];

/// What contradicts itself, in the order of [`CHECKS`]; the size alone where no robot has it, as every place depends on it.
pub(crate) fn doubts(seen: &Seen) -> Vec<Doubt> {
    let whole = !seen.runs.is_empty() && seen.runs.iter().all(|run| !run.times_s.is_empty());
    match base::size(seen).filter(|_| whole) {
        Some(doubt) => vec![doubt],
        None => CHECKS.iter().filter(|_| whole).filter_map(|check| check(seen)).collect(),
    }
}
