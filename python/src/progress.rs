//! Progress to a Python function, and Ctrl-C back from Python.

use pyo3::prelude::*;
use std::ops::ControlFlow;

/// Who is told how far long work is. Python looks for signals each time; what it raises ends work that can be ended.
pub struct Teller {
    told: Option<Py<PyAny>>,
    /// What was raised first.
    raised: Option<PyErr>,
}

impl Teller {
    /// Tells a function of two arguments: what is being done, and which share of the whole is done or None.
    pub fn new(told: Option<Py<PyAny>>) -> Teller {
        Teller { told, raised: None }
    }

    /// Tells, and says whether to go on.
    pub fn tell(&mut self, what: &str, share: Option<f64>) -> ControlFlow<()> {
        if self.raised.is_some() {
            return ControlFlow::Break(());
        }
        let told = Python::attach(|py| {
            py.check_signals()?;
            self.told.as_ref().map_or(Ok(()), |told| told.call1(py, (what, share)).map(|_| ()))
        });
        match told {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.raised = Some(error);
                ControlFlow::Break(())
            }
        }
    }

    /// The result of the work, or what was raised meanwhile.
    pub fn finish<T>(self, result: PyResult<T>) -> PyResult<T> {
        self.raised.map_or(result, Err)
    }
}
