//! Several long jobs beside each other, with one line of progress.

use super::Context;
use crate::failure::Failure;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};

/// What a worker says.
enum News<T> {
    /// A job stands here.
    Stands(usize, String, Option<f64>),
    /// A job ended.
    Ended(usize, Result<Option<T>, Failure>),
}

/// Does jobs `0..count` in this order, `workers` at a time, and returns what they gave by number. A job gives `None` if the
/// user interrupted it; then nothing new is begun, and the answer is the number of jobs that were done.
///
/// # Errors
/// That of the first job in their order that failed; the jobs that run beside it are finished before.
pub fn together<T: Send>(
    count: usize,
    workers: usize,
    context: &mut Context,
    job: &(impl Fn(usize, &mut Context) -> Result<Option<T>, Failure> + Sync),
) -> Result<Result<Vec<T>, usize>, Failure> {
    let next = AtomicUsize::new(0);
    let mut done: Vec<Option<T>> = (0..count).map(|_| None).collect();
    let mut faults = BTreeMap::new();
    std::thread::scope(|scope| {
        let (tell, hear) = channel();
        for _ in 0..workers.clamp(1, count.max(1)) {
            let (tell, next) = (tell.clone(), &next);
            let Context { json, written, interrupt, .. } = *context;
            scope.spawn(move || {
                loop {
                    let index = next.fetch_add(1, Ordering::SeqCst);
                    if index >= count {
                        return;
                    }
                    let mut progress = report(&tell, index);
                    let mut inner = Context { json, progress: &mut progress, written, interrupt };
                    let found = job(index, &mut inner);
                    if !matches!(found, Ok(Some(_))) {
                        next.store(count, Ordering::SeqCst);
                    }
                    let _ = tell.send(News::Ended(index, found));
                }
            });
        }
        drop(tell);
        let mut standing: BTreeMap<usize, (String, Option<f64>)> = BTreeMap::new();
        for news in hear {
            match news {
                News::Stands(index, text, share) => {
                    standing.insert(index, (text, share));
                    let ended = done.iter().flatten().count() as f64;
                    let shares: f64 = standing.values().filter_map(|s| s.1).sum();
                    let texts: Vec<&str> = standing.values().map(|s| s.0.as_str()).collect();
                    (context.progress)(&texts.join(" | "), Some((ended + shares) / count as f64));
                }
                News::Ended(index, found) => {
                    standing.remove(&index);
                    match found {
                        Ok(found) => done[index] = found,
                        Err(error) => _ = faults.insert(index, error),
                    }
                }
            }
        }
    });
    if let Some((_, first)) = faults.pop_first() {
        return Err(first);
    }
    let ended = done.iter().flatten().count();
    let all: Option<Vec<T>> = done.into_iter().collect();
    Ok(all.ok_or(ended))
}

fn report<T>(tell: &Sender<News<T>>, index: usize) -> impl FnMut(&str, Option<f64>) {
    let tell = tell.clone();
    move |text, share| {
        let _ = tell.send(News::Stands(index, text.to_owned(), share));
    }
}

/// Jobs at a time, and threads of each, for so many threads (0: one per core). Two runs on a core each are done sooner
/// than one after the other on both: a step is too short to be shared without loss.
pub fn shared(threads: usize, jobs: usize) -> (usize, usize) {
    let threads = if threads == 0 { std::thread::available_parallelism().map_or(1, usize::from) } else { threads };
    let workers = threads.min(jobs).max(1);
    (workers, threads / workers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::context::Interrupt;
    use std::sync::Mutex;

    type Found = Result<Result<Vec<usize>, usize>, Failure>;

    /// What came back, and the shares that were told.
    fn tried(
        count: usize,
        workers: usize,
        job: &(impl Fn(usize) -> Result<Option<usize>, Failure> + Sync),
    ) -> (Found, Vec<f64>) {
        let (written, interrupt) = (Mutex::new(false), Interrupt::new());
        let mut shares = Vec::new();
        let mut progress = |_: &str, share: Option<f64>| shares.extend(share);
        let mut context = Context { json: false, progress: &mut progress, written: &written, interrupt: &interrupt };
        let found = together(count, workers, &mut context, &|index, inner: &mut Context| {
            (inner.progress)("half", Some(0.5));
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
                Ok(Some(i * i))
            });
            assert_eq!(found.unwrap().unwrap(), [0, 1, 4, 9, 16, 25, 36]);
            assert!(shares.len() == 7 && shares.iter().all(|s| (0.0..=1.0).contains(s)), "{shares:?}");
        }
    }

    #[test]
    fn nothing_new_begins_after_an_interrupt_or_an_error() {
        let (interrupted, shares) = tried(5, 1, &|i| Ok((i < 2).then_some(i)));
        assert_eq!((interrupted.unwrap().unwrap_err(), shares.len()), (2, 3));
        let (failed, shares) = tried(5, 1, &|i| if i < 2 { Ok(Some(i)) } else { Err(Failure::usage("no", "yes")) });
        assert!(failed.is_err() && shares.len() == 3);
    }

    #[test]
    fn of_several_errors_the_first_jobs_is_told_whichever_came_first() {
        let (failed, _) = tried(3, 3, &|i| {
            std::thread::sleep(std::time::Duration::from_millis(40 * (2 - i) as u64));
            if i == 0 { Ok(Some(0)) } else { Err(Failure::usage(format!("job {i}"), "yes")) }
        });
        assert!(failed.unwrap_err().to_string().contains("job 1"));
    }

    #[test]
    fn threads_are_shared_among_the_jobs() {
        assert_eq!([shared(4, 2), shared(2, 5), shared(3, 1), shared(1, 3)], [(2, 2), (2, 1), (1, 3), (1, 1)]);
    }
}
