//! Requests to a session.

use std::sync::Arc;

#[cfg(feature = "load")]
use afp::load::{Injection, LoadedPlan, NotInjected};
#[cfg(feature = "load")]
use afp_core::ElementId;
use afp_core::devices::{ControlId, Devices, FaultId, controls, faults};
use afp_core::rt::{NamedPlan, Plan};
use afp_core::trace::ComponentId;
use afp_core::trace::Names as _;
use afp_core::{Clock, Duration, EntryId, Instant, Release, Value, WriteError};

use super::Session;
use super::meter::Meter;
use crate::hardware::{Hardware, STALL};
use crate::holds::Hold;
use crate::not_set::NotSet;
use crate::observer::{Applied, Observer};
use crate::record::{Keep, Kept};
use crate::request::{Put, Request, RequestError, RequestId, Waiting};
use crate::robot::Robot;
use crate::sample::Pose2;
use crate::stimulus::Stimulus;
use crate::watch::{Pulse, Watch};

/// Functions that only loaded plans have.
pub(super) struct Testing<P> {
    #[cfg(feature = "load")]
    inject: fn(&mut P, Option<ElementId>, &Injection) -> Result<(), NotInjected>,
    idle: fn(&mut P, Option<ComponentId>) -> bool,
}

/// The work of a step.
#[derive(Clone, Copy, Debug)]
pub(super) enum Work {
    Start,
    Step,
    Hold,
    Release(Release),
}

/// The result of a request.
struct Done {
    /// The time of the request.
    at: Instant,
    id: RequestId,
    /// By names, if an observer wants it.
    what: Option<Stimulus>,
    /// Whether it activates a fault.
    breaks: bool,
    result: Result<(), RequestError>,
}

impl<P> Testing<P> {
    pub(super) fn copy(&self) -> Self {
        Testing {
            #[cfg(feature = "load")]
            inject: self.inject,
            idle: self.idle,
        }
    }
}

impl<P, R> Session<P, R, Kept>
where
    P: NamedPlan + Plan<R>,
    R: Hardware,
{
    /// As [`Session::new`], on a real robot: controls and faults are not available, and the run
    /// ends if the control loop is later than [`STALL`].
    pub fn on_hardware(plan: P, robot: R) -> Self {
        let pulse: Arc<Pulse> = Arc::default();
        let mut session = Session::with_sink(plan, robot, Kept::with_room(pulse.clone()));
        session.stall = Some(STALL);
        session.pulse = Some(pulse);
        session.meter = Some(Box::new(Meter::new(session.names.components())));
        session
    }

    /// The watch of the control loop, for another thread.
    pub fn watch(&self) -> Option<Watch> {
        let (pulse, clock) = (self.pulse.clone()?, self.robot.clock());
        Some(Watch::new(pulse, Box::new(move || clock.now(Instant::ZERO))))
    }
}

#[cfg(feature = "load")]
impl<R: Robot + 'static> Session<LoadedPlan<R>, R, Kept> {
    /// A loaded plan on a robot: its components can be made to report outcomes, or to do nothing.
    pub fn loaded(plan: LoadedPlan<R>, robot: R) -> Self {
        Session::new(plan, robot).testable()
    }

    /// Lets components be made to report outcomes, or to do nothing.
    pub(crate) fn testable(mut self) -> Self {
        self.testing = Some(Testing { inject: LoadedPlan::inject, idle: LoadedPlan::idle });
        self
    }
}

impl<P, R, S> Session<P, R, S>
where
    P: NamedPlan + Plan<R>,
    R: Robot,
    S: Keep,
{
    /// Makes a request for an instant. It is checked now and done then; observers learn if it fails
    /// then. On a real robot, an instant in the past means now.
    ///
    /// # Errors
    /// The request can never be done.
    pub fn at(&mut self, at: Instant, request: Request) -> Result<RequestId, RequestError> {
        let now = self.robot.now();
        if at < now && self.stall.is_none() {
            return Err(RequestError::Over { at, now });
        }
        let at = at.max(now);
        self.check(&request, at == now)?;
        let at = self.after_step_at(at);
        self.asked.push((at, request.clone()));
        Ok(self.requests.add(at, request))
    }

    /// The instant, or the next one if its step is over: requests come before the step of their
    /// instant, also when the run is repeated.
    fn after_step_at(&self, at: Instant) -> Instant {
        match self.stepped == Some(at) {
            true => at + Duration::from_nanos(1),
            false => at,
        }
    }

    /// Requests whose time has not come, by time.
    pub fn pending(&self) -> Vec<(Instant, RequestId, Stimulus)> {
        let named = |request| Stimulus::new(request, self.table(), &self.names);
        self.requests.pending().map(|(at, id, request)| (at, id, named(request))).collect()
    }

    /// All requests so far with their times.
    pub fn requests(&self) -> &[(Instant, Request)] {
        &self.asked
    }

    /// Whether the plan is held.
    pub fn is_held(&self) -> bool {
        self.scheduler.is_held()
    }

    /// Whether a request could be made for some instant.
    ///
    /// # Errors
    /// The request can never be done.
    pub fn can(&self, request: &Request) -> Result<(), RequestError> {
        self.check(request, false)
    }

    /// Whether a request can be done: now if `is_now`, else at some time.
    fn check(&self, request: &Request, is_now: bool) -> Result<(), RequestError> {
        let of_plan = !matches!(
            request,
            Request::Press(..) | Request::Hold(..) | Request::Break(..) | Request::Put(..)
        );
        if of_plan && self.scheduler.ending().is_some() {
            return Err(RequestError::Ended);
        }
        match request {
            Request::Press(..) | Request::Hold(..) | Request::Break(..) if self.stall.is_some() => {
                Err(RequestError::Refused)
            }
            Request::Write(entry, value) => {
                self.scheduler.plan().accepts(entry.0, value).map_err(RequestError::Write)
            }
            Request::Press(id, _) | Request::Hold(id, _) => self.check_control(*id),
            Request::Break(id, amount, _) => self.check_fault(*id, *amount),
            Request::Inject(..) | Request::Idle(_) => {
                self.testing.as_ref().map(|_| ()).ok_or(RequestError::Compiled)
            }
            Request::Put(what, at) => self.check_put(what, *at, is_now),
            Request::Pause | Request::Release(_) if !P::HOLDS => Err(RequestError::NotHeld),
            Request::Pause | Request::Release(_) | Request::Stop => Ok(()),
        }
    }

    fn check_put(&self, what: &Put, at: Pose2, is_now: bool) -> Result<(), RequestError> {
        let Pose2 { x, y, heading } = at;
        if ![x, y, heading].into_iter().all(f64::is_finite) {
            return Err(RequestError::Nowhere);
        }
        let is_next = is_now && self.requests.next() > self.robot.now();
        match self.robot.check_put(what, at) {
            // The room or the thing may exist by then.
            Err(RequestError::Occupied(_) | RequestError::NoThing(_)) if !is_next => Ok(()),
            checked => checked,
        }
    }

    fn check_control(&self, id: ControlId) -> Result<(), RequestError> {
        let found = controls(self.table()).find(|(known, ..)| *known == id);
        let (_, device, _) = found.ok_or(RequestError::NoControl)?;
        lacks::<R>(device.name, "")
    }

    fn check_fault(&self, id: FaultId, amount: Option<f64>) -> Result<(), RequestError> {
        let found = faults(self.table()).find(|(known, ..)| *known == id);
        let (_, device, row) = found.ok_or(RequestError::NoFault)?;
        lacks::<R>(device.name, row.name)?;
        match (R::Devices::fault(id, amount), amount) {
            (Some(_), _) => Ok(()),
            (None, Some(amount)) => Err(RequestError::Amount(amount)),
            (None, None) => Err(RequestError::NoFault),
        }
    }

    /// Does the requests that are due, begins and ends faults, and ends holds.
    pub(super) fn apply_due(&mut self, now: Instant, to: &mut [&mut dyn Observer]) {
        let mut applied = Vec::new();
        while let Some((at, id, Waiting { request, done })) = self.requests.take_due(now) {
            let what = (!to.is_empty()).then(|| Stimulus::new(&request, self.table(), &self.names));
            let breaks = matches!(request, Request::Break(..));
            let result = if done { Ok(()) } else { self.apply(id, request, now) };
            applied.push(Done { at, id, what, breaks, result });
        }
        applied.extend(self.let_go(now, !to.is_empty()));
        if applied.iter().any(|done| done.breaks) || self.faults.next_change() <= now {
            let set = self.robot.set_faults(&self.faults.advance(now));
            for done in applied.iter_mut().filter(|done| done.breaks && done.result.is_ok()) {
                if set.is_err() {
                    done.result = Err(RequestError::Refused);
                }
            }
        }
        for Done { at, id, what, result, .. } in &applied {
            let Some(what) = what else { continue };
            let applied = Applied { now, at: *at, id: *id, what, refused: result.as_ref().err() };
            to.iter_mut().for_each(|each| each.on_request(&applied));
        }
    }

    fn apply(&mut self, by: RequestId, request: Request, now: Instant) -> Result<(), RequestError> {
        match request {
            Request::Write(entry, value) => {
                self.scheduler.write(entry, value).map_err(RequestError::Write)
            }
            Request::Press(control, true) => self.hold(Hold { control, by, until: Instant::MAX }),
            Request::Hold(control, lasting) => {
                self.hold(Hold { control, by, until: now + lasting })
            }
            Request::Press(control, false) => {
                self.holds.end(control);
                self.press(control, false)
            }
            Request::Break(id, amount, lasting) => {
                let fault = R::Devices::fault(id, amount).ok_or(RequestError::NoFault)?;
                self.faults.add(fault, now, now + lasting);
                Ok(())
            }
            #[cfg(feature = "load")]
            Request::Inject(component, outcome, outputs) => {
                self.inject(&Injection { component, outcome, outputs })
            }
            #[cfg(not(feature = "load"))]
            Request::Inject(..) => Err(RequestError::Compiled),
            Request::Idle(element) => {
                let testing = self.testing.as_ref().ok_or(RequestError::Compiled)?;
                match (testing.idle)(self.scheduler.plan_under_test(), element) {
                    true => Ok(()),
                    false => Err(RequestError::NoElement),
                }
            }
            Request::Put(what, at) => self.robot.put(&what, at),
            Request::Pause => {
                self.steer(Work::Hold, now);
                Ok(())
            }
            Request::Release(how) => {
                self.steer(Work::Release(how), now);
                Ok(())
            }
            Request::Stop => {
                self.scheduler.request_stop();
                // The stop does not wait for the plan's next step.
                self.due = self.due.min(now);
                Ok(())
            }
        }
    }

    /// Sets the work of the next step, which is due now. A plan that has not started holds at its
    /// start.
    fn steer(&mut self, work: Work, now: Instant) {
        if self.started {
            self.work = work;
            self.due = self.due.min(now);
            return;
        }
        let Session { scheduler, robot, sink, clock, .. } = self;
        let on = (robot, sink, &*clock);
        match work {
            Work::Hold => scheduler.hold(on, now),
            Work::Release(how) => scheduler.release(on, now, how),
            Work::Start | Work::Step => return,
        };
    }

    fn press(&mut self, id: ControlId, held: bool) -> Result<(), RequestError> {
        let control = R::Devices::control(id).ok_or(RequestError::NoControl)?;
        self.robot.press(control, held).map_err(|_| RequestError::Refused)
    }

    fn hold(&mut self, hold: Hold) -> Result<(), RequestError> {
        self.press(hold.control, true)?;
        self.holds.add(hold);
        Ok(())
    }

    /// Releases the controls whose last hold has ended.
    fn let_go(&mut self, now: Instant, told: bool) -> Vec<Done> {
        let over = self.holds.advance(now);
        let release = |Hold { control, by, until }| {
            let result = self.press(control, false);
            let request = Request::Press(control, false);
            let what = told.then(|| Stimulus::new(&request, self.table(), &self.names));
            Done { at: until, id: by, what, breaks: false, result }
        };
        over.into_iter().map(release).collect()
    }

    #[cfg(feature = "load")]
    fn inject(&mut self, injection: &Injection) -> Result<(), RequestError> {
        let testing = self.testing.as_ref().ok_or(RequestError::Compiled)?;
        let active = self.scheduler.active();
        let done = (testing.inject)(self.scheduler.plan_under_test(), active, injection);
        done.map_err(|why| {
            let path = self.names.component(injection.component).path.to_owned();
            match why {
                NotInjected::Waiting => RequestError::Reports(path),
                _ => RequestError::NotActive(path),
            }
        })
    }

    /// Writes an entry: an `in` entry at once before the start, later any entry with the next step.
    ///
    /// # Errors
    /// The value does not fit, the plan has ended, or too many writes are pending.
    pub fn write(&mut self, entry: EntryId, value: Value) -> Result<(), WriteError> {
        self.scheduler.write(entry, value.clone())?;
        let at = self.after_step_at(self.robot.now());
        let request = Request::Write(entry, value);
        self.asked.push((at, request.clone()));
        self.requests.add_done(at, request);
        Ok(())
    }

    /// Writes the seed of the run to the plan's input `seed`. The recipe of the run has the seed, so
    /// this is not a request. An entry of another kind or type keeps its value.
    pub(crate) fn write_seed(&mut self, seed: u64) {
        if let Some(entry) = self.scheduler.plan().entry_named("seed") {
            let _ = self.scheduler.write(entry, Value::Int(seed.cast_signed()));
        }
    }

    /// Writes an entry as text, `35 cm`: before the start an `in` entry, later any entry with the
    /// next step. Returns the value.
    ///
    /// # Errors
    /// The entry does not exist or cannot be written; the value does not fit.
    pub fn set(&mut self, entry: &str, text: &str) -> Result<Value, NotSet> {
        let set = self.scheduler.read_named(entry, text).and_then(|(id, value)| {
            self.write(id, value.clone())?;
            Ok(value)
        });
        set.map_err(|why| {
            let plan = self.scheduler.plan();
            let units = plan.entry_named(entry).into_iter().flat_map(|id| plan.units(id.0));
            let units: Vec<_> = units.map(|unit| unit.name).collect();
            NotSet::new(why, &self.names, self.started, (entry, text), &units)
        })
    }
}

/// Whether a robot has a part of its declared devices.
fn lacks<R: Robot>(device: &str, part: &str) -> Result<(), RequestError> {
    let missing = R::LACKS.iter().find(|known| match known.split_once('.') {
        None => **known == device,
        Some((of, what)) => of == device && what == part,
    });
    missing.map_or(Ok(()), |what| Err(RequestError::Lacks(what)))
}
