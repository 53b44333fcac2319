//! How far long work is, for a terminal.

use crate::words::printable;
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// A line with a bar and the time left; it appears on terminals only, after the first quarter of a second.
pub(crate) struct Meter {
    bar: ProgressBar,
    start: Instant,
    /// Highest share so far, in thousandths: a bar never falls back.
    highest: AtomicU64,
}

/// An estimate of the time left is worthless before \[s\].
const KNOWN_AFTER_S: f64 = 1.5;

impl Meter {
    pub(crate) fn new(is_wanted: bool) -> Meter {
        let bar = if is_wanted { ProgressBar::new(1000) } else { ProgressBar::hidden() };
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed} {bar:24} {msg}") {
            bar.set_style(style);
        }
        if is_wanted {
            bar.enable_steady_tick(Duration::from_millis(250));
        }
        Meter { bar, start: Instant::now(), highest: AtomicU64::new(0) }
    }

    /// Shows the current work, and the finished share of the whole.
    pub(crate) fn tell(&self, what: &str, share: Option<f64>) {
        let now = (1000.0 * share.unwrap_or(0.0)) as u64;
        let highest = self.highest.fetch_max(now, Ordering::Relaxed).max(now);
        let left = left_s(self.start.elapsed().as_secs_f64(), 1e-3 * highest as f64);
        let left = left.map_or(String::new(), |s| format!(", {s:.0} s left"));
        self.bar.set_message(printable(what) + &left);
        self.bar.set_position(highest);
    }

    /// Does something else with the terminal.
    pub(crate) fn apart<R>(&self, work: impl FnOnce() -> R) -> R {
        self.bar.suspend(work)
    }

    pub(crate) fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

/// The time left \[s\] after so many seconds for a share of the whole, if it can be said.
fn left_s(passed_s: f64, share: f64) -> Option<f64> {
    (passed_s > KNOWN_AFTER_S && share > 0.02).then(|| passed_s * (1.0 - share) / share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_never_falls_back_and_the_time_left_is_that_of_the_share() {
        let bar = Meter::new(false);
        let at = |share| {
            bar.tell("work", Some(share));
            bar.bar.position()
        };
        assert_eq!([0.25, 0.1, 0.5, 0.0].map(at), [250, 250, 500, 500]);
        assert_eq!([left_s(1.0, 0.5), left_s(3.0, 0.25), left_s(3.0, 0.01)], [None, Some(9.0), None]);
    }
}
