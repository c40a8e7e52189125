//! Real robots: time passes by itself, and motion cannot be undone.

use std::error::Error;

use afp_core::devices::Devices;
use afp_core::{Duration, Platform};

use crate::robot::Robot;
use crate::world::{Drawing, World, WorldError};
use crate::{Pose2, Shape};

/// A real robot. [`Platform::advance`] sleeps, and meanwhile transfers data in both directions. It
/// repeats commands that the robot must receive often, even if the sleep is long.
///
/// The driver calls [`Platform::advance`] at least every 20 ms, and
/// [`emergency_stop`](afp_core::Environment::emergency_stop) at the end. A process can die without
/// either, so the robot itself must stop if it receives no commands.
///
/// ```
/// use afp_session::{Hardware, Settings};
/// use std::error::Error;
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
///     port: String,
///     baud: u32,
///     now: Instant,
/// }
///
/// impl Hardware for Toy {
///     type Error = Box<dyn Error + Send + Sync>;
///
///     fn open(settings: &Settings) -> Result<Self, Self::Error> {
///         let port = settings.get("port").ok_or("'settings' does not name the 'port'")?;
///         let baud = settings.get_or("baud", "115200").parse()?;
///         Ok(Toy { port: port.to_owned(), baud, now: Instant::ZERO })
///     }
/// }
/// # let settings = Settings::new([("port", "/dev/ttyUSB0"), ("baud", "fast")]);
/// # assert!(Toy::open(&settings).is_err());
/// ```
pub trait Hardware:
    Robot<Devices: Devices<Fault: Send>> + Platform<Clock: Send> + Sized + Send + 'static
{
    /// The reason why the robot cannot be reached: any error or `String`. `Box<dyn Error + Send +
    /// Sync>` takes all of them with `?`.
    type Error: Into<Box<dyn Error + Send + Sync>>;

    /// Opens the robot without a motion; its time begins at zero.
    ///
    /// # Errors
    /// The robot cannot be reached. The error names what was tried and the result.
    fn open(settings: &Settings) -> Result<Self, Self::Error>;

    /// A function that stops the robot from another thread while a component hangs; `None` if that
    /// is impossible. It is called before the process ends by force.
    fn last_resort(&self) -> Option<LastResort> {
        None
    }
}

/// The default limit for the lateness of the control loop; beyond it, the run ends.
pub const STALL: Duration = Duration::from_millis(100);

/// Stops a robot from another thread.
pub type LastResort = Box<dyn FnMut() + Send>;

/// The hardware settings of the project: `port = "/dev/ttyUSB0"`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Settings(Vec<(String, String)>);

impl Settings {
    /// Names and values; for a repeated name the last value counts.
    pub fn new<'a>(all: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let owned = |(name, value): (&str, &str)| (name.to_owned(), value.to_owned());
        Settings(all.into_iter().map(owned).collect())
    }

    /// The value of a name as written.
    pub fn get(&self, name: &str) -> Option<&str> {
        let found = self.0.iter().rev().find(|(known, _)| known == name);
        found.map(|(_, value)| value.as_str())
    }

    /// The value of a name, or a default.
    pub fn get_or<'a>(&'a self, name: &str, usual: &'a str) -> &'a str {
        self.get(name).unwrap_or(usual)
    }
}

/// The world of a robot without one, real or simulated.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoWorld;

impl World for NoWorld {
    const DEFAULT: &'static str = "";

    fn read(text: &str) -> Result<Self, WorldError> {
        match text.trim().is_empty() {
            true => Ok(NoWorld),
            false => Err(WorldError::new(None, "this robot has no worlds")),
        }
    }

    fn name(&self) -> &str {
        "none"
    }

    fn started_at(&self, _: Pose2) -> Result<Self, WorldError> {
        Err(WorldError::new(None, "this robot has no worlds to start in"))
    }

    fn scene(&self) -> Vec<Shape> {
        Vec::new()
    }

    fn drawing(&self) -> Drawing {
        Drawing::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_later_of_two_settings_with_one_name_counts() {
        let settings = Settings::new([("port", "a"), ("baud", "9600"), ("port", "b")]);
        assert_eq!((settings.get("port"), settings.get("Port")), (Some("b"), None));
        assert_eq!(
            (settings.get_or("baud", "1"), settings.get_or("parity", "none")),
            ("9600", "none")
        );
    }
}
