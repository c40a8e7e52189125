//! The interpreter, taken for a call and given back while something computes for long.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

/// How often a computation in the background looks for signals.
const EVERY: Duration = Duration::from_millis(30);

/// Calls Python. A thread that comes after the end of the interpreter rests for good: the program is about to end.
pub fn attached<T>(call: impl FnOnce(Python<'_>) -> T) -> T {
    Python::try_attach(call).unwrap_or_else(|| {
        loop {
            thread::park();
        }
    })
}

/// Computes something in a thread of its own, so that other threads of Python run and Ctrl-C is seen meanwhile; it is
/// left to itself then.
///
/// # Errors
/// What a handler of a signal raises; it panicked.
pub fn in_background<T: Send + 'static>(
    py: Python<'_>,
    compute: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (send, done) = channel();
    py.detach(move || {
        thread::spawn(move || {
            // Nobody waits any more after a signal.
            let _ = send.send(compute());
        });
        loop {
            match done.recv_timeout(EVERY) {
                Ok(computed) => return Ok(computed),
                Err(RecvTimeoutError::Timeout) => attached(|py| py.check_signals())?,
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(PyRuntimeError::new_err("the computation broke"));
                }
            }
        }
    })
}
