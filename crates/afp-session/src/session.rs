//! A plan on a robot, and the passage of time for both.

mod any;
mod asked;
pub(crate) mod broken;
pub(crate) mod grid;
mod meter;
mod report;

use std::sync::Arc;

use afp_core::devices::Devices;
use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{Ending, TraceHash};
use afp_core::{Duration, Instant, Scheduler, StartError, Wake};

use crate::faults::Faults;
use crate::figures::Figures;
use crate::holds::Holds;
use crate::observer::{Gate, Go, Next, Observer, Open};
use crate::record::{Keep, Kept};
use crate::request::{Request, Requests};
use crate::robot::{FaultOf, Measure, Robot};
use crate::sampling::Turn;
use crate::watch::Pulse;

use asked::{Testing, Work};
use grid::SampleGrid;
use meter::{Meter, Metered};

/// The period of samples for measures.
pub const SAMPLE: Duration = Duration::from_millis(20);

/// A plan on a robot.
///
/// A dropped session stops the robot.
pub struct Session<P: NamedPlan, R: Robot, S = Kept> {
    scheduler: Scheduler<P>,
    robot: R,
    names: P::Names,
    clock: R::Clock,
    sink: S,
    /// The limit for the lateness of a real robot's control loop; `None` in simulation. With a
    /// limit, controls and faults are not available.
    stall: Option<Duration>,
    /// The last time at which time passed.
    passed: Instant,
    /// The same for another thread; `None` in simulation.
    pulse: Option<Arc<Pulse>>,
    started: bool,
    /// The work of the next step.
    work: Work,
    /// Whether a step is in progress: then a panic comes from the plan.
    stepping: bool,
    /// The time of the last step.
    stepped: Option<Instant>,
    /// The time of the next step: now before the start, never after the end.
    due: Instant,
    /// The latest end of the run: after the end of the plan, when the robot rests.
    last: Instant,
    /// How long the run continues after the plan's end.
    rest: Duration,
    /// Consecutive calls in which time should have passed but did not.
    still: u32,
    requests: Requests,
    /// All requests so far.
    asked: Vec<(Instant, Request)>,
    faults: Faults<FaultOf<R>>,
    holds: Holds,
    measures: Vec<Box<dyn Measure<R>>>,
    samples: SampleGrid,
    trace: TraceHash,
    /// Measures a real robot's control loop; `None` in simulation.
    meter: Option<Box<Meter>>,
    /// Whether the session makes the lines and the hash of the trace.
    makes_trace: bool,
    /// A buffer for the line of a record.
    line: String,
    /// Functions of loaded plans only.
    testing: Option<Testing<P>>,
}

impl<P, R> Session<P, R, Kept>
where
    P: NamedPlan + Plan<R>,
    R: Robot,
{
    /// A session of a plan that has not started, on a robot that has not moved. Inputs may still be
    /// set.
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
    /// As [`Session::new`], with a custom sink.
    pub fn with_sink(plan: P, robot: R, sink: S) -> Self {
        Session {
            names: plan.names(),
            scheduler: Scheduler::new(plan),
            clock: robot.clock(),
            samples: SampleGrid::NONE,
            sink,
            stall: None,
            passed: robot.now(),
            pulse: None,
            started: false,
            work: Work::Start,
            stepping: false,
            stepped: None,
            due: robot.now(),
            last: Instant::MAX,
            rest: Duration::ZERO,
            still: 0,
            requests: Requests::default(),
            asked: Vec::new(),
            faults: Faults::default(),
            holds: Holds::default(),
            measures: Vec::new(),
            trace: TraceHash::default(),
            meter: None,
            makes_trace: true,
            line: String::new(),
            testing: None,
            robot,
        }
    }

    /// Adds a measure that judges the run.
    pub fn add_measure(&mut self, measure: Box<dyn Measure<R>>) {
        self.measures.push(measure);
    }

    /// Sets how long the run continues after the plan's end, so that the robot comes to rest; zero
    /// by default.
    pub fn set_rest(&mut self, rest: Duration) {
        self.rest = rest;
    }

    /// A copy of the run that continues in the same way; `None` if the robot, a measure or a
    /// component cannot be copied.
    pub fn keyframe(&self) -> Option<Self>
    where
        S: Clone,
    {
        let robot = self.robot.keyframe()?;
        let measures = self.measures.iter().map(|measure| measure.keyframe());
        Some(Session {
            scheduler: self.scheduler.try_clone()?,
            names: self.scheduler.plan().names(),
            clock: robot.clock(),
            robot,
            sink: self.sink.clone(),
            measures: measures.collect::<Option<_>>()?,
            requests: self.requests.clone(),
            asked: self.asked.clone(),
            faults: self.faults.clone(),
            holds: self.holds.clone(),
            line: String::new(),
            stall: self.stall,
            passed: self.passed,
            pulse: self.pulse.clone(),
            started: self.started,
            work: self.work,
            stepping: self.stepping,
            stepped: self.stepped,
            due: self.due,
            last: self.last,
            rest: self.rest,
            still: self.still,
            samples: self.samples,
            trace: self.trace,
            meter: None,
            makes_trace: self.makes_trace,
            testing: self.testing.as_ref().map(Testing::copy),
        })
    }

    /// The robot.
    pub fn robot(&self) -> &R {
        &self.robot
    }

    /// The plan.
    pub fn plan(&self) -> &P {
        self.scheduler.plan()
    }

    /// The plan, to set its inputs; `None` after the start.
    pub fn plan_mut(&mut self) -> Option<&mut P> {
        self.scheduler.plan_mut()
    }

    /// The names of the plan.
    pub fn plan_names(&self) -> &P::Names {
        &self.names
    }

    /// The ending of the plan, if it has ended.
    pub fn ending(&self) -> Option<Ending> {
        self.scheduler.ending()
    }

    /// The hash of the trace so far.
    pub fn trace(&self) -> TraceHash {
        self.trace
    }

    /// The time of the next step; [`Instant::MAX`] after the end of the plan.
    #[inline]
    pub fn due(&self) -> Instant {
        self.due.max(self.robot.ready())
    }

    /// Runs up to `until`, to the end of the plan and the rest of the robot, or until the gate
    /// stops the run; returns whether it did. A plan that has not ended continues with the next
    /// call.
    ///
    /// # Errors
    /// The plan cannot start.
    pub fn run(
        &mut self,
        until: Instant,
        gate: &mut (impl Gate + ?Sized),
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError> {
        self.fit(to);
        loop {
            let went = self.guarded(to, |session, to| {
                while !session.is_over(until) {
                    if session.tick_fitted(until, gate, to)? == Go::Stop {
                        return Ok(Go::Stop);
                    }
                }
                Ok(Go::On)
            });
            if went != Ok(Go::Again) {
                return went;
            }
        }
    }

    /// Whether the run has no event left up to `until`.
    #[inline]
    pub fn is_over(&self, until: Instant) -> bool {
        let now = self.robot.now();
        now >= until.min(self.last) && self.due() > now && self.next_from_outside() > now
    }

    /// The next request, or begin or end of a fault, or end of a hold.
    #[inline]
    fn next_from_outside(&self) -> Instant {
        self.requests.next().min(self.faults.next_change()).min(self.holds.next_change())
    }

    /// Lets time pass up to the next event of the run, at most to `limit`, and handles it.
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
        self.guarded(to, |session, to| session.tick_fitted(limit, gate, to))
    }

    /// As [`Session::tick`] without limit or gate; returns the kind of event.
    ///
    /// # Errors
    /// The plan cannot start.
    pub fn next_step(&mut self, to: &mut [&mut dyn Observer]) -> Result<Next, StartError> {
        if self.ending().is_some() {
            return Ok(Next::Ended);
        }
        self.fit(to);
        let due = self.due();
        self.guarded(to, |session, to| session.tick_fitted(Instant::MAX, &mut Open, to))?;
        Ok(match (self.ending(), self.robot.now() >= due) {
            (Some(_), _) => Next::Ended,
            (None, true) => Next::Step,
            (None, false) => Next::BeforeStep,
        })
    }

    #[inline]
    fn tick_fitted(
        &mut self,
        limit: Instant,
        gate: &mut (impl Gate + ?Sized),
        to: &mut [&mut dyn Observer],
    ) -> Result<Go, StartError> {
        let outside = self.next_from_outside().min(self.samples.next);
        let target = self.due().min(outside).min(limit).min(self.last);
        let before = self.robot.now();
        match gate.pass(target, before) {
            Go::On => {}
            other => return Ok(other),
        }
        // Also before `advance`, because the driver repeats commands.
        let late = before.since(self.passed);
        if self.has_stalled(late, to) {
            return Ok(Go::On);
        }
        self.robot.advance(target);
        let now = self.robot.now();
        self.passes(now);
        if self.has_stalled(late + now.since(target.max(before)), to) {
            return Ok(Go::On);
        }
        if let Some(fault) = self.robot.broken() {
            self.distrust(fault, to);
        }
        self.note_wake_up(target, before, now);
        match now == before && target > now {
            true => self.stood_still(now, to),
            false => self.still = 0,
        }
        if outside <= now {
            self.before_step(now, to);
        }
        if self.due() <= now {
            self.step(now, to)?;
            self.note_step(now);
        }
        Ok(Go::On)
    }

    /// Takes samples and does requests that are due.
    #[cold]
    fn before_step(&mut self, now: Instant, to: &mut [&mut dyn Observer]) {
        if self.samples.next <= now {
            self.sample_on_grid(now, self.due() <= now, to);
        }
        if self.next_from_outside() <= now {
            self.apply_due(now, to);
        }
    }

    /// Stops the robot permanently and returns the results.
    pub fn end(&mut self) -> Figures {
        self.robot.emergency_stop();
        self.figures()
    }

    /// The results so far.
    pub fn figures(&self) -> Figures {
        let measured = self.measures.iter().flat_map(|measure| measure.figures());
        Figures(measured.chain(self.robot.figures()).collect())
    }

    #[inline]
    fn step(&mut self, now: Instant, to: &mut [&mut dyn Observer]) -> Result<(), StartError> {
        let Session { scheduler, robot, sink, clock, meter, .. } = self;
        let clock = &*clock;
        let mut sink = Metered { sink, clock, meter: meter.as_deref_mut() };
        let on = (robot, &mut sink, clock);
        self.stepping = true;
        let wake = match self.work {
            Work::Step => scheduler.step(on, now),
            Work::Start => match scheduler.start(on, now) {
                Ok(wake) => wake,
                Err(why) => {
                    self.stepping = false;
                    return Err(why);
                }
            },
            Work::Hold => scheduler.hold(on, now),
            Work::Release(how) => scheduler.release(on, now, how),
        };
        self.work = Work::Step;
        self.stepping = false;
        self.note_reaction(now);
        self.woke(wake, now, to);
        Ok(())
    }

    /// Handles the end of a step.
    #[inline]
    fn woke(&mut self, wake: Wake, now: Instant, to: &mut [&mut dyn Observer]) {
        self.started = true;
        self.stepped = Some(now);
        match wake {
            Wake::At(due) => self.due = due,
            Wake::Ended(_) | Wake::NotStarted => self.ended(now),
        }
        if !self.sink.is_empty() {
            self.report_records(to);
        }
        if !to.is_empty() {
            self.report_step(now, to);
        }
    }

    /// Notes that the plan has ended.
    #[cold]
    fn ended(&mut self, now: Instant) {
        self.due = Instant::MAX;
        self.last = self.last.min(now + self.rest);
    }

    /// Adapts the kept records and the grid of samples to the observers.
    #[inline]
    fn fit(&mut self, to: &[&mut dyn Observer]) {
        self.makes_trace = !to.iter().any(|each| each.makes_trace());
        self.sink.keep_clear_polls(to.iter().any(|each| each.wants_clear_polls()));
        let periods = periods(!self.measures.is_empty(), to);
        self.samples.fit(periods, self.robot.now(), self.started);
    }

    fn sample_on_grid(&mut self, now: Instant, before_step: bool, to: &mut [&mut dyn Observer]) {
        let stretch = self.samples.take(periods(!self.measures.is_empty(), to), now);
        if stretch.has_multiple_of(SAMPLE) {
            for measure in &mut self.measures {
                measure.on_sample(now, &self.robot);
            }
        }
        if let Some(wrong) = self.take_samples(now, Turn::Grid { before_step, stretch }, to) {
            self.distrust(wrong, to);
        }
    }

    fn table(&self) -> &'static [afp_core::devices::DeviceRow] {
        <R::Devices as Devices>::TABLE
    }
}

/// The sample periods of all observers and measures.
#[inline]
fn periods<'a>(
    measured: bool,
    to: &'a [&mut dyn Observer],
) -> impl Iterator<Item = Duration> + Clone + 'a {
    let observers = to.iter().filter_map(|each| each.sampling().grid());
    observers.chain(measured.then_some(SAMPLE))
}

impl<P: NamedPlan, R: Robot, S> Drop for Session<P, R, S> {
    fn drop(&mut self) {
        self.robot.emergency_stop();
    }
}
