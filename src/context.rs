//! What commands share: the outside that they may use, the wish to end, and what they have to say.

use crate::failure::{Failure, INTERRUPTED};
use crate::shown::as_json;
use fem::session::Progress;
use serde::Serialize;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

/// What a command may use of the outside.
pub(crate) struct Context<'a> {
    pub typed: Vec<String>,
    pub json: bool,
    pub threads: usize,
    pub force: bool,
    /// Takes the current work, and the finished share of the whole if known.
    pub progress: &'a mut (dyn FnMut(&str, Option<f64>) + Send),
    /// Takes text for standard output before the command ends; nothing is printed where JSON is asked for.
    pub say: &'a mut (dyn FnMut(&str) + Send),
    /// Held while files are written; true once they are.
    pub written: &'a Mutex<bool>,
    pub interrupt: &'a Interrupt,
}

impl Context<'_> {
    /// Makes finite element runs. Ctrl-C asks them to end from here on, which they do with a checkpoint.
    pub(crate) fn fem<T, E>(&mut self, make: impl FnOnce(Progress) -> Result<T, E>) -> Result<T, E> {
        let Context { progress, interrupt, .. } = self;
        interrupt.awaited.fetch_add(1, Ordering::SeqCst);
        let made = make(&mut |text, share| {
            progress(text, share);
            if interrupt.asked() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        interrupt.awaited.fetch_sub(1, Ordering::SeqCst);
        made
    }
}

/// Signals within this time are one.
const ONE_REQUEST: Duration = Duration::from_secs(1);

/// How Ctrl-C reaches a command that saves its state before it ends.
#[derive(Debug)]
pub(crate) struct Interrupt {
    /// Runs that will end themselves when asked.
    awaited: AtomicUsize,
    asked: OnceLock<Instant>,
}

impl Interrupt {
    pub(crate) const fn new() -> Interrupt {
        Interrupt { awaited: AtomicUsize::new(0), asked: OnceLock::new() }
    }

    /// Asks the command to end; false if it will not, or was asked before. Who asks again at once asks once: `timeout` and job
    /// schedulers signal a program and its group, and a checkpoint shall still be written.
    pub(crate) fn ask(&self) -> bool {
        self.awaited.load(Ordering::SeqCst) > 0 && self.asked.get_or_init(Instant::now).elapsed() < ONE_REQUEST
    }

    pub(crate) fn asked(&self) -> bool {
        self.asked.get().is_some()
    }
}

#[derive(Debug, Default)]
pub(crate) struct Outcome {
    pub text: String,
    pub json: Option<serde_json::Value>,
    pub notes: Vec<String>,
    pub code: u8,
}

impl Outcome {
    /// A text, and the same as JSON of a shape in its first version.
    pub(crate) fn answer(text: String, schema: &'static str, body: &impl Serialize) -> Outcome {
        Outcome::new(text, as_json(schema, body))
    }

    pub(crate) fn of(text: String) -> Outcome {
        Outcome { text, ..Outcome::default() }
    }

    pub(crate) fn new(text: String, json: serde_json::Value) -> Outcome {
        Outcome { text, json: Some(json), notes: Vec::new(), code: 0 }
    }

    pub(crate) fn interrupted(note: String) -> Outcome {
        Outcome { notes: vec![note], code: INTERRUPTED, ..Outcome::default() }
    }

    pub(crate) fn warn<'w>(&mut self, warnings: impl IntoIterator<Item = &'w String>) {
        self.notes.extend(warnings.into_iter().map(|w| format!("warning: {w}")));
    }

    pub(crate) fn report(&mut self, folder: &Path) {
        self.notes.push(format!("report: {}", folder.join("report.html").display()));
    }

    /// Keeps the result, and adds the later failure below it.
    pub(crate) fn fail(&mut self, failure: &Failure) {
        self.notes.push(failure.render().trim_end().to_string());
        self.code = failure.code();
    }
}
