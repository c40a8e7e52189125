//! The interface between a session and a robot, beyond the passage of time.

use std::error::Error;

use afp_core::devices::{Devices, SignalId};
use afp_core::{Fault, Instant, Platform};

use crate::faults::Active;
use crate::figures::Figure;
use crate::observer::NamedRecord;
use crate::request::{Put, RequestError};
use crate::sample::{Pose2, SampleRef};
use crate::sampling::Samples;
use crate::world::World;

/// The controls of a robot.
pub type ControlOf<R> = <<R as Robot>::Devices as Devices>::Control;
/// The faults of a robot.
pub type FaultOf<R> = <<R as Robot>::Devices as Devices>::Fault;

/// The robot does not support the request.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the robot does not support that")]
pub struct Refused;

/// A platform with devices. Hardware leaves `press` and `set_faults` out.
///
/// The robot of this example has one button, which is also its signal. `Button`, `Panel` and
/// `PRESSED` usually come from `toolbox!`:
///
/// ```
/// use afp_session::{Refused, Robot, SampleRef, Samples, read_signal};
/// # use afp_core::devices::{ControlId, ControlRow, DeviceRow, Devices, FaultId};
/// # use afp_core::devices::{SignalId, SignalRow, SignalType};
/// # use afp_core::{Environment, Instant, Platform, StillClock};
/// # const PRESSED: SignalId = SignalId(0);
/// # #[derive(Clone, Copy)]
/// # struct Button;
/// # struct Panel;
/// # impl Devices for Panel {
/// # const TABLE: &'static [DeviceRow] = &[DeviceRow {
/// # name: "panel",
/// # help: "",
/// # controls: &[ControlRow { name: "go", help: "", stops: false }],
/// # faults: &[],
/// # signals: &[SignalRow { name: "pressed", ty: SignalType::Bool, truth: false, help: "" }],
/// # }];
/// # type Control = Button;
/// # type Fault = std::convert::Infallible;
/// # fn control(_: ControlId) -> Option<Button> { Some(Button) }
/// # fn fault(_: FaultId, _: Option<f64>) -> Option<std::convert::Infallible> { None }
/// # }
/// # impl Environment for Toy {
/// # fn stop(&mut self, _: Instant) {}
/// # fn emergency_stop(&mut self) {}
/// # }
/// # impl Platform for Toy {
/// # type Clock = StillClock;
/// # fn clock(&self) -> StillClock { StillClock }
/// # fn now(&self) -> Instant { self.now }
/// # fn advance(&mut self, to: Instant) { self.now = self.now.max(to) }
/// # }
///
/// struct Toy {
///     now: Instant,
///     pressed: bool,
/// }
///
/// impl Robot for Toy {
///     type Devices = Panel;
///
///     fn press(&mut self, _: Button, held: bool) -> Result<(), Refused> {
///         self.pressed = held;
///         Ok(())
///     }
///
///     fn sample(&self, to: &mut Samples<'_, '_>) {
///         to.put(PRESSED, SampleRef::Bool(self.pressed));
///     }
/// }
/// # let mut toy = Toy { now: Instant::ZERO, pressed: false };
/// # toy.press(Button, true)?;
/// # read_signal(&toy, PRESSED, &mut |value| assert_eq!(value, SampleRef::Bool(true)));
/// # Ok::<(), Refused>(())
/// ```
pub trait Robot: Platform {
    /// Its devices.
    type Devices: Devices;

    /// Devices and faults that are declared but that this robot lacks: `camera`, `wheels.slip`.
    const LACKS: &'static [&'static str] = &[];

    /// Presses or releases a control.
    ///
    /// # Errors
    /// The control cannot be pressed by software.
    fn press(&mut self, control: ControlOf<Self>, held: bool) -> Result<(), Refused> {
        let _ = (control, held);
        Err(Refused)
    }

    /// Activates exactly these faults.
    ///
    /// # Errors
    /// The robot has no faults to activate.
    fn set_faults(&mut self, active: &Active<'_, FaultOf<Self>>) -> Result<(), Refused> {
        let _ = active;
        Err(Refused)
    }

    /// Whether the button that arms a real robot is pressed; `None` for a robot without a button.
    fn button(&self) -> Option<bool> {
        None
    }

    /// Places an object of the world, as a hand would: nothing is pushed, and no wheel turns.
    ///
    /// # Errors
    /// The world has no such object, no room, or objects cannot be placed in it.
    fn put(&mut self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        let _ = (what, at);
        Err(RequestError::Refused)
    }

    /// Whether [`Robot::put`] would succeed now.
    ///
    /// # Errors
    /// As [`Robot::put`].
    fn check_put(&self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        let _ = (what, at);
        Err(RequestError::Refused)
    }

    /// The reason why the robot cannot be driven on, if there is one: its controller has restarted,
    /// for example. The run then ends with this fault.
    fn broken(&self) -> Option<Fault> {
        None
    }

    /// Gives the present values of the signals; a signal without one has no value now.
    /// [`Samples::wants`] tells whether an expensive value is needed.
    fn sample(&self, to: &mut Samples<'_, '_>);

    /// A copy of the robot at this instant, with its own clock; `None` if it cannot be copied.
    fn keyframe(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// The results of the robot so far, in addition to measures.
    fn figures(&self) -> Vec<Figure> {
        Vec::new()
    }
}

/// A thing that can be added to a world during a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Droppable {
    /// Its name in [`Put::New`].
    pub shape: &'static str,
    /// Its outline around its centre, metres, counter-clockwise.
    pub outline: &'static [[f64; 2]],
}

/// A simulated robot in a world, in virtual time.
///
/// ```
/// use afp_session::{NoWorld, Simulated, WorldError};
/// # use afp_session::{Robot, Samples};
/// # use std::convert::Infallible;
/// # use afp_core::devices::{ControlId, DeviceRow, Devices, FaultId};
/// # use afp_core::{Environment, Instant, Platform, StillClock};
/// # struct NoDevices;
/// # impl Devices for NoDevices {
/// # const TABLE: &'static [DeviceRow] = &[];
/// # type Control = Infallible;
/// # type Fault = Infallible;
/// # fn control(_: ControlId) -> Option<Infallible> { None }
/// # fn fault(_: FaultId, _: Option<f64>) -> Option<Infallible> { None }
/// # }
/// # impl Environment for Toy {
/// # fn stop(&mut self, _: Instant) {}
/// # fn emergency_stop(&mut self) {}
/// # }
/// # impl Platform for Toy {
/// # type Clock = StillClock;
/// # fn clock(&self) -> StillClock { StillClock }
/// # fn now(&self) -> Instant { self.now }
/// # fn advance(&mut self, to: Instant) { self.now = self.now.max(to) }
/// # }
/// # impl Robot for Toy {
/// # type Devices = NoDevices;
/// # fn sample(&self, _: &mut Samples<'_, '_>) {}
/// # }
///
/// struct Toy {
///     now: Instant,
///     seed: u64,
/// }
///
/// impl Simulated for Toy {
///     type World = NoWorld;
///     type Error = WorldError;
///
///     fn new(_: &NoWorld, seed: u64) -> Result<Self, WorldError> {
///         Ok(Toy { now: Instant::ZERO, seed })
///     }
/// }
/// # assert_eq!(Toy::new(&NoWorld, 3)?.seed, 3);
/// # Ok::<(), WorldError>(())
/// ```
pub trait Simulated:
    Robot<Devices: Devices<Fault: Send>> + Platform<Clock: Send> + Sized + Send + 'static
{
    /// The world.
    type World: World;
    /// The reason why the robot cannot be built in a world: a [`WorldError`](crate::WorldError), or
    /// any error or `String`.
    type Error: Into<Box<dyn Error + Send + Sync>>;

    /// The robot at its start, at time zero; `seed` determines all noise.
    ///
    /// # Errors
    /// The world cannot be built.
    fn new(world: &Self::World, seed: u64) -> Result<Self, Self::Error>;

    /// The shapes that can be added to its world during a run.
    const DROPS: &'static [Droppable] = &[];

    /// Additional facts for logs: name and value.
    const FACTS: &'static [(&'static str, &'static str)] = &[];

    /// The names of its measures.
    const MEASURES: &'static [&'static str] = &[];

    /// The measure of that name.
    fn measure(name: &str) -> Option<Box<dyn Measure<Self>>> {
        let _ = name;
        None
    }
}

/// Judges a run with knowledge of the robot's crate.
///
/// ```
/// use afp_core::Instant;
/// use afp_session::{Figure, FigureValue, Measure};
/// # struct Toy { x: f64 }
///
/// /// The farthest point that the robot reached.
/// #[derive(Clone, Default)]
/// struct Farthest(f64);
///
/// impl Measure<Toy> for Farthest {
///     fn on_sample(&mut self, _: Instant, robot: &Toy) {
///         self.0 = self.0.max(robot.x);
///     }
///
///     fn figures(&self) -> Vec<Figure> {
///         let value = FigureValue::Numbers(vec![("m", self.0)]);
///         vec![Figure { name: "farthest", value, text: format!("{:.2} m", self.0) }]
///     }
///
///     fn keyframe(&self) -> Option<Box<dyn Measure<Toy>>> {
///         Some(Box::new(self.clone()))
///     }
/// }
/// # let mut farthest = Farthest::default();
/// # farthest.on_sample(Instant::ZERO, &Toy { x: 0.5 });
/// # assert_eq!(farthest.figures()[0].text, "0.50 m");
/// ```
pub trait Measure<R>: Send {
    /// Takes a record of the step that ended.
    fn on_record(&mut self, record: &NamedRecord<'_>, robot: &R) {
        let _ = (record, robot);
    }

    /// Looks at the robot, every [`crate::SAMPLE`].
    fn on_sample(&mut self, at: Instant, robot: &R) {
        let _ = (at, robot);
    }

    /// Its results.
    fn figures(&self) -> Vec<Figure>;

    /// A copy of the measure at this instant.
    fn keyframe(&self) -> Option<Box<dyn Measure<R>>> {
        None
    }
}

/// Reads a signal of a robot; `to` is not called if the signal has no value.
pub fn read_signal<R: Robot>(robot: &R, signal: SignalId, to: &mut dyn FnMut(SampleRef<'_>)) {
    let table = <R::Devices as Devices>::TABLE;
    robot.sample(&mut Samples::of_one(robot.now(), table, signal, to));
}
