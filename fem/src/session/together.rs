//! Several long jobs in parallel, with one line of progress.

use super::Progress;
use crate::{FemError, Result};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Where the jobs are, and who wants to know.
struct JobProgress<'a> {
    progress: Progress<'a>,
    /// Of the jobs that run: text and share.
    running: BTreeMap<usize, (String, Option<f64>)>,
    complete: usize,
}

impl JobProgress<'_> {
    fn report(&mut self, index: usize, text: &str, share: Option<f64>, count: usize) -> ControlFlow<()> {
        self.running.insert(index, (text.to_owned(), share));
        let shares: f64 = self.running.values().filter_map(|job| job.1).sum();
        let texts: Vec<&str> = self.running.values().map(|job| job.0.as_str()).collect();
        (self.progress)(&texts.join(" | "), Some((self.complete as f64 + shares) / count as f64))
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Does jobs `0..count` in this order, `workers` at a time, and returns what they gave by number. After an error, or once
/// `progress` asks to end, nothing new is begun.
///
/// # Errors
/// The error of the first job in their order that failed; jobs that run at the same time are finished before. Of jobs that were
/// interrupted [`FemError::Interrupted`] with the number that are complete.
pub(super) fn together<T: Send>(
    count: usize,
    workers: usize,
    progress: Progress,
    job: &(impl Fn(usize, Progress) -> Result<T> + Sync),
) -> Result<Vec<T>> {
    let (next, stop) = (AtomicUsize::new(0), AtomicBool::new(false));
    let standing = Mutex::new(JobProgress { progress, running: BTreeMap::new(), complete: 0 });
    let found = Mutex::new(BTreeMap::new());
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::SeqCst);
            if index >= count || stop.load(Ordering::SeqCst) {
                return;
            }
            let ended = job(index, &mut |text, share| {
                stop.fetch_or(lock(&standing).report(index, text, share, count).is_break(), Ordering::SeqCst);
                if stop.load(Ordering::SeqCst) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            if ended.is_err() {
                next.store(count, Ordering::SeqCst);
            }
            let mut standing = lock(&standing);
            standing.running.remove(&index);
            standing.complete += usize::from(ended.is_ok());
            lock(&found).insert(index, ended);
        }
    };
    std::thread::scope(|scope| (0..workers.clamp(1, count.max(1))).for_each(|_| drop(scope.spawn(work))));
    let mut all = Vec::with_capacity(count);
    for ended in found.into_inner().unwrap_or_else(PoisonError::into_inner).into_values() {
        match ended {
            Ok(found) => all.push(found),
            // An interrupt is not a fault of the job that it met first.
            Err(FemError::Interrupted { .. }) => {}
            Err(fault) => return Err(fault),
        }
    }
    let done = all.len();
    if done == count { Ok(all) } else { Err(FemError::interrupted(done, count)) }
}

/// Jobs at a time, and threads of each, for so many threads (0: one per core). Two runs on a core each are done sooner
/// than one after the other on both: a step is too short to be shared without loss.
pub(super) fn shared(threads: usize, jobs: usize) -> (usize, usize) {
    let threads = crate::cost::threads(threads);
    let workers = threads.min(jobs).max(1);
    (workers, threads / workers)
}

#[cfg(test)]
mod tests {
    use super::*;

    type Found = Result<Vec<usize>, FemError>;

    fn interrupted() -> FemError {
        FemError::interrupted(0, 1)
    }

    /// The result, and the reported shares of progress.
    fn tried(
        count: usize,
        workers: usize,
        job: &(impl Fn(usize) -> Result<usize, FemError> + Sync),
    ) -> (Found, Vec<f64>) {
        let mut shares = Vec::new();
        let mut progress = |_: &str, share: Option<f64>| {
            shares.extend(share);
            ControlFlow::Continue(())
        };
        let found = together(count, workers, &mut progress, &|index, tell: Progress| {
            let _ = tell("half", Some(0.5));
            job(index)
        });
        (found, shares)
    }

    #[test]
    fn answers_come_by_number_whatever_the_order_they_were_found_in() {
        for workers in [1, 3, 9] {
            let wait = |i: usize| std::thread::sleep(std::time::Duration::from_millis(7 * ((i * 5) % 4) as u64));
            let (found, shares) = tried(7, workers, &|i| {
                wait(i);
                Ok(i * i)
            });
            assert_eq!(found.unwrap(), [0, 1, 4, 9, 16, 25, 36]);
            assert!(shares.len() == 7 && shares.iter().all(|s| (0.0..=1.0).contains(s)), "{shares:?}");
        }
    }

    #[test]
    fn nothing_new_begins_after_an_interrupt_or_an_error() {
        let (found, shares) = tried(5, 1, &|i| if i < 2 { Ok(i) } else { Err(interrupted()) });
        assert!(matches!(found, Err(FemError::Interrupted { done: 2, of: 5, .. })) && shares.len() == 3, "{found:?}");
        let (failed, shares) = tried(5, 1, &|i| if i < 2 { Ok(i) } else { Err(FemError::setting("no", "yes")) });
        assert!(failed.is_err() && shares.len() == 3);
    }

    #[test]
    fn whoever_asks_to_end_is_heard_by_jobs_that_run_and_by_those_to_come() {
        let mut asked = |_: &str, _: Option<f64>| ControlFlow::Break(());
        let found = together(6, 2, &mut asked, &|_, tell: Progress| {
            for _ in 0..1000 {
                if tell("on", None).is_break() {
                    return Err(interrupted());
                }
                std::thread::sleep(std::time::Duration::from_millis(2));
            }
            Ok(0)
        });
        assert!(matches!(found, Err(FemError::Interrupted { done: 0, of: 6, .. })), "{found:?}");
    }

    #[test]
    fn of_several_errors_the_first_jobs_is_told_whichever_came_first() {
        let (failed, _) = tried(3, 3, &|i| {
            std::thread::sleep(std::time::Duration::from_millis(40 * (2 - i) as u64));
            if i == 0 { Ok(0) } else { Err(FemError::setting(format!("job {i}"), "yes")) }
        });
        assert!(failed.unwrap_err().to_string().contains("job 1"));
    }

    #[test]
    fn threads_are_shared_among_the_jobs() {
        assert_eq!([shared(4, 2), shared(2, 5), shared(3, 1), shared(1, 3)], [(2, 2), (2, 1), (1, 3), (1, 1)]);
    }
}
