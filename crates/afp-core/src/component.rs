//! Actors, supervisors and computations: the traits for authors of templates.
//!
//! `toolbox!` generates marker types that implement the template traits (`ActorTemplate` and its
//! siblings). The author implements the component traits. Outputs are payloads of states and
//! events, so the types guarantee that each output is written only on its state.

use core::task::Poll;

use afp_types::{Duration, Instant};

use crate::fault::Fault;

/// Operations of every platform, independent of its devices.
///
/// ```
/// use afp_core::{Environment, Instant};
///
/// struct Wheels {
///     speed: f64,
///     powered: bool,
/// }
///
/// impl Environment for Wheels {
///     fn stop(&mut self, _: Instant) {
///         self.speed = 0.0;
///     }
///
///     fn emergency_stop(&mut self) {
///         self.speed = 0.0;
///         self.powered = false;
///     }
/// }
/// # let mut wheels = Wheels { speed: 0.2, powered: true };
/// # wheels.stop(Instant::ZERO);
/// # assert!(wheels.speed == 0.0 && wheels.powered);
/// # wheels.emergency_stop();
/// # assert!(!wheels.powered);
/// ```
pub trait Environment {
    /// Sends the stop command to every motor and returns at once. Called if an actor cannot start,
    /// and at the end of a plan that [`Scheduler::run`](crate::Scheduler::run) drives. Later
    /// commands are obeyed.
    fn stop(&mut self, now: Instant);

    /// Keeps the robot stationary while the plan is held by a debugger. Called every 10 ms. The
    /// default sends the stop command.
    fn hold(&mut self, now: Instant) {
        self.stop(now);
    }

    /// Stops by the strongest means after which the robot is usable again once it is opened or
    /// reset. Called if the run can no longer be trusted, and by the driver before it leaves the
    /// robot unattended. May be called several times and without a clock.
    fn emergency_stop(&mut self);
}

pub use afp_types::Events;

/// Ports and states of an actor, as declared in its toolbox file.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is declared in the toolbox, but not as an actor",
    note = "an actor implements `afp::Actor`, a supervisor `afp::Supervisor`, a computation `afp::Computation`"
)]
pub trait ActorTemplate {
    /// Inputs read once, before the start.
    type Inputs<'a>;
    /// Inputs read again before every poll.
    type Live<'a>;
    /// The states with their outputs.
    type State;
}

/// Ports and events of a supervisor, as declared in its toolbox file.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is declared in the toolbox, but not as a supervisor",
    note = "an actor implements `afp::Actor`, a supervisor `afp::Supervisor`, a computation `afp::Computation`"
)]
pub trait SupervisorTemplate {
    /// Inputs read once, before the start.
    type Inputs<'a>;
    /// Inputs read again before every poll.
    type Live<'a>;
    /// The events with their outputs.
    type Event;
}

/// Ports and states of a computation, as declared in its toolbox file.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is declared in the toolbox, but not as a computation",
    note = "an actor implements `afp::Actor`, a supervisor `afp::Supervisor`, a computation `afp::Computation`"
)]
pub trait ComputationTemplate {
    /// The inputs.
    type Inputs<'a>;
    /// The states with their outputs.
    type State;
}

/// A running actor of template `T` on platform `E`.
///
/// ```text
///   start --Ok--> running --poll: Ready--> finished
///     |              |  \---poll: Err----> interrupt, then gone
///    Err: gone       \------interrupted--> interrupt, then gone
/// ```
///
/// The actor `Light` lights a lamp for a while. `toolbox!` generates `templates` from the toolbox
/// file:
///
/// ```
/// use afp_core::{Actor, Fault, Instant, Poll};
/// # mod templates {
/// # use afp_core::{ActorTemplate, quantity::Time};
/// # pub struct Light;
/// # impl ActorTemplate for Light {
/// # type Inputs<'a> = light::Inputs;
/// # type Live<'a> = light::Live;
/// # type State = light::State;
/// # }
/// # pub mod light {
/// # pub struct Inputs { pub lasting: super::Time }
/// # pub struct Live {}
/// # pub enum State { Lit }
/// # }
/// # }
/// # struct Lamp { on: bool }
/// use templates::light;
///
/// struct Light {
///     until: Instant,
/// }
///
/// impl Actor<templates::Light, Lamp> for Light {
///     fn start(inputs: light::Inputs, lamp: &mut Lamp, now: Instant) -> Result<Self, Fault> {
///         lamp.on = true;
///         Ok(Light { until: now + inputs.lasting.duration() })
///     }
///
///     fn poll(
///         &mut self,
///         _: light::Live,
///         lamp: &mut Lamp,
///         now: Instant,
///     ) -> Result<Poll<light::State>, Fault> {
///         lamp.on = now < self.until;
///         Ok(if lamp.on { Poll::Pending } else { Poll::Ready(light::State::Lit) })
///     }
///
///     fn interrupt(&mut self, lamp: &mut Lamp, _: Instant) -> Result<(), Fault> {
///         lamp.on = false;
///         Ok(())
///     }
/// }
/// # let mut lamp = Lamp { on: false };
/// # let at = |seconds| Instant::ZERO + afp_core::Duration::from_secs(seconds);
/// # let lasting = afp_core::quantity::Time::from_si(2.0);
/// # let mut light = Light::start(light::Inputs { lasting }, &mut lamp, at(0))?;
/// # assert!(light.poll(light::Live {}, &mut lamp, at(1))?.is_pending() && lamp.on);
/// # assert!(light.poll(light::Live {}, &mut lamp, at(2))?.is_ready() && !lamp.on);
/// # light.interrupt(&mut lamp, at(2))?;
/// # Ok::<(), Fault>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement the actor `{T}` on the platform `{E}`",
    note = "either the platform lacks a trait that the implementation needs, or there is no `impl Actor<{T}, _> for {Self}`"
)]
pub trait Actor<T: ActorTemplate, E: ?Sized>: Sized {
    /// Starts the actor. The first poll follows one period later.
    ///
    /// # Errors
    /// On a fault nothing runs; the scheduler calls [`Environment::stop`] instead of `interrupt`.
    fn start(inputs: T::Inputs<'_>, env: &mut E, now: Instant) -> Result<Self, Fault>;

    /// Continues without blocking. An actor that is ready leaves the robot as safe as an
    /// interrupted one.
    ///
    /// # Errors
    /// On a fault the actor cannot continue; `interrupt` follows.
    fn poll(
        &mut self,
        live: T::Live<'_>,
        env: &mut E,
        now: Instant,
    ) -> Result<Poll<T::State>, Fault>;

    /// Sends the stop command and returns. Called exactly once for an actor that started and did
    /// not finish, before anything else starts; for a suspended actor ([`Resumable`]) later.
    ///
    /// # Errors
    /// A fault ends the whole run, since nothing may follow an actor that does not stop.
    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault>;
}

/// An actor that can be set aside while a handler is active, and continue afterwards.
///
/// The toolbox file declares it: `actor Light resumable`. The generated code then requires this
/// implementation.
///
/// ```text
///   running --suspend--> suspended --resume--> running
///                            \------interrupted--> interrupt, then gone
/// ```
///
/// The actor `Light` of [`Actor`] lights a lamp for a while, without the time of a suspension:
///
/// ```
/// # use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};
/// # mod templates {
/// # pub struct Light;
/// # impl afp_core::ActorTemplate for Light {
/// # type Inputs<'a> = ();
/// # type Live<'a> = ();
/// # type State = ();
/// # }
/// # }
/// # struct Lamp { on: bool }
/// # struct Light { until: Instant }
/// # impl Actor<templates::Light, Lamp> for Light {
/// # fn start(_: (), lamp: &mut Lamp, now: Instant) -> Result<Self, Fault> {
/// # lamp.on = true;
/// # Ok(Light { until: now + Duration::from_secs(2) })
/// # }
/// # fn poll(&mut self, _: (), lamp: &mut Lamp, now: Instant) -> Result<Poll<()>, Fault> {
/// # lamp.on = now < self.until;
/// # Ok(if lamp.on { Poll::Pending } else { Poll::Ready(()) })
/// # }
/// # fn interrupt(&mut self, lamp: &mut Lamp, _: Instant) -> Result<(), Fault> {
/// # lamp.on = false;
/// # Ok(())
/// # }
/// # }
/// impl Resumable<templates::Light, Lamp> for Light {
///     fn suspend(&mut self, lamp: &mut Lamp, _: Instant) -> Result<(), Fault> {
///         lamp.on = false;
///         Ok(())
///     }
///
///     fn resume(&mut self, _: &mut Lamp, _: Instant, away: Duration) -> Result<(), Fault> {
///         self.until += away;
///         Ok(())
///     }
/// }
/// # let mut lamp = Lamp { on: false };
/// # let at = |seconds| Instant::ZERO + Duration::from_secs(seconds);
/// # let mut light = Light::start((), &mut lamp, at(0))?;
/// # light.suspend(&mut lamp, at(1))?;
/// # assert!(!lamp.on);
/// # light.resume(&mut lamp, at(11), Duration::from_secs(10))?;
/// # assert!(light.poll((), &mut lamp, at(11))?.is_pending() && lamp.on);
/// # assert!(light.poll((), &mut lamp, at(12))?.is_ready() && !lamp.on);
/// # Ok::<(), Fault>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "the toolbox calls `{T}` resumable, but `{Self}` cannot be suspended on the platform `{E}`",
    note = "write `impl afp::Resumable<{T}, _> for {Self}`, or remove `resumable` from the toolbox file"
)]
pub trait Resumable<T: ActorTemplate, E: ?Sized>: Actor<T, E> {
    /// Stops and switches off all that the actor commands, and keeps its goal and its progress.
    /// Afterwards nothing but `resume` or `interrupt` is called.
    ///
    /// # Errors
    /// On a fault the actor cannot continue; `interrupt` follows.
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault>;

    /// Prepares the actor to continue after `away`, without a command that moves. The next poll
    /// follows one period later.
    ///
    /// # Errors
    /// On a fault the actor cannot continue; `interrupt` follows.
    fn resume(&mut self, env: &mut E, now: Instant, away: Duration) -> Result<(), Fault>;
}

/// The reaction of a supervisor when its element continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnReturn {
    /// It keeps its state.
    Continues,
    /// It starts again, with new inputs.
    Restarts,
}

/// A watching supervisor of template `T` on platform `E`.
///
/// The supervisor `CheckDark` reads a light sensor and faults if the sensor does not answer:
///
/// ```
/// use afp_core::{Events, Fault, Instant, Reason, Supervisor};
/// # mod templates {
/// # pub struct CheckDark;
/// # impl afp_core::SupervisorTemplate for CheckDark {
/// # type Inputs<'a> = check_dark::Inputs;
/// # type Live<'a> = check_dark::Live;
/// # type Event = check_dark::Event;
/// # }
/// # pub mod check_dark {
/// # pub struct Inputs {}
/// # pub struct Live { pub limit: f64 }
/// # #[derive(Debug, PartialEq)]
/// # pub enum Event { Dark }
/// # }
/// # }
/// # struct Sensor { brightness: Option<f64> }
/// use templates::check_dark;
///
/// const NO_SENSOR: Fault =
///     Fault::new(&Reason { code: "no-light-sensor", text: "the light sensor does not answer" });
///
/// struct CheckDark;
///
/// impl Supervisor<templates::CheckDark, Sensor> for CheckDark {
///     fn start(_: check_dark::Inputs, _: &mut Sensor, _: Instant) -> Result<Self, Fault> {
///         Ok(CheckDark)
///     }
///
///     fn poll(
///         &mut self,
///         live: check_dark::Live,
///         wanted: Events,
///         sensor: &mut Sensor,
///         _: Instant,
///     ) -> Result<Option<check_dark::Event>, Fault> {
///         let brightness = sensor.brightness.ok_or(NO_SENSOR)?;
///         let dark = wanted.contains(0) && brightness < live.limit;
///         Ok(dark.then_some(check_dark::Event::Dark))
///     }
/// }
/// # let mut sensor = Sensor { brightness: Some(0.1) };
/// # let mut check = CheckDark::start(check_dark::Inputs {}, &mut sensor, Instant::ZERO)?;
/// # let live = || check_dark::Live { limit: 0.2 };
/// # let seen = check.poll(live(), Events::from_bits(1), &mut sensor, Instant::ZERO)?;
/// # assert_eq!(seen, Some(check_dark::Event::Dark));
/// # assert_eq!(check.poll(live(), Events::from_bits(0), &mut sensor, Instant::ZERO)?, None);
/// # Ok::<(), Fault>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not implement the supervisor `{T}` on the platform `{E}`",
    note = "either the platform lacks a trait that the implementation needs, or there is no `impl Supervisor<{T}, _> for {Self}`"
)]
pub trait Supervisor<T: SupervisorTemplate, E: ?Sized>: Sized {
    /// Starts watching.
    ///
    /// # Errors
    /// A supervisor that cannot watch is not "all clear": its actor takes the `Error` edge.
    fn start(inputs: T::Inputs<'_>, env: &mut E, now: Instant) -> Result<Self, Fault>;

    /// Polls without blocking and reports at most one of the `wanted` events, the first declared if
    /// several hold. An event is wanted if it would be taken: it is not ignored and does not lead
    /// to the active element. The set may change at each poll and may be empty.
    ///
    /// # Errors
    /// As for [`Supervisor::start`].
    fn poll(
        &mut self,
        live: T::Live<'_>,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<T::Event>, Fault>;

    /// Called when an element that was set aside continues, for supervisors that were not polled
    /// for `away` and that their toolbox calls `resumable`. The default starts the supervisor again.
    ///
    /// # Errors
    /// As for [`Supervisor::start`].
    fn resume(&mut self, _env: &mut E, _now: Instant, _away: Duration) -> Result<OnReturn, Fault> {
        Ok(OnReturn::Restarts)
    }
}

/// A computation of template `T`: without an environment, so without side effects.
///
/// ```
/// use afp_core::{Computation, Fault};
/// # mod templates {
/// # pub struct Longer;
/// # impl afp_core::ComputationTemplate for Longer {
/// # type Inputs<'a> = longer::Inputs;
/// # type State = longer::State;
/// # }
/// # pub mod longer {
/// # pub struct Inputs { pub left: f64, pub right: f64 }
/// # pub enum State { Done { result: f64 } }
/// # }
/// # }
/// use templates::longer;
///
/// struct Longer;
///
/// impl Computation<templates::Longer> for Longer {
///     fn compute(inputs: longer::Inputs) -> Result<longer::State, Fault> {
///         Ok(longer::State::Done { result: inputs.left.max(inputs.right) })
///     }
/// }
/// # let longer::State::Done { result } = Longer::compute(longer::Inputs { left: 1.0, right: 2.0 })?;
/// # assert_eq!(result, 2.0);
/// # Ok::<(), Fault>(())
/// ```
#[diagnostic::on_unimplemented(message = "`{Self}` does not implement the computation `{T}`")]
pub trait Computation<T: ComputationTemplate> {
    /// Computes the result in one call.
    ///
    /// # Errors
    /// On a fault the plan takes the computation's `Error` edge.
    fn compute(inputs: T::Inputs<'_>) -> Result<T::State, Fault>;

    /// As [`Computation::compute`]. A declared computation stores the state whose condition or
    /// assignment it evaluates, for the message of a fault.
    ///
    /// # Errors
    /// As [`Computation::compute`].
    #[doc(hidden)]
    fn compute_in(inputs: T::Inputs<'_>, _: &mut Option<u16>) -> Result<T::State, Fault> {
        Self::compute(inputs)
    }
}
