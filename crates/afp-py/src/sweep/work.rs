//! Does runs in threads, and hands their outcomes to the thread that asked for them.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use afp_sweep::{Engine, Outcome, Setting};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::{Sweeper, graph, with_setting};
use crate::component::{Components, may_sweep};
use crate::errors::run_error;

/// How often signals are looked at while no outcome comes.
const EVERY: Duration = Duration::from_millis(30);
/// For so many looks a component may go on when its run is called off; then it is interrupted.
const PATIENCE: u32 = 10;

impl Sweeper {
    /// Does runs; hands their outcomes to `each`, several at once if they come fast. What `each` or a handler
    /// of a signal raises ends it; runs that have not ended then are not done.
    pub(super) fn work(
        &self,
        py: Python<'_>,
        runs: &[u64],
        jobs: usize,
        each: impl FnMut(Python<'_>, Vec<Outcome>) -> PyResult<()> + Send,
    ) -> PyResult<()> {
        if let Some(run) = runs.iter().find(|run| **run >= self.sweep.len()) {
            let text = format!("there is no run {run}; the sweep has {}", self.sweep.len());
            return Err(PyValueError::new_err(text));
        }
        may_sweep()?;
        with_setting(py, &self.toolboxes, |robot, components| {
            let mut sweep = self.sweep.clone();
            let setting = Setting::new(&mut sweep, graph(&self.compiled)?, &self.file, robot);
            let setting = setting.map_err(|why| run_error(&why))?;
            let stop = AtomicBool::new(false);
            let engine =
                Engine { sweep: &sweep, maker: &|row| setting.make(row), jobs, stop: &stop };
            py.detach(|| drive(&engine, runs, components, each))
        })
    }
}

/// Runs the engine beside this thread, which attends to Python.
fn drive(
    engine: &Engine<'_>,
    runs: &[u64],
    components: &Components<'_>,
    each: impl FnMut(Python<'_>, Vec<Outcome>) -> PyResult<()>,
) -> PyResult<()> {
    thread::scope(|scope| {
        let (send, outcomes) = channel();
        let working = scope.spawn(move || engine.run(runs, |outcome| send.send(outcome).is_ok()));
        let attended = attend(&outcomes, components, each);
        // Whatever still runs is called off.
        engine.stop.store(attended.is_err(), Ordering::Relaxed);
        drop(outcomes);
        // A component that hangs does not look at that.
        let mut waited = 0;
        while attended.is_err() && !working.is_finished() {
            thread::sleep(EVERY);
            waited += 1;
            if waited >= PATIENCE {
                Python::attach(|py| components.interrupt(py))?;
            }
        }
        attended
    })
}

fn attend(
    outcomes: &Receiver<Outcome>,
    components: &Components<'_>,
    mut each: impl FnMut(Python<'_>, Vec<Outcome>) -> PyResult<()>,
) -> PyResult<()> {
    loop {
        let news = match outcomes.recv_timeout(EVERY) {
            Ok(first) => std::iter::once(first).chain(outcomes.try_iter()).collect(),
            Err(RecvTimeoutError::Timeout) => Vec::new(),
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        Python::attach(|py| {
            if !news.is_empty() {
                each(py, news)?;
            }
            if components.is_over() {
                components.raised(py)?;
            }
            py.check_signals()
        })?;
    }
}
