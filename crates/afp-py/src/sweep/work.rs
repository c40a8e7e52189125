//! Does runs in threads, and hands their outcomes to the thread that asked for them.

use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::thread;
use std::time::Duration;

use afp_sweep::{Engine, Outcome, Setting, Watch, columns};
use pyo3::prelude::*;

use super::watch::Watching;
use super::{Sweeper, graph, with_setting};
use crate::component::{Components, may_sweep};
use crate::errors::run_error;
use crate::pause::attached;

/// How often signals are looked at while no outcome comes.
const EVERY: Duration = Duration::from_millis(30);
/// For so many looks a component may go on when its run is called off; then it is interrupted.
const PATIENCE: u32 = 10;
/// Outcomes that may wait until this thread has told of them: those with runs of which figures are taken are large.
const WAITING: usize = 64;

impl Sweeper {
    /// Does runs; hands their outcomes to `each`, several at once if they come fast. What `each` or a handler
    /// of a signal raises ends it; runs that have not ended then are not done. `judge` gives further figures of each run,
    /// in this thread.
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
        with_setting(py, &self.toolboxes, |robot, components| {
            let mut sweep = self.sweep.clone();
            let graph = graph(&self.compiled)?;
            let setting = Setting::new(&mut sweep, graph, &self.file, robot);
            let setting = setting.map_err(|why| run_error(&why))?;
            let stop = AtomicBool::new(false);
            let (sweep, setting, compiled) = (&sweep, &setting, &self.compiled);
            let watching = judge.map(|judge| Watching {
                sweep,
                setting,
                graph,
                compiled,
                judge,
                columns: columns(sweep, &[]).into_iter().map(|it| it.name).collect(),
                kept: Mutex::default(),
            });
            let watch = watching.as_ref().map(|it| it as &dyn Watch);
            let engine =
                Engine { sweep, maker: &|row| setting.make(row), jobs, stop: &stop, watch };
            let each = |py: Python<'_>, mut news: Vec<Outcome>| {
                for outcome in &mut news {
                    watching.as_ref().map_or(Ok(()), |it| it.judge(py, outcome))?;
                }
                each(py, news)
            };
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
        let (send, outcomes) = sync_channel(WAITING);
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
                attached(|py| components.interrupt(py))?;
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
        attached(|py| {
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
