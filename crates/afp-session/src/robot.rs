//! What a session asks of a robot, beyond that time passes for it.

use std::error::Error;
use std::fmt;

use afp_core::devices::Devices;
use afp_core::{Instant, Platform};

use crate::faults::Active;
use crate::figures::Figure;
use crate::observer::NamedRecord;
use crate::request::{Put, RequestError};
use crate::sample::{Pose2, Samples};
use crate::world::World;

/// What can be held down on a robot.
pub type ControlOf<R> = <<R as Robot>::Devices as Devices>::Control;
/// What can be broken of a robot.
pub type FaultOf<R> = <<R as Robot>::Devices as Devices>::Fault;

/// The robot does not do that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Refused;

/// A platform with devices. Hardware leaves `press` and `set_faults` out.
pub trait Robot: Platform {
    /// Its devices.
    type Devices: Devices;

    /// What its devices declare and it has not: `camera`, `wheels.slip`.
    const LACKS: &'static [&'static str] = &[];

    /// Holds a control down or lets it go.
    ///
    /// # Errors
    /// Nobody can press it here.
    fn press(&mut self, control: ControlOf<Self>, held: bool) -> Result<(), Refused> {
        let _ = (control, held);
        Err(Refused)
    }

    /// Breaks exactly these, and mends everything else.
    ///
    /// # Errors
    /// Nothing can be broken here.
    fn set_faults(&mut self, active: &Active<'_, FaultOf<Self>>) -> Result<(), Refused> {
        let _ = active;
        Err(Refused)
    }

    /// Puts something of its world somewhere, as a hand would: what it touches there is not pushed, and no wheel turns.
    ///
    /// # Errors
    /// There is no hand here, no such thing, or no room.
    fn put(&mut self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        let _ = (what, at);
        Err(RequestError::Refused)
    }

    /// Whether something could be put somewhere now, as [`Robot::put`] does it.
    ///
    /// # Errors
    /// As of [`Robot::put`].
    fn check_put(&self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        let _ = (what, at);
        Err(RequestError::Refused)
    }

    /// Says what its signals are now; one that is not said has no value now, whatever it said before. What is dear to compute is
    /// asked for with [`Samples::wants`].
    fn sample(&self, to: &mut Samples<'_, '_>);

    /// The same robot at the same instant, with a clock of its own; none where there is no such thing.
    fn keyframe(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// What it came to so far, beyond what measures say.
    fn figures(&self) -> Vec<Figure> {
        Vec::new()
    }
}

/// Something that can be put into a world while a plan runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Droppable {
    /// What it is called in [`Put::New`].
    pub shape: &'static str,
    /// Its outline around its middle, metres, counter-clockwise.
    pub outline: &'static [[f64; 2]],
}

/// A robot in a world, in virtual time.
pub trait Simulated:
    Robot<Devices: Devices<Fault: Send>> + Platform<Clock: Send> + Sized + Send + 'static
{
    /// The world.
    type World: World;
    /// Why the robot cannot be built in a world: a [`WorldError`](crate::WorldError), or any error or `String`.
    type Error: Into<Box<dyn Error + Send + Sync>>;

    /// The robot at its start, at time zero; `seed` decides on every noise.
    ///
    /// # Errors
    /// Why the world cannot be built.
    fn new(world: &Self::World, seed: u64) -> Result<Self, Self::Error>;

    /// The shapes that can be put into its world while a plan runs.
    const DROPS: &'static [Droppable] = &[];

    /// What logs say of it beyond that it is simulated: name and value.
    const FACTS: &'static [(&'static str, &'static str)] = &[];

    /// The names of its measures.
    const MEASURES: &'static [&'static str] = &[];

    /// A measure of that name.
    fn measure(name: &str) -> Option<Box<dyn Measure<Self>>> {
        let _ = name;
        None
    }
}

/// Judges a run, with all that the robot's own crate knows of the robot.
pub trait Measure<R>: Send {
    /// Takes a record of the step that is over.
    fn on_record(&mut self, record: &NamedRecord<'_>, robot: &R) {
        let _ = (record, robot);
    }

    /// Looks at the robot, every [`crate::SAMPLE`].
    fn on_sample(&mut self, at: Instant, robot: &R) {
        let _ = (at, robot);
    }

    /// What it came to.
    fn figures(&self) -> Vec<Figure>;

    /// The same judge at the same instant.
    fn keyframe(&self) -> Option<Box<dyn Measure<R>>> {
        None
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the robot does not do that")
    }
}

impl Error for Refused {}
