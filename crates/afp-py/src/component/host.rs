//! The shared state of a run's components: the robot, available during calls, and their exceptions.

use std::cell::Cell;
use std::mem;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use afp_core::{Fault, Instant, Reason};
use afp_session::Simulated;
use pyo3::exceptions::{PyBaseException, PyException, PyKeyboardInterrupt};
use pyo3::prelude::*;
use pyo3::{PyTraverseError, PyVisit};

use super::depth::inside;
use super::handles::PyHandles;
use crate::attach::attached;
use crate::robot::{Caller, Robot};

/// The fault of a plan after an exception.
pub const RAISED: Fault = Fault::new(&Reason {
    code: "python-exception",
    text: "a component written in Python raised an exception",
});

/// The reason for a run that a component ended by Ctrl-C or similar; the scheduler sees a panic.
pub const ENDED_ALL: Reason = Reason {
    code: "python-ended",
    text: "Ctrl-C, or another BaseException, in a component written in Python",
};

/// An exception of a component.
pub struct Failure {
    pub at: Instant,
    pub template: String,
    pub error: Py<PyBaseException>,
}

/// The shared state of a run's components.
pub struct Host {
    pub robot: Py<Robot>,
    /// Other references of the plan to Python.
    pub handles: Arc<PyHandles>,
    failures: Mutex<Vec<Failure>>,
    /// The exception that ends the whole run, such as Ctrl-C, which no `Error` edge may catch.
    abort: Mutex<Option<Py<PyBaseException>>>,
    /// Whether there was such an exception.
    ended: AtomicBool,
    /// Python's id of the thread in which a component is being called, or 0.
    calling: AtomicU64,
}

thread_local! {
    /// Python's id of this thread, once known.
    static THREAD: Cell<u64> = const { Cell::new(0) };
}

impl Host {
    /// Makes the host of a run with this robot.
    pub fn new(robot: Py<Robot>) -> Host {
        Host {
            robot,
            handles: Arc::default(),
            failures: Mutex::default(),
            abort: Mutex::default(),
            ended: AtomicBool::new(false),
            calling: AtomicU64::new(0),
        }
    }

    /// Calls Python, which may use the robot during the call.
    ///
    /// # Errors
    /// [`RAISED`] for an exception, which is stored. An exception that ends the whole run, such as
    /// Ctrl-C, unwinds like a panic: no `Error` edge takes it, and no component is called again.
    pub fn call_with_robot<R: Simulated, T>(
        &self,
        env: &mut R,
        caller: &Arc<Caller>,
        call: impl FnOnce(Python<'_>) -> PyResult<T>,
    ) -> Result<T, Fault> {
        let now = env.now();
        attached(|py| {
            let robot = self.robot.get();
            robot.exchange(env, Some(caller));
            let done = self.inside(py, call);
            robot.exchange(env, None);
            done.map_err(|error| self.keep(py, now, &caller.name, error))
        })
        .map_err(Raised::fault)
    }

    /// Calls Python without a robot.
    ///
    /// # Errors
    /// As [`Host::call_with_robot`].
    pub fn call<T>(
        &self,
        template: &str,
        call: impl FnOnce(Python<'_>) -> PyResult<T>,
    ) -> Result<T, Fault> {
        attached(|py| {
            let done = self.inside(py, call);
            done.map_err(|error| self.keep(py, Instant::ZERO, template, error))
        })
        .map_err(Raised::fault)
    }

    /// Calls Python in a thread known to [`Host::interrupt`].
    fn inside<T>(
        &self,
        py: Python<'_>,
        call: impl FnOnce(Python<'_>) -> PyResult<T>,
    ) -> PyResult<T> {
        let outer = self.calling.swap(thread(py)?, Ordering::Relaxed);
        let done = inside(|| call(py));
        self.calling.store(outer, Ordering::Relaxed);
        done
    }

    /// Raises `KeyboardInterrupt` in the component that is being called, at its next Python
    /// instruction. This reaches components in threads without signals.
    ///
    /// # Errors
    /// Those of `ctypes`.
    pub fn interrupt(&self, py: Python<'_>) -> PyResult<()> {
        let thread = self.calling.load(Ordering::Relaxed);
        if thread == 0 {
            return Ok(());
        }
        let ctypes = py.import("ctypes")?;
        let thread = ctypes.getattr("c_ulong")?.call1((thread,))?;
        let raised = ctypes.getattr("py_object")?.call1((py.get_type::<PyKeyboardInterrupt>(),))?;
        let api = ctypes.getattr("pythonapi")?;
        api.call_method1("PyThreadState_SetAsyncExc", (thread, raised)).map(drop)
    }

    fn keep(&self, py: Python<'_>, at: Instant, template: &str, error: PyErr) -> Raised {
        let ordinary = error.is_instance_of::<PyException>(py);
        let error = error.into_value(py);
        if ordinary {
            lock(&self.failures).push(Failure { at, template: template.to_owned(), error });
            return Raised::Exception;
        }
        lock(&self.abort).get_or_insert(error);
        self.ended.store(true, Ordering::Relaxed);
        Raised::EndOfAll
    }

    /// Whether a component's exception has ended the run, even if it has been passed on.
    pub fn has_ended_all(&self) -> bool {
        self.ended.load(Ordering::Relaxed)
    }

    /// Whether an exception that ends the run is pending.
    pub fn is_aborted(&self) -> bool {
        lock(&self.abort).is_some()
    }

    /// Takes the exception that ends the run.
    pub fn aborted(&self, py: Python<'_>) -> Option<PyErr> {
        let raised = lock(&self.abort).take()?;
        Some(PyErr::from_value(raised.into_bound(py).into_any()))
    }

    /// Passes all references to the garbage collector.
    ///
    /// # Errors
    /// Those of the collector.
    pub fn traverse(&self, visit: &PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.handles.traverse(visit)?;
        lock(&self.failures).iter().try_for_each(|failure| visit.call(&failure.error))?;
        visit.call(&*lock(&self.abort))
    }

    /// Drops all references.
    pub fn clear(&self) {
        self.handles.clear();
        drop(self.failures());
        let raised = lock(&self.abort).take();
        drop(raised);
    }

    /// Takes the exceptions since the last call.
    pub fn failures(&self) -> Vec<Failure> {
        mem::take(&mut *lock(&self.failures))
    }
}

/// An exception of a component.
enum Raised {
    Exception,
    /// One that ends the run, such as Ctrl-C.
    EndOfAll,
}

impl Raised {
    /// The fault for the plan; an exception that ends the run unwinds.
    fn fault(self) -> Fault {
        match self {
            Raised::Exception => RAISED,
            Raised::EndOfAll => resume_unwind(Box::new("a component ends the run")),
        }
    }
}

/// Python's id of this thread.
fn thread(py: Python<'_>) -> PyResult<u64> {
    let known = THREAD.get();
    if known != 0 {
        return Ok(known);
    }
    let thread = py.import("threading")?.call_method0("get_ident")?.extract()?;
    THREAD.set(thread);
    Ok(thread)
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // Pushing to a list is atomic: a panic leaves no partial change.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
