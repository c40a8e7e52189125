//! The decisions of the controller.

use afp_types::Instant;
use afp_wire::{COMMAND_TIMEOUT, Received, Receiver, Rejected, Sender};

use crate::messages::{Command, LONGEST, Ping, Report, Setup, VERSION};
use crate::odometry::Odometry;
use crate::wheel::Wheel;
use crate::{REPORT, STEP};

/// The controller. See the [crate](crate) for its life.
#[derive(Debug)]
pub struct Controller {
    sender: Sender,
    receiver: Receiver<LONGEST>,
    /// Whether the computer waits for a hello.
    greets: bool,
    setup: Option<Setup>,
    /// Whether it obeys no command before the next start.
    stopped: bool,
    /// Speed and turn rate, as commanded.
    asked: [f32; 2],
    /// The speeds of the rims on the ramp, in m/s.
    rims: [f32; 2],
    wheels: [Wheel; 2],
    odometry: Odometry,
    /// The commanded bearing of the range sensor, in radians.
    bearing: f32,
    /// The last ping and its time.
    ping: Option<(Ping, Instant)>,
    /// The switches, as read.
    switches: [bool; 2],
    /// The time of the last report.
    reported: Instant,
}

/// The readings of one step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Inputs {
    /// The counts of the left and the right encoder, forwards up. They may overflow.
    pub counts: [i32; 2],
    /// Whether the switch of the bumper is closed.
    pub bumper: bool,
    /// Whether the switch of the button is closed.
    pub button: bool,
    /// A ping that was completed since the last step: the distance in metres, or `None` without an
    /// echo.
    pub ping: Option<Option<f32>>,
}

/// The commands of one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Outputs {
    /// The power of the left and the right motor, from -1 (backwards) to 1. At 0 the driver brakes.
    pub power: [f32; 2],
    /// The bearing of the range sensor in radians, counter-clockwise.
    pub bearing: f32,
}

impl Controller {
    /// A stationary controller. `boot` must differ from those of earlier starts: a random number,
    /// or a counter in persistent memory.
    pub fn new(boot: u32) -> Self {
        Controller {
            sender: Sender::new(boot, VERSION),
            receiver: Receiver::new(VERSION),
            greets: false,
            setup: None,
            stopped: true,
            asked: [0.0; 2],
            rims: [0.0; 2],
            wheels: [Wheel::default(); 2],
            odometry: Odometry::default(),
            bearing: 0.0,
            ping: None,
            switches: [false; 2],
            reported: Instant::ZERO,
        }
    }

    /// Takes a byte from the line.
    pub fn receive(&mut self, byte: u8, now: Instant) {
        match self.receiver.receive::<Command>(byte, now) {
            Some(Ok(Received::Hello)) => self.greets = true,
            Some(Ok(Received::Message { message, .. })) if message.is_possible() => {
                self.obey(message);
            }
            // A new program begins: the robot does not move before its start.
            Some(Err(Rejected::Restarted)) => {
                self.receiver.forget();
                self.stop();
            }
            // A program that speaks another version reads ours in the hello.
            Some(Err(Rejected::Version { .. })) => self.greets = true,
            _ => {}
        }
    }

    fn obey(&mut self, command: Command) {
        match command {
            Command::Setup(setup) if self.stopped => {
                self.setup = Some(setup);
                self.odometry = Odometry::default();
            }
            Command::Start => self.stopped &= self.setup.is_none(),
            Command::Stop => self.stop(),
            Command::Drive { speed, turn } if !self.stopped => self.asked = [speed, turn],
            Command::Point(bearing) if !self.stopped => self.bearing = bearing,
            Command::Setup(_) | Command::Drive { .. } | Command::Point(_) => {}
        }
    }

    fn stop(&mut self) {
        self.stopped = true;
        (self.asked, self.rims) = ([0.0; 2], [0.0; 2]);
        self.wheels.iter_mut().for_each(Wheel::release);
    }

    /// Makes a step of [`STEP`] up to `now`.
    pub fn step(&mut self, inputs: &Inputs, now: Instant) -> Outputs {
        self.switches = [inputs.bumper, inputs.button];
        if let Some(distance) = inputs.ping {
            self.ping = Some((Ping { distance, bearing: self.bearing, age: 0 }, now));
        }
        // A computer that was held up does not know what has happened meanwhile: it must start
        // again. The next step would be too late.
        if self.is_moving() && self.receiver.is_silent(now + STEP, COMMAND_TIMEOUT) {
            self.stop();
        }
        let Some(setup) = self.setup else { return Outputs::default() };
        let dt = STEP.as_secs_f64() as f32;
        let mut ways = [0.0; 2];
        let counts = inputs.counts.into_iter().zip(setup.metres_per_tick);
        for ((wheel, (count, metres)), way) in self.wheels.iter_mut().zip(counts).zip(&mut ways) {
            *way = wheel.count(count, metres);
        }
        self.odometry.add(ways, &setup);
        self.ramp(&setup, dt);
        let mut power = [0.0; 2];
        for ((wheel, rim), power) in self.wheels.iter_mut().zip(self.rims).zip(&mut power) {
            *power = wheel.power(rim, &setup, dt);
        }
        Outputs { power, bearing: self.bearing }
    }

    /// Brings the rims nearer to the command. Both change by the same share, so that the robot
    /// keeps to a curve.
    fn ramp(&mut self, setup: &Setup, dt: f32) {
        let [speed, turn] = self.asked;
        let wanted = setup.rims(speed, turn);
        let change = [wanted[0] - self.rims[0], wanted[1] - self.rims[1]];
        let largest = libm::fmaxf(libm::fabsf(change[0]), libm::fabsf(change[1]));
        let most = setup.fastest / setup.ramp * dt;
        if largest <= most {
            self.rims = wanted;
            return;
        }
        for (rim, change) in self.rims.iter_mut().zip(change) {
            *rim += change / largest * most;
        }
    }

    /// Whether the wheels are commanded to move.
    pub fn is_moving(&self) -> bool {
        self.asked != [0.0; 2] || self.rims != [0.0; 2]
    }

    /// Whether it obeys no command before the next start.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// The bytes to send now: a hello after that of the computer, and a report every [`REPORT`].
    pub fn transmit<'b>(&mut self, now: Instant, buffer: &'b mut [u8; 2 * LONGEST]) -> &'b [u8] {
        let mut length = 0;
        if core::mem::take(&mut self.greets) {
            length = self.sender.hello(buffer).map_or(0, <[u8]>::len);
        }
        if now.since(self.reported) >= REPORT {
            self.reported = now;
            let report = self.report(now);
            let rest = buffer.get_mut(length..).unwrap_or_default();
            length += self.sender.send(&report, rest).map_or(0, <[u8]>::len);
        }
        buffer.get(..length).unwrap_or_default()
    }

    fn report(&self, now: Instant) -> Report {
        let setup = self.setup.unwrap_or_default();
        let (speed, turn) = self.odometry.rates(&setup, STEP.as_secs_f64() as f32);
        let [bumper, button] = self.switches;
        let ping = self.ping.map(|(ping, at)| {
            let age = now.since(at).as_millis();
            Ping { age: u16::try_from(age).unwrap_or(u16::MAX), ..ping }
        });
        Report {
            pose: self.odometry.pose(),
            speed,
            turn,
            bumper: bumper != setup.bumper_opens,
            button: button != setup.button_opens,
            bearing: self.bearing,
            ping,
            stopped: self.stopped,
        }
    }
}

#[cfg(test)]
mod tests;
