//! Access to a run: one caller at a time drives it, and others read its recent state.

use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, MutexGuard, TryLockError, Weak};

use afp_dsl::Compiled;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use super::Runner;
use super::glance::Glance;
use super::session::Run;
use crate::component::{Host, may_run};
use crate::forks;
use crate::leave::Call;
use crate::pause::Pause;

impl Runner {
    /// Makes a driver of a run, whose components in Python share the host.
    pub fn new(mut run: Run, host: Option<Arc<Host>>, compiled: &Arc<Compiled>) -> Runner {
        let stop = Arc::new(AtomicBool::new(false));
        run.pause = Pause::new(host.clone(), Arc::clone(&stop));
        let seen = Arc::clone(&run.seen);
        let (session, process) = (Mutex::new(run), forks::process());
        Runner { session, host, stop, seen, process, compiled: Arc::clone(compiled) }
    }

    /// The session, unless it is in use.
    #[inline]
    pub(super) fn lock(&self) -> PyResult<MutexGuard<'_, Run>> {
        match self.session.try_lock() {
            Ok(session) if self.process == forks::process() => Ok(session),
            _ => self.no_lock(),
        }
    }

    /// The error if the session is in use, or the session if it has become free.
    #[cold]
    fn no_lock(&self) -> PyResult<MutexGuard<'_, Run>> {
        if self.process != forks::process() {
            let text =
                "this simulation belongs to the process that was forked; make a new one here";
            return Err(PyRuntimeError::new_err(text));
        }
        match self.session.try_lock() {
            Ok(session) => Ok(session),
            Err(TryLockError::WouldBlock) => Err(PyRuntimeError::new_err(
                "the simulation is running: another thread drives it, or one of its own components called",
            )),
            Err(TryLockError::Poisoned(_)) => Err(PyRuntimeError::new_err(
                "the simulation broke in an earlier call; make a new one",
            )),
        }
    }

    /// Reads the robot.
    #[cfg(feature = "carbot")]
    pub fn with_robot<T>(&self, look: impl FnOnce(&dyn std::any::Any) -> T) -> PyResult<T> {
        Ok(look(self.lock()?.session.robot()))
    }

    /// Reads the run, or its recent state while another thread drives it.
    pub(super) fn see<T>(
        &self,
        now: impl FnOnce(&Run) -> PyResult<T>,
        before: impl FnOnce(Glance) -> PyResult<T>,
    ) -> PyResult<T> {
        match self.lock() {
            Ok(run) => now(&run),
            Err(why) if self.session.is_poisoned() || self.process != forks::process() => Err(why),
            Err(why) => self.seen.glance().map_or(Err(why), before),
        }
    }

    /// Checks that this thread may drive it; without components in Python there is no nesting.
    #[inline]
    pub(super) fn may_run(&self) -> PyResult<()> {
        if self.host.is_some() { may_run() } else { Ok(()) }
    }

    /// Drives the session with the interpreter released.
    pub(super) fn drive(
        &self,
        py: Python<'_>,
        drive: impl FnOnce(&mut Run) -> PyResult<bool> + Send,
    ) -> PyResult<bool> {
        self.may_run()?;
        let mut session = self.lock()?;
        let session = &mut *session;
        session.show();
        let host = self.host.as_ref().map(Arc::downgrade);
        let call = Call::new(py, &self.stop, move |py| {
            host.as_ref().and_then(Weak::upgrade).map_or(Ok(()), |host| host.interrupt(py))
        });
        let driven = py.detach(|| call.run(|| drive(session)));
        self.after(py, driven)
    }

    /// A component's exception that ends the run has priority over the run's result.
    pub(super) fn after(&self, py: Python<'_>, driven: PyResult<bool>) -> PyResult<bool> {
        match self.host.as_ref().and_then(|host| host.aborted(py)) {
            Some(raised) => Err(raised),
            None => driven,
        }
    }
}
