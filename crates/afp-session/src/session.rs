//! A plan on a robot, and how time passes for both.

mod any;
mod asked;
pub(crate) mod broken;
pub(crate) mod grid;
mod report;

use std::sync::Arc;

use afp_core::devices::Devices;
use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::{Ending, TraceHash};
use afp_core::{Duration, Fault, Instant, Scheduler, StartError, Wake};

use crate::faults::Faults;
use crate::figures::Figures;
use crate::holds::Holds;
use crate::observer::{Gate, Go, Next, Observer, Open};
use crate::record::{Keep, Kept};
use crate::request::{Request, Requests};
use crate::robot::{FaultOf, Measure, Robot};
use crate::sampling::Turn;
use crate::watch::Pulse;

use asked::Testing;
use grid::SampleGrid;

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
    /// How late the control loop of a real robot may be; none in simulation. Nobody can press or break anything of a real
    /// robot from here.
    stall: Option<Duration>,
    /// When time has passed last.
    passed: Instant,
    /// Where another thread sees that; none in simulation.
    pulse: Option<Arc<Pulse>>,
    /// Whether the plan has started.
    started: bool,
    /// Whether a step is under way: a panic is the plan's then.
    stepping: bool,
    /// When the last step was made, once there was one.
    stepped: Option<Instant>,
    /// When the next step is made: now before the start, never after the end.
    due: Instant,
    /// When the run is over at the latest: once the robot rests after the end of its plan.
    last: Instant,
    /// How long a run goes on when the plan has ended.
    rest: Duration,
    /// How often in a row time was to pass and has not.
    still: u32,
    requests: Requests,
    /// All that was asked for.
    asked: Vec<(Instant, Request)>,
    faults: Faults<FaultOf<R>>,
    holds: Holds,
    measures: Vec<Box<dyn Measure<R>>>,
    samples: SampleGrid,
    trace: TraceHash,
    /// Whether lines and hash of the trace are made here.
    makes_trace: bool,
    /// The line of the record at hand.
    line: String,
    /// What only loaded plans can do.
    testing: Option<Testing<P>>,
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
            samples: SampleGrid::NONE,
            sink,
            stall: None,
            passed: robot.now(),
            pulse: None,
            started: false,
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
            makes_trace: true,
            line: String::new(),
            testing: None,
            robot,
        }
    }

    /// Judges the run, too.
    pub fn add_measure(&mut self, measure: Box<dyn Measure<R>>) {
        self.measures.push(measure);
    }

    /// How long a run goes on when the plan has ended, so that the robot comes to rest; zero by default.
    pub fn set_rest(&mut self, rest: Duration) {
        self.rest = rest;
    }

    /// The same run at the same instant, which goes on by itself and alike; none where the robot, a measure or a
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
            stepping: self.stepping,
            stepped: self.stepped,
            due: self.due,
            last: self.last,
            rest: self.rest,
            still: self.still,
            samples: self.samples,
            trace: self.trace,
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

    /// The plan, to set its inputs; none once it has started.
    pub fn plan_mut(&mut self) -> Option<&mut P> {
        self.scheduler.plan_mut()
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
        self.due.max(self.robot.ready())
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

    /// Whether nothing is left to do before `until`, or at it.
    #[inline]
    pub fn is_over(&self, until: Instant) -> bool {
        let now = self.robot.now();
        now >= until.min(self.last) && self.due() > now && self.next_from_outside() > now
    }

    /// When the next request is due, a fault begins or ends, or somebody lets a control go.
    #[inline]
    fn next_from_outside(&self) -> Instant {
        self.requests.next().min(self.faults.next_change()).min(self.holds.next_change())
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
        self.guarded(to, |session, to| session.tick_fitted(limit, gate, to))
    }

    /// Does the next thing, as [`Session::tick`] does without a limit or a gate, and says what that was.
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
        // Before the robot's driver goes on, too: it repeats commands.
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
        match now == before && target > now {
            true => self.stood_still(now, to),
            false => self.still = 0,
        }
        if outside <= now {
            self.before_step(now, to);
        }
        if self.due() <= now {
            self.step(now, to)?;
        }
        Ok(Go::On)
    }

    /// Takes samples and does what was asked for, where their time has come.
    #[cold]
    fn before_step(&mut self, now: Instant, to: &mut [&mut dyn Observer]) {
        if self.samples.next <= now {
            self.sample_on_grid(now, self.due() <= now, to);
        }
        if self.next_from_outside() <= now {
            self.apply_due(now, to);
        }
    }

    /// Makes the plan end here and now, as interrupted.
    pub fn stop(&mut self, to: &mut [&mut dyn Observer]) {
        let now = self.robot.now();
        self.apply_due(now, to);
        if self.scheduler.ending().is_none() {
            self.scheduler.request_stop();
            // A plan that has not started ends at its start; one that cannot start has nothing to stop.
            let _ = self.guarded(to, |session, to| session.step(now, to).map(|()| Go::On));
        }
        self.robot.emergency_stop();
    }

    /// Ends the plan here and now because nothing of it can be trusted any more.
    pub fn abort(&mut self, fault: Fault, to: &mut [&mut dyn Observer]) {
        let now = self.robot.now();
        let wake = self.scheduler.abort((&mut self.robot, &mut self.sink, &self.clock), fault);
        self.woke(wake, now, to);
    }

    /// Stops the robot for good and says what the run came to.
    pub fn end(&mut self) -> Figures {
        self.robot.emergency_stop();
        self.figures()
    }

    /// What the run came to so far.
    pub fn figures(&self) -> Figures {
        let measured = self.measures.iter().flat_map(|measure| measure.figures());
        Figures(measured.chain(self.robot.figures()).collect())
    }

    #[inline]
    fn step(&mut self, now: Instant, to: &mut [&mut dyn Observer]) -> Result<(), StartError> {
        let Session { scheduler, robot, sink, clock, .. } = self;
        let on = (robot, sink, &*clock);
        self.stepping = true;
        let wake = match self.started {
            true => scheduler.step(on, now),
            false => match scheduler.start(on, now) {
                Ok(wake) => wake,
                Err(why) => {
                    self.stepping = false;
                    return Err(why);
                }
            },
        };
        self.stepping = false;
        self.woke(wake, now, to);
        Ok(())
    }

    /// A step is over.
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

    /// The plan has ended, now or before.
    #[cold]
    fn ended(&mut self, now: Instant) {
        self.due = Instant::MAX;
        self.last = self.last.min(now + self.rest);
    }

    /// Fits what is kept, and the grid of samples, to who is there.
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

    /// The devices of the robot.
    fn table(&self) -> &'static [afp_core::devices::DeviceRow] {
        <R::Devices as Devices>::TABLE
    }
}

/// How often anybody wants samples.
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
