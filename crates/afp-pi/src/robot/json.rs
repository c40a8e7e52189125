//! The line to the controller of a Waveshare UGV: one JSON object a line.
//!
//! The controller drives with `{"T":13,"X":m/s,"Z":rad/s}` and reports with `T` 1001: the speeds of
//! its wheels and their distances in centimetres. It stops by itself after the time of
//! `{"T":136,"cmd":ms}` without a command, 3 s by default. Its lines have no checksum, so only
//! possible numbers count.

use std::io::{self, Write};

use afp_core::{Duration, Instant};
use afp_drive::{Command, Report, Setup};
use afp_platform::{LastResort, RealTime, Settings};
use serde::Deserialize;

use super::Line;
use crate::link::Heard;
use crate::port::Port;

/// The longest line of the controller, in bytes.
const LONGEST: usize = 512;
/// The longest command, in bytes.
const COMMAND: usize = 64;
/// The controller stops after this time without a command. It forgets the time in a restart, so it
/// is repeated.
const SETTINGS: &[u8] = b"{\"T\":143,\"cmd\":0}\n{\"T\":142,\"cmd\":20}\n{\"T\":131,\"cmd\":1}\n";
const DEAD_MAN: &[u8] = b"{\"T\":136,\"cmd\":200}\n";
const REPEATED: Duration = Duration::from_millis(500);
const STOP: &[u8] = b"{\"T\":1,\"L\":0,\"R\":0}\n";
/// A wheel that is this much farther than in the last report has jumped: the controller has
/// restarted. Metres.
const JUMP: f64 = 0.2;
/// The top speed of a possible report, in metres a second.
const FASTEST: f32 = 10.0;

/// A report of the controller.
#[derive(Clone, Copy, Debug, Deserialize)]
struct Feedback {
    #[serde(rename = "T")]
    kind: i32,
    #[serde(rename = "L")]
    left: f32,
    #[serde(rename = "R")]
    right: f32,
    /// The distances of the wheels in centimetres.
    odl: f64,
    odr: f64,
}

/// The line to a UGV.
#[derive(Debug)]
pub struct JsonLine {
    port: Port,
    reports: Reports,
    /// The time of the last dead-man setting.
    guarded: Option<Instant>,
}

/// The reports of a UGV's controller, and the odometry that they give.
#[derive(Debug)]
pub struct Reports {
    line: [u8; LONGEST],
    length: usize,
    /// The distances of both wheels in the last report, in metres.
    ways: Option<[f64; 2]>,
    report: Report,
    restarted: bool,
    track: f64,
    /// The way of each wheel in metres for one metre of its counter.
    scale: [f64; 2],
}

impl Reports {
    /// No reports so far, of a robot with these measures.
    pub fn new(setup: &Setup) -> Self {
        Reports {
            line: [0; LONGEST],
            length: 0,
            ways: None,
            report: Report::default(),
            restarted: false,
            track: f64::from(setup.track),
            scale: setup.metres_per_tick.map(f64::from),
        }
    }

    /// Takes a byte; returns the report that it completes.
    pub fn take(&mut self, byte: u8) -> Option<Report> {
        self.completes(byte).then_some(self.report)
    }

    /// Whether a counter has jumped, as in a restart of the controller.
    pub fn has_restarted(&self) -> bool {
        self.restarted
    }

    fn completes(&mut self, byte: u8) -> bool {
        if byte != b'\n' {
            if let Some(place) = self.line.get_mut(self.length) {
                *place = byte;
            }
            // A line that is too long fails below.
            self.length = self.length.saturating_add(1);
            return false;
        }
        let length = std::mem::take(&mut self.length);
        let Some(line) = self.line.get(..length) else { return false };
        let feedback = serde_json::from_slice::<Feedback>(line).ok();
        feedback.is_some_and(|feedback| self.note(&feedback))
    }

    /// Adds a report to the odometry; returns whether it is possible.
    fn note(&mut self, feedback: &Feedback) -> bool {
        let Feedback { kind, left, right, odl, odr } = *feedback;
        let speeds = -FASTEST..=FASTEST;
        let is_possible = speeds.contains(&left) && speeds.contains(&right);
        if kind != 1001 || !is_possible || !odl.is_finite() || !odr.is_finite() {
            return false;
        }
        let ways = [odl / 100.0, odr / 100.0];
        let [before_left, before_right] = self.ways.replace(ways).unwrap_or(ways);
        let (left_way, right_way) = (ways[0] - before_left, ways[1] - before_right);
        if left_way.abs() > JUMP || right_way.abs() > JUMP {
            self.restarted = true;
            return false;
        }
        let (left_way, right_way) = (left_way * self.scale[0], right_way * self.scale[1]);
        let (driven, turned) = ((left_way + right_way) / 2.0, (right_way - left_way) / self.track);
        let [x, y, heading] = &mut self.report.pose;
        let (sin, cos) = libm::sincos(*heading + turned / 2.0);
        *x += driven * cos;
        *y += driven * sin;
        *heading += turned;
        self.report.speed = (left + right) / 2.0;
        self.report.turn = (right - left) / self.track as f32;
        true
    }
}

impl Line for JsonLine {
    const PROFILE: &'static str = "ugv";

    fn open(settings: &Settings, setup: &Setup) -> io::Result<Self> {
        let path = settings.get(Self::PLACE).unwrap_or_default();
        Ok(JsonLine {
            port: Port::open(path, 115_200, b'\n')?,
            reports: Reports::new(setup),
            guarded: None,
        })
    }

    fn begin(&mut self) {
        self.port.write(SETTINGS);
        self.port.write(DEAD_MAN);
    }

    fn send(&mut self, command: &Command, now: Instant) {
        if self.guarded.is_none_or(|at| now.since(at) >= REPEATED) {
            self.guarded = Some(now);
            self.port.write(DEAD_MAN);
        }
        match command {
            Command::Drive { speed, turn } => {
                let mut bytes = [0; COMMAND];
                let mut rest = &mut bytes[..];
                if writeln!(rest, "{{\"T\":13,\"X\":{speed:.4},\"Z\":{turn:.4}}}").is_ok() {
                    let length = COMMAND - rest.len();
                    self.port.write(bytes.get(..length).unwrap_or_default());
                }
            }
            Command::Stop => self.port.write(STOP),
            Command::Setup(_) | Command::Point(_) | Command::Start => {}
        }
    }

    fn discard(&mut self) {
        self.port.discard();
    }

    fn hear(&mut self, time: &RealTime) -> Option<Heard<Report>> {
        let mut last = None;
        let mut bytes = [0; LONGEST];
        loop {
            let read = self.port.read(&mut bytes);
            for byte in bytes.get(..read).unwrap_or_default() {
                if let Some(report) = self.reports.take(*byte) {
                    last = Some(Heard::Message(report, time.now()));
                }
            }
            if read < LONGEST {
                break;
            }
        }
        if self.reports.restarted { Some(Heard::Restarted) } else { last }
    }

    fn last_resort(&self) -> Option<LastResort> {
        let mut port = self.port.copy()?;
        Some(Box::new(move || {
            port.discard();
            port.write(STOP);
        }))
    }

    fn release(&self) {
        self.port.release();
    }
}
