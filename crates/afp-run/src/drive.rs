//! The driver in virtual time.
//!
//! At an instant: physics, then whatever happens to the robot from outside, then the step. Between
//! the steps that the plan asks for, the truth is looked at on a grid of its own, which the plan
//! cannot notice.

use std::panic::{AssertUnwindSafe, catch_unwind};

use afp_core::rt::Plan;
use afp_core::trace::{Line, Names, Record, TraceEntryId, TraceHash};
use afp_core::{
    Duration, Ending, Environment, Fault, Instant, PlanState, Scheduler, StartError, StillClock,
    Wake,
};
use afp_log::robot::Level;
use afp_sim::Simulation;

use crate::judge::{Judge, SAMPLE};
use crate::options::{Button, Press};
use crate::pace::{Pace, Waited};
use crate::report::{Report, StoppedBy};
use crate::robot::RobotLog;
use crate::stop::StopFlag;
use crate::tracer::Tracer;

/// How long a button is held down.
const HOLD: Duration = Duration::from_millis(200);

/// A run in progress.
pub(crate) struct Drive<'a, P: PlanState, N> {
    pub scheduler: Scheduler<P>,
    pub sim: Simulation,
    pub names: &'a N,
    pub tracer: Tracer,
    pub judge: Judge,
    pub trace: TraceHash,
    pub report: Report,
    pub pace: Pace,
    pub stop: StopFlag,
    pub robot_log: Option<RobotLog>,
    pub stimuli: Stimuli,
    pub end: Instant,
}

/// What happens to the robot from outside, in order of time.
#[derive(Debug, Default)]
pub(crate) struct Stimuli(Vec<(Instant, Stimulus)>);

#[derive(Clone, Copy, Debug)]
enum Stimulus {
    Press(Button),
    Release(Button),
}

impl Stimuli {
    pub(crate) fn new(presses: &[Press]) -> Self {
        let mut stimuli = Stimuli::default();
        for press in presses {
            stimuli.press(press.button, press.at);
        }
        stimuli
    }

    fn press(&mut self, button: Button, at: Instant) {
        self.0.push((at, Stimulus::Press(button)));
        self.0.push((at + HOLD, Stimulus::Release(button)));
        // The sort is stable: what was asked for first happens first.
        self.0.sort_by_key(|(at, _)| *at);
    }

    fn next(&self) -> Instant {
        self.0.first().map_or(Instant::MAX, |(at, _)| *at)
    }

    fn take_due(&mut self, now: Instant) -> Option<Stimulus> {
        (self.next() <= now && !self.0.is_empty()).then(|| self.0.remove(0).1)
    }
}

impl<P: Plan<Simulation>, N: Names> Drive<'_, P, N> {
    /// Runs the plan to its end, or until it is stopped. The motors stand afterwards.
    ///
    /// # Errors
    /// The plan cannot start.
    pub(crate) fn run(&mut self) -> Result<Option<StoppedBy>, StartError> {
        let mut wake = self.start()?;
        let mut look = Instant::ZERO;
        let mut stopped_by = None;
        while let Wake::At(due) = wake {
            let target = due.min(self.stimuli.next()).min(look).min(self.end);
            match self.pace.wait(target, &self.stop) {
                Waited::Due => {}
                Waited::Escape => {
                    let now = self.pace.simulated().unwrap_or(target).min(target);
                    self.stimuli.press(Button::Escape, now.max(self.sim.now()));
                    continue;
                }
                Waited::Stop => stopped_by = Some(StoppedBy::Signal),
            }
            if stopped_by.is_none() {
                self.sim.advance_to(target);
            }
            let now = self.sim.now();
            if now == look && stopped_by.is_none() {
                self.look(now);
                look = look + SAMPLE;
            }
            self.stimulate(now);
            if self.report.is_closed() {
                stopped_by = Some(StoppedBy::Signal);
            } else if now >= self.end && due > now {
                stopped_by = stopped_by.or(Some(StoppedBy::Until));
            }
            if stopped_by.is_some() {
                self.scheduler.request_stop();
            }
            if due <= now || stopped_by.is_some() {
                wake = self.step(now);
            }
            self.report.pass(now);
        }
        self.sim.emergency_stop();
        Ok(stopped_by)
    }

    fn start(&mut self) -> Result<Wake, StartError> {
        let Drive { scheduler, sim, tracer, .. } = self;
        let start = AssertUnwindSafe(|| scheduler.start(sim, tracer, &StillClock, Instant::ZERO));
        let wake = match catch_unwind(start) {
            Ok(wake) => wake?,
            Err(_) => self.panicked(),
        };
        let own = (0..self.names.entries())
            .take_while(|id| !self.names.entry(TraceEntryId(*id)).path.contains('.'))
            .count();
        let plan = self.scheduler.plan();
        let entries = (0..own as u16).map(|entry| plan.entry(entry).to_owned());
        self.tracer.started(Instant::ZERO, entries);
        self.tell();
        Ok(wake)
    }

    fn step(&mut self, now: Instant) -> Wake {
        let Drive { scheduler, sim, tracer, .. } = self;
        let step = AssertUnwindSafe(|| scheduler.step(sim, tracer, &StillClock, now));
        let wake = match catch_unwind(step) {
            Ok(wake) => wake,
            Err(_) => self.panicked(),
        };
        if !self.tracer.news.is_empty() {
            self.tell();
        }
        wake
    }

    /// A component panicked: nothing of the plan can be trusted any more.
    fn panicked(&mut self) -> Wake {
        self.scheduler.abort(&mut self.sim, &mut self.tracer, Fault::PANIC)
    }

    /// Tells everybody what happened in the step that is over.
    fn tell(&mut self) {
        let truth = self.sim.truth();
        let Tracer { news, log, .. } = &mut self.tracer;
        for owned in news.drain(..) {
            let (at, record) = (owned.at, owned.get());
            self.judge.hear(at, &record, self.names, &truth);
            self.trace.record(at, &record, self.names);
            self.report.tell(at, &record, self.names);
            if let (Some(log), Some(level)) = (log.as_mut(), level(&record)) {
                let line = Line { at, record: &record, names: self.names }.to_string();
                // The message has a time of its own.
                log.text(at, level, "plan", line.split_once(' ').map_or("", |(_, text)| text));
            }
        }
    }

    fn look(&mut self, now: Instant) {
        self.judge.look(now, &self.sim.truth());
        if let (Some(robot), Some(log)) = (&mut self.robot_log, &mut self.tracer.log) {
            robot.look(log, &self.sim);
        }
    }

    fn stimulate(&mut self, now: Instant) {
        while let Some(stimulus) = self.stimuli.take_due(now) {
            match stimulus {
                Stimulus::Press(Button::Escape) => self.sim.press_escape(),
                Stimulus::Release(Button::Escape) => self.sim.release_escape(),
            }
        }
    }
}

/// What people who read the log as text want to know, and how much it matters.
fn level(record: &Record<'_>) -> Option<Level> {
    match record {
        Record::Faulted { .. } | Record::Ended { ending: Ending::Error(_), .. } => {
            Some(Level::Error)
        }
        Record::Missed { .. } | Record::ClockWentBack { .. } => Some(Level::Warning),
        Record::Event { .. } | Record::Ended { .. } | Record::StopRequested => Some(Level::Info),
        _ => None,
    }
}
