//! Drives a session to the end of its run, and handles keys, signals and viewers on the way.

use std::io;
use std::panic::resume_unwind;
use std::thread;

use afp_core::trace::Names;
use afp_core::{Duration, Instant, StartError};
use afp_project::Realtime;
use afp_session::{AnySession, Figures, Go, Observer, QueueReader, Steering, Watch, Wire, queue};

use super::gate::{Halt, RunGate};
use super::realtime;
use crate::error::RunError;
use crate::inputs;
use crate::live::Live;
use crate::options::TimeKeeper;
use crate::report::StoppedBy;
use crate::requests;
use crate::stop::StopFlag;
use crate::watchdog::Watchdog;

/// The maximum sleep of a real robot between two looks at keys and signals.
const SLICE: Duration = Duration::from_millis(10);

/// The period in which the observers of a real robot look at their queue, unless they are woken.
const LOOK: std::time::Duration = std::time::Duration::from_millis(400);

/// An observer that may work on another thread.
pub(super) type AnyObserver<'a> = dyn Observer + Send + 'a;

/// The start of a watchdog.
type StartWatchdog = Box<dyn FnOnce() -> io::Result<Watchdog>>;

/// Starts the watchdog of a control loop, which may be late by less than a limit.
pub(super) fn watchdog(
    (watch, stall): (Watch, Duration),
    realtime: Realtime,
    stop: StopFlag,
    names: Box<dyn Names + Send>,
) -> StartWatchdog {
    Box::new(move || Watchdog::start(watch, stall, realtime.priority, stop, names))
}

/// The driver of a session.
pub(super) struct Driver<'a> {
    /// The watchdog of a real robot.
    pub watchdog: Option<StartWatchdog>,
    pub realtime: Realtime,
    pub keeper: TimeKeeper,
    /// The time at which the plan is stopped.
    pub end: Instant,
    pub live: Option<&'a dyn Live>,
    /// The parts of a debugger on the control thread.
    pub debugger: Option<(Wire, Steering)>,
}

/// A session at the end of its run.
pub(super) struct Driven {
    pub stopped_by: Option<StoppedBy>,
    pub measured: Figures,
    /// The number of items that a full queue lost before the observers.
    pub lost: u64,
}

/// Stops the robot, also if a panic ends the run.
struct Stop<'a>(&'a mut dyn AnySession);

impl Drop for Stop<'_> {
    fn drop(&mut self) {
        self.0.end();
    }
}

impl Driver<'_> {
    /// Runs the plan to its end, or until it is stopped, and stops the robot. The observers of a
    /// real robot have their own thread.
    ///
    /// # Errors
    /// The plan or the thread cannot start.
    pub fn drive(
        mut self,
        session: &mut dyn AnySession,
        gate: &mut RunGate<'_>,
        observers: &mut [&mut AnyObserver<'_>],
    ) -> Result<Driven, RunError> {
        if matches!(self.keeper, TimeKeeper::Robot) {
            return self.drive_apart(session, gate, observers);
        }
        let (mut wire, steering) = self.debugger.take().unzip();
        let mut observers = plain(observers);
        observers.extend(wire.iter_mut().map(|wire| wire as &mut dyn Observer));
        let went = self.run_to_end(session, gate, steering, &mut observers);
        let measured = session.end();
        let stopped_by = went.map_err(|error| inputs::missing(error, session.names()))?;
        Ok(Driven { stopped_by, measured, lost: 0 })
    }

    /// Drives a session with a queue before its observers.
    fn drive_apart(
        mut self,
        session: &mut dyn AnySession,
        gate: &mut RunGate<'_>,
        observers: &mut [&mut AnyObserver<'_>],
    ) -> Result<Driven, RunError> {
        let (writer, reader) = queue(session.owned_names(), session.devices(), observers);
        thread::scope(move |scope| {
            // Dropped in any case, because the other thread waits for it.
            let mut writer = writer;
            let observe = move || observe(reader, &mut plain(observers));
            let observing = thread::Builder::new().name("afp-observers".into());
            let observing = observing.spawn_scoped(scope, observe);
            let observing =
                observing.map_err(RunError::file("cannot watch", "the run".as_ref()))?;
            let thread = observing.thread().clone();
            writer.set_wake(Box::new(move || thread.unpark()));
            realtime::apply(self.realtime);
            let stop = Stop(session);
            // It starts after the settings, which may take long, and before the first call.
            let watchdog = self.watchdog.take().map(|start| start()).transpose();
            let watchdog = watchdog.map_err(RunError::file("cannot watch", "the run".as_ref()))?;
            let went = match self.debugger.take() {
                None => self.run_to_end(&mut *stop.0, gate, None, &mut [&mut writer]),
                Some((mut wire, steering)) => {
                    let observers: &mut [&mut dyn Observer] = &mut [&mut writer, &mut wire];
                    self.run_to_end(&mut *stop.0, gate, Some(steering), observers)
                }
            };
            drop(watchdog);
            let measured = stop.0.end();
            // The robot is stopped before the wait for the observers.
            drop(writer);
            let (trace, lost) = observing.join().unwrap_or_else(|panic| resume_unwind(panic));
            stop.0.set_trace(trace);
            let stopped_by = went.map_err(|error| inputs::missing(error, stop.0.names()))?;
            Ok(Driven { stopped_by, measured, lost })
        })
    }

    /// Runs the plan to its end, or until it is stopped. Returns the cause.
    fn run_to_end(
        &self,
        session: &mut dyn AnySession,
        gate: &mut RunGate<'_>,
        mut steering: Option<Steering>,
        observers: &mut [&mut dyn Observer],
    ) -> Result<Option<StoppedBy>, StartError> {
        let itself = matches!(self.keeper, TimeKeeper::Robot);
        let stopped_by = loop {
            let went = match itself {
                true => self.slice(session, gate, observers)?,
                false => session.run(self.end, gate, observers)?,
            };
            match (gate.take_halt(), self.live) {
                // The robot's own buttons are out of reach here, so the key stops the plan.
                (Some((Halt::Escape, _)), _) if itself => break StoppedBy::Signal,
                (Some((Halt::Escape, at)), _) => requests::press_stop(session, at),
                (Some((Halt::Asked, at)), live) => {
                    let at = if itself { session.now() } else { at };
                    live.into_iter().for_each(|live| live.serve(session, at));
                    let steering = steering.as_mut().filter(|it| it.is_asked());
                    steering.into_iter().for_each(|it| it.apply(session, at, observers));
                }
                _ if session.ending().is_some() => return Ok(None),
                _ if went == Go::Stop => break StoppedBy::Signal,
                _ if !itself || session.now() >= self.end => break StoppedBy::Until,
                _ => {}
            }
        };
        session.stop(observers);
        Ok(Some(stopped_by))
    }

    /// Looks at keys and signals every [`SLICE`], also while the plan waits, and before each step,
    /// also if it is late.
    fn slice(
        &self,
        session: &mut dyn AnySession,
        gate: &mut RunGate<'_>,
        observers: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError> {
        match session.now() {
            now if now < self.end => session.tick(self.end.min(now + SLICE), gate, observers),
            _ => Ok(Go::On),
        }
    }
}

/// The observers for one thread.
fn plain<'a>(observers: &'a mut [&mut AnyObserver<'_>]) -> Vec<&'a mut dyn Observer> {
    observers.iter_mut().map(|each| &mut **each as &mut dyn Observer).collect()
}

/// Reports all items of the control thread until it ends.
fn observe(
    mut reader: QueueReader,
    to: &mut [&mut dyn Observer],
) -> (afp_core::trace::TraceHash, u64) {
    while reader.read(to) {
        thread::park_timeout(LOOK);
    }
    reader.finish()
}
