//! Attaching to the interpreter for a call, and releasing it during long computations.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::callout::guarded;
use crate::leave;

/// The interval of signal checks during a background computation.
const EVERY: Duration = Duration::from_millis(30);

/// Calls Python. At the end of the interpreter the thread sleeps permanently, since the program is
/// about to end.
pub fn attached<T>(call: impl FnOnce(Python<'_>) -> T) -> T {
    leave::stay_if_closed();
    Python::try_attach(|py| guarded(|| call(py))).unwrap_or_else(|| {
        loop {
            thread::park();
        }
    })
}

/// Computes in a separate thread, so that other Python threads run and Ctrl-C works. After a signal
/// the thread is abandoned.
///
/// # Errors
/// The exception of a signal handler, or a panic.
pub fn in_background<T: Send + 'static>(
    py: Python<'_>,
    compute: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (send, done) = channel();
    py.detach(move || {
        thread::spawn(move || {
            // After a signal there is no receiver.
            let _ = send.send(compute());
        });
        loop {
            match done.recv_timeout(EVERY) {
                Ok(computed) => return Ok(computed),
                Err(RecvTimeoutError::Timeout) => attached(|py| py.check_signals())?,
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(PyRuntimeError::new_err("the computation failed"));
                }
            }
        }
    })
}
