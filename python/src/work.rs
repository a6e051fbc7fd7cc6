//! Work outside the interpreter: on a thread of its own, stopped by Ctrl-C, its failures as exceptions.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use secant::diagnostic::Problem;
use secant::guard::guarded;
use secant::stop::stoppable;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::Builder;
use std::time::Duration;

/// Address space for the stack of a piece of work; memory is taken as it is used.
const STACK: usize = 256 << 20;
/// How often Ctrl-C is looked for.
const TICK: Duration = Duration::from_millis(50);

/// Does a piece of work without holding the interpreter.
///
/// # Errors
/// The exception of its problem; `KeyboardInterrupt` (or what a signal handler raises), whereupon the work is told to stop.
pub fn outside<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<T, Problem> + Send + 'static,
) -> PyResult<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let (send, mut receive) = channel();
    let flag = Arc::clone(&stop);
    let started = Builder::new().name("secant".to_owned()).stack_size(STACK).spawn(move || {
        // Nobody listens where the work was stopped.
        let _ = send.send(guarded(|| stoppable(Some(flag), work)));
    });
    started.map_err(|e| PyRuntimeError::new_err(format!("no thread for the work: {e}")))?;
    loop {
        let (got, back) = py.detach(move || (receive.recv_timeout(TICK), receive));
        receive = back;
        match got {
            Ok(done) => return done.map_err(|problem| exception(py, &problem)),
            Err(RecvTimeoutError::Timeout) => {
                if let Err(interrupt) = py.check_signals() {
                    stop.store(true, Ordering::Relaxed);
                    return Err(interrupt);
                }
            }
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the work ended without a result"));
            }
        }
    }
}

/// A problem as an exception of `secant._errors`.
pub fn exception(py: Python<'_>, problem: &Problem) -> PyErr {
    let (line, column) = problem.position().unzip();
    let fields =
        (problem.id(), problem.message(), problem.file(), line, column, problem.remedy(), problem.is_internal());
    let made = py.import("secant._errors").and_then(|m| m.getattr("made")).and_then(|make| make.call1(fields));
    match made {
        Ok(value) => PyErr::from_value(value),
        Err(error) => error,
    }
}
