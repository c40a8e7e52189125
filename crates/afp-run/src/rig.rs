//! The one way of driving a plan on the simulated robot, in virtual time.
//!
//! At an instant: physics, then whatever happens to the robot from outside, then the step. Between
//! the steps that the plan asks for, the truth is looked at on a grid of its own, which the plan
//! cannot notice. Whoever runs plans (`afpc run`, scenarios, sweeps) differs in its [`Company`] alone.

use std::panic::{AssertUnwindSafe, catch_unwind};

use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{Line, Names, Record, TraceEntryId, TraceHash};
use afp_core::{Duration, Ending, Fault, Instant, Scheduler, StartError, Wake};
use afp_log::robot::Level;
use afp_log::{Recorder, Written};
use afp_sim::{STEP, Simulation, Truth, VirtualClock, World};

use crate::error::RunError;
use crate::robot::RobotLog;
use crate::tracer::Tracer;

/// How often the truth is looked at.
pub const SAMPLE: Duration = Duration::from_millis(20);

/// Whether a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Go {
    /// It does.
    On,
    /// Ask again: what happens next may have changed.
    Again,
    /// It is to stop.
    Stop,
}

/// What there is to a run beside its plan and its robot. Every method may be left out.
pub trait Company<P: NamedPlan> {
    /// Time is about to pass up to `target`.
    fn wait(&mut self, target: Instant, now: Instant) -> Go {
        let _ = (target, now);
        Go::On
    }

    /// When the next thing happens from outside.
    fn next(&self) -> Instant {
        Instant::MAX
    }

    /// Lets happen what is due.
    fn happen(&mut self, rig: &mut Rig<P>, now: Instant) {
        let _ = (rig, now);
    }

    /// Takes a record of the step that is over; polls that saw nothing are left out.
    fn hear(&mut self, at: Instant, record: &Record<'_>, names: &P::Names, truth: &Truth<'_>) {
        let _ = (at, record, names, truth);
    }

    /// All records of the step at this instant have been heard; for who follows the robot, at every
    /// instant at which anything happens.
    fn settle(&mut self, rig: &Rig<P>, now: Instant) {
        let _ = (rig, now);
    }

    /// Whether it follows the robot: nothing is left out for longer than a step of physics.
    fn follows(&self) -> bool {
        false
    }

    /// Whether the truth is to be looked at, every [`SAMPLE`].
    fn looks(&self) -> bool {
        false
    }

    /// Looks at the truth.
    fn look(&mut self, now: Instant, truth: &Truth<'_>) {
        let _ = (now, truth);
    }
}

/// A plan on the simulated robot.
pub struct Rig<P: NamedPlan> {
    /// The plan.
    pub scheduler: Scheduler<P>,
    /// The robot in its world.
    pub sim: Simulation,
    names: P::Names,
    tracer: Tracer,
    robot_log: Option<RobotLog>,
    clock: VirtualClock,
    wake: Option<Wake>,
    /// When the plan ended.
    ended: Option<Instant>,
    /// When the truth is looked at next.
    look: Instant,
    /// How long a run goes on when the plan has ended, so that the robot comes to rest.
    rest: Duration,
    trace: TraceHash,
}

impl<P: NamedPlan + Plan<Simulation>> Rig<P> {
    /// A plan that has not started, its inputs set, on a robot that has not moved. A run goes on for
    /// `rest` when the plan has ended.
    pub fn new(plan: P, sim: Simulation, rest: Duration) -> Self {
        Rig {
            names: plan.names(),
            scheduler: Scheduler::new(plan),
            clock: sim.clock(),
            sim,
            tracer: Tracer::new(None),
            robot_log: None,
            wake: None,
            ended: None,
            look: Instant::ZERO,
            rest,
            trace: TraceHash::default(),
        }
    }

    /// Records the run, with `camera` also what the camera sees; to be called before the start.
    pub fn record(&mut self, mut log: Recorder, world: &World, camera: bool) {
        self.robot_log = Some(RobotLog::begin(&mut log, world, camera));
        self.tracer.log = Some(log);
    }

    /// The names of the plan.
    pub fn names(&self) -> &P::Names {
        &self.names
    }

    /// The hash of the trace so far, without polls that saw nothing: the same for the same plan,
    /// world and seed, on every machine.
    pub fn trace(&self) -> TraceHash {
        self.trace
    }

    /// How the plan ended, once it has.
    pub fn ending(&self) -> Option<Ending> {
        self.scheduler.ending()
    }

    /// Starts the plan, unless it has started.
    ///
    /// # Errors
    /// An input is missing.
    pub fn start(&mut self, company: &mut impl Company<P>) -> Result<(), StartError> {
        if self.wake.is_some() {
            return Ok(());
        }
        let Rig { scheduler, sim, tracer, clock, .. } = self;
        let start = AssertUnwindSafe(|| scheduler.start(sim, tracer, clock, Instant::ZERO));
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
        self.woke(wake, Instant::ZERO, company);
        Ok(())
    }

    /// Runs the plan until `end`, until it has ended and the robot has come to rest, or until its
    /// company stops it; whether it was stopped so. A plan that is still running goes on with the next
    /// call, or ends with [`Rig::stop`].
    ///
    /// # Errors
    /// The plan cannot start.
    pub fn run(&mut self, end: Instant, company: &mut impl Company<P>) -> Result<Go, StartError> {
        self.start(company)?;
        while !self.is_over(end) {
            if self.tick(end, company) == Go::Stop {
                return Ok(Go::Stop);
            }
        }
        Ok(Go::On)
    }

    /// Whether nothing is left to do before `end`, or at it.
    fn is_over(&self, end: Instant) -> bool {
        let now = self.sim.now();
        now >= end.min(self.last()) && self.due() > now
    }

    /// When a run is over at the latest: once the robot rests after the end of its plan.
    fn last(&self) -> Instant {
        self.ended.map_or(Instant::MAX, |ended| ended + self.rest)
    }

    /// When the plan's next step is due: [`Instant::MAX`] once it has ended.
    pub fn due(&self) -> Instant {
        match self.wake {
            Some(Wake::At(due)) => due.max(self.clock.free()),
            Some(Wake::Ended(_)) => Instant::MAX,
            None => Instant::ZERO,
        }
    }

    /// Lets time pass up to the next thing to do, but not beyond `limit`, and does it.
    pub fn tick(&mut self, limit: Instant, company: &mut impl Company<P>) -> Go {
        let due = self.due();
        let look = if self.is_watched(company) { self.look } else { Instant::MAX };
        let follow = if company.follows() { self.sim.now() + STEP } else { Instant::MAX };
        let next = company.next().min(look).min(follow);
        let target = due.min(next).min(limit).min(self.last());
        match company.wait(target, self.sim.now()) {
            Go::On => {}
            other => return other,
        }
        self.sim.advance_to(target);
        let now = self.sim.now();
        if now == look {
            self.look_at(now, company);
            self.look = look + SAMPLE;
        }
        company.happen(self, now);
        if due <= now {
            self.step(now, company);
        }
        if company.follows() {
            company.settle(self, now);
        }
        Go::On
    }

    fn is_watched(&self, company: &impl Company<P>) -> bool {
        self.robot_log.is_some() || company.looks()
    }

    /// Makes the plan end here and now, as `Interrupted`.
    pub fn stop(&mut self, company: &mut impl Company<P>) {
        let now = self.sim.now();
        company.happen(self, now);
        self.scheduler.request_stop();
        self.step(now, company);
    }

    /// Ends the plan here and now because nothing of it can be trusted any more.
    pub fn abort(&mut self, company: &mut impl Company<P>) {
        let now = self.sim.now();
        let wake = self.panicked();
        self.woke(wake, now, company);
    }

    /// Closes the log; `None` where there is none.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn finish_log(&mut self) -> Result<Option<Written>, RunError> {
        Ok(self.tracer.log.take().map(Recorder::finish).transpose()?)
    }

    fn step(&mut self, now: Instant, company: &mut impl Company<P>) {
        let Rig { scheduler, sim, tracer, clock, .. } = self;
        let step = AssertUnwindSafe(|| scheduler.step(sim, tracer, clock, now));
        let wake = match catch_unwind(step) {
            Ok(wake) => wake,
            Err(_) => self.panicked(),
        };
        self.woke(wake, now, company);
    }

    /// A step is over.
    fn woke(&mut self, wake: Wake, now: Instant, company: &mut impl Company<P>) {
        self.wake = Some(wake);
        if matches!(wake, Wake::Ended(_)) {
            self.ended = self.ended.or(Some(now));
        }
        if !self.tracer.news.is_empty() {
            self.tell(now, company);
        }
    }

    /// A component panicked: nothing of the plan can be trusted any more.
    fn panicked(&mut self) -> Wake {
        self.scheduler.abort(&mut self.sim, &mut self.tracer, Fault::PANIC)
    }

    /// Tells everybody what happened in the step that is over.
    fn tell(&mut self, now: Instant, company: &mut impl Company<P>) {
        let Rig { sim, names, tracer, trace, .. } = self;
        let truth = sim.truth();
        let Tracer { news, log, .. } = tracer;
        for owned in news.drain(..) {
            let (at, record) = (owned.at, owned.get());
            company.hear(at, &record, names, &truth);
            trace.record(at, &record, names);
            if let (Some(log), Some(level)) = (log.as_mut(), level(&record)) {
                let line = Line { at, record: &record, names }.to_string();
                // The message has a time of its own.
                log.text(at, level, "plan", line.split_once(' ').map_or("", |(_, text)| text));
            }
        }
        company.settle(self, now);
    }

    fn look_at(&mut self, now: Instant, company: &mut impl Company<P>) {
        if company.looks() {
            company.look(now, &self.sim.truth());
        }
        if let (Some(robot), Some(log)) = (&mut self.robot_log, &mut self.tracer.log) {
            robot.look(log, &self.sim);
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
