//! What all components of a run share: the robot, which they have while they are called, and what they raised.

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

/// What a plan sees of an exception.
pub const RAISED: Fault = Fault::new(&Reason {
    code: "python-exception",
    text: "a component written in Python raised an exception",
});

/// What is said of a run that a component ended by Ctrl-C and the like: for the scheduler it is one that panicked.
pub const ENDED_ALL: Reason = Reason {
    code: "python-ended",
    text: "Ctrl-C, or another exception that is no Exception, in a component written in Python",
};

/// An exception of a component.
pub struct Failure {
    pub at: Instant,
    pub template: String,
    pub error: Py<PyBaseException>,
}

/// What the components of a run share.
pub struct Host {
    pub robot: Py<Robot>,
    /// What else the plan holds of Python.
    pub handles: Arc<PyHandles>,
    failures: Mutex<Vec<Failure>>,
    /// What ends the whole run: Ctrl-C and the like, which no `Error` edge shall catch.
    abort: Mutex<Option<Py<PyBaseException>>>,
    /// Whether there was such.
    ended: AtomicBool,
    /// The thread in which a component is being called, as Python numbers threads; 0 for none.
    calling: AtomicU64,
}

thread_local! {
    /// What Python calls this thread, once it has been asked.
    static THREAD: Cell<u64> = const { Cell::new(0) };
}

impl Host {
    /// For a run whose components get this robot.
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

    /// Calls Python, which may use the robot meanwhile.
    ///
    /// # Errors
    /// [`RAISED`] for an exception, which is kept. What ends the whole run, Ctrl-C and the like, unwinds as a panic
    /// does: no `Error` edge takes it, and no component is called again.
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

    /// Calls Python in a thread that [`Host::interrupt`] knows.
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

    /// Raises `KeyboardInterrupt` in the component that is being called, if there is one, as soon as it runs Python
    /// again: for components in threads of ours, which no signal reaches.
    ///
    /// # Errors
    /// `ctypes` is not there.
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

    /// Whether a component has ended the run by what it raised, also once that has been passed on.
    pub fn has_ended_all(&self) -> bool {
        self.ended.load(Ordering::Relaxed)
    }

    /// Whether something was raised that ends the run.
    pub fn is_aborted(&self) -> bool {
        lock(&self.abort).is_some()
    }

    /// What was raised that ends the run.
    pub fn aborted(&self, py: Python<'_>) -> Option<PyErr> {
        let raised = lock(&self.abort).take()?;
        Some(PyErr::from_value(raised.into_bound(py).into_any()))
    }

    /// Shows what is held of Python to the garbage collector.
    ///
    /// # Errors
    /// Those of the collector.
    pub fn traverse(&self, visit: &PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.handles.traverse(visit)?;
        lock(&self.failures).iter().try_for_each(|failure| visit.call(&failure.error))?;
        visit.call(&*lock(&self.abort))
    }

    /// Lets go of it.
    pub fn clear(&self) {
        self.handles.clear();
        drop(self.failures());
        let raised = lock(&self.abort).take();
        drop(raised);
    }

    /// What was raised since this was last asked.
    pub fn failures(&self) -> Vec<Failure> {
        mem::take(&mut *lock(&self.failures))
    }
}

/// What a component raised.
enum Raised {
    Exception,
    /// Ctrl-C and the like.
    EndOfAll,
}

impl Raised {
    /// What the plan sees of it, outside of Python; the end of all unwinds.
    fn fault(self) -> Fault {
        match self {
            Raised::Exception => RAISED,
            Raised::EndOfAll => resume_unwind(Box::new("a component ends the run")),
        }
    }
}

/// What Python calls this thread.
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
    // Lists are pushed to as a whole: a panic leaves nothing half done.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
