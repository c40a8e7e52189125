//! A run that can be driven in pieces, with the same driver as everywhere.
//!
//! Between steps callers may read and write. The result depends only on the simulated times of
//! these writes.

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

pub struct Run {
    pub session: Box<dyn AnySession>,
    pub names: PlanNames,
    pub keeper: Keeper,
    pub track: Track,
    pub stopped_by: Option<&'static str>,
    pub pause: Pause,
    /// Its state for other threads.
    pub seen: Arc<Seen>,
    pub(super) own_entries: u32,
    process: u32,
    log: Option<SessionLog>,
    log_path: Option<PathBuf>,
}

impl Run {
    /// A run without a log.
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

    /// A run before its start, with a log.
    ///
    /// # Errors
    /// The log cannot be written.
    pub fn logged(session: Box<dyn AnySession>, setting: &Setting<'_>) -> PyResult<Run> {
        if let Some(folder) = setting.log.filter(|path| path.is_dir()) {
            let why = io::Error::new(io::ErrorKind::IsADirectory, "it is a folder");
            return Err(os_error("cannot write the log", folder, &why));
        }
        if setting.camera && setting.log.is_none() {
            let text = "the log has the camera's pictures, and there is no log: also give log=\"run.mcap\"";
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

    /// A copy of the run at this moment without its log, which continues independently; `None` if a
    /// component cannot be copied.
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

    /// Continues from another run's moment.
    ///
    /// # Errors
    /// The run is logged, and a log cannot be undone.
    pub fn restore(&mut self, mut other: Run) -> PyResult<()> {
        if self.log_path.is_some() {
            let text =
                "the simulation writes a log, which cannot be taken back; restore one without";
            return Err(PyRuntimeError::new_err(text));
        }
        // Stop requests and observers stay.
        mem::swap(&mut self.pause, &mut other.pause);
        mem::swap(&mut self.seen, &mut other.seen);
        mem::swap(self, &mut other);
        Ok(())
    }

    /// Publishes its state for other threads.
    pub fn show(&self) {
        self.seen.show(Glance {
            time: self.session.now().as_secs_f64(),
            pose: self.pose().ok(),
            ending: self.ending(),
            active: self.active(),
            driver: thread::current().id(),
        });
    }

    /// Drives the plan to its end or to `until`; with `stop`, stops it then. Returns whether it is
    /// still running.
    ///
    /// # Errors
    /// The plan cannot start, a request is rejected, or a signal handler raised.
    pub fn run(&mut self, until: Instant, stop: bool) -> PyResult<bool> {
        self.drive(until, usize::MAX)?;
        if stop && self.is_running() {
            self.stop("until");
        }
        self.ended_or_not()
    }

    /// Drives the plan until there are more than `seen` events, or to `until`; returns whether it
    /// is still running.
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

    /// Makes the plan's next step; returns whether it is still running.
    ///
    /// # Errors
    /// As [`Run::run`].
    #[inline]
    pub fn step(&mut self) -> PyResult<bool> {
        // Between steps Python checks signals; only a long step checks them here.
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

    /// Returns whether the plan is still running, and finishes the log at its end.
    fn ended_or_not(&mut self) -> PyResult<bool> {
        match self.is_running() {
            true => Ok(true),
            false => self.close().map(|_| false),
        }
    }

    /// The reason to stop the run; at intervals also publishes its state.
    fn look(&mut self) -> Option<Halt> {
        let halt = self.pause.look();
        if self.pause.is_long {
            self.show();
        }
        halt
    }

    /// Does the next action, unless the run must stop; returns whether it is still running.
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

    /// Rejects continuing a plan with a closed log.
    #[inline]
    pub fn is_open(&self) -> PyResult<()> {
        if self.log_path.is_some() && self.log.is_none() && self.is_running() {
            let text = "the simulation was closed with its log; make a new one";
            return Err(PyRuntimeError::new_err(text));
        }
        Ok(())
    }

    /// The reason why the plan cannot start.
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

    /// Calls the session with all its observers.
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

    /// Requests a stimulus; requests for the same instant are applied in order.
    ///
    /// # Errors
    /// It can never be applied.
    pub fn ask(&mut self, at: Instant, request: Request) -> Result<(), String> {
        self.session.at(at, request).map(|_| ()).map_err(|why| why.to_string())
    }

    /// The instants and components of exceptions, without sub-plans that passed them on.
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

    /// An instant that is not in the past, or now.
    pub fn moment(&self, at: Option<Instant>) -> PyResult<Instant> {
        self.is_open()?;
        match self.is_running() {
            true => Ok(at.unwrap_or(self.session.now())),
            false => Err(PyRuntimeError::new_err("the plan has ended")),
        }
    }

    /// Writes an entry: at once before the start, later at the next step.
    ///
    /// # Errors
    /// The value does not fit, or too many writes are pending.
    pub fn write(&mut self, entry: EntryId, value: Value) -> Result<(), String> {
        let written = self.session.write(entry, value);
        let about = self.session.names().entry(entry.into());
        written.map_err(|why| refusal(why, about))
    }

    /// The robot's true pose.
    ///
    /// # Errors
    /// It has no such signal.
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
            Some(Ending::Interrupted) if self.stopped_by == Some("until") => "time_limit",
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

    /// The robot's contacts: obstacle, first and last time.
    pub fn collisions(&self) -> Vec<(String, f64, f64)> {
        let figures = self.session.figures();
        let told = figures.spans("contacts").iter();
        told.map(|span| (span.name.clone(), span.begin.as_secs_f64(), span.end.as_secs_f64()))
            .collect()
    }

    /// Ends the log and returns its path.
    pub fn close(&mut self) -> PyResult<Option<PathBuf>> {
        let closed = self.log.take().map(|log| log.finish(&*self.session)).transpose();
        closed.map_err(|why| log_error(&why))?;
        Ok(self.log_path.clone())
    }
}

/// The error for a robot without a pose.
pub fn no_pose() -> PyErr {
    error("the robot has no position: it does not declare 'robot.pose'")
}

impl Drop for Run {
    fn drop(&mut self) {
        if self.process != forks::process() {
            // Its writer is a thread of the parent process.
            mem::forget(self.log.take());
            return;
        }
        // There is no receiver for an error here; close the simulation to see it.
        let _ = self.close();
    }
}
