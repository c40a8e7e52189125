//! Executes runs in threads, and passes their outcomes to the calling thread.
//!
//! The threads own all their data, so a hanging component does not block the caller.

use std::panic::resume_unwind;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use afp_dsl::Compiled;
use afp_run::RunError;
use afp_sweep::{Engine, Outcome, Setting, Sweep, Watch};
use pyo3::prelude::*;

use super::watch::{Judging, Keeping, Kept};
use super::{Sweeper, graph, with_setting};
use crate::attach::attached;
use crate::component::{AnyRegistry, Components, interruption, may_sweep};
use crate::errors::run_error;
use crate::leave::{Call, may_begin};
use crate::link::link;

/// The interval of signal checks without outcomes.
const EVERY: Duration = Duration::from_millis(15);
/// The time in which a cancelled run may end before its component is interrupted.
const PATIENCE: Duration = Duration::from_millis(15);
/// The time after which an unresponsive component is abandoned. Each time this thread wants the
/// interpreter, every running component keeps it for some milliseconds more.
const LEFT: Duration = Duration::from_millis(35);
/// The interval of these checks.
const LOOK: Duration = Duration::from_millis(2);
/// The most outcomes in the queue; with metrics they hold large runs.
const WAITING: usize = 64;

impl Sweeper {
    /// Executes runs and passes their outcomes to `each`, several at once if they come fast. An
    /// exception of `each` or a signal handler ends it, and unfinished runs are not done. `judge`
    /// computes metrics of each run, in this thread.
    pub(super) fn work(
        &self,
        py: Python<'_>,
        runs: &[u64],
        jobs: usize,
        judge: Option<&Py<PyAny>>,
        mut each: impl FnMut(Python<'_>, Vec<Outcome>) -> PyResult<()> + Send,
    ) -> PyResult<()> {
        runs.iter().try_for_each(|run| self.row(*run).map(drop))?;
        may_sweep()?;
        if !self.toolboxes.is_empty() {
            may_begin()?;
        }
        let graph = graph(&self.compiled)?;
        let mut job = Job {
            compiled: Arc::clone(&self.compiled),
            components: Arc::new(Components::new(py, &self.toolboxes, &self.compiled)?),
            sweep: self.sweep.clone(),
            file: self.file.clone(),
            runs: runs.to_vec(),
            jobs,
            stop: Arc::default(),
            kept: None,
        };
        let Some(judge) = judge else { return drive(py, job, each) };
        let kept = Arc::new(Kept::default());
        job.kept = Some(Arc::clone(&kept));
        with_setting(py, &self.toolboxes, &self.compiled, |robot| {
            let mut sweep = self.sweep.clone();
            let setting = Setting::new(&mut sweep, graph, &self.file, robot);
            let setting = &setting.map_err(|why| run_error(&why))?;
            let (sweep, compiled, metrics) = (&sweep, &self.compiled, &*self.metrics);
            let judging = Judging { sweep, setting, compiled, judge, metrics, kept: &kept };
            drive(py, job, |py: Python<'_>, mut new: Vec<Outcome>| {
                new.iter_mut().try_for_each(|outcome| judging.judge(py, outcome))?;
                each(py, new)
            })
        })
    }
}

/// Runs to execute, with all their inputs.
struct Job {
    compiled: Arc<Compiled>,
    components: Arc<Components>,
    sweep: Sweep,
    file: PathBuf,
    runs: Vec<u64>,
    jobs: usize,
    /// Cancels everything when true.
    stop: Arc<AtomicBool>,
    /// The runs whose metrics are pending.
    kept: Option<Arc<Kept>>,
}

impl Job {
    /// Executes the runs while their outcomes are wanted.
    fn run(mut self, send: &SyncSender<Outcome>) -> Result<(), RunError> {
        let Some(graph) = &self.compiled.graph else { return Ok(()) };
        let more = |registry: &mut dyn AnyRegistry| self.components.register(registry);
        let robot = link().loader(&more);
        let setting = Setting::new(&mut self.sweep, graph, &self.file, &*robot)?;
        let keeping = self.kept.as_deref().map(|kept| Keeping { graph, kept });
        let watch = keeping.as_ref().map(|keeping| keeping as &dyn Watch);
        let (sweep, jobs, stop) = (&self.sweep, self.jobs, &*self.stop);
        let engine = Engine { sweep, maker: &|row| setting.make(row), jobs, stop, watch };
        engine.run(&self.runs, |outcome| send.send(outcome).is_ok());
        Ok(())
    }
}

/// Executes a job in another thread, while this one serves Python.
fn drive(
    py: Python<'_>,
    job: Job,
    each: impl FnMut(Python<'_>, Vec<Outcome>) -> PyResult<()> + Send,
) -> PyResult<()> {
    let (stop, components) = (Arc::clone(&job.stop), Arc::clone(&job.components));
    let call = Call::new(py, &stop, interruption(&components));
    let of_job = Arc::clone(&call);
    let attended = || {
        let (send, outcomes) = sync_channel(WAITING);
        let working = thread::spawn(move || {
            let done = job.run(&send);
            drop(of_job);
            done
        });
        let attended = attend(&outcomes, &components, each);
        drop(outcomes);
        if let Err(why) = attended {
            stop.store(true, Ordering::Relaxed);
            leave(&working, &components)?;
            return Err(why);
        }
        let done = working.join().unwrap_or_else(|panic| resume_unwind(panic));
        done.map_err(|why| run_error(&why))?;
        attached(|py| components.raised(py))
    };
    py.detach(|| call.run(attended))
}

/// Waits briefly for a cancelled job; interrupts a hanging component once.
fn leave<T>(working: &JoinHandle<T>, components: &Components) -> PyResult<()> {
    let begun = Instant::now();
    let wait_until = |end: Duration| {
        while !working.is_finished() && begun.elapsed() < end {
            thread::sleep(LOOK);
        }
        working.is_finished()
    };
    if !wait_until(PATIENCE) {
        attached(|py| components.interrupt(py))?;
        wait_until(LEFT);
    }
    Ok(())
}

fn attend(
    outcomes: &Receiver<Outcome>,
    components: &Components,
    mut each: impl FnMut(Python<'_>, Vec<Outcome>) -> PyResult<()>,
) -> PyResult<()> {
    loop {
        let new = match outcomes.recv_timeout(EVERY) {
            Ok(first) => std::iter::once(first).chain(outcomes.try_iter()).collect(),
            Err(RecvTimeoutError::Timeout) => Vec::new(),
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        };
        attached(|py| {
            if !new.is_empty() {
                each(py, new)?;
            }
            if components.is_over() {
                components.raised(py)?;
            }
            py.check_signals()
        })?;
    }
}
