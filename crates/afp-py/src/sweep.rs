//! `Sweeper`: many runs of a plan, on the engine of `afpc sweep`.
//!
//! The runs go on in threads of the engine while the interpreter is free; components in Python take its lock in
//! turn. The calling thread looks at signals and tells how it goes. Outcomes travel as lines of JSON, those of the
//! journal, so that runs may be done by other processes.

mod given;
mod rows;
mod watch;
mod work;

use std::collections::HashSet;
use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};
use std::thread;

use afp::load::PlanNames;
use afp_core::Duration;
use afp_dsl::Compiled;
use afp_dsl::graph::Graph;
use afp_run::hash;
use afp_session::{Build, Loader};
use afp_sweep::{Header, Journal, JournalError, Outcome, OutputFiles, Parts, Row, Setting, Sweep};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::{PyTraverseError, PyVisit};

use crate::component::{AnyRegistry, Components};
use crate::errors::{error, plan_error, run_error};
use crate::link::{fits, link};
use crate::plan::Plan;
use crate::simulation::{Run, Runner, Setting as Begun};
use crate::toolbox::Toolbox;
use crate::value::no_pickle;
use crate::world::World;

use given::{GivenSeeds, GivenValues, GivenWorld};
pub use rows::alike;

/// A sweep: its grid, and the outcomes so far.
#[pyclass(module = "afp", frozen)]
pub struct Sweeper {
    compiled: Arc<Compiled>,
    file: PathBuf,
    toolboxes: Vec<Py<Toolbox>>,
    sweep: Sweep,
    /// The names of figures that are taken of each run.
    metrics: Vec<String>,
    header: Header,
    done: Mutex<Done>,
}

/// What has been done.
#[derive(Default)]
struct Done {
    outcomes: Vec<Outcome>,
    /// The numbers of their runs.
    runs: HashSet<u64>,
    journal: Option<Journal>,
    output: Option<OutputFiles>,
}

#[pymethods]
impl Sweeper {
    #[new]
    #[expect(clippy::too_many_arguments, reason = "what a sweep has")]
    #[pyo3(signature = (plan, worlds, seeds, vary, until, stimuli, metrics, parts))]
    fn new(
        py: Python<'_>,
        plan: &Plan,
        worlds: Vec<GivenWorld>,
        seeds: GivenSeeds,
        vary: Vec<(String, GivenValues)>,
        until: f64,
        stimuli: (Vec<String>, Vec<String>),
        metrics: Vec<String>,
        parts: Parts,
    ) -> PyResult<Self> {
        let compiled = plan.compiled(py)?;
        if compiled.graph.is_none() {
            return Err(plan_error(py, &compiled));
        }
        if !(until.is_finite() && until > 0.0) {
            return Err(PyValueError::new_err(format!("until is {until}; give seconds above 0")));
        }
        let (file, toolboxes) = (plan.file(), plan.python_toolboxes(py));
        fits(&file)?;
        let mut sweep = Sweep {
            caveat: plan.caveat(),
            presses: given::presses(&stimuli.0)?,
            failures: given::failures(&stimuli.1)?,
            plan: file.display().to_string(),
            worlds: given::rooms(worlds),
            axes: Vec::new(),
            seeds: seeds.seeds()?,
            until: Duration::from_secs_f64(until),
        };
        let header = with_setting(py, &toolboxes, &compiled, |robot| {
            let graph = graph(&compiled)?;
            let names = PlanNames::new(graph);
            let axes = vary.into_iter().map(|(name, values)| values.axis(&names, name));
            sweep.axes = axes.collect::<PyResult<_>>()?;
            if sweep.is_empty() {
                let text = "there is nothing to run: no worlds, seeds or values";
                return Err(PyValueError::new_err(text));
            }
            let setting = Setting::new(&mut sweep, graph, &file, robot);
            let setting = setting.map_err(|why| run_error(&why))?;
            given::check_metrics(&metrics, &sweep)?;
            let header = Header::new(program(py)?, (&compiled, graph), &setting, &sweep);
            Ok(header.with(parts))
        })?;
        Ok(Sweeper { compiled, file, toolboxes, sweep, metrics, header, done: Mutex::default() })
    }

    /// How many runs there are.
    #[getter]
    fn total(&self) -> u64 {
        self.sweep.len()
    }

    /// Whether its runs call nothing that is written in Python.
    #[getter]
    fn is_quiet(&self) -> bool {
        self.toolboxes.is_empty()
    }

    /// What makes it this sweep: program, plan, worlds, grid and what is written in Python, as in its journal, all but the
    /// first by its hash. What Python reads is left out: where runs are done by other processes it goes along.
    #[getter]
    fn identity(&self) -> String {
        let Header { program, plan, worlds, grid, parts, .. } = &self.header;
        let parts: String =
            parts.iter().map(|(name, (does, _))| format!(", {name} {does}")).collect();
        format!("{program} {plan} {worlds} {}{parts}", hash(grid))
    }

    /// Keeps outcomes in a journal beside the table `out`, and takes up those that are there.
    fn open(&self, out: &str, restart: bool) -> PyResult<()> {
        let output = OutputFiles::new(Some(Path::new(out)), &self.file, &self.header);
        let output = output.map_err(|why| run_error(&why))?;
        let journal = Journal::open(&output.journal, &self.header, restart);
        let (journal, outcomes) = journal.map_err(|why| no_journal(&why))?;
        let done = &mut *self.lock()?;
        let runs = outcomes.iter().map(|outcome| outcome.run).collect();
        *done = Done { outcomes, runs, journal: Some(journal), output: Some(output) };
        Ok(())
    }

    /// The numbers of the runs that are not done.
    fn left(&self) -> PyResult<Vec<u64>> {
        let done = self.lock()?;
        Ok((0..self.sweep.len()).filter(|run| !done.runs.contains(run)).collect())
    }

    /// Does runs and keeps their outcomes; tells `progress` how many of this call are done, and `on_run` the row of
    /// each. `judge` gives further figures of a run: its number, its end, its world and its seed go in, numbers by name
    /// come out.
    #[pyo3(signature = (runs, jobs=None, progress=None, on_run=None, judge=None))]
    fn run(
        &self,
        py: Python<'_>,
        runs: Vec<u64>,
        jobs: Option<NonZero<usize>>,
        progress: Option<Py<PyAny>>,
        on_run: Option<Py<PyAny>>,
        judge: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let mut done = self.lock()?;
        let done = &mut *done;
        let mut reported = 0_usize;
        self.work(py, &runs, cores(jobs), judge.as_ref(), |py, new| {
            reported += new.len();
            let rows = self.rows(py, &new, on_run.as_ref())?;
            done.keep(new)?;
            report(py, on_run.as_ref(), rows)?;
            progress.as_ref().map_or(Ok(()), |tell| tell.call1(py, (reported,)).map(drop))
        })
    }

    /// Does runs for another process; their outcomes as lines of JSON.
    #[pyo3(signature = (runs, jobs=None, judge=None))]
    fn lines(
        &self,
        py: Python<'_>,
        runs: Vec<u64>,
        jobs: Option<NonZero<usize>>,
        judge: Option<Py<PyAny>>,
    ) -> PyResult<Vec<String>> {
        let mut lines = Vec::with_capacity(runs.len());
        self.work(py, &runs, cores(jobs), judge.as_ref(), |_, new| {
            for outcome in &new {
                lines.push(serde_json::to_string(outcome).map_err(error)?);
            }
            Ok(())
        })?;
        Ok(lines)
    }

    /// Keeps outcomes of another process, and passes their rows to `on_run`; those of runs that are done are dropped. How many
    /// were new.
    #[pyo3(signature = (lines, on_run=None))]
    fn accept(
        &self,
        py: Python<'_>,
        lines: Vec<String>,
        on_run: Option<Py<PyAny>>,
    ) -> PyResult<usize> {
        let mut done = self.lock()?;
        let (mut new, mut runs) = (Vec::new(), HashSet::new());
        for line in &lines {
            let outcome: Outcome = serde_json::from_str(line).map_err(error)?;
            let run = outcome.run;
            if run < self.sweep.len() && !done.runs.contains(&run) && runs.insert(run) {
                new.push(outcome);
            }
        }
        let count = new.len();
        let rows = self.rows(py, &new, on_run.as_ref())?;
        done.keep(new)?;
        report(py, on_run.as_ref(), rows)?;
        Ok(count)
    }

    /// A run about to begin again, and its world; its log is written to a file, perhaps with what the camera sees.
    #[pyo3(signature = (run, log=None, camera=false))]
    fn runner(
        &self,
        py: Python<'_>,
        run: u64,
        log: Option<PathBuf>,
        camera: bool,
    ) -> PyResult<(Runner, World)> {
        let row = self.row(run)?;
        let graph = graph(&self.compiled)?;
        let components = Components::new(py, &self.toolboxes, &self.compiled)?;
        let (session, loaded) = {
            let more = |registry: &mut dyn AnyRegistry| components.register(registry);
            let loader = link().loader(&more);
            let mut sweep = self.sweep.clone();
            let setting = Setting::new(&mut sweep, graph, &self.file, &*loader);
            let setting = setting.map_err(|why| run_error(&why))?;
            let made = setting.world(&row).and_then(|world| Ok((setting.make(&row)?, world)));
            made.map_err(|why| run_error(&why))?
        };
        let host = components.host(py)?;
        let (world, log) = (&loaded, log.as_deref());
        let (file, compiled) = (&*self.file, &self.compiled);
        let settings =
            row.values.iter().map(|(name, point)| ((*name).to_owned(), point.text.clone()));
        let settings = &*settings.collect::<Vec<_>>();
        let seed = row.seed;
        let world_file = world.path.as_deref();
        let setting =
            Begun { compiled, graph, world, seed, settings, file, world_file, log, camera };
        let runner = Runner::new(Run::logged(session, &setting)?, host, &self.compiled);
        Ok((runner, World::new(loaded)))
    }

    /// Writes the table, if it is written anywhere, and closes the journal; its paths.
    fn write(&self) -> PyResult<Vec<PathBuf>> {
        let mut done = self.lock()?;
        let kept = done.journal.take().map_or(Ok(()), Journal::close);
        let Some(output) = &done.output else { return Ok(Vec::new()) };
        let written = output.write(&self.sweep, &done.sorted());
        written.and(kept).map_err(|why| run_error(&why))?;
        Ok(output.tables.iter().map(|(path, _)| path.clone()).collect())
    }

    /// The outcomes so far by column, in the order of the runs; the second of a pair is the type.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        rows::columns(py, &self.sweep, &self.lock()?.sorted())
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.toolboxes.iter().try_for_each(|toolbox| visit.call(toolbox))
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(no_pickle("Sweeper", "make it anew from what it was made of"))
    }
}

impl Sweeper {
    /// A run by its number.
    fn row(&self, run: u64) -> PyResult<Row<'_>> {
        if run >= self.sweep.len() {
            let text = format!("there is no run {run}; the sweep has {}", self.sweep.len());
            return Err(PyValueError::new_err(text));
        }
        Ok(self.sweep.row(run))
    }

    /// The rows of outcomes, where somebody wants them.
    fn rows<'py>(
        &self,
        py: Python<'py>,
        outcomes: &[Outcome],
        wanted: Option<&Py<PyAny>>,
    ) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let outcomes = wanted.map_or(&[][..], |_| outcomes);
        outcomes.iter().map(|outcome| rows::row(py, &self.sweep, outcome)).collect()
    }

    fn lock(&self) -> PyResult<MutexGuard<'_, Done>> {
        match self.done.try_lock() {
            Ok(done) => Ok(done),
            Err(TryLockError::Poisoned(done)) => Ok(done.into_inner()),
            Err(TryLockError::WouldBlock) => {
                Err(PyRuntimeError::new_err("the sweep is running in another call"))
            }
        }
    }
}

impl Done {
    /// Keeps outcomes, in the journal too.
    fn keep(&mut self, new: Vec<Outcome>) -> PyResult<()> {
        for outcome in new {
            if let Some(journal) = &mut self.journal {
                journal.keep(&outcome).map_err(|why| run_error(&why))?;
            }
            self.runs.insert(outcome.run);
            self.outcomes.push(outcome);
        }
        Ok(())
    }

    fn sorted(&self) -> Vec<Outcome> {
        let mut all = self.outcomes.clone();
        all.sort_by_key(|outcome| outcome.run);
        all
    }
}

/// Lets something be done with what registers the components in Python.
fn with_setting<T>(
    py: Python<'_>,
    toolboxes: &[Py<Toolbox>],
    compiled: &Compiled,
    use_it: impl FnOnce(&dyn Loader) -> PyResult<T>,
) -> PyResult<T> {
    let components = Components::new(py, toolboxes, compiled)?;
    let more = |registry: &mut dyn AnyRegistry| components.register(registry);
    let used = use_it(&*link().loader(&more));
    components.raised(py)?;
    used
}

/// The graph of a plan that has one.
fn graph(compiled: &Compiled) -> PyResult<&Graph> {
    compiled.graph.as_ref().ok_or_else(|| error("the plan has errors"))
}

/// What runs the plans: with parts of a project, what the extension was built from counts too. `afpc sweep` goes on with a
/// journal of plans without components in Python, on the Carbot with built-in toolboxes.
fn program(py: Python<'_>) -> PyResult<String> {
    let mut program = Build::this().to_string();
    if link().own_robot().is_some() || !link().toolboxes().is_empty() {
        let extension: PathBuf = py.import("afp._afp")?.getattr("__file__")?.extract()?;
        program += &format!(" {}", hash(&String::from_utf8_lossy(&fs::read(extension)?)));
    }
    Ok(program)
}

/// Why a journal cannot be used, and what to do about it from Python.
fn no_journal(why: &JournalError) -> PyErr {
    let help = match why {
        JournalError::File(why) => return run_error(why),
        JournalError::InUse(_) => "wait for it, or give another 'out'",
        _ => "restart=True begins anew and drops what is there; another 'out' keeps both",
    };
    error(format!("{why}\n  help: {help}"))
}

/// Passes rows to a function of Python, one after the other.
fn report(py: Python<'_>, to: Option<&Py<PyAny>>, rows: Vec<Bound<'_, PyDict>>) -> PyResult<()> {
    let Some(to) = to else { return Ok(()) };
    rows.into_iter().try_for_each(|row| to.call1(py, (row,)).map(drop))
}

fn cores(jobs: Option<NonZero<usize>>) -> usize {
    jobs.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZero::get)
}
