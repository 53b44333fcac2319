//! Watches a reader at its work: panics, long calls and large memory are faults, and their inputs are kept.

use crate::readers::Reader;
use stats_alloc::{Region, StatsAlloc};
use std::alloc::System;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// No small file takes longer to read.
pub(crate) const LONGEST: Duration = Duration::from_secs(20);
/// No small file needs more memory, all requests added up.
pub(crate) const MOST_MEMORY: usize = 1 << 30;

pub(crate) struct WatchTotals {
    /// Different faults: places of panics, and reasons.
    pub kinds: usize,
    /// Inputs that were read without an error.
    pub read: u64,
    pub seconds: f64,
}

/// The case that a reader works on.
type Current = Option<(u64, Instant, Vec<u8>)>;

pub(crate) struct WatchedReader<'r> {
    reader: &'r Reader,
    keep: PathBuf,
    current: Arc<Mutex<Current>>,
    over: Arc<AtomicBool>,
    kinds: BTreeMap<String, u64>,
    read: u64,
    began: Instant,
}

static PANIC: Mutex<String> = Mutex::new(String::new());

impl<'r> WatchedReader<'r> {
    pub(crate) fn new(reader: &'r Reader, keep: &Path) -> WatchedReader<'r> {
        std::panic::set_hook(Box::new(|panic| {
            let place = panic.location().map(ToString::to_string).unwrap_or_default();
            *PANIC.lock().unwrap_or_else(PoisonError::into_inner) = place;
        }));
        let (current, over) = (Arc::new(Mutex::new(None)), Arc::new(AtomicBool::new(false)));
        let watched = WatchedReader {
            reader,
            keep: keep.into(),
            current,
            over,
            kinds: BTreeMap::new(),
            read: 0,
            began: Instant::now(),
        };
        watched.look_out();
        watched
    }

    /// Ends the program with the input saved when a case takes too long: a thread that hangs cannot be stopped otherwise.
    fn look_out(&self) {
        let (current, over) = (Arc::clone(&self.current), Arc::clone(&self.over));
        let (name, keep) = (self.reader.name, self.keep.clone());
        std::thread::spawn(move || {
            while !over.load(Ordering::Relaxed) {
                std::thread::sleep(Duration::from_millis(200));
                let now = current.lock().unwrap_or_else(PoisonError::into_inner);
                if let Some((case, since, input)) = &*now
                    && since.elapsed() > LONGEST
                {
                    println!("{name}: case {case} takes longer than {LONGEST:?}: {}", save(&keep, name, *case, input));
                    std::process::exit(1);
                }
            }
        });
    }

    pub(crate) fn feed(&mut self, case: u64, input: Vec<u8>, counting: &StatsAlloc<System>) {
        let now = |value: Current| *self.current.lock().unwrap_or_else(PoisonError::into_inner) = value;
        now(Some((case, Instant::now(), input.clone())));
        let region = Region::new(counting);
        let ended = catch_unwind(AssertUnwindSafe(|| (self.reader.read)(&input)));
        let asked = region.change().bytes_allocated;
        now(None);
        let kind = match ended {
            Err(_) => Some(format!("panic at {}", PANIC.lock().unwrap_or_else(PoisonError::into_inner))),
            Ok(_) if asked > MOST_MEMORY => Some("memory".into()),
            Ok(read) => {
                self.read += u64::from(read);
                None
            }
        };
        if let Some(kind) = kind {
            self.keep(case, &input, kind);
        }
    }

    /// Keeps the first input of every kind of fault.
    fn keep(&mut self, case: u64, input: &[u8], kind: String) {
        let count = self.kinds.entry(kind.clone()).or_insert(0);
        *count += 1;
        if *count == 1 {
            println!("{}: {kind}, case {case}: {}", self.reader.name, save(&self.keep, self.reader.name, case, input));
        }
    }

    pub(crate) fn end(self) -> WatchTotals {
        self.over.store(true, Ordering::Relaxed);
        WatchTotals { kinds: self.kinds.len(), read: self.read, seconds: self.began.elapsed().as_secs_f64() }
    }
}

/// Saves an input and returns where it is.
fn save(keep: &Path, reader: &str, case: u64, input: &[u8]) -> String {
    let path = keep.join(format!("{reader}-{case}"));
    match std::fs::create_dir_all(keep).and_then(|()| std::fs::write(&path, input)) {
        Ok(()) => path.display().to_string(),
        Err(cause) => format!("not saved in {}: {cause}", path.display()),
    }
}
