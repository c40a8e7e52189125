//! A run that can be driven bit by bit, in the one way in which plans are driven everywhere.
//!
//! Between steps anybody may look and write; what a run does depends only on the times at which that was.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::{io, mem};

use afp::load::PlanNames;
use afp_core::devices::find_signal;
use afp_core::trace::{ComponentKind, Ending, Names, Record};
use afp_core::{EntryId, Fault, Instant, StartError, Value};
use afp_dsl::graph::Graph;
use afp_log::{Recorder, SessionLog, WhenFull};
use afp_run::RunError;
use afp_run::inputs::missing;
use afp_session::{AnySession, Go, Next, Observer, Pose2, Request, SampleRef, Track, refusal};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use super::glance::{Glance, Seen};
use super::keeper::Keeper;
use super::setting::Setting;
use crate::component::{ENDED_ALL, RAISED};
use crate::errors::{error, log_error, os_error, run_error};
use crate::forks;
use crate::pause::{Halt, Pause};

/// A run.
pub struct Run {
    pub session: Box<dyn AnySession>,
    pub names: PlanNames,
    pub keeper: Keeper,
    pub track: Track,
    pub stopped_by: Option<&'static str>,
    pub pause: Pause,
    /// What other threads see of it meanwhile.
    pub seen: Arc<Seen>,
    pub(super) own_entries: u32,
    process: u32,
    log: Option<SessionLog>,
    log_path: Option<PathBuf>,
}

impl Run {
    /// A run of which nobody keeps a log.
    pub fn new(session: Box<dyn AnySession>, graph: &Graph) -> Run {
        let own_entries = graph.main().entries.len();
        Run {
            keeper: Keeper::default(),
            track: Track::new(session.devices()),
            session,
            names: PlanNames::new(graph),
            stopped_by: None,
            pause: Pause::of_signals(),
            seen: Arc::default(),
            own_entries: u32::try_from(own_entries).unwrap_or(u32::MAX),
            process: forks::process(),
            log: None,
            log_path: None,
        }
    }

    /// A run about to start.
    ///
    /// # Errors
    /// Its log cannot be written.
    pub fn logged(session: Box<dyn AnySession>, setting: &Setting<'_>) -> PyResult<Run> {
        if let Some(folder) = setting.log.filter(|path| path.is_dir()) {
            let why = io::Error::new(io::ErrorKind::IsADirectory, "it is a folder");
            return Err(os_error("cannot write the log", folder, &why));
        }
        if setting.camera && setting.log.is_none() {
            let text = "what the camera sees goes into the log, and there is none: give log=\"run.mcap\", too";
            return Err(PyValueError::new_err(text));
        }
        setting.log.map_or(Ok(()), |log| setting.check_log(log)).map_err(|why| run_error(&why))?;
        let world = &setting.world.world;
        let log = setting.log.map(|path| {
            let names = session.owned_names();
            let recorder = Recorder::create(path, &setting.about(), names, WhenFull::Wait)?;
            Ok(SessionLog::new(recorder, session.devices(), world.scene(), setting.camera))
        });
        let log = log.transpose().map_err(|why| log_error(&why))?;
        let mut run = Run::new(session, setting.graph);
        (run.log, run.log_path) = (log, setting.log.map(Path::to_owned));
        Ok(run)
    }

    /// The same run at this moment, without its log, which goes on by itself; none where a component cannot be copied.
    pub fn keyframe(&self) -> Option<Run> {
        let happened = self.keeper.happened.clone();
        Some(Run {
            session: self.session.keyframe()?,
            names: self.names.clone(),
            keeper: Keeper { happened, refused: None },
            track: self.track.clone(),
            stopped_by: self.stopped_by,
            pause: Pause::of_signals(),
            seen: Arc::default(),
            own_entries: self.own_entries,
            process: forks::process(),
            log: None,
            log_path: None,
        })
    }

    /// Goes on from another run's moment.
    ///
    /// # Errors
    /// The run is logged: what a log says has happened.
    pub fn restore(&mut self, mut other: Run) -> PyResult<()> {
        if self.log_path.is_some() {
            let text =
                "the simulation writes a log, which cannot be taken back; restore one without";
            return Err(PyRuntimeError::new_err(text));
        }
        // Who asks it to stop, and who looks at it, stays.
        mem::swap(&mut self.pause, &mut other.pause);
        mem::swap(&mut self.seen, &mut other.seen);
        mem::swap(self, &mut other);
        Ok(())
    }

    /// Lets other threads see how far it is.
    pub fn show(&self) {
        self.seen.show(Glance {
            time: self.session.now().as_secs_f64(),
            pose: self.pose().ok(),
            ending: self.ending(),
            active: self.active(),
            driver: thread::current().id(),
        });
    }

    /// Drives the plan to its end or to `until`, where it is stopped if `stop` is set; whether it still runs.
    ///
    /// # Errors
    /// The plan cannot start; what a request or a handler of a signal raised.
    pub fn run(&mut self, until: Instant, stop: bool) -> PyResult<bool> {
        self.drive(until, usize::MAX)?;
        if stop && self.is_running() {
            self.stop("until");
        }
        self.ended_or_not()
    }

    /// Drives the plan until there are more than `seen` events, or to `until`; whether it still runs.
    ///
    /// # Errors
    /// As [`Run::run`].
    pub fn listen(&mut self, seen: usize, until: Instant) -> PyResult<bool> {
        self.drive(until, seen.saturating_add(1))?;
        self.ended_or_not()
    }

    fn drive(&mut self, until: Instant, enough: usize) -> PyResult<()> {
        while self.is_running()
            && self.keeper.happened.len() < enough
            && !self.session.is_over(until)
        {
            let halt = self.look();
            self.tick(until, halt)?;
        }
        Ok(())
    }

    /// Makes the plan's next step; whether it still runs.
    ///
    /// # Errors
    /// As [`Run::run`].
    #[inline]
    pub fn step(&mut self) -> PyResult<bool> {
        // Python looks at signals between two steps; here that is left to one that takes long.
        let mut halt = if self.pause.is_asked() { self.pause.asked() } else { None };
        loop {
            if halt.is_some() {
                self.tick(Instant::MAX, halt)?;
                return self.ended_or_not();
            }
            self.is_open()?;
            match self.with_observers(|session, to| session.next_step(to)) {
                Err(why) => return Err(self.no_start(why)),
                Ok(_) if self.keeper.refused.is_some() => {
                    return self.keeper.refused.take().map_or(Ok(true), Err);
                }
                Ok(Next::Step) => return Ok(true),
                Ok(Next::Ended) => return self.end(),
                Ok(Next::BeforeStep) => halt = self.look(),
            }
        }
    }

    /// The plan has ended.
    #[cold]
    fn end(&mut self) -> PyResult<bool> {
        self.session.end();
        self.ended_or_not()
    }

    /// Whether the plan still runs; where it does not, the log is finished, too.
    fn ended_or_not(&mut self) -> PyResult<bool> {
        match self.is_running() {
            true => Ok(true),
            false => self.close().map(|_| false),
        }
    }

    /// What halts the run; from time to time others see how far it is.
    fn look(&mut self) -> Option<Halt> {
        let halt = self.pause.look();
        if self.pause.is_long {
            self.show();
        }
        halt
    }

    /// Does the next thing, unless something halts the run; whether it still runs.
    fn tick(&mut self, limit: Instant, mut halt: Option<Halt>) -> PyResult<bool> {
        self.is_open()?;
        if halt.is_none() {
            self.with_observers(|session, to| {
                session.tick(limit, &mut afp_session::Open, to).map(|_: Go| ())
            })
            .map_err(|why| self.no_start(why))?;
            halt = self.keeper.refused.take().map(Halt::Raised);
        }
        match halt {
            Some(Halt::Asked) if self.is_running() => self.stop("stop"),
            Some(Halt::Aborted) if self.is_running() => {
                self.with_observers(|session, to| session.abort(Fault::PANIC, to));
            }
            Some(Halt::Raised(why)) => return Err(why),
            Some(Halt::Asked | Halt::Aborted) | None => {}
        }
        let running = self.is_running();
        if !running {
            self.session.end();
        }
        Ok(running)
    }

    /// Refuses to go on with a plan whose log is closed.
    #[inline]
    pub fn is_open(&self) -> PyResult<()> {
        if self.log_path.is_some() && self.log.is_none() && self.is_running() {
            let text = "the simulation was closed with its log; make a new one";
            return Err(PyRuntimeError::new_err(text));
        }
        Ok(())
    }

    /// Why the plan cannot start.
    #[cold]
    fn no_start(&self, why: StartError) -> PyErr {
        match (missing(why, &self.names), why) {
            (RunError::Usage { message, .. }, StartError::InputMissing(entry)) => {
                let path = self.names.entry(entry.into()).path;
                error(format!("{message}\n  help: give it one, set={{\"{path}\": ...}}"))
            }
            (other, _) => run_error(&other),
        }
    }

    /// Lets the session do something, with all who observe it.
    #[inline]
    fn with_observers<T>(
        &mut self,
        drive: impl FnOnce(&mut dyn AnySession, &mut [&mut dyn Observer]) -> T,
    ) -> T {
        let Run { session, keeper, track, log, .. } = self;
        match log {
            Some(log) => drive(&mut **session, &mut [keeper, track, log]),
            None => drive(&mut **session, &mut [keeper, track]),
        }
    }

    fn stop(&mut self, by: &'static str) {
        self.stopped_by = Some(by);
        self.with_observers(|session, to| session.stop(to));
    }

    fn is_running(&self) -> bool {
        self.session.ending().is_none()
    }

    /// Asks for something; what is asked for at one instant happens in that order.
    ///
    /// # Errors
    /// It can never be done.
    pub fn ask(&mut self, at: Instant, request: Request) -> Result<(), String> {
        self.session.at(at, request).map(|_| ()).map_err(|why| why.to_string())
    }

    /// The instants and components of what components in Python raised, sub-plans that passed it on left out.
    pub fn raised(&self) -> impl Iterator<Item = (Instant, &str)> {
        let names = &self.names;
        self.keeper.records().filter_map(|(at, record)| match record {
            Record::Faulted { component, fault, .. } if fault == RAISED => {
                let name = names.component(component);
                let inner = !matches!(name.kind, ComponentKind::Plan | ComponentKind::SubPlan);
                inner.then_some((at, name.path))
            }
            _ => None,
        })
    }

    /// An instant to come, or now.
    pub fn moment(&self, at: Option<Instant>) -> PyResult<Instant> {
        self.is_open()?;
        match self.is_running() {
            true => Ok(at.unwrap_or(self.session.now())),
            false => Err(PyRuntimeError::new_err("the plan has ended; nothing happens any more")),
        }
    }

    /// Writes an entry at once before the start, at the next step later.
    ///
    /// # Errors
    /// The value does not fit, or too many writes wait.
    pub fn write(&mut self, entry: EntryId, value: Value) -> Result<(), String> {
        let written = self.session.write(entry, value);
        let about = self.session.names().entry(entry.into());
        written.map_err(|why| refusal(why, about))
    }

    /// Where the robot truly is.
    ///
    /// # Errors
    /// It does not say.
    pub fn pose(&self) -> PyResult<Pose2> {
        let mut pose = None;
        if let Some(signal) = find_signal(self.session.devices(), "robot", "pose") {
            self.session.read(signal, &mut |sample| {
                if let SampleRef::Pose(frame) = sample {
                    pose = Some(frame.pose);
                }
            });
        }
        pose.ok_or_else(no_pose)
    }

    /// The active element of the outermost plan.
    pub fn active(&self) -> Option<String> {
        let active = self.session.active()?;
        Some(self.names.component(active).path.to_owned())
    }

    /// How the plan ended.
    pub fn ending(&self) -> &'static str {
        match self.session.ending() {
            None => "running",
            Some(Ending::Ok) => "ok",
            Some(Ending::Interrupted) => "interrupted",
            Some(Ending::Error(_)) => "error",
        }
    }

    /// The code and the text of the fault that ended the plan.
    pub fn fault(&self) -> Option<(&'static str, String)> {
        let Some(Ending::Error(fault)) = self.session.ending() else { return None };
        if fault == Fault::PANIC && self.pause.has_ended_all() {
            return Some((ENDED_ALL.code, ENDED_ALL.text.to_owned()));
        }
        let mut failed = self.keeper.records().rev().filter_map(|(_, record)| match record {
            Record::Faulted { fault: of, detail, .. } if of == fault => Some(detail),
            _ => None,
        });
        let text = fault.explained(failed.next().flatten(), &self.names).to_string();
        Some((fault.code(), text))
    }

    /// What the robot touched: obstacle, first and last time.
    pub fn collisions(&self) -> Vec<(String, f64, f64)> {
        let figures = self.session.figures();
        let told = figures.spans("contacts").iter();
        told.map(|span| (span.name.clone(), span.begin.as_secs_f64(), span.end.as_secs_f64()))
            .collect()
    }

    /// Ends the log; where it is.
    pub fn close(&mut self) -> PyResult<Option<PathBuf>> {
        let closed = self.log.take().map(|log| log.finish(&*self.session)).transpose();
        closed.map_err(|why| log_error(&why))?;
        Ok(self.log_path.clone())
    }
}

/// What to say of a robot without a pose.
pub fn no_pose() -> PyErr {
    error("the robot does not say where it is: it declares no 'robot.pose'")
}

impl Drop for Run {
    fn drop(&mut self) {
        if self.process != forks::process() {
            // Its writer is a thread of the process that was forked.
            mem::forget(self.log.take());
            return;
        }
        // Nobody is left to tell of a failure; whoever wants to know closes the simulation.
        let _ = self.close();
    }
}
