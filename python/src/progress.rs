//! Long work on another thread than Python's: its progress to a Python function, and Ctrl-C back from Python.

use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::Duration;

/// How often Python is asked for signals while no progress comes.
const ASK_EVERY: Duration = Duration::from_millis(50);

/// The current work, and the finished share of the whole if known.
type News = (String, Option<f64>);

/// Receives the progress of the work; answers whether to go on.
pub(crate) type Tell<'a> = &'a mut (dyn FnMut(&str, Option<f64>) -> ControlFlow<()> + Send);

/// Does work on a separate thread, because engines report their progress from threads on which Python hears no signal. This thread
/// waits, passes the latest news to `listener`, and looks for Ctrl-C; an exception in Python asks the work to end and is then the error.
pub(crate) fn beside<T: Send>(
    py: Python<'_>,
    listener: Option<&Py<PyAny>>,
    work: impl FnOnce(Tell) -> T + Send,
) -> PyResult<T> {
    let (sender, receiver) = channel::<News>();
    py.detach(move || {
        let stop = AtomicBool::new(false);
        std::thread::scope(|scope| {
            let stop = &stop;
            let worker = scope.spawn(move || {
                work(&mut |what, share| {
                    // Sending fails only after an exception in Python.
                    let _ = sender.send((what.to_string(), share));
                    if stop.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                })
            });
            let heard = listen(&receiver, listener);
            stop.store(true, Ordering::Relaxed);
            let made = worker.join().unwrap_or_else(|panic| resume_unwind(panic));
            heard.map(|()| made)
        })
    })
}

/// Passes on the latest news until the work has ended.
fn listen(receiver: &Receiver<News>, listener: Option<&Py<PyAny>>) -> PyResult<()> {
    loop {
        let news = match receiver.recv_timeout(ASK_EVERY) {
            Ok(news) => Some(receiver.try_iter().last().unwrap_or(news)),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        Python::attach(|py| {
            py.check_signals()?;
            match (listener, news) {
                (Some(listener), Some(news)) => listener.call1(py, news).map(|_| ()),
                _ => Ok(()),
            }
        })?;
    }
}
