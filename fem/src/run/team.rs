//! Threads that help only while they help.
//!
//! Results do not depend on the number of threads, so it may change at any time. On a machine that is busy with other
//! work a second thread is often not running when its share is due, and everybody waits for it; so stretches of steps
//! are timed with one thread and with all, and the faster is used. Nobody spins while waiting.

use std::time::Instant;

use crate::FemError;

/// Every so many stretches the way that is not in use is tried again; at worst it costs 1/24 of its disadvantage.
const TRY_AGAIN: u64 = 24;
/// Weight of the newest time in the running mean.
const NEWEST: f64 = 0.3;

/// One thread, or all.
pub struct Team {
    one: rayon::ThreadPool,
    all: Option<rayon::ThreadPool>,
    /// Seconds per step with one thread and with all; 0 before the first try.
    seconds: [f64; 2],
    stretches: u64,
    /// Processor seconds of all threads since they were taken.
    cpu_s: f64,
}

impl Team {
    /// A team of `threads`; 0 for as many as the machine has.
    ///
    /// # Errors
    /// [`FemError::Problem`] when the system gives no threads.
    pub fn new(threads: usize) -> Result<Team, FemError> {
        let threads = if threads == 0 { std::thread::available_parallelism().map_or(1, usize::from) } else { threads };
        let pool = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.map_err(|e| FemError::Problem(format!("cannot start {threads} threads: {e}")))
        };
        let all = if threads > 1 { Some(pool(threads)?) } else { None };
        Ok(Team { one: pool(1)?, all, seconds: [0.0; 2], stretches: 0, cpu_s: 0.0 })
    }

    /// Processor seconds of all threads since this was last asked.
    pub fn take_cpu_s(&mut self) -> f64 {
        std::mem::take(&mut self.cpu_s)
    }

    /// Runs a stretch of `work`, which returns the number of steps it did and what else there is to say.
    pub fn run<T: Send>(&mut self, work: impl FnOnce() -> (u64, T) + Send) -> T {
        let Some(all) = &self.all else {
            return self.alone(work).1;
        };
        let better = usize::from(self.seconds[1] <= self.seconds[0]);
        let untried = self.seconds.iter().position(|s| *s == 0.0);
        let turn = self.stretches % TRY_AGAIN == TRY_AGAIN - 1;
        let way = untried.unwrap_or(if turn { 1 - better } else { better });
        let start = Instant::now();
        let (steps, said) = if way == 1 {
            let spent = || all.broadcast(|_| thread_seconds()).iter().sum::<f64>();
            let before = spent();
            let done = all.install(work);
            self.cpu_s += spent() - before;
            done
        } else {
            self.alone(work)
        };
        let taken = start.elapsed().as_secs_f64() / steps.max(1) as f64;
        let mean = &mut self.seconds[way];
        *mean = if *mean == 0.0 { taken } else { (1.0 - NEWEST) * *mean + NEWEST * taken };
        self.stretches += 1;
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

/// Processor seconds of the calling thread; 0 where the system does not say.
fn thread_seconds() -> f64 {
    cpu_time::ThreadTime::try_now().map_or(0.0, |t| t.as_duration().as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_that_is_slower_is_tried_now_and_then_only() {
        let mut team = Team::new(2).unwrap();
        let mut slow = 0;
        for _ in 0..96 {
            let with_all = std::sync::atomic::AtomicBool::new(false);
            team.run(|| {
                if rayon::current_num_threads() == 2 {
                    with_all.store(true, std::sync::atomic::Ordering::Relaxed);
                    std::thread::sleep(std::time::Duration::from_millis(20));
                }
                (1, ())
            });
            slow += u64::from(with_all.into_inner());
        }
        assert!((1..=6).contains(&slow), "{slow}");
    }
}
