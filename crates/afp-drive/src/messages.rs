//! The messages between the robot's computer and the controller.

use core::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

/// The version of the messages. Each change of a message needs a new one.
pub const VERSION: u16 = 2;

/// The longest frame, in bytes.
pub const LONGEST: usize = 96;

/// The share of full power for the top speed; the rest keeps the wheels on their course.
const USED: f32 = 0.9;

/// A message of the computer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Command {
    /// Sets the robot's measures and its odometry to zero. A controller that obeys ignores it.
    Setup(Setup),
    /// Drive and turn until the next command.
    Drive {
        /// Speed ahead in m/s.
        speed: f32,
        /// Turn rate in rad/s, counter-clockwise.
        turn: f32,
    },
    /// Turn the range sensor to this bearing in radians, counter-clockwise.
    Point(f32),
    /// Cut the power, and obey no command before `Start`.
    Stop,
    /// Obey again. A controller without a setup ignores it.
    Start,
}

/// The measures of a robot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Setup {
    /// The distance between the two wheels, in metres.
    pub track: f32,
    /// The distances of the left and the right rim for one count of their encoders, in metres.
    pub metres_per_tick: [f32; 2],
    /// The top speed of a rim: nine tenths of its speed at full power, in m/s.
    pub fastest: f32,
    /// The time from standstill to the top speed, in seconds.
    pub ramp: f32,
    /// The radius of the narrowest curve, in metres; 0 for a robot that turns in place.
    pub narrowest: f32,
    /// Whether a pressed bumper opens its switch.
    pub bumper_opens: bool,
    /// Whether a pressed button opens its switch.
    pub button_opens: bool,
}

/// A message of the controller.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// Position along the heading at the setup and to the left of it, in metres; heading against
    /// it, in radians, not wrapped.
    pub pose: [f64; 3],
    /// Forward speed in m/s, by the encoders.
    pub speed: f32,
    /// Turn rate in rad/s, by the encoders.
    pub turn: f32,
    /// Whether the bumper is pressed.
    pub bumper: bool,
    /// Whether the button is pressed.
    pub button: bool,
    /// The bearing of the range sensor in radians.
    pub bearing: f32,
    /// The latest ping.
    pub ping: Option<Ping>,
    /// Whether the controller obeys no command before [`Command::Start`].
    pub stopped: bool,
}

/// A completed ping of the range sensor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ping {
    /// The distance in metres; `None` without an echo.
    pub distance: Option<f32>,
    /// The bearing of the range sensor in radians.
    pub bearing: f32,
    /// The time from the ping to the report, in milliseconds.
    pub age: u16,
}

impl Default for Setup {
    /// A robot of 18 cm with wheels of 65 mm.
    fn default() -> Self {
        Setup {
            track: 0.14,
            metres_per_tick: [0.000_142; 2],
            fastest: 0.5,
            ramp: 0.15,
            narrowest: 0.0,
            bumper_opens: true,
            button_opens: true,
        }
    }
}

impl Setup {
    /// Whether its numbers are in their ranges; a controller rejects other setups.
    pub fn is_possible(&self) -> bool {
        let within = |value: f32, limits: RangeInclusive<f32>| limits.contains(&value);
        within(self.track, 0.01..=2.0)
            && self.metres_per_tick.iter().all(|it| within(*it, 1e-8..=0.3))
            && within(self.fastest, 0.01..=5.0)
            && within(self.ramp, 0.005..=1.0)
            && within(self.narrowest, 0.0..=10.0)
    }

    /// The speeds of the left and the right rim for a command, in m/s. If a rim would be too fast,
    /// both are reduced by the same factor, so that the robot keeps to the curve. A curve that is
    /// too narrow becomes the narrowest one.
    pub fn rims(&self, speed: f32, turn: f32) -> [f32; 2] {
        let turn = match self.narrowest > 0.0 {
            true => {
                let most = libm::fabsf(speed) / self.narrowest;
                libm::fmaxf(-most, libm::fminf(turn, most))
            }
            false => turn,
        };
        let across = turn * self.track / 2.0;
        let rims = [speed - across, speed + across];
        let outer = libm::fmaxf(libm::fabsf(rims[0]), libm::fabsf(rims[1]));
        match outer > self.fastest {
            true => rims.map(|rim| rim / outer * self.fastest),
            false => rims,
        }
    }

    /// The speed and the turn rate with which the robot follows a command.
    pub fn reduced(&self, speed: f32, turn: f32) -> (f32, f32) {
        let [left, right] = self.rims(speed, turn);
        ((left + right) / 2.0, (right - left) / self.track)
    }

    /// The speed of a rim at full power, in m/s.
    pub fn at_full_power(&self) -> f32 {
        self.fastest / USED
    }
}

impl Command {
    /// Whether its numbers are possible; a controller rejects other commands.
    pub fn is_possible(&self) -> bool {
        match self {
            Command::Setup(setup) => setup.is_possible(),
            Command::Drive { speed, turn } => {
                let limits = -100.0..=100.0;
                limits.contains(speed) && limits.contains(turn)
            }
            Command::Point(bearing) => (-7.0..=7.0).contains(bearing),
            Command::Stop | Command::Start => true,
        }
    }
}

impl Report {
    /// Whether its numbers are possible; a computer rejects other reports.
    pub fn is_possible(&self) -> bool {
        let rates = [self.speed, self.turn, self.bearing];
        let ping = self.ping.is_none_or(|ping| {
            let is_length = |distance: f32| (0.0..=100.0).contains(&distance);
            ping.bearing.is_finite() && ping.distance.is_none_or(is_length)
        });
        self.pose.iter().all(|at| at.is_finite()) && rates.iter().all(|it| it.is_finite()) && ping
    }
}

#[cfg(test)]
mod tests {
    use afp_wire::Sender;

    use super::*;

    #[test]
    fn every_message_fits_a_frame() {
        let ping = Ping { distance: Some(f32::MIN), bearing: f32::MIN, age: u16::MAX };
        let report = Report { pose: [f64::MIN; 3], ping: Some(ping), ..Report::default() };
        let mut sender = Sender::new(u32::MAX, VERSION);
        let mut buffer = [0; LONGEST];
        assert!(sender.send(&report, &mut buffer).is_ok());
        let longest = Command::Setup(Setup::default());
        assert!(sender.send(&longest, &mut buffer).is_ok_and(|frame| frame.len() <= 44));
    }

    #[test]
    fn impossible_numbers_are_rejected() {
        for number in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX] {
            assert!(!Command::Drive { speed: number, turn: 0.0 }.is_possible());
            assert!(!Command::Drive { speed: 0.0, turn: number }.is_possible());
            assert!(!Command::Point(number).is_possible());
            let setup = Setup { metres_per_tick: [1e-4, number], ..Setup::default() };
            assert!(!Command::Setup(setup).is_possible());
        }
        assert!(!Report { pose: [0.0, f64::NAN, 0.0], ..Report::default() }.is_possible());
        let ping = Ping { distance: Some(-1.0), bearing: 0.0, age: 0 };
        assert!(!Report { ping: Some(ping), ..Report::default() }.is_possible());
        assert!(Report::default().is_possible() && Setup::default().is_possible());
    }

    #[test]
    fn a_reduced_command_keeps_to_its_curve() {
        let setup = Setup::default();
        let (speed, turn) = setup.reduced(0.2, 0.5);
        assert!((speed - 0.2).abs() < 1e-5 && (turn - 0.5).abs() < 1e-5, "{speed} {turn}");
        let (speed, turn) = setup.reduced(2.0, 1.0);
        assert!((speed / turn - 2.0).abs() < 1e-4, "{speed} {turn}");
        assert!((speed + turn * setup.track / 2.0 - setup.fastest).abs() < 1e-4);
    }

    #[test]
    fn a_car_drives_no_curve_narrower_than_its_narrowest() {
        let car = Setup { narrowest: 0.15, ..Setup::default() };
        for (asked, turns) in [(0.5, 0.5), (-0.5, -0.5), (9.0, 0.2 / 0.15)] {
            let (speed, turn) = car.reduced(0.2, asked);
            assert!((speed - 0.2).abs() < 1e-5 && (turn - turns).abs() < 1e-4, "{asked}: {turn}");
        }
        assert_eq!(car.reduced(0.0, 1.0), (0.0, 0.0));
    }
}
