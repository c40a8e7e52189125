//! The end of the interpreter: everything that runs is called off, and no thread attaches again.
//!
//! Python ends while daemon threads and abandoned threads of sweeps still run plans. An exit
//! handler calls their runs off, interrupts components and waits briefly. A thread whose run was
//! called off sleeps until the process ends, instead of returning to an interpreter that is being
//! torn down. A component that does not come back in time sleeps, too, see [`crate::callout`].

use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::wrap_pyfunction;

use crate::forks;

/// The time after which running components are interrupted.
const PATIENCE: Duration = Duration::from_millis(15);
/// The time after which Python ends in any case.
const LEFT: Duration = Duration::from_millis(150);
/// The interval of checks.
const LOOK: Duration = Duration::from_millis(2);

/// Everything runs.
const OPEN: u8 = 0;
/// Runs are called off; their components may still call Python.
const CALLED_OFF: u8 = 1;
/// No thread attaches again.
const CLOSED: u8 = 2;

static PHASE: AtomicU8 = AtomicU8::new(OPEN);
/// The thread that ends the interpreter. Exit handlers of the program may still run plans in it.
static LAST: OnceLock<ThreadId> = OnceLock::new();
/// Used only while attached, so that no fork finds it locked.
static CALLS: Mutex<Vec<Arc<Call>>> = Mutex::new(Vec::new());

/// Interrupts the components of a call.
type Interrupt = Box<dyn Fn(Python<'_>) -> PyResult<()> + Send + Sync>;

/// Something that runs, for as long as a second reference exists.
pub struct Call {
    stop: Arc<AtomicBool>,
    interrupt: Interrupt,
    process: u32,
}

impl Call {
    /// Announces a call that ends soon after `stop` is set.
    pub fn new(
        _attached: Python<'_>,
        stop: &Arc<AtomicBool>,
        interrupt: impl Fn(Python<'_>) -> PyResult<()> + Send + Sync + 'static,
    ) -> Arc<Call> {
        let (stop, interrupt) = (Arc::clone(stop), Box::new(interrupt));
        let call = Arc::new(Call { stop, interrupt, process: forks::process() });
        let mut calls = CALLS.lock().unwrap_or_else(PoisonError::into_inner);
        calls.retain(|call| Arc::strong_count(call) > 1);
        calls.push(Arc::clone(&call));
        call
    }

    /// Runs it, and does not return if the interpreter ends. The caller is detached.
    pub fn run<T>(self: Arc<Self>, run: impl FnOnce() -> T) -> T {
        stay(CALLED_OFF);
        let ran = run();
        drop(self);
        stay(CALLED_OFF);
        ran
    }

    fn is_running(self: &Arc<Self>) -> bool {
        self.process == forks::process() && Arc::strong_count(self) > 2
    }
}

/// Sleeps until the process ends, from this phase on. The caller is detached.
fn stay(phase: u8) {
    while PHASE.load(Ordering::Acquire) >= phase && !is_last() {
        thread::park();
    }
}

/// Sleeps until the process ends if Python can no longer be called. The caller may be attached
/// only in the last thread.
pub fn stay_if_closed() {
    stay(CLOSED);
}

fn is_last() -> bool {
    LAST.get().is_some_and(|last| *last == thread::current().id())
}

/// Checks that components may run in other threads.
///
/// # Errors
/// The interpreter ends.
pub fn may_begin() -> PyResult<()> {
    match PHASE.load(Ordering::Acquire) {
        OPEN => Ok(()),
        _ => Err(PyRuntimeError::new_err(
            "Python is ending, so a sweep with components cannot begin",
        )),
    }
}

/// Registers for the end of Python.
///
/// # Errors
/// Those of Python.
pub fn listen(module: &Bound<'_, PyModule>) -> PyResult<()> {
    let py = module.py();
    // The thread that imports it first counts as the main thread, so a sweep must not do it.
    py.import("threading")?;
    // It interrupts components, and must not be imported while they run.
    py.import("ctypes")?;
    py.import("atexit")?.call_method1("register", (wrap_pyfunction!(call_off, module)?,))?;
    Ok(())
}

/// Calls off everything that runs, and waits briefly for its end.
#[pyfunction]
fn call_off(py: Python<'_>) -> PyResult<()> {
    let _ = LAST.set(thread::current().id());
    PHASE.store(CALLED_OFF, Ordering::Release);
    let calls = CALLS.lock().unwrap_or_else(PoisonError::into_inner).clone();
    for call in &calls {
        call.stop.store(true, Ordering::Relaxed);
    }
    let begun = Instant::now();
    let wait_until = |end: Duration| {
        while calls.iter().any(Call::is_running) && begun.elapsed() < end {
            thread::sleep(LOOK);
        }
    };
    py.detach(|| wait_until(PATIENCE));
    let mut running = calls.iter().filter(|call| call.is_running());
    let interrupted = running.try_for_each(|call| (call.interrupt)(py));
    py.detach(|| wait_until(LEFT));
    PHASE.store(CLOSED, Ordering::Release);
    interrupted
}
