//! `Runner`: a plan in a simulated world, driven from Python.

mod access;
mod driven;
mod event;
mod glance;
mod keeper;
mod lookup;
mod names;
mod session;
mod setting;
mod stimuli;
mod time;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use afp_core::devices::faults as faults_of;
use afp_core::trace::{Names as _, TraceEntryId};
use afp_core::{Duration, Instant};
use afp_dsl::Compiled;
use afp_log::svg::{SoFar, draw_run};
use afp_session::{Outlines, Request, SessionError, Track, Waypoint};
use numpy::PyArray2;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::{PyTraverseError, PyVisit};

use crate::attach::in_background;
use crate::component::{AnyRegistry, Components, Host};
use crate::errors::{error, log_error, plan_error};
use crate::forks;
use crate::link::{devices, fits, link};
use crate::plan::Plan;
use crate::sensed::table;
use crate::value::{Given, measured, no_pickle, to_python};
use crate::world::World;

pub use driven::Driven;
use event::line;
pub use event::{Event, plain, value};
use glance::Seen;
pub use keeper::Keeper;
pub use lookup::unknown_entry;
pub use names::Names;
pub use session::Run;
use session::no_pose;
pub use setting::{Setting, read_of};
pub use stimuli::{control, fault};
use time::some;
pub use time::{duration, instant};

/// A plan in a simulated world, the base of `afp.Simulation`.
#[pyclass(module = "afp", frozen)]
pub struct Runner {
    session: Mutex<Run>,
    host: Option<Arc<Host>>,
    stop: Arc<AtomicBool>,
    seen: Arc<Seen>,
    process: u32,
    compiled: Arc<Compiled>,
}

#[pymethods]
impl Runner {
    #[new]
    #[expect(clippy::too_many_arguments, reason = "a start condition of the run")]
    #[pyo3(signature = (plan, world, seed, set, settings, log, camera=false))]
    fn of_plan(
        py: Python<'_>,
        plan: &Plan,
        world: &World,
        seed: u64,
        set: &Bound<'_, PyDict>,
        settings: Vec<(String, String)>,
        log: Option<PathBuf>,
        camera: bool,
    ) -> PyResult<Self> {
        let compiled = plan.compiled(py)?;
        let graph = compiled.graph.as_ref().ok_or_else(|| plan_error(py, &compiled))?;
        let (file, toolboxes) = (plan.file(), plan.python_toolboxes(py));
        fits(&file)?;
        let components = Components::new(py, &toolboxes, &compiled)?;
        let more = |registry: &mut dyn AnyRegistry| components.register(registry);
        let world_file = world.read.as_deref();
        let world = &world.loaded;
        let session = link().loader(&more).session(graph, &*world.world, seed, &[]);
        let session = session.map_err(|why| no_session(&why))?;
        let host = components.host(py)?;
        let mut inputs = Vec::new();
        for (name, value) in set {
            let name: String = name.extract()?;
            inputs.push((Given::new(&value)?, name));
        }
        let (file, log) = (&*file, log.as_deref());
        let (compiled_as, settings) = (&compiled, &*settings);
        let setting = Setting {
            compiled: compiled_as,
            graph,
            world,
            seed,
            settings,
            file,
            world_file,
            log,
            camera,
        };
        let mut run = Run::logged(session, &setting)?;
        for (given, name) in inputs {
            let entry = run.entry(&name)?;
            let value = given.for_entry(&*run.session, entry)?;
            run.write(entry, value).map_err(|why| error(format!("'{name}': {why}")))?;
        }
        Ok(Runner::new(run, host, &compiled))
    }

    /// Run the plan until it ends or until a time; with `stop`, stop it at that time. Return
    /// whether it is still running.
    fn run(&self, py: Python<'_>, until: Option<f64>, stop: bool) -> PyResult<bool> {
        let until = until.map(instant).transpose()?;
        self.drive(py, |session| session.run(until.unwrap_or(Instant::MAX), stop))
    }

    /// Make one step of the plan; return whether it is still running.
    #[inline]
    fn step(&self, py: Python<'_>) -> PyResult<bool> {
        // Components attach to the interpreter themselves; without components, releasing it costs
        // more than a step.
        if self.host.is_none() {
            return self.lock()?.step();
        }
        self.drive(py, Run::step)
    }

    /// Continue until there are more than `seen` events, or until a time; return whether the plan
    /// is still running.
    fn listen(&self, py: Python<'_>, seen: usize, until: Option<f64>) -> PyResult<bool> {
        let until = until.map(instant).transpose()?.unwrap_or(Instant::MAX);
        self.drive(py, |session| session.listen(seen, until))
    }

    /// Request the plan to stop at its next step; callable from any thread.
    fn request_stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Request all stimuli of a logged run.
    fn repeat(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let log = py.detach(|| afp_log::read(&path)).map_err(|why| log_error(&why))?;
        log.recipe().ask(&mut *self.lock()?.session).map_err(error)
    }

    /// A copy of the run at this moment, which continues independently; it writes no log.
    fn keyframe(&self) -> PyResult<Runner> {
        let copied = self.lock()?.keyframe().ok_or_else(|| {
            error(
                "the plan has a component that cannot be copied, as those written in Python cannot",
            )
        });
        Ok(Runner::new(copied?, None, &self.compiled))
    }

    /// Continue from the moment of another run of the same plan.
    fn restore(&self, moment: &Runner) -> PyResult<()> {
        let run = moment.keyframe()?.session.into_inner();
        self.lock()?.restore(run.unwrap_or_else(PoisonError::into_inner))
    }

    /// The time in seconds.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        self.see(|run| Ok(run.session.now().as_secs_f64()), |glance| Ok(glance.time))
    }

    /// How the plan ended: `ok`, `interrupted`, `time_limit`, `error`; `running` before.
    #[getter]
    fn ending(&self) -> PyResult<&'static str> {
        self.see(|run| Ok(run.ending()), |glance| Ok(glance.ending))
    }

    /// The code and the text of the fault that ended the plan.
    #[getter]
    fn fault(&self) -> PyResult<Option<(&'static str, String)>> {
        Ok(self.lock()?.fault())
    }

    /// The reason why the plan stopped before its own end: `until` or `stop`.
    #[getter]
    fn stopped_by(&self) -> PyResult<Option<&'static str>> {
        Ok(self.lock()?.stopped_by)
    }

    /// The hash of the trace so far, as in `afpc run`.
    #[getter]
    fn trace_hash(&self) -> PyResult<String> {
        Ok(self.lock()?.session.trace().to_string())
    }

    /// The number of missed deadlines so far.
    #[getter]
    fn deadline_misses(&self) -> PyResult<u64> {
        Ok(self.lock()?.session.misses())
    }

    /// The path of the active element, without sub-plans.
    #[getter]
    fn active(&self) -> PyResult<Option<String>> {
        self.see(|run| Ok(run.active()), |glance| Ok(glance.active))
    }

    /// The number of events.
    #[getter]
    fn event_count(&self) -> PyResult<usize> {
        Ok(self.lock()?.keeper.happened.len())
    }

    /// The events from index `first` on.
    fn events(&self, first: usize) -> PyResult<Vec<Event>> {
        let session = self.lock()?;
        let news = session.keeper.happened.get(first..).unwrap_or_default();
        Ok(news.iter().map(|each| Event::new(each, &session.names)).collect())
    }

    /// The timeline as printed by `afpc run`.
    #[getter]
    fn timeline(&self) -> PyResult<Vec<String>> {
        let session = self.lock()?;
        let happened = session.keeper.happened.iter();
        Ok(happened.filter_map(|each| line(each, &session.names)).collect())
    }

    /// The robot's pose every 20 ms: time, x, y, heading.
    fn path<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let session = self.lock()?;
        let row = |point: &Waypoint| {
            [point.at.as_secs_f64(), point.pose.x, point.pose.y, point.pose.heading]
        };
        let path: Vec<_> = session.track.path.iter().map(row).collect();
        drop(session);
        table(py, &path)
    }

    /// The last outlines of moving things, in metres.
    fn things(&self) -> PyResult<Outlines> {
        Ok(self.lock()?.track.things.clone())
    }

    /// The names of the plan.
    #[getter]
    fn names(&self) -> PyResult<Names> {
        Ok(Names(self.lock()?.names.clone()))
    }

    /// The path so far over the world, as SVG.
    fn draw(&self, py: Python<'_>, plan: String, world: &World, seed: u64) -> PyResult<String> {
        let run = self.lock()?;
        let (track, names, time) = (run.track.clone(), run.names.clone(), run.session.now());
        drop(run);
        let (world, seed) = (Arc::clone(&world.loaded.world), seed.to_string());
        in_background(py, move || {
            let (plan, world, seed) = (&*plan, &*world, &*seed);
            let Track { path, marks, things, .. } = &track;
            draw_run(&SoFar { plan, world, seed, time, path, marks, things }, &names)
        })
    }

    /// The robot's pose: x, y, heading.
    #[getter]
    fn pose(&self) -> PyResult<(f64, f64, f64)> {
        let pose = self.see(Run::pose, |glance| glance.pose.ok_or_else(no_pose))?;
        Ok((pose.x, pose.y, pose.heading))
    }

    /// The robot's contacts: obstacle, first and last time.
    #[getter]
    fn collisions(&self) -> PyResult<Vec<(String, f64, f64)>> {
        Ok(self.lock()?.collisions())
    }

    /// The value of a sensor.
    fn sense<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let sensed = link().sense(self.lock()?.session.robot(), name, true)?;
        sensed.into_bound(py)
    }

    /// The entries by name.
    fn entries<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let session = self.lock()?;
        let names = session.own_entries();
        drop(session);
        let dict = PyDict::new(py);
        for name in names {
            dict.set_item(&name, self.get(py, &name)?)?;
        }
        Ok(dict)
    }

    /// The value of an entry.
    fn get<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let session = self.lock()?;
        let number = session.entry(name)?;
        let value = session.session.entry(number).to_value().map_err(error)?;
        let id = TraceEntryId::from(number);
        let names = session.names.clone();
        drop(session);
        to_python(py, value.as_deref(), |choice| names.choice(id, choice).to_owned())
    }

    /// Write an entry: before the start an `in` entry, later an `in` or `var` entry at the next
    /// step.
    #[pyo3(signature = (name, value, at=None))]
    fn set(&self, name: &str, value: &Bound<'_, PyAny>, at: Option<f64>) -> PyResult<()> {
        // This may run Python code that uses the simulation.
        let given = Given::new(value)?;
        let mut session = self.lock()?;
        let number = session.entry(name)?;
        let value = given.for_entry(&*session.session, number)?;
        session.is_open()?;
        if session.session.ending().is_some() {
            let text = "the plan has ended; its entries can no longer be set";
            return Err(PyRuntimeError::new_err(text));
        }
        let set = match at {
            None => session.write(number, value),
            Some(at) => session.ask(instant(at)?, Request::Write(number, value)),
        };
        set.map_err(|why| error(format!("'{name}': {why}")))
    }

    /// Hold a control for a while.
    fn hold(&self, control: Option<&str>, at: Option<f64>, time: f64) -> PyResult<()> {
        let control = self::control(control)?;
        let time = some("hold", time)?;
        let mut session = self.lock()?;
        let from = session.moment(at.map(instant).transpose()?)?;
        session.ask(from, Request::Hold(control, time)).map_err(error)
    }

    /// Inject a fault.
    #[pyo3(signature = (device, kind, at, lasting, delay, share))]
    fn fail(
        &self,
        device: &str,
        kind: &str,
        at: Option<f64>,
        lasting: Option<f64>,
        delay: Option<f64>,
        share: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let share = share.map(|share| measured("share", share, "")).transpose()?;
        let delay = delay.map(duration).transpose()?.map(Duration::as_secs_f64);
        let (fault, amount) = fault(device, kind, delay, share)?;
        let lasting = lasting.map(|time| some("lasting", time)).transpose()?;
        let lasting = lasting.unwrap_or(Duration::MAX);
        let mut session = self.lock()?;
        let from = session.moment(at.map(instant).transpose()?)?;
        session.ask(from, Request::Break(fault, amount, lasting)).map_err(error)
    }

    /// Make a component report an outcome with its outputs.
    fn fire(
        &self,
        component: &str,
        outcome: &str,
        outputs: &Bound<'_, PyDict>,
        at: Option<f64>,
    ) -> PyResult<()> {
        let (id, reported) = self.lock()?.reported(component, outcome)?;
        // Reading values may run Python, as above.
        let outputs = match &self.compiled.graph {
            Some(graph) => {
                stimuli::outputs(graph, (component, outcome, reported.number()), outputs)?
            }
            None => Vec::new(),
        };
        let mut session = self.lock()?;
        let from = session.moment(at.map(instant).transpose()?)?;
        session.ask(from, Request::Inject(id, reported, outputs)).map_err(error)
    }

    /// Make an actor, the actors of a sub-plan, or all of them do nothing from their next start on.
    fn idle(&self, element: Option<&str>, at: Option<f64>) -> PyResult<()> {
        let mut session = self.lock()?;
        let element = element.map(|path| session.element(path)).transpose()?;
        let from = session.moment(at.map(instant).transpose()?)?;
        session.ask(from, Request::Idle(element)).map_err(error)
    }

    /// End the log and return its path. A forked process has no log.
    fn close(&self) -> PyResult<Option<PathBuf>> {
        if self.process != forks::process() {
            return Ok(None);
        }
        self.lock()?.close()
    }

    /// The exceptions of components after the first `seen`: time, element or supervisor, template,
    /// exception.
    fn failures<'py>(
        &self,
        py: Python<'py>,
        seen: usize,
    ) -> Vec<(f64, String, String, Bound<'py, PyAny>)> {
        let failures = self.host.as_ref().map(|host| host.failures()).unwrap_or_default();
        // The trace has component and time, also for computations; it is inaccessible during a run.
        let run = self.lock().ok();
        let mut raised = run.as_ref().map(|run| run.raised().skip(seen));
        let each = failures.into_iter().map(|failure| {
            let known = raised.as_mut().and_then(Iterator::next);
            let (at, path) = known.unwrap_or((failure.at, ""));
            let error = failure.error.into_bound(py).into_any();
            (at.as_secs_f64(), path.to_owned(), failure.template, error)
        });
        each.collect()
    }

    fn __traverse__(&self, visit: PyVisit<'_>) -> Result<(), PyTraverseError> {
        self.host.as_ref().map_or(Ok(()), |host| host.traverse(&visit))
    }

    fn __clear__(&self) {
        if let Some(host) = &self.host {
            host.clear();
        }
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(no_pickle("Simulation", "make it again from its plan, world and seed"))
    }
}

/// The error for a plan that cannot be loaded.
fn no_session(why: &SessionError) -> PyErr {
    match why {
        SessionError::Load(_) => error(format!(
            "{why}\n  help: implement it in Python (see Toolbox); Rust of a project is linked by afp.use(\"its folder\"), before anything else"
        )),
        _ => error(format!("{why}\n  help: {}", why.help())),
    }
}

/// Every fault for `fail`: device and kind.
#[pyfunction]
pub fn faults() -> Vec<(&'static str, &'static str)> {
    faults_of(devices()).map(|(_, device, row)| (device.name, row.name)).collect()
}
