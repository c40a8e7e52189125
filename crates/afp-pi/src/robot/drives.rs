//! Drives for the calibration of a robot. The robot is stopped after each of them.

use std::f64::consts::TAU;
use std::fmt;

use afp_carbot::devices::{Motion, Navigator, Odometry, Ultrasonic};
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Environment, Instant, Platform};
use afp_platform::{Hardware, Settings};

use super::{JsonLine, Line, LocalLine, SerialRobot, WireLine};
use crate::board::{PicarX, Pins};

/// The interval of commands.
const STEP: Duration = Duration::from_millis(10);
/// The time for the robot to come to rest.
const REST: Duration = Duration::from_secs(3);
/// The time in which echoes are collected, and the fewest that count.
const LISTEN: Duration = Duration::from_secs(2);
const ECHOES: u32 = 10;

/// A robot that can be calibrated.
pub trait Calibrated {
    /// The distance between its wheels as set, in metres.
    fn track(&self) -> f64;

    /// Drives so far by the counts, in metres; straight ahead by the counts.
    ///
    /// # Errors
    /// The reason why the drive ended before.
    fn ahead(&mut self, metres: f64, goes: &dyn Fn() -> bool) -> Result<Drive, Halt>;

    /// The radius of its turns in metres; 0 on the spot.
    fn radius(&self) -> f64;

    /// Turns so often by the counts, counter-clockwise.
    ///
    /// # Errors
    /// The reason why the turns ended before.
    fn turns(&mut self, turns: f64, goes: &dyn Fn() -> bool) -> Result<Drive, Halt>;

    /// The mean distance to the echoes in front of the resting robot in metres; `None` without
    /// enough echoes.
    ///
    /// # Errors
    /// The controller does not answer.
    fn echoes(&mut self, goes: &dyn Fn() -> bool) -> Result<Option<f64>, Halt>;
}

/// The counts of a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// The way along the course in metres, backwards negative.
    pub way: f64,
    /// The change of the heading in radians, counter-clockwise.
    pub turned: f64,
    /// The time from the command to stop to standstill.
    pub stop: Duration,
}

/// Why a drive ended too early.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halt {
    /// Somebody asked for it.
    Asked,
    /// The controller does not answer, or has restarted.
    Silent,
    /// The bumper was pressed.
    Bumped,
    /// The counts do not change as they must.
    Stuck,
}

impl fmt::Display for Halt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Halt::Asked => "the drive was stopped",
            Halt::Silent => "the controller does not answer any longer",
            Halt::Bumped => "the bumper was pressed",
            Halt::Stuck => "the wheels do not count as the robot drives: check motors and encoders",
        })
    }
}

impl std::error::Error for Halt {}

/// Opens a robot of a profile for its calibration; `None` if there is no driver for the profile.
pub fn calibrated(
    profile: &str,
    settings: &Settings,
) -> Option<Result<Box<dyn Calibrated>, Box<dyn std::error::Error + Send + Sync>>> {
    fn open<L: Line>(
        settings: &Settings,
    ) -> Result<Box<dyn Calibrated>, Box<dyn std::error::Error + Send + Sync>> {
        Ok(Box::new(SerialRobot::<L>::open(settings)?))
    }
    match profile {
        WireLine::PROFILE => Some(open::<WireLine>(settings)),
        JsonLine::PROFILE => Some(open::<JsonLine>(settings)),
        <LocalLine<Pins>>::PROFILE => Some(open::<LocalLine<Pins>>(settings)),
        <LocalLine<PicarX>>::PROFILE => Some(open::<LocalLine<PicarX>>(settings)),
        _ => None,
    }
}

impl<L: Line> SerialRobot<L> {
    /// Commands rates, which `rates` chooses from the counts since the start, until it returns
    /// `None`.
    fn drive_by(
        &mut self,
        goes: &dyn Fn() -> bool,
        patience: Duration,
        rates: impl Fn(&Drive) -> Option<[f64; 2]>,
    ) -> Result<Drive, Halt> {
        let began = self.now();
        let mut drive = Drive { way: 0.0, turned: 0.0, stop: Duration::ZERO };
        let mut last: Option<Motion> = None;
        let mut halt = None;
        while halt.is_none() {
            match self.heard_of(&mut last, &mut drive) {
                Ok(()) => {}
                Err(why) => halt = Some(why),
            }
            let Some([speed, turn]) = rates(&drive) else { break };
            halt = halt
                .or_else(|| (!goes()).then_some(Halt::Asked))
                .or_else(|| (self.now().since(began) > patience).then_some(Halt::Stuck));
            if halt.is_none() {
                let now = self.now();
                self.drive(Speed::from_si(speed), AngularSpeed::from_si(turn), now);
                self.advance(now + STEP);
            }
        }
        let now = self.now();
        self.drive(Speed::from_si(0.0), AngularSpeed::from_si(0.0), now);
        self.rest(now, &mut last, &mut drive)?;
        halt.map_or(Ok(drive), Err)
    }

    /// Waits for standstill, and counts on.
    fn rest(
        &mut self,
        asked: Instant,
        last: &mut Option<Motion>,
        drive: &mut Drive,
    ) -> Result<(), Halt> {
        let mut stands_since = None;
        while self.now().since(asked) < REST {
            self.advance(self.now() + STEP);
            self.heard_of(last, drive)?;
            let stands = last.is_some_and(|motion| motion.stands());
            stands_since = stands.then(|| stands_since.unwrap_or(self.now()));
            if let Some(since) = stands_since {
                drive.stop = since.since(asked);
                if self.now().since(since) > Duration::from_millis(300) {
                    return Ok(());
                }
            }
        }
        self.emergency_stop();
        Err(Halt::Stuck)
    }

    /// Adds the counts since the last call.
    fn heard_of(&self, last: &mut Option<Motion>, drive: &mut Drive) -> Result<(), Halt> {
        let motion = self.motion().value.map_err(|_| Halt::Silent)?;
        if let Some(before) = last.replace(motion) {
            let (dx, dy) = (motion.x.si() - before.x.si(), motion.y.si() - before.y.si());
            let middle = (motion.heading.si() + before.heading.si()) / 2.0;
            let (sin, cos) = libm::sincos(middle);
            drive.way += dx * cos + dy * sin;
            drive.turned += motion.heading.si() - before.heading.si();
        }
        let bumped = self.values.bumper && self.report().is_ok_and(|(report, _)| report.bumper);
        if bumped { Err(Halt::Bumped) } else { Ok(()) }
    }

    /// A comfortable speed of the wheels in m/s.
    fn easy(&self) -> f64 {
        (f64::from(self.values.setup.fastest) * 0.6).min(0.25)
    }
}

/// Slows down towards the end, in units a second.
fn slowing(left: f64, most: f64) -> f64 {
    (left * 2.0).clamp(most * 0.1, most)
}

impl<L: Line> Calibrated for SerialRobot<L> {
    fn track(&self) -> f64 {
        f64::from(self.values.setup.track)
    }

    fn ahead(&mut self, metres: f64, goes: &dyn Fn() -> bool) -> Result<Drive, Halt> {
        let easy = self.easy();
        let patience = patience(metres / easy);
        self.drive_by(goes, patience, |drive| {
            let left = metres - drive.way;
            // The counts must stay straight, although the robot may not.
            (left > 0.0).then(|| [slowing(left, easy), -2.0 * drive.turned])
        })
    }

    fn radius(&self) -> f64 {
        // A car must not need all of its steering.
        f64::from(self.values.setup.narrowest) * 1.5
    }

    fn turns(&mut self, turns: f64, goes: &dyn Fn() -> bool) -> Result<Drive, Halt> {
        let radius = self.radius();
        let easy = self.easy() / (radius + self.track() / 2.0);
        let patience = patience(turns * TAU / easy);
        self.drive_by(goes, patience, |drive| {
            let left = turns * TAU - drive.turned;
            let turn = slowing(left, easy);
            (left > 0.0).then_some([turn * radius, turn])
        })
    }

    fn echoes(&mut self, goes: &dyn Fn() -> bool) -> Result<Option<f64>, Halt> {
        let (until, mut heard) = (self.now() + LISTEN, Vec::new());
        let mut last = Instant::ZERO;
        while self.now() < until {
            if !goes() {
                return Err(Halt::Asked);
            }
            self.advance(self.now() + STEP);
            self.motion().value.map_err(|_| Halt::Silent)?;
            let echo = self.echo();
            if let Some(distance) = echo.value.ok().and_then(|echo| echo.distance)
                && echo.time > last
            {
                last = echo.time;
                heard.push(distance.si());
            }
        }
        heard.sort_by(f64::total_cmp);
        // The median ignores single echoes of other things.
        Ok((heard.len() as u32 >= ECHOES).then(|| heard.get(heard.len() / 2).copied()).flatten())
    }
}

/// The longest time for a drive that takes so many seconds at its full speed.
fn patience(seconds: f64) -> Duration {
    Duration::from_secs_f64(seconds * 2.0 + 5.0)
}
