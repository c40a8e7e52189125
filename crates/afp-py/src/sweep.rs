//! `Sweeper`: many runs of a plan, on the engine of `afpc sweep`.
//!
//! The runs use the engine's threads while the interpreter is released; components in Python take
//! its lock in turn. The calling thread checks signals and reports progress. Outcomes are passed as
//! the journal's lines of JSON, so that other processes can do runs.

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
use afp_sweep::{
    Axis, Header, Journal, JournalError, Outcome, OutputFiles, Parts, Row, Setting, Sweep,
    varies_stimuli,
};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::{PyTraverseError, PyVisit};

use crate::callout;
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
    /// The names of the metrics of each run.
    metrics: Vec<String>,
    header: Header,
    done: Mutex<Done>,
}

/// The finished runs.
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
    #[expect(clippy::too_many_arguments, reason = "a part of a sweep")]
    #[pyo3(signature = (plan, worlds, seeds, vary, until, stimuli, metrics, parts))]
    fn new(
        py: Python<'_>,
        plan: &Plan,
        worlds: (Vec<GivenWorld>, bool),
        seeds: GivenSeeds,
        vary: Vec<(String, GivenValues, bool)>,
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
        let seeds = seeds.seeds()?;
        let (worlds, worlds_by_seed) = worlds;
        let mut sweep = Sweep {
            caveat: plan.caveat(),
            presses: given::presses(&stimuli.0)?,
            failures: given::failures(&stimuli.1)?,
            plan: file.display().to_string(),
            worlds: given::rooms(worlds, worlds_by_seed.then_some(&seeds)),
            worlds_by_seed,
            axes: Vec::new(),
            seeds,
            until: Duration::from_secs_f64(until),
        };
        let header = with_setting(py, &toolboxes, &compiled, |robot| {
            let graph = graph(&compiled)?;
            let names = PlanNames::new(graph);
            let known = graph.main().entries.iter().map(|entry| entry.name.clone());
            let known: Vec<String> = known.collect();
            let axes = vary.into_iter().map(|(name, values, by_seed)| {
                Ok(Axis { by_seed, ..values.axis(&names, &known, name)? })
            });
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

    /// The number of runs.
    #[getter]
    fn total(&self) -> u64 {
        self.sweep.len()
    }

    /// Whether its runs call no Python code.
    #[getter]
    fn is_quiet(&self) -> bool {
        self.toolboxes.is_empty()
    }

    /// The identity of the sweep: program, plan, worlds, grid and Python code, as in its journal,
    /// all but the first by its hash. Files read by Python are not included; they are sent along to
    /// other processes.
    #[getter]
    fn identity(&self) -> String {
        let Header { program, plan, worlds, grid, parts, .. } = &self.header;
        let parts: String =
            parts.iter().map(|(name, (does, _))| format!(", {name} {does}")).collect();
        format!("{program} {plan} {worlds} {}{parts}", hash(grid))
    }

    /// Keep outcomes in a journal next to the table `out`, and load earlier ones.
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

    /// The numbers of the remaining runs.
    fn left(&self) -> PyResult<Vec<u64>> {
        let done = self.lock()?;
        Ok((0..self.sweep.len()).filter(|run| !done.runs.contains(run)).collect())
    }

    /// Do runs and keep their outcomes. `progress` receives the number of runs done by this call,
    /// and `on_run` the row of each. `judge` computes metrics: it receives the run's number,
    /// simulation, world and seed, and returns numbers by name.
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
            progress
                .as_ref()
                .map_or(Ok(()), |tell| callout::call(tell.bind(py), (reported,)).map(drop))
        })
    }

    /// Do runs for another process and return their outcomes as lines of JSON.
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

    /// Keep outcomes of another process, and pass their rows to `on_run`. Drop outcomes of finished
    /// runs, and return the number of new ones.
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

    /// A run at its start, and its world; optionally with a log and the camera's pictures.
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
        let settings = row.values.iter().filter(|(name, _)| !varies_stimuli(name));
        let settings = settings.map(|(name, point)| ((*name).to_owned(), point.text.clone()));
        let settings = &*settings.collect::<Vec<_>>();
        let seed = row.seed;
        let world_file = world.path.as_deref();
        let setting =
            Begun { compiled, graph, world, seed, settings, file, world_file, log, camera };
        let runner = Runner::new(Run::logged(session, &setting)?, host, &self.compiled);
        Ok((runner, World::new(loaded)))
    }

    /// Write the table, if one is wanted, and close the journal; return the paths.
    fn write(&self) -> PyResult<Vec<PathBuf>> {
        let mut done = self.lock()?;
        let kept = done.journal.take().map_or(Ok(()), Journal::close);
        let Some(output) = &done.output else { return Ok(Vec::new()) };
        let written = output.write(&self.sweep, &done.sorted());
        written.and(kept).map_err(|why| run_error(&why))?;
        Ok(output.tables.iter().map(|(path, _)| path.clone()).collect())
    }

    /// The outcomes so far by column, in the order of runs; each pair ends with the type.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        rows::columns(py, &self.sweep, &self.lock()?.sorted())
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.toolboxes.iter().try_for_each(|toolbox| visit.call(toolbox))
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(no_pickle("Sweeper", "create it again from its plan, seeds and worlds"))
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

    /// The rows of outcomes, if there is a callback.
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
    /// Keeps outcomes, also in the journal.
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

/// Calls a function with the registration of the components in Python.
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

/// The graph of a valid plan.
fn graph(compiled: &Compiled) -> PyResult<&Graph> {
    compiled.graph.as_ref().ok_or_else(|| error("the plan has errors"))
}

/// The identity of the program; with parts of a project it includes the sources of the extension.
/// `afpc sweep` resumes a journal if the plan has only built-in toolboxes and no components in
/// Python, on the Carbot.
fn program(py: Python<'_>) -> PyResult<String> {
    let mut program = Build::this().to_string();
    if link().own_robot().is_some() || !link().toolboxes().is_empty() {
        let extension: PathBuf = py.import("afp._afp")?.getattr("__file__")?.extract()?;
        program += &format!(" {}", hash(&String::from_utf8_lossy(&fs::read(extension)?)));
    }
    Ok(program)
}

/// The error for an unusable journal, with help for Python.
fn no_journal(why: &JournalError) -> PyErr {
    let help = match why {
        JournalError::File(why) => return run_error(why),
        JournalError::InUse(_) => "wait for it, or give another 'out'",
        _ => "restart=True starts again and deletes the old outcomes; a different 'out' keeps both",
    };
    error(format!("{why}\n  help: {help}"))
}

/// Passes rows to a Python function one by one.
fn report(py: Python<'_>, to: Option<&Py<PyAny>>, rows: Vec<Bound<'_, PyDict>>) -> PyResult<()> {
    let Some(to) = to else { return Ok(()) };
    rows.into_iter().try_for_each(|row| callout::call(to.bind(py), (row,)).map(drop))
}

fn cores(jobs: Option<NonZero<usize>>) -> usize {
    jobs.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZero::get)
}
