//! A plan on a robot, and how time passes for both.

mod any;
mod asked;
mod told;

use std::panic::{AssertUnwindSafe, catch_unwind};

use afp_core::devices::Devices;
use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{Ending, TraceHash};
use afp_core::{Duration, Fault, Instant, Scheduler, StartError, Wake};

use crate::faults::Faults;
use crate::figures::Figures;
use crate::observer::{Gate, Go, Observer};
use crate::record::{Keep, Kept};
use crate::request::{Request, Requests};
use crate::robot::{FaultOf, Measure, Robot};
use crate::sample::Turn;

use asked::Testing;

/// How often measures look at the robot.
pub const SAMPLE: Duration = Duration::from_millis(20);

/// A plan on a robot.
///
/// Dropped, it stops the robot.
pub struct Session<P: NamedPlan, R: Robot, S = Kept> {
    scheduler: Scheduler<P>,
    robot: R,
    names: P::Names,
    clock: R::Clock,
    sink: S,
    /// What the last step left to do; none before the start.
    wake: Option<Wake>,
    /// When the plan ended.
    ended: Option<Instant>,
    /// How long a run goes on when the plan has ended.
    rest: Duration,
    requests: Requests,
    /// All that was asked for.
    asked: Vec<(Instant, Request)>,
    faults: Faults<FaultOf<R>>,
    measures: Vec<Box<dyn Measure<R>>>,
    samples: SampleGrid,
    trace: TraceHash,
    /// The line of the record at hand.
    line: String,
    /// What only loaded plans can do.
    testing: Option<Testing<P>>,
}

/// When samples are taken.
#[derive(Clone, Copy, Debug)]
struct SampleGrid {
    /// The finest of those that want any.
    every: Duration,
    /// The next instant on it.
    next: Instant,
}

impl<P, R> Session<P, R, Kept>
where
    P: NamedPlan + Plan<R>,
    R: Robot,
{
    /// A plan that has not started, its inputs set or still to be, on a robot that has not moved.
    pub fn new(plan: P, robot: R) -> Self {
        Session::with_sink(plan, robot, Kept::default())
    }
}

impl<P, R, S> Session<P, R, S>
where
    P: NamedPlan + Plan<R>,
    R: Robot,
    S: Keep,
{
    /// The same with a sink of one's own.
    pub fn with_sink(plan: P, robot: R, sink: S) -> Self {
        Session {
            names: plan.names(),
            scheduler: Scheduler::new(plan),
            clock: robot.clock(),
            samples: SampleGrid { every: Duration::ZERO, next: Instant::MAX },
            robot,
            sink,
            wake: None,
            ended: None,
            rest: Duration::ZERO,
            requests: Requests::default(),
            asked: Vec::new(),
            faults: Faults::default(),
            measures: Vec::new(),
            trace: TraceHash::default(),
            line: String::new(),
            testing: None,
        }
    }

    /// Judges the run, too.
    pub fn add_measure(&mut self, measure: Box<dyn Measure<R>>) {
        self.measures.push(measure);
    }

    /// How long a run goes on when the plan has ended, so that the robot comes to rest; nothing unless told.
    pub fn set_rest(&mut self, rest: Duration) {
        self.rest = rest;
    }

    /// The robot.
    pub fn robot(&self) -> &R {
        &self.robot
    }

    /// The plan.
    pub fn plan(&self) -> &P {
        self.scheduler.plan()
    }

    /// The plan, to set its inputs; none once it has started.
    pub fn plan_mut(&mut self) -> Option<&mut P> {
        match self.wake {
            None => Some(self.scheduler.plan_mut()),
            Some(_) => None,
        }
    }

    /// The names of the plan.
    pub fn plan_names(&self) -> &P::Names {
        &self.names
    }

    /// How the plan ended, once it has.
    pub fn ending(&self) -> Option<Ending> {
        self.scheduler.ending()
    }

    /// The hash of the trace so far.
    pub fn trace(&self) -> TraceHash {
        self.trace
    }

    /// When the next step is made; [`Instant::MAX`] once the plan has ended.
    #[inline]
    pub fn due(&self) -> Instant {
        match self.wake {
            Some(Wake::At(due)) => due.max(self.robot.ready()),
            Some(Wake::Ended(_)) => Instant::MAX,
            None => self.robot.now(),
        }
    }

    /// Runs the plan until `until`, until it has ended and the robot has come to rest, or until the gate stops it;
    /// whether it did. A plan that still runs goes on with the next call.
    ///
    /// # Errors
    /// The plan cannot start.
    pub fn run(
        &mut self,
        until: Instant,
        gate: &mut (impl Gate + ?Sized),
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError> {
        while !self.is_over(until) {
            if self.tick(until, gate, to)? == Go::Stop {
                return Ok(Go::Stop);
            }
        }
        Ok(Go::On)
    }

    /// Whether nothing is left to do before `until`, or at it.
    #[inline]
    pub fn is_over(&self, until: Instant) -> bool {
        let now = self.robot.now();
        now >= until.min(self.last()) && self.due() > now && self.next_from_outside() > now
    }

    /// When a run is over at the latest: once the robot rests after the end of its plan.
    #[inline]
    fn last(&self) -> Instant {
        self.ended.map_or(Instant::MAX, |ended| ended + self.rest)
    }

    /// When the next request is due, or a fault begins or ends.
    #[inline]
    fn next_from_outside(&self) -> Instant {
        self.requests.next().min(self.faults.next_change())
    }

    /// Lets time pass up to the next thing to do, but not beyond `limit`, and does it.
    ///
    /// # Errors
    /// The plan cannot start.
    pub fn tick(
        &mut self,
        limit: Instant,
        gate: &mut (impl Gate + ?Sized),
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError> {
        self.fit(to);
        let outside = self.next_from_outside().min(self.samples.next);
        let target = self.due().min(outside).min(limit).min(self.last());
        match gate.pass(target, self.robot.now()) {
            Go::On => {}
            other => return Ok(other),
        }
        self.robot.advance(target);
        let now = self.robot.now();
        let due = self.due() <= now;
        if self.samples.next <= now {
            self.sample_on_grid(now, due, to);
        }
        if self.next_from_outside() <= now {
            self.apply_due(now, to);
        }
        // A request may have asked for a step at once.
        if due || self.due() <= now {
            self.step(now, to)?;
        }
        Ok(Go::On)
    }

    /// Makes the plan end here and now, as interrupted.
    pub fn stop(&mut self, to: &mut [&mut dyn Observer]) {
        let now = self.robot.now();
        self.apply_due(now, to);
        if self.ended.is_none() {
            self.scheduler.request_stop();
            // A plan that has not started ends at its start; one that cannot start has nothing to stop.
            let _ = self.step(now, to);
        }
        self.robot.emergency_stop();
    }

    /// Ends the plan here and now because nothing of it can be trusted any more.
    pub fn abort(&mut self, fault: Fault, to: &mut [&mut dyn Observer]) {
        let now = self.robot.now();
        let wake = self.scheduler.abort(&mut self.robot, &mut self.sink, fault);
        self.woke(wake, now, to);
    }

    /// Stops the robot for good and says what the run came to.
    pub fn end(&mut self) -> Figures {
        self.robot.emergency_stop();
        let measured = self.measures.iter().flat_map(|measure| measure.figures());
        Figures(measured.chain(self.robot.figures()).collect())
    }

    fn step(&mut self, now: Instant, to: &mut [&mut dyn Observer]) -> Result<(), StartError> {
        let wake = match self.wake {
            Some(_) => self.guarded_step(now),
            None => self.guarded_start(now)?,
        };
        self.woke(wake, now, to);
        Ok(())
    }

    fn guarded_start(&mut self, now: Instant) -> Result<Wake, StartError> {
        let Session { scheduler, robot, sink, clock, .. } = self;
        let start = AssertUnwindSafe(|| scheduler.start(robot, sink, clock, now));
        match catch_unwind(start) {
            Ok(wake) => wake,
            Err(_) => Ok(self.panicked()),
        }
    }

    #[inline]
    fn guarded_step(&mut self, now: Instant) -> Wake {
        let Session { scheduler, robot, sink, clock, .. } = self;
        let step = AssertUnwindSafe(|| scheduler.step(robot, sink, clock, now));
        match catch_unwind(step) {
            Ok(wake) => wake,
            Err(_) => self.panicked(),
        }
    }

    /// A component panicked: nothing of the plan can be trusted any more.
    #[cold]
    fn panicked(&mut self) -> Wake {
        self.scheduler.abort(&mut self.robot, &mut self.sink, Fault::PANIC)
    }

    /// A step is over.
    #[inline]
    fn woke(&mut self, wake: Wake, now: Instant, to: &mut [&mut dyn Observer]) {
        self.wake = Some(wake);
        if matches!(wake, Wake::Ended(_)) {
            self.ended = self.ended.or(Some(now));
        }
        if !self.sink.is_empty() {
            self.tell_records(to);
        }
        if !to.is_empty() {
            self.tell_step(now, to);
        }
    }

    /// Fits what is kept, and the grid of samples, to who is there.
    #[inline]
    fn fit(&mut self, to: &[&mut dyn Observer]) {
        self.sink.keep_clear_polls(to.iter().any(|each| each.wants_clear_polls()));
        let measures = (!self.measures.is_empty()).then_some(SAMPLE);
        let observers = to.iter().filter_map(|each| each.sampling().grid());
        let every = observers.chain(measures).min().unwrap_or(Duration::ZERO);
        if every != self.samples.every {
            self.samples = SampleGrid { every, next: self.first_on_grid(every) };
        }
    }

    /// The first instant of a grid on which no samples have been taken: now, before the start, later a multiple of
    /// the period.
    #[cold]
    fn first_on_grid(&self, every: Duration) -> Instant {
        let now = self.robot.now();
        match (every, self.wake) {
            (Duration::ZERO, _) => Instant::MAX,
            (_, None) => now,
            (every, Some(_)) => after(now, every),
        }
    }

    fn sample_on_grid(&mut self, now: Instant, before_step: bool, to: &mut [&mut dyn Observer]) {
        self.samples.next = after(now, self.samples.every);
        if crate::sample::is_on_grid(now, SAMPLE) {
            for measure in &mut self.measures {
                measure.on_sample(now, &self.robot);
            }
        }
        self.take_samples(now, Turn::Grid { before_step }, to);
    }

    /// The devices of the robot.
    fn table(&self) -> &'static [afp_core::devices::DeviceRow] {
        <R::Devices as Devices>::TABLE
    }
}

/// The first instant of a grid after `now`.
fn after(now: Instant, every: Duration) -> Instant {
    let every = every.as_nanos().max(1);
    Instant::from_nanos((now.as_nanos() / every).saturating_add(1).saturating_mul(every))
}

impl<P: NamedPlan, R: Robot, S> Drop for Session<P, R, S> {
    fn drop(&mut self) {
        self.robot.emergency_stop();
    }
}
