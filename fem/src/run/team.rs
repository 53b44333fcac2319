//! Threads that help only while they help.
//!
//! Results do not depend on the number of threads, so it may change at any time. On a machine that is busy with other
//! work a second thread is often not running when its share is due, and everybody waits for it; so stretches of steps
//! are timed with one thread and with all, and the faster is used. Within a stretch no thread sleeps.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Instant;

use crate::cost::{self, thread_seconds};
use crate::{FemError, Result};

/// Stretches after a change until the way that is not in use is tried again, since one bad stretch may have misled; twice as
/// many each time it stays the slower one.
const TRY_SOON: u64 = 2;
/// The most of them; at worst a try costs 1/24 of its disadvantage.
const TRY_AGAIN: u64 = 24;
/// Weight of the newest time in the running mean.
const NEWEST: f64 = 0.3;

pub(super) struct Team {
    one: rayon::ThreadPool,
    all: Option<rayon::ThreadPool>,
    ways: Ways,
    /// Processor seconds of all threads since they were taken.
    cpu_s: f64,
}

/// Timings of the two ways to run a stretch: 0 with one thread, 1 with all.
struct Ways {
    /// Running mean of the seconds per step; 0 before the first try.
    seconds: [f64; 2],
    /// Stretches since both ways were tried, and after how many to do so again.
    since: u64,
    patience: u64,
}

impl Ways {
    const NEW: Ways = Ways { seconds: [0.0; 2], since: 0, patience: TRY_SOON };

    /// The way for the next stretch.
    fn next(&self) -> usize {
        let untried = self.seconds.iter().position(|s| *s == 0.0);
        untried.unwrap_or(if self.since >= self.patience { 1 - self.better() } else { self.better() })
    }

    fn better(&self) -> usize {
        usize::from(self.seconds[1] <= self.seconds[0])
    }

    /// A stretch took so many seconds per step.
    fn took(&mut self, way: usize, seconds: f64) {
        let better = self.better();
        let mean = &mut self.seconds[way];
        *mean = if *mean == 0.0 { seconds } else { (1.0 - NEWEST) * *mean + NEWEST * seconds };
        if self.better() != better {
            (self.since, self.patience) = (0, TRY_SOON);
        } else if way != better {
            (self.since, self.patience) = (0, TRY_AGAIN.min(2 * self.patience));
        } else {
            self.since += 1;
        }
    }
}

impl Team {
    /// A team of `threads`; 0 for as many as the machine has.
    ///
    /// # Errors
    /// [`FemError::Problem`] when the system gives no threads.
    pub(super) fn new(threads: usize) -> Result<Team> {
        let threads = cost::threads(threads);
        let pool = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.map_err(|e| FemError::Problem(format!("cannot start {threads} threads: {e}")))
        };
        let all = (threads > 1).then(|| pool(threads)).transpose()?;
        Ok(Team { one: pool(1)?, all, ways: Ways::NEW, cpu_s: 0.0 })
    }

    /// Processor seconds of all threads since this was last asked.
    pub(crate) fn take_cpu_s(&mut self) -> f64 {
        std::mem::take(&mut self.cpu_s)
    }

    /// Runs a stretch of `work`, which returns the number of steps it did and what else there is to say.
    pub(super) fn run<T: Send>(&mut self, work: impl FnOnce() -> (u64, T) + Send) -> T {
        let Some(all) = &self.all else {
            return self.alone(work).1;
        };
        let way = self.ways.next();
        let start = Instant::now();
        let (steps, said) = if way == 1 {
            let spent = || all.broadcast(|_| thread_seconds()).iter().sum::<f64>();
            let before = spent();
            let done = all.install(|| awake(work));
            self.cpu_s += spent() - before;
            done
        } else {
            self.alone(work)
        };
        self.ways.took(way, start.elapsed().as_secs_f64() / steps.max(1) as f64);
        said
    }

    fn alone<T: Send>(&mut self, work: impl FnOnce() -> (u64, T) + Send) -> (u64, T) {
        let (done, spent_s) = self.one.install(|| {
            let before = thread_seconds();
            (work(), thread_seconds() - before)
        });
        self.cpu_s += spent_s;
        done
    }
}

/// Runs `work` while the other threads of the pool look for their shares of it instead of falling asleep: a step is about as
/// short as waking one. They let other programs go first.
fn awake<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    /// Marks the work as over, also when it panics.
    struct Over<'a>(&'a AtomicBool);
    impl Drop for Over<'_> {
        fn drop(&mut self) {
            self.0.store(true, Ordering::Release);
        }
    }
    let over = AtomicBool::new(false);
    let ready = AtomicUsize::new(1);
    let me = rayon::current_thread_index();
    rayon::scope(|scope| {
        scope.spawn_broadcast(|_, thread| {
            // The thread that works must not wait for itself.
            if Some(thread.index()) == me {
                return;
            }
            ready.fetch_add(1, Ordering::AcqRel);
            while !over.load(Ordering::Acquire) {
                if rayon::yield_now() != Some(rayon::Yield::Executed) {
                    std::thread::yield_now();
                }
            }
        });
        let _over = Over(&over);
        // A thread that took a share first would begin to look for others in the middle of it, and never end it.
        while ready.load(Ordering::Acquire) < rayon::current_num_threads() {
            std::thread::yield_now();
        }
        work()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many of `count` stretches use all threads, where one takes 4 ms and all take 20 if `slow` is true of their number, else 1.
    fn with_all(count: usize, slow: impl Fn(usize) -> bool) -> usize {
        let mut ways = Ways::NEW;
        let mut with_all = 0;
        for i in 0..count {
            let way = ways.next();
            with_all += way;
            ways.took(
                way,
                if way == 0 {
                    4e-3
                } else if slow(i) {
                    20e-3
                } else {
                    1e-3
                },
            );
        }
        with_all
    }

    #[test]
    fn a_way_that_is_slower_is_tried_now_and_then_only() {
        assert!((2..=8).contains(&with_all(96, |_| true)), "{}", with_all(96, |_| true));
    }

    #[test]
    fn a_bad_stretch_does_not_put_a_way_off_for_long() {
        let lost = with_all(64, |_| false) - with_all(64, |i| (20..23).contains(&i));
        assert!((1..=10).contains(&lost), "{lost}");
    }

    fn shares(depth: usize) -> usize {
        if depth == 0 {
            return 1;
        }
        let (a, b) = rayon::join(|| shares(depth - 1), || shares(depth - 1));
        a + b
    }

    #[test]
    fn shares_of_shares_come_to_an_end() {
        let all = Team::new(2).unwrap().all.unwrap();
        for _ in 0..5000 {
            // Threads that have just worked look around before they sleep.
            all.broadcast(|_| thread_seconds());
            assert_eq!(all.install(|| awake(|| shares(4))), 16);
        }
    }

    #[test]
    fn a_panic_in_a_stretch_comes_out_of_it() {
        let all = Team::new(2).unwrap().all.unwrap();
        let run = || all.install(|| awake(|| panic!("on purpose")));
        assert!(std::panic::catch_unwind(std::panic::AssertUnwindSafe(run)).is_err());
    }
}
