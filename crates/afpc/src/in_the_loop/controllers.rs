//! Controllers of simulated robots, each with the protocol of a profile.

use std::fmt::Write;

use afp_carbot::devices::{Button, Buttons, TouchSensor, Ultrasonic};
use afp_core::{Duration, Instant};
use afp_drive::{Inputs, LONGEST, Setup};
use afp_sim::Simulation;
use serde_json::Value;

/// The commands of a controller.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moves {
    /// The speeds of the left and the right rim in m/s.
    pub rims: [f64; 2],
    /// The bearing of the range sensor in radians.
    pub bearing: Option<f64>,
}

/// A controller.
pub trait Controller: Send + 'static {
    /// A controller of a robot with these measures.
    fn new(setup: &Setup) -> Self;

    /// Takes a byte from the line.
    fn receive(&mut self, byte: u8, now: Instant);

    /// Decides one step. `ways` has the distances of the wheels in metres.
    fn step(&mut self, robot: &Simulation, ways: [f64; 2], now: Instant) -> Moves;

    /// The bytes to send now.
    fn transmit(&mut self, now: Instant) -> Vec<u8>;
}

/// The second controller of the profile `carbot`, with its own program.
pub struct Wire {
    controller: afp_drive::Controller,
    setup: Setup,
    /// The time of the last echo.
    heard: Option<Instant>,
}

impl Controller for Wire {
    fn new(setup: &Setup) -> Self {
        Wire { controller: afp_drive::Controller::new(1), setup: *setup, heard: None }
    }

    fn receive(&mut self, byte: u8, now: Instant) {
        self.controller.receive(byte, now);
    }

    fn step(&mut self, robot: &Simulation, ways: [f64; 2], now: Instant) -> Moves {
        let setup = &self.setup;
        let count = |(way, metres): (f64, f32)| (way / f64::from(metres)) as i32;
        let [left, right] = [0, 1].map(|side: usize| {
            let of = |all: [f64; 2]| all.get(side).copied().unwrap_or_default();
            count((of(ways), of(setup.metres_per_tick.map(f64::from)) as f32))
        });
        let echo = robot.echo();
        let is_new = self.heard.replace(echo.time) != Some(echo.time);
        let distance = echo.value.map(|echo| echo.distance.map(|far| far.si() as f32));
        // A failed switch counts as pressed.
        let touched = robot.touched().value.unwrap_or(true);
        let pressed = robot.pressed(Button::Escape).value.unwrap_or(true);
        let inputs = Inputs {
            counts: [left, right],
            bumper: touched != setup.bumper_opens,
            button: pressed != setup.button_opens,
            ping: distance.ok().filter(|_| is_new),
        };
        let outputs = self.controller.step(&inputs, now);
        let full = f64::from(setup.at_full_power());
        let rims = outputs.power.map(|power| f64::from(power) * full);
        Moves { rims, bearing: Some(f64::from(outputs.bearing)) }
    }

    fn transmit(&mut self, now: Instant) -> Vec<u8> {
        self.controller.transmit(now, &mut [0; 2 * LONGEST]).to_vec()
    }
}

/// The controller of a Waveshare UGV.
pub struct Json {
    line: Vec<u8>,
    track: f64,
    rims: [f64; 2],
    ways: [f64; 2],
    /// The ways before the last step, for the speeds.
    before: [f64; 2],
    dead_man: Duration,
    commanded: Instant,
    reports: bool,
    sent: Instant,
}

/// The period of reports.
const REPORT: Duration = Duration::from_millis(20);
/// The longest line in bytes.
const LINE: usize = 512;

impl Json {
    fn obey(&mut self, now: Instant) {
        let line = std::mem::take(&mut self.line);
        let Ok(command) = serde_json::from_slice::<Value>(&line) else { return };
        let number = |key: &str| command.get(key).and_then(Value::as_f64).unwrap_or_default();
        match command.get("T").and_then(Value::as_i64) {
            Some(1) => self.drive([number("L"), number("R")], now),
            Some(13) => {
                let (speed, across) = (number("X"), number("Z") * self.track / 2.0);
                self.drive([speed - across, speed + across], now);
            }
            Some(131) => self.reports = number("cmd") == 1.0,
            Some(136) => self.dead_man = Duration::from_secs_f64(number("cmd") / 1000.0),
            _ => {}
        }
    }

    fn drive(&mut self, rims: [f64; 2], now: Instant) {
        (self.rims, self.commanded) = (rims, now);
    }
}

impl Controller for Json {
    fn new(setup: &Setup) -> Self {
        Json {
            line: Vec::new(),
            track: f64::from(setup.track),
            rims: [0.0; 2],
            ways: [0.0; 2],
            before: [0.0; 2],
            dead_man: Duration::from_secs(3),
            commanded: Instant::ZERO,
            reports: false,
            sent: Instant::ZERO,
        }
    }

    fn receive(&mut self, byte: u8, now: Instant) {
        match byte {
            b'\n' => self.obey(now),
            byte if self.line.len() < LINE => self.line.push(byte),
            _ => {}
        }
    }

    fn step(&mut self, _: &Simulation, ways: [f64; 2], now: Instant) -> Moves {
        if now.since(self.commanded) > self.dead_man {
            self.rims = [0.0; 2];
        }
        self.ways = ways;
        Moves { rims: self.rims, bearing: None }
    }

    fn transmit(&mut self, now: Instant) -> Vec<u8> {
        let took = now.since(self.sent);
        if !self.reports || took < REPORT {
            return Vec::new();
        }
        self.sent = now;
        let [before_left, before_right] = std::mem::replace(&mut self.before, self.ways);
        let [left, right] = self.ways;
        let speed = |way: f64| way / took.as_secs_f64();
        let (l, r) = (speed(left - before_left), speed(right - before_right));
        let (odl, odr) = (left * 100.0, right * 100.0);
        let mut line = String::new();
        let written = writeln!(
            line,
            "{{\"T\":1001,\"L\":{l:.4},\"R\":{r:.4},\"odl\":{odl:.3},\"odr\":{odr:.3}}}\r"
        );
        written.map(|()| line.into_bytes()).unwrap_or_default()
    }
}
