//! Long work beside Python: its progress to a Python function, and Ctrl-C back from Python.

use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// How often Python is asked for signals while nothing is told.
const ASK_EVERY: Duration = Duration::from_millis(50);

/// What is being done, and which share of the whole is done if known.
type News = (String, Option<f64>);

/// Told how far work is; says whether to go on.
pub(crate) type Tell<'a> = &'a mut (dyn FnMut(&str, Option<f64>) -> ControlFlow<()> + Send);

/// Does work on a thread of its own, because engines tell their progress from threads on which Python hears no signal. This one
/// waits, tells `told` the latest, and looks for Ctrl-C; what Python raises asks the work to end and is the error when it has.
pub(crate) fn beside<T: Send>(
    py: Python<'_>,
    told: Option<&Py<PyAny>>,
    work: impl FnOnce(Tell) -> T + Send,
) -> PyResult<T> {
    let (sender, receiver) = channel::<News>();
    py.detach(move || {
        let stop = AtomicBool::new(false);
        std::thread::scope(|scope| {
            let stop = &stop;
            let worker = scope.spawn(move || {
                work(&mut |what, share| {
                    // Nobody listens any more only when Python has raised something.
                    let _ = sender.send((what.to_string(), share));
                    if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                })
            });
            let heard = listen(&receiver, told);
            stop.store(true, Ordering::Relaxed);
            let made = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
            heard.map(|()| made)
        })
    })
}

/// Tells the latest until there is no more.
fn listen(receiver: &Receiver<News>, told: Option<&Py<PyAny>>) -> PyResult<()> {
    loop {
        let news = match receiver.recv_timeout(ASK_EVERY) {
            Ok(news) => Some(receiver.try_iter().last().unwrap_or(news)),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        Python::attach(|py| {
            py.check_signals()?;
            match (told, news) {
                (Some(told), Some(news)) => told.call1(py, news).map(|_| ()),
                _ => Ok(()),
            }
        })?;
    }
}
