//! Robots with a controller that executes driving commands: a second one on a serial port, or a
//! thread of this program.
//!
//! The driver repeats the command every 20 ms. A stop overtakes queued commands. While the
//! controller is silent, the driver sends only standstill; after a restart of the controller, only
//! [`Command::Stop`].

mod devices;
pub(crate) mod drives;
mod json;
mod local;
mod wire;

use std::error::Error;
use std::io;

use afp_carbot::devices::{Body, Bump};
use afp_carbot::guard::CONTROLLER_RESTARTED;
use afp_carbot::table::{Carbot, Control, Fault};
use afp_carbot::trail::Trail;
use afp_core::{Duration, Environment, Instant, Invalid, Platform};
use afp_drive::{Command, Report, Setup, VERSION};
use afp_platform::{Hardware, LastResort, RealTime, Settings};
use afp_session::{
    Active, Figure, Opener, Pose2, Put, Refused, RequestError, Samples, only_hardware,
};

use crate::board::{PicarX, Pins};
use crate::link::Heard;
use crate::values::Values;

pub use json::{JsonLine, Reports};
pub use local::LocalLine;
pub use wire::WireLine;

/// Reports are discarded after this time.
const STALE: Duration = Duration::from_millis(100);
/// Commands are repeated this often.
const OFTEN: Duration = Duration::from_millis(20);
/// The controller must obey within this time after the port was opened.
const PATIENCE: Duration = Duration::from_secs(2);

/// The line to a robot's controller. Nothing waits; bytes that do not fit the line are lost.
///
/// A line to a controller of a simulated robot also presses buttons and breaks devices there.
pub trait Line: Send + Sized + 'static {
    /// The profile of its robots.
    const PROFILE: &'static str;
    /// The setting that names its device.
    const PLACE: &'static str = "port";

    /// Devices and facts that a robot with this line does not have. No device measures the true
    /// pose of a real robot.
    const LACKS: &'static [&'static str] =
        &["robot", "world", "infrared", "color", "camera", "battery", "localisation", "signals"];

    /// Opens the device for only this program.
    ///
    /// # Errors
    /// The device cannot be opened or set up.
    fn open(settings: &Settings, setup: &Setup) -> io::Result<Self>;

    /// Sends everything that a controller needs before it drives. It is called until the controller
    /// reports that it obeys.
    fn begin(&mut self);

    /// Sends a command.
    fn send(&mut self, command: &Command, now: Instant);

    /// Discards all commands in the output queue.
    fn discard(&mut self);

    /// Reads everything that has arrived; returns the last report.
    fn hear(&mut self, time: &RealTime) -> Option<Heard<Report>>;

    /// Stops the controller from another thread.
    fn last_resort(&self) -> Option<LastResort>;

    /// Lets other programs open the port.
    fn release(&self);

    /// The reason why the robot cannot be driven on, if there is one.
    fn broken(&self) -> Option<afp_core::Fault> {
        None
    }

    /// The simulated robot at the other end.
    fn simulated(&self) -> Option<&dyn Behind> {
        None
    }
}

/// A simulated robot at the other end of a line.
pub trait Behind {
    /// See [`afp_session::Robot::press`].
    ///
    /// # Errors
    /// The control cannot be pressed.
    fn press(&self, control: Control, held: bool) -> Result<(), Refused>;

    /// See [`afp_session::Robot::set_faults`].
    ///
    /// # Errors
    /// The robot has no faults to activate.
    fn set_faults(&self, active: &Active<'_, Fault>) -> Result<(), Refused>;

    /// See [`afp_session::Robot::put`].
    ///
    /// # Errors
    /// The object cannot be placed.
    fn put(&self, what: &Put, at: Pose2) -> Result<(), RequestError>;

    /// See [`afp_session::Robot::check_put`].
    ///
    /// # Errors
    /// As [`Behind::put`].
    fn check_put(&self, what: &Put, at: Pose2) -> Result<(), RequestError>;

    /// The facts that no device measures.
    fn sample(&self, to: &mut Samples<'_, '_>);

    /// See [`afp_session::Robot::figures`].
    fn figures(&self) -> Vec<Figure>;
}

/// A robot with the profile `carbot`.
pub type SerialCarbot = SerialRobot<WireLine>;
/// A robot with the profile `ugv`.
pub type Ugv = SerialRobot<JsonLine>;
/// A robot with the profile `pi`.
pub type PinRobot = SerialRobot<LocalLine<Pins>>;
/// A robot with the profile `picarx`.
pub type PicarXRobot = SerialRobot<LocalLine<PicarX>>;

/// A robot with a controller on a line.
#[derive(Debug)]
pub struct SerialRobot<L: Line> {
    time: RealTime,
    line: L,
    values: Values,
    heard: Option<Heard<Report>>,
    /// Speed in m/s and turn rate in rad/s, as commanded.
    asked: [f32; 2],
    /// The commanded bearing of the range sensor, in radians.
    bearing: f32,
    /// The time of the last commands.
    told: Instant,
    trail: Trail,
    bump: Option<Bump>,
}

/// Opens robots of a profile, for plans with the toolboxes `std` and `carbot`; `None` if there is no
/// driver for the profile.
pub fn opener(profile: &str) -> Option<Box<dyn Opener>> {
    macro_rules! opener {
        ($robot:ty) => {
            Some(Box::new(only_hardware::<$robot, _>(|registry| {
                afp_std::templates::register(registry);
                afp_carbot::register!(registry, $robot);
            })))
        };
    }
    match profile {
        WireLine::PROFILE => opener!(SerialCarbot),
        JsonLine::PROFILE => opener!(Ugv),
        <LocalLine<Pins>>::PROFILE => opener!(PinRobot),
        <LocalLine<PicarX>>::PROFILE => opener!(PicarXRobot),
        _ => None,
    }
}

impl<L: Line> SerialRobot<L> {
    /// Opens a line with the robot's measures, and starts its controller.
    ///
    /// # Errors
    /// The settings are invalid, or the controller cannot be reached.
    pub fn with_line(
        settings: &Settings,
        open: impl FnOnce(&Setup) -> Result<L, String>,
    ) -> Result<Self, Box<dyn Error + Send + Sync>> {
        let values = Values::read(L::PROFILE, settings)?;
        let line = open(&values.setup)?;
        let time = RealTime::start();
        let mut robot = SerialRobot {
            told: time.now(),
            time,
            line,
            values,
            heard: None,
            asked: [0.0; 2],
            bearing: 0.0,
            trail: Trail::new(),
            bump: None,
        };
        let port = settings.get(L::PLACE).unwrap_or_default();
        robot.begin().map_err(|error| format!("'{port}': {error}"))?;
        Ok(robot)
    }

    /// The last report, or the reason why there is none. A controller that has stopped by itself
    /// counts as silent.
    fn report(&self) -> Result<(Report, Instant), Invalid> {
        match self.heard {
            Some(Heard::Message(report, at))
                if self.time.now().since(at) < STALE && !report.stopped =>
            {
                Ok((report, at))
            }
            Some(Heard::Restarted) => Err(Invalid::Restarted),
            _ => Err(Invalid::NoAnswer),
        }
    }

    /// Takes the controller's reports.
    fn hear(&mut self) {
        let Some(heard) = self.line.hear(&self.time) else { return };
        self.heard = Some(heard);
        let Heard::Message(report, at) = heard else { return };
        let motion = devices::motion(&report);
        self.trail.note(motion, &self.body());
        if self.values.bumper && report.bumper {
            self.bump = Some(Bump { at: motion, time: at });
        }
    }

    fn body(&self) -> Body {
        devices::body(&self.values)
    }

    /// Connects and starts the controller. Frames may be lost, so everything is repeated until the
    /// controller obeys.
    fn begin(&mut self) -> Result<(), String> {
        let patience = self.time.now() + PATIENCE;
        loop {
            self.line.begin();
            self.time.sleep_until(self.time.now() + OFTEN);
            self.hear();
            match self.heard {
                Some(Heard::Message(Report { stopped: false, .. }, _)) => return Ok(()),
                Some(Heard::Version(theirs)) => {
                    return Err(format!(
                        "the controller has version {theirs} of the protocol, this program has version {VERSION}"
                    ));
                }
                _ if self.time.now() <= patience => {}
                Some(Heard::Message(..)) => return Err("the controller does not start".to_owned()),
                Some(Heard::Restarted) => return Err("the controller restarts".to_owned()),
                None => return Err("the controller does not answer".to_owned()),
            }
        }
    }

    /// Sends the commands: a standstill while the controller is silent, because a controller that
    /// still receives would not stop by itself, and `Stop` after a restart.
    fn tell(&mut self) {
        self.told = self.time.now();
        match self.report() {
            Ok(_) => {
                let [speed, turn] = self.asked;
                let (speed, turn) = self.values.setup.reduced(speed, turn);
                self.line.send(&Command::Drive { speed, turn }, self.told);
                self.line.send(&Command::Point(self.bearing), self.told);
            }
            Err(Invalid::Restarted) => self.line.send(&Command::Stop, self.told),
            Err(_) => self.line.send(&Command::Drive { speed: 0.0, turn: 0.0 }, self.told),
        }
    }

    /// The time of the next commands. The first standstill of a silent controller does not wait for
    /// its turn.
    fn next_tell(&self) -> Instant {
        let next = self.told + OFTEN;
        match self.heard {
            Some(Heard::Message(_, at)) if at + STALE > self.told => next.min(at + STALE),
            _ => next,
        }
    }

    /// Stops the wheels, before everything in the output queue.
    fn halt_at_once(&mut self) {
        self.asked = [0.0; 2];
        self.line.discard();
        self.tell();
    }
}

impl<L: Line> Hardware for SerialRobot<L> {
    type Error = Box<dyn Error + Send + Sync>;

    fn open(settings: &Settings) -> Result<Self, Self::Error> {
        let place = L::PLACE;
        let port = settings.get(place).ok_or_else(|| format!("'{place}' has no value"))?;
        let at_port = |error: &dyn std::fmt::Display| format!("'{port}': {error}");
        SerialRobot::with_line(settings, |setup| {
            L::open(settings, setup).map_err(|error| at_port(&error))
        })
    }

    fn last_resort(&self) -> Option<LastResort> {
        self.line.last_resort()
    }
}

impl<L: Line> Environment for SerialRobot<L> {
    fn stop(&mut self, _: Instant) {
        self.halt_at_once();
    }

    fn emergency_stop(&mut self) {
        self.asked = [0.0; 2];
        self.line.discard();
        self.line.send(&Command::Stop, self.told);
    }
}

impl<L: Line> Drop for SerialRobot<L> {
    fn drop(&mut self) {
        self.emergency_stop();
        self.line.release();
    }
}

impl<L: Line> Platform for SerialRobot<L> {
    type Clock = RealTime;

    fn clock(&self) -> RealTime {
        self.time
    }

    fn now(&self) -> Instant {
        self.time.now()
    }

    fn advance(&mut self, to: Instant) {
        loop {
            self.hear();
            if self.time.now() >= self.next_tell() {
                self.tell();
            }
            self.time.sleep_until(to.min(self.next_tell()));
            // A sleep that lasted too long is noticed before anything is sent.
            if self.time.now() >= to {
                self.hear();
                return;
            }
        }
    }
}

impl<L: Line> afp_session::Robot for SerialRobot<L> {
    type Devices = Carbot;
    const LACKS: &'static [&'static str] = L::LACKS;

    fn sample(&self, to: &mut Samples<'_, '_>) {
        self.sample_devices(to);
        if let Some(behind) = self.line.simulated() {
            behind.sample(to);
        }
    }

    fn press(&mut self, control: Control, held: bool) -> Result<(), Refused> {
        self.line.simulated().ok_or(Refused)?.press(control, held)
    }

    fn set_faults(&mut self, active: &Active<'_, Fault>) -> Result<(), Refused> {
        self.line.simulated().ok_or(Refused)?.set_faults(active)
    }

    fn put(&mut self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        self.line.simulated().ok_or(RequestError::Refused)?.put(what, at)
    }

    fn check_put(&self, what: &Put, at: Pose2) -> Result<(), RequestError> {
        self.line.simulated().ok_or(RequestError::Refused)?.check_put(what, at)
    }

    fn figures(&self) -> Vec<Figure> {
        self.line.simulated().map(Behind::figures).unwrap_or_default()
    }

    /// A controller that is silent cannot tell, and is not armed.
    fn button(&self) -> Option<bool> {
        self.values.button.then(|| self.report().is_ok_and(|(report, _)| report.button))
    }

    fn broken(&self) -> Option<afp_core::Fault> {
        match self.heard {
            Some(Heard::Restarted) => Some(CONTROLLER_RESTARTED),
            _ => self.line.broken(),
        }
    }
}
