//! Parts of an observation, each with its bounds.
//!
//! They contain values of devices, never ground truth. A broken device, or one without a new
//! measurement, keeps its last value. `distance`, `glow`, `color` and `valid` also tell whether the
//! value is known.

use afp_carbot::devices::{
    Battery, Color, ColorSensor, Glow, InfraredSensor, Motion, Odometry, TouchSensor, Ultrasonic,
};
use afp_core::Instant;
use afp_sim::{Pose, Simulation};

/// The observed distance if the range sensor has no echo, in metres.
pub const RANGE: f64 = 2.5;
/// The largest observed distance from the start, in metres.
const FAR: f32 = 1e3;
const PI: f32 = core::f32::consts::PI;
/// The tolerance between a ping and a bearing of the fan, in radians.
const AIMED: f64 = 0.06;
/// The pings after which the fan moves on in any case.
const PATIENCE: u32 = 12;

/// A part of an observation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Distance,
    Odometry,
    Motion,
    Bumper,
    Fan,
    Target,
    Glow,
    Color,
    Battery,
    Valid,
}

impl Part {
    /// All parts by name.
    pub const ALL: [(&'static str, Part); 10] = [
        ("distance", Part::Distance),
        ("odometry", Part::Odometry),
        ("motion", Part::Motion),
        ("bumper", Part::Bumper),
        ("fan", Part::Fan),
        ("target", Part::Target),
        ("glow", Part::Glow),
        ("color", Part::Color),
        ("battery", Part::Battery),
        ("valid", Part::Valid),
    ];

    /// Finds a part by name.
    ///
    /// # Errors
    /// There is none.
    pub fn named(name: &str) -> Result<Part, String> {
        let known = Part::ALL.iter().find(|(known, _)| *known == name);
        known.map(|(_, part)| *part).ok_or_else(|| {
            let names = Part::ALL.map(|(name, _)| name).join(", ");
            format!("no part '{name}' of an observation; there are: {names}")
        })
    }

    /// Minimum and maximum of each of its numbers; `fan` is the number of bearings.
    pub fn bounds(self, fan: usize) -> Vec<(f32, f32)> {
        let far = (-FAR, FAR);
        match self {
            Part::Distance => vec![(0.0, 10.0), (0.0, 1.0)],
            Part::Odometry => {
                vec![far, far, (-1.0, 1.0), (-1.0, 1.0), (-5.0, 5.0), (-20.0, 20.0)]
            }
            Part::Motion => vec![(-5.0, 5.0), (-20.0, 20.0)],
            Part::Bumper => vec![(0.0, 1.0)],
            Part::Fan => vec![(0.0, RANGE as f32); fan],
            Part::Target => vec![(0.0, FAR), (-1.0, 1.0), (-1.0, 1.0)],
            Part::Glow => vec![(0.0, 1.0), (-PI, PI), (0.0, 1e4)],
            Part::Color => vec![(0.0, 1.0); 4],
            Part::Battery => vec![(0.0, 100.0), (0.0, 1.0)],
            Part::Valid => vec![(0.0, 1.0); 5],
        }
    }
}

/// The last values of the devices.
#[derive(Clone, Debug)]
pub struct Senses {
    distance: Option<f64>,
    motion: [f64; 5],
    touched: bool,
    glow: Option<(f64, f64)>,
    color: Option<[f64; 3]>,
    battery: [f64; 2],
    /// Whether odometry, bumper, infrared sensor, colour sensor and battery respond.
    valid: [bool; 5],
    fan: Fan,
}

/// The last echo for each bearing; the range sensor sweeps over them to and fro.
#[derive(Clone, Debug, Default)]
struct Fan {
    bearings: Vec<f64>,
    echoes: Vec<f64>,
    next: usize,
    back: bool,
    waited: u32,
    heard: Option<Instant>,
}

impl Senses {
    /// The senses of a robot at its start, with the bearings of its fan, if any.
    pub fn new(sim: &mut Simulation, bearings: &[f64]) -> Senses {
        let echoes = vec![RANGE; bearings.len()];
        let fan = Fan { bearings: bearings.to_vec(), echoes, ..Fan::default() };
        let mut senses = Senses {
            distance: None,
            motion: [0.0; 5],
            touched: false,
            glow: None,
            color: None,
            battery: [0.0; 2],
            valid: [false; 5],
            fan,
        };
        senses.fan.aim(sim);
        senses.look(sim);
        senses
    }

    /// Takes a new echo of the fan and points the sensor to the next bearing; call it at least once
    /// between pings.
    pub fn update(&mut self, sim: &mut Simulation) {
        self.fan.update(sim);
    }

    /// Reads all devices.
    pub fn look(&mut self, sim: &Simulation) {
        let echo = sim.echo().value.ok();
        self.distance =
            echo.map(|echo| echo.distance.map_or(RANGE, |far| far.si().clamp(0.0, RANGE)));
        let motion = sim.motion().value.ok();
        if let Some(Motion { x, y, heading, speed, turn }) = motion {
            self.motion = [x.si(), y.si(), heading.si(), speed.si(), turn.si()];
        }
        let touched = sim.touched().value.ok();
        self.touched = touched.unwrap_or(self.touched);
        let glow = sim.glow().value.ok();
        if let Some(seen) = glow {
            self.glow = seen.map(|Glow { bearing, strength }| (bearing.si(), strength));
        }
        let color = sim.color().value.ok();
        self.color = color.map(|Color { red, green, blue }| [red, green, blue]);
        let charge = sim.charge().value.ok();
        if let Some(charge) = charge {
            self.battery = [charge.voltage.si(), charge.left];
        }
        let (glow, color) = (glow.is_some(), color.is_some());
        self.valid = [motion.is_some(), touched.is_some(), glow, color, charge.is_some()];
    }

    /// Writes a part; `target` is relative to the start.
    pub fn write(&self, part: Part, target: Option<[f64; 2]>, into: &mut Vec<f64>) {
        let flag = |truth: bool| f64::from(u8::from(truth));
        let [x, y, heading, speed, turn] = self.motion;
        match part {
            Part::Distance => {
                into.extend([self.distance.unwrap_or(RANGE), flag(self.distance.is_some())]);
            }
            Part::Odometry => {
                let (sin, cos) = libm::sincos(heading);
                into.extend([x, y, sin, cos, speed, turn]);
            }
            Part::Motion => into.extend([speed, turn]),
            Part::Bumper => into.push(flag(self.touched)),
            Part::Fan => into.extend(&self.fan.echoes),
            Part::Target => {
                let [to_x, to_y] = target.map_or([0.0; 2], |[gx, gy]| [gx - x, gy - y]);
                let (sin, cos) = libm::sincos(libm::atan2(to_y, to_x) - heading);
                into.extend([libm::hypot(to_x, to_y), sin, cos]);
            }
            Part::Glow => {
                let (bearing, strength) = self.glow.unwrap_or_default();
                into.extend([flag(self.glow.is_some()), bearing, strength]);
            }
            Part::Color => {
                into.extend(self.color.unwrap_or_default());
                into.push(flag(self.color.is_some()));
            }
            Part::Battery => into.extend(self.battery),
            Part::Valid => into.extend(self.valid.map(flag)),
        }
    }
}

impl Fan {
    fn aim(&self, sim: &mut Simulation) {
        use afp_carbot::devices::Rotator;
        use afp_core::quantity::Angle;
        if let Some(bearing) = self.bearings.get(self.next) {
            let now = sim.now();
            sim.point(Angle::from_si(*bearing), now);
        }
    }

    fn update(&mut self, sim: &mut Simulation) {
        if self.bearings.is_empty() {
            return;
        }
        let reading = sim.echo();
        if self.heard == Some(reading.time) {
            return;
        }
        self.heard = Some(reading.time);
        self.waited += 1;
        let mut there = self.waited >= PATIENCE;
        if let Ok(echo) = reading.value {
            let aimed = |bearing: &f64| (echo.bearing.si() - bearing).abs() <= AIMED;
            if let Some(index) = self.bearings.iter().position(aimed) {
                let far = echo.distance.map_or(RANGE, |far| far.si().clamp(0.0, RANGE));
                if let Some(known) = self.echoes.get_mut(index) {
                    *known = far;
                }
                there |= index == self.next;
            }
        }
        if there {
            self.waited = 0;
            self.go_on();
            self.aim(sim);
        }
    }

    /// Moves to the next bearing, to and fro.
    fn go_on(&mut self) {
        let last = self.bearings.len() - 1;
        if self.next == last {
            self.back = true;
        } else if self.next == 0 {
            self.back = false;
        }
        self.next = if self.back { self.next.saturating_sub(1) } else { self.next + 1 }.min(last);
    }
}

/// A point of the world relative to a pose.
pub fn seen_from(pose: Pose, [x, y]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = libm::sincos(pose.heading);
    let (dx, dy) = (x - pose.x, y - pose.y);
    [dx * cos + dy * sin, dy * cos - dx * sin]
}
