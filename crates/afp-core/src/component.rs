//! What a template's author writes: actors, supervisors, computations.
//!
//! The template traits (`ActorTemplate` and its siblings) are implemented by marker types that
//! `toolbox!` makes from a toolbox file; the component traits by the author. States and events
//! carry their outputs as payload, so "written only on that state" follows from the types.

use core::task::Poll;

use afp_types::Instant;

use crate::fault::Fault;

/// What every platform offers, whatever devices it has.
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
    /// Gives the stop command to every motor and returns at once: called where an actor cannot start, and at the end of a plan
    /// that [`Scheduler::run`](crate::Scheduler::run) drives. What is asked for afterwards is obeyed.
    fn stop(&mut self, now: Instant);

    /// Stops by the strongest means there is that the robot can be used after, once it is opened, reset or made anew: called when the run
    /// cannot be trusted any more, and before the robot is left alone, by whoever drives a scheduler. May be called several
    /// times and without a clock.
    fn emergency_stop(&mut self);
}

pub use afp_types::Events;

/// The ports and states of an actor, as its toolbox file declares them.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is declared in the toolbox, but not as an actor",
    note = "an actor implements `afp::Actor`, a supervisor `afp::Supervisor`, a computation `afp::Computation`"
)]
pub trait ActorTemplate {
    /// Inputs read once, before the start.
    type Inputs<'a>;
    /// Inputs read again before every poll.
    type Live<'a>;
    /// The states with the outputs that each carries.
    type State;
}

/// The ports and events of a supervisor, as its toolbox file declares them.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is declared in the toolbox, but not as a supervisor",
    note = "an actor implements `afp::Actor`, a supervisor `afp::Supervisor`, a computation `afp::Computation`"
)]
pub trait SupervisorTemplate {
    /// Inputs read once, before the start.
    type Inputs<'a>;
    /// Inputs read again before every poll.
    type Live<'a>;
    /// The events with the outputs that each carries.
    type Event;
}

/// The ports and states of a computation, as its toolbox file declares them.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is declared in the toolbox, but not as a computation",
    note = "an actor implements `afp::Actor`, a supervisor `afp::Supervisor`, a computation `afp::Computation`"
)]
pub trait ComputationTemplate {
    /// Its inputs.
    type Inputs<'a>;
    /// The states with the outputs that each carries.
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
/// The actor `Light` of a toolbox lights a lamp for a while. `toolbox!` makes `templates` from the toolbox file:
///
/// ```
/// use afp_core::{Actor, Fault, Instant, Poll};
/// # mod templates {
/// #     use afp_core::{ActorTemplate, quantity::Time};
/// #     pub struct Light;
/// #     impl ActorTemplate for Light {
/// #         type Inputs<'a> = light::Inputs;
/// #         type Live<'a> = light::Live;
/// #         type State = light::State;
/// #     }
/// #     pub mod light {
/// #         pub struct Inputs { pub lasting: super::Time }
/// #         pub struct Live {}
/// #         pub enum State { Lit }
/// #     }
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
    note = "either the platform lacks what the implementation asks for, or there is no `impl Actor<{T}, _> for {Self}`"
)]
pub trait Actor<T: ActorTemplate, E: ?Sized>: Sized {
    /// Begins to act. The first poll comes one period later.
    ///
    /// # Errors
    /// A fault means that nothing runs; the scheduler calls [`Environment::stop`], not
    /// `interrupt`.
    fn start(inputs: T::Inputs<'_>, env: &mut E, now: Instant) -> Result<Self, Fault>;

    /// Goes on without blocking. An actor that is ready leaves the robot as safe as an
    /// interrupted one.
    ///
    /// # Errors
    /// A fault means that the actor cannot go on; `interrupt` follows.
    fn poll(
        &mut self,
        live: T::Live<'_>,
        env: &mut E,
        now: Instant,
    ) -> Result<Poll<T::State>, Fault>;

    /// Gives the stop command and returns. Called exactly once for an actor that was started and
    /// did not finish, before anything else starts.
    ///
    /// # Errors
    /// A fault ends the whole run: what cannot be stopped must not be followed.
    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault>;
}

/// A watching supervisor of template `T` on platform `E`.
///
/// The supervisor `CheckDark` of a toolbox reads a light sensor; a sensor that does not answer is a fault:
///
/// ```
/// use afp_core::{Events, Fault, Instant, Reason, Supervisor};
/// # mod templates {
/// #     pub struct CheckDark;
/// #     impl afp_core::SupervisorTemplate for CheckDark {
/// #         type Inputs<'a> = check_dark::Inputs;
/// #         type Live<'a> = check_dark::Live;
/// #         type Event = check_dark::Event;
/// #     }
/// #     pub mod check_dark {
/// #         pub struct Inputs {}
/// #         pub struct Live { pub limit: f64 }
/// #         #[derive(Debug, PartialEq)]
/// #         pub enum Event { Dark }
/// #     }
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
    note = "either the platform lacks what the implementation asks for, or there is no `impl Supervisor<{T}, _> for {Self}`"
)]
pub trait Supervisor<T: SupervisorTemplate, E: ?Sized>: Sized {
    /// Begins to watch.
    ///
    /// # Errors
    /// A supervisor that cannot see is not "all clear": its actor goes to `Error`.
    fn start(inputs: T::Inputs<'_>, env: &mut E, now: Instant) -> Result<Self, Fault>;

    /// Looks without blocking; reports an event of the `wanted` ones or none, the first declared one
    /// where several hold. Wanted is what would be taken: neither ignored, nor leading to where the
    /// plan is already. That may be another set at each poll, and none.
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
}

/// A computation of template `T`: no environment, so no side effect.
///
/// ```
/// use afp_core::{Computation, Fault};
/// # mod templates {
/// #     pub struct Longer;
/// #     impl afp_core::ComputationTemplate for Longer {
/// #         type Inputs<'a> = longer::Inputs;
/// #         type State = longer::State;
/// #     }
/// #     pub mod longer {
/// #         pub struct Inputs { pub left: f64, pub right: f64 }
/// #         pub enum State { Done { result: f64 } }
/// #     }
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
    /// Computes at once.
    ///
    /// # Errors
    /// A fault takes the computation's `Error` edge.
    fn compute(inputs: T::Inputs<'_>) -> Result<T::State, Fault>;
}
