//! The pressure log: whole seconds for readings in between, readings that are missing, and readings that are repeated.

use super::frozen::stands_still;
use super::seen::{Doubt, LogSeen, Seen};
use crate::policy::tolerance_act_pa;
use crate::units::kpa;

/// Share of the readings that may have the time of the one before.
const SAME_TIME: f64 = 0.3;
/// A gap is this many times longer than nine in ten distances of readings, and at least so long \[s\].
const GAP: (f64, f64) = (5.0, 1.0);
/// Part of the range at its ends in which a sensor may repeat its reading.
const END: f64 = 0.05;
/// Fewest readings of a log that is judged.
const FEWEST: usize = 20;

/// Several readings have one time, none were written while the pressure changed, or the last one was repeated.
pub(super) fn log(seen: &Seen) -> Option<Doubt> {
    let judged = seen.logs.iter().filter(|log| log.times_s.len() >= FEWEST);
    judged.into_iter().find_map(|log| coarse(log).or_else(|| gap(seen, log)).or_else(|| still(log)))
}

/// The pressure is repeated to the last digit for a while, and not elsewhere; a sensor at the end of its range repeats it too.
fn still(log: &LogSeen) -> Option<Doubt> {
    let known = || log.act_pa.iter().copied().filter(|p| p.is_finite());
    let (low, high) = (known().fold(f64::INFINITY, f64::min), known().fold(f64::NEG_INFINITY, f64::max));
    let within = |p: f64| p > low + END * (high - low) && p < high - END * (high - low);
    // The ends of the range are put where nothing repeats.
    let place = |(k, p): (usize, &f64)| if within(*p) { [*p, 0.0, 0.0] } else { [*p, k as f64 + 1.0, 0.0] };
    let places: Vec<[f64; 3]> = log.act_pa.iter().enumerate().map(place).collect();
    let Doubt { message, .. } = stands_still(&log.times_s, &[places])?;
    let still = message.replacen("all markers are", "the actuator's pressure is", 1).replacen("frames", "readings", 1);
    let help =
        "export the log again, or leave these times out: the logger repeated its last reading while the time went on";
    Some(Doubt::new(format!("{}: {still}", log.file), help))
}

fn coarse(log: &LogSeen) -> Option<Doubt> {
    let same = log.times_s.windows(2).filter(|pair| pair[0] == pair[1]).count();
    let count = log.times_s.len();
    let first = log.times_s.windows(2).position(|pair| pair[0] == pair[1])?;
    let message = format!(
        "{}: {same} of {count} readings have the time of the reading before, for example {} s: the clock is too coarse",
        log.file, log.times_s[first]
    );
    let help = "export the times with their decimals, or write a column of the number of the reading divided by the readings per second";
    (same as f64 > SAME_TIME * count as f64).then(|| Doubt::new(message, help))
}

/// Readings that are farther apart have others missing between them \[s\].
pub(crate) fn longest_step_s(times_s: &[f64]) -> f64 {
    let mut steps: Vec<f64> = times_s.windows(2).map(|pair| pair[1] - pair[0]).collect();
    steps.sort_by(f64::total_cmp);
    GAP.1.max(GAP.0 * steps.get(steps.len() * 9 / 10).copied().unwrap_or(0.0))
}

fn gap(seen: &Seen, log: &LogSeen) -> Option<Doubt> {
    let most_s = longest_step_s(&log.times_s);
    let jumps = |k: &usize| {
        let [before, after] = [log.act_pa[*k], log.act_pa[*k + 1]];
        log.times_s[*k + 1] - log.times_s[*k] > most_s && (after - before).abs() > tolerance_act_pa(before.min(after))
    };
    let k = (0..log.times_s.len() - 1).find(jumps)?;
    let [from_s, to_s] = [log.times_s[k], log.times_s[k + 1]];
    let filmed = seen.runs.is_empty() || seen.runs.iter().any(|run| run.pressures_pa[1].iter().any(|p| p.is_finite()));
    let message = format!(
        "{}: no readings from {from_s:.1} to {to_s:.1} s, and the pressure goes from {:.1} to {:.1} kPa",
        log.file,
        kpa(log.act_pa[k]),
        kpa(log.act_pa[k + 1])
    );
    let help = "export the log again with all its readings, or import the video before the gap and after it apart";
    filmed.then(|| Doubt::new(message, help))
}

#[cfg(test)]
mod tests {
    use super::super::tests::{Made, refused, right};
    use super::log;

    #[test]
    fn a_log_of_whole_seconds_and_one_with_a_gap_are_refused() {
        let whole = |made: &mut Made| made.log.iter_mut().for_each(|reading| reading[0] = reading[0].floor());
        refused(log, whole, &["log.csv", "readings have the time of the reading before", "decimals"]);
        let gap = |made: &mut Made| made.log.retain(|[t, _]| *t < 8.0 || *t > 16.0);
        refused(log, gap, &["log.csv: no readings from 8.0 to 16", "kPa"]);
        let stuck = |made: &mut Made| {
            let noise = |k: usize| (7.0 * k as f64).sin() * 20.0;
            made.log.iter_mut().enumerate().for_each(|(k, reading)| reading[1] += noise(k));
            let kept = made.log[200][1];
            made.log[200..340].iter_mut().for_each(|reading| reading[1] = kept);
        };
        refused(log, stuck, &["log.csv: the actuator's pressure is frozen", "from 10.0 to 16.9 s", "140 readings"]);
        right(log);
    }
}
