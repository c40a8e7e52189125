//! A robot for tests: it moves exactly as commanded among plane walls, and its devices can fail.

use crate::devices::{
    Battery, Beam, Body, Bump, Button, Buttons, Camera, Charge, Color, ColorSensor, Echo, Frame,
    Glow, InfraredSensor, Invalid, Lens, Motion, Navigator, Odometry, Reading, RotatingTelemetry,
    Rotator, TouchSensor, Ultrasonic,
};
use crate::helpers::motion::wrap;
use crate::helpers::trail::Trail;
use crate::objects::Path;
use afp_core::quantity::{Angle, AngularSpeed, Frequency, Length, Speed, Voltage};
use afp_core::{
    Actor, ActorTemplate, Duration, Environment, Events, Fault, Instant, Poll, Supervisor,
    SupervisorTemplate,
};
use core::mem::replace;
use picture::Picture;
use std::collections::VecDeque;
use std::vec::Vec;

pub(crate) mod pause;
mod picture;
mod place;

/// A plane wall: the direction of its outward normal, and its distance from the origin.
#[derive(Clone, Copy)]
pub(crate) struct Plane {
    pub(crate) normal: f64,
    pub(crate) distance: f64,
    /// The wall ends at this x.
    pub(crate) end: f64,
}

/// An infinite wall.
pub(crate) fn plane(normal_deg: f64, distance: f64) -> Plane {
    Plane { normal: normal_deg.to_radians(), distance, end: f64::INFINITY }
}

/// Starts at the origin and looks along the x axis.
pub(crate) struct Fake {
    pub(crate) now: Instant,
    pub(crate) walls: Vec<Plane>,
    pub(crate) motion: Motion,
    pub(crate) rotator: f64,
    pub(crate) touched: bool,
    /// The last bump.
    pub(crate) bump: Option<Bump>,
    trail: Trail,
    pub(crate) escape: bool,
    pub(crate) dead_odometry: bool,
    /// The odometry is silent between these times, milliseconds.
    pub(crate) odometry_gap: (u64, u64),
    /// Largest increase of the commanded speed and turn rate per tick.
    pub(crate) gains: (f64, f64),
    /// The range sensor sends no ping from this time on, milliseconds.
    pub(crate) range_dies: u64,
    pub(crate) dead_switches: bool,
    pub(crate) stuck_rotator: bool,
    /// Position of an infrared source of strength 1.
    pub(crate) light: Option<(f64, f64)>,
    /// The light goes out at this time, milliseconds.
    pub(crate) light_goes_out: u64,
    /// The infrared sensor is silent or repeats itself from this time on, milliseconds.
    pub(crate) infrared_dies: u64,
    pub(crate) infrared_freezes: u64,
    /// Position of a red post of 30 cm by 30 cm on a grey floor.
    pub(crate) post: Option<(f64, f64)>,
    /// The post disappears at this time, milliseconds.
    pub(crate) post_goes: u64,
    /// The camera repeats its picture from this time on, milliseconds.
    pub(crate) camera_freezes: u64,
    pub(crate) dead_camera: bool,
    pub(crate) floor: Color,
    pub(crate) dead_color: bool,
    /// Remaining share of the charge.
    pub(crate) charge: f64,
    pub(crate) dead_battery: bool,
    /// Start in milliseconds and number of pings that hear nothing.
    pub(crate) lost_pings: (u64, u64),
    /// Every ping repeats the one before from this time on, milliseconds.
    pub(crate) range_freezes: u64,
    /// Delay of echoes, milliseconds.
    pub(crate) late_echoes: u64,
    /// The shares of the commanded speed and turn rate that the wheels achieve.
    pub(crate) follows: (f64, f64),
    /// Number of reports that the drive is blocked.
    pub(crate) blocked: u32,
    /// Error of the turn rate, radians a second.
    pub(crate) drifts: f64,
    pub(crate) top_speed: f64,
    pub(crate) steers_like_a_car: bool,
    /// Start position on the map.
    pub(crate) map_offset: [f64; 2],
    /// Uncertainty of the position estimate, metres.
    pub(crate) spread: f64,
    /// The robot is lost from this time on, milliseconds.
    pub(crate) lost_from: u64,
    pub(crate) dead_localisation: bool,
    /// No search finds a path.
    pub(crate) no_way: bool,
    /// The next viewpoint, metres.
    pub(crate) view: [f64; 2],
    /// The current search, and the number of searches.
    pub(crate) search: Option<(Instant, Option<Path>)>,
    pub(crate) searches: u16,
    /// Every signal sent, in order.
    pub(crate) signals: Vec<(bool, Option<Frequency>)>,
    target: f64,
    pub(crate) command: (f64, f64),
    commanded: Instant,
    before: (f64, f64),
    glow: Option<Glow>,
    echo: Reading<Echo>,
    /// Echoes not yet reported.
    heard: VecDeque<Reading<Echo>>,
    picture: Picture,
}

const FORWARD: f64 = 0.1;
const HALF_BEAM: f64 = 15.0 / 180.0 * core::f64::consts::PI;

impl Fake {
    pub(crate) fn new(walls: &[Plane]) -> Self {
        Fake {
            now: Instant::ZERO,
            walls: walls.to_vec(),
            motion: Motion::default(),
            rotator: 0.0,
            touched: false,
            bump: None,
            trail: Trail::new(),
            escape: false,
            dead_odometry: false,
            odometry_gap: (0, 0),
            gains: (0.0, 0.0),
            range_dies: u64::MAX,
            dead_switches: false,
            stuck_rotator: false,
            light: None,
            light_goes_out: u64::MAX,
            infrared_dies: u64::MAX,
            infrared_freezes: u64::MAX,
            post: None,
            post_goes: u64::MAX,
            camera_freezes: u64::MAX,
            dead_camera: false,
            floor: Color { red: 0.5, green: 0.5, blue: 0.5 },
            dead_color: false,
            charge: 1.0,
            dead_battery: false,
            lost_pings: (u64::MAX, 0),
            range_freezes: u64::MAX,
            late_echoes: 0,
            follows: (1.0, 1.0),
            blocked: 0,
            drifts: 0.0,
            top_speed: f64::INFINITY,
            steers_like_a_car: false,
            map_offset: [0.0, 0.0],
            spread: 0.05,
            lost_from: u64::MAX,
            dead_localisation: false,
            no_way: false,
            view: [0.0; 2],
            search: None,
            searches: 0,
            signals: Vec::new(),
            target: 0.0,
            command: (0.0, 0.0),
            commanded: Instant::ZERO,
            before: (0.0, 0.0),
            glow: None,
            echo: Reading::invalid(Invalid::NotYet, Instant::ZERO),
            heard: VecDeque::new(),
            picture: Picture::default(),
        }
    }

    /// The commanded speed and turn rate.
    pub(crate) fn command(&self) -> (f64, f64) {
        self.command
    }

    pub(crate) fn millis(&self) -> u64 {
        self.now.since(Instant::ZERO).as_millis()
    }

    /// Advances by ten milliseconds.
    pub(crate) fn tick(&mut self) {
        self.now += Duration::from_millis(10);
        if self.now.since(self.commanded) > Duration::from_millis(200) {
            self.command = (0.0, 0.0);
        }
        let ((speed, turn), before) = (self.command, replace(&mut self.before, self.command));
        self.gains.0 = self.gains.0.max(speed.abs() - before.0.abs());
        self.gains.1 = self.gains.1.max(turn.abs() - before.1.abs());
        let speed = speed.clamp(-self.top_speed, self.top_speed) * self.follows.0;
        let turn = turn * self.follows.1 + self.drifts;
        let heading = self.motion.heading.si() + turn * 0.01;
        self.motion = Motion {
            x: self.motion.x + Length::from_si(speed * 0.01 * heading.cos()),
            y: self.motion.y + Length::from_si(speed * 0.01 * heading.sin()),
            heading: Angle::from_si(heading),
            speed: Speed::from_si(speed),
            turn: AngularSpeed::from_si(turn),
        };
        self.trail.note(self.motion, &self.body());
        if !self.stuck_rotator {
            self.rotator += (self.target - self.rotator).clamp(-0.05, 0.05);
        }
        if self.millis().is_multiple_of(50) && self.millis() < self.range_dies {
            let (from, count) = self.lost_pings;
            let lost = self.millis() >= from && self.millis() < from.saturating_add(count * 50);
            let distance = if lost { None } else { self.nearest() };
            let now = Echo { distance, bearing: Angle::from_si(self.rotator) };
            let frozen = self.echo.value.ok().filter(|_| self.millis() >= self.range_freezes);
            let echo = frozen.unwrap_or(now);
            self.heard.push_back(Reading::valid(echo, self.now));
        }
        if self.millis() < self.infrared_freezes {
            self.glow = self.brightest();
        }
        if self.millis().is_multiple_of(50) && self.millis() < self.camera_freezes {
            let post = self.post.filter(|_| self.millis() < self.post_goes);
            self.picture.take(post, &self.motion);
        }
        let late = Duration::from_millis(self.late_echoes);
        while let Some(echo) = self.heard.pop_front_if(|echo| self.now.since(echo.time) >= late) {
            self.echo = echo;
        }
    }

    fn brightest(&self) -> Option<Glow> {
        let (x, y) = self.light.filter(|_| self.millis() < self.light_goes_out)?;
        let (ahead, aside) = (x - self.motion.x.si(), y - self.motion.y.si());
        let bearing = wrap(aside.atan2(ahead) - self.motion.heading.si());
        let strength = 1.0 / (ahead * ahead + aside * aside).max(0.01);
        let seen = bearing.abs() <= self.field_of_view().si() / 2.0;
        seen.then_some(Glow { bearing: Angle::from_si(bearing), strength })
    }

    fn nearest(&self) -> Option<Length> {
        let heading = self.motion.heading.si();
        let x = self.motion.x.si() + FORWARD * heading.cos();
        let y = self.motion.y.si() + FORWARD * heading.sin();
        let ranges = self.walls.iter().filter(|wall| x <= wall.end).filter_map(|wall| {
            let slant = wrap(heading + self.rotator - wall.normal).abs();
            let square = wall.distance - x * wall.normal.cos() - y * wall.normal.sin();
            let beyond = (slant - HALF_BEAM).max(0.0);
            (slant < 0.75 && square > 0.0).then(|| square / beyond.cos())
        });
        // Noise: two echoes are never identical.
        let noise = if (self.millis() / 50).is_multiple_of(2) { 1e-6 } else { 0.0 };
        ranges
            .filter(|range| *range < 4.0)
            .reduce(f64::min)
            .map(|range| Length::from_si(range + noise))
    }

    /// Runs an actor until it is ready, for at most `seconds`; checks that the robot has then
    /// stopped.
    pub(crate) fn run<'a, T: ActorTemplate, A: Actor<T, Fake>>(
        &mut self,
        inputs: T::Inputs<'_>,
        live: impl Fn() -> T::Live<'a>,
        seconds: u64,
    ) -> Result<Option<T::State>, Fault> {
        let now = self.now;
        let mut actor = A::start(inputs, self, now)?;
        for _ in 0..seconds * 100 {
            self.tick();
            let now = self.now;
            if let Poll::Ready(state) = actor.poll(live(), self, now)? {
                assert!(self.motion.stands(), "ready while moving: {:?}", self.motion);
                assert_eq!(self.command, (0.0, 0.0), "ready while commanding");
                return Ok(Some(state));
            }
        }
        actor.interrupt(self, self.now)?;
        assert_eq!(self.command, (0.0, 0.0), "interrupt does not stop");
        Ok(None)
    }

    /// Polls a supervisor every ten milliseconds until it reports or the time is over.
    pub(crate) fn watch<'a, T: SupervisorTemplate, S: Supervisor<T, Fake>>(
        &mut self,
        inputs: T::Inputs<'_>,
        live: impl Fn() -> T::Live<'a>,
        wanted: u64,
        millis: u64,
    ) -> Result<Option<T::Event>, Fault> {
        let now = self.now;
        let mut supervisor = S::start(inputs, self, now)?;
        for _ in 0..millis / 10 {
            self.tick();
            let now = self.now;
            let event = supervisor.poll(live(), Events::from_bits(wanted), self, now)?;
            if event.is_some() {
                return Ok(event);
            }
        }
        Ok(None)
    }

    /// Polls a supervisor every ten milliseconds, once for each of `polls`. Before each poll, `set`
    /// presses or releases the switch; the second value has the wanted events. Returns which polls
    /// reported.
    pub(crate) fn clicks<'a, T: SupervisorTemplate, S: Supervisor<T, Fake>>(
        &mut self,
        inputs: T::Inputs<'_>,
        live: impl Fn() -> T::Live<'a>,
        set: fn(&mut Fake, bool),
        polls: &[(bool, u64)],
    ) -> Result<Vec<bool>, Fault> {
        let now = self.now;
        let mut supervisor = S::start(inputs, self, now)?;
        let poll = |(held, wanted): &(bool, u64)| {
            set(self, *held);
            self.tick();
            let now = self.now;
            let event = supervisor.poll(live(), Events::from_bits(*wanted), self, now)?;
            Ok(event.is_some())
        };
        polls.iter().map(poll).collect()
    }
}

impl Environment for Fake {
    fn stop(&mut self, now: Instant) {
        self.halt(now);
    }

    fn emergency_stop(&mut self) {
        self.command = (0.0, 0.0);
    }
}

impl Navigator for Fake {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant) {
        self.command = (speed.si(), turn.si());
        self.commanded = now;
    }

    fn reduced(&self, speed: Speed, turn: AngularSpeed) -> (Speed, AngularSpeed) {
        let share = if self.steers_like_a_car && speed.si() == 0.0 { 0.0 } else { 1.0 };
        (Speed::from_si(speed.si().clamp(-self.top_speed, self.top_speed)), turn * share)
    }

    fn note_blocked(&mut self, _: Instant) {
        self.blocked += 1;
    }

    fn body(&self) -> Body {
        let [front, half_width] = [0.2, 0.175].map(Length::from_si);
        Body { front, rear: front, half_width }
    }
}

/// A reading of a device that may be dead.
fn reading<T: Copy>(dead: bool, value: T, now: Instant) -> Reading<T> {
    if dead { Reading::invalid(Invalid::NoAnswer, now) } else { Reading::valid(value, now) }
}

impl Camera for Fake {
    fn frame(&self) -> Reading<Frame<'_>> {
        reading(self.dead_camera, self.picture.frame(), self.now)
    }

    fn lens(&self) -> Lens {
        picture::lens()
    }
}

impl Odometry for Fake {
    fn motion(&self) -> Reading<Motion> {
        let (from, to) = self.odometry_gap;
        let silent = self.dead_odometry || (from..to).contains(&self.millis());
        reading(silent, self.motion, self.now)
    }

    fn last_bump(&self) -> Option<Bump> {
        self.bump
    }

    fn trail(&self) -> Trail {
        self.trail
    }
}

impl Ultrasonic for Fake {
    fn echo(&self) -> Reading<Echo> {
        self.echo
    }

    fn beam(&self) -> Beam {
        Beam {
            forward: Length::from_si(FORWARD),
            opening: Angle::from_si(2.0 * HALF_BEAM),
            min: Length::from_si(0.03),
            max: Length::from_si(4.0),
        }
    }
}

impl Rotator for Fake {
    fn point(&mut self, bearing: Angle, _: Instant) {
        self.target = bearing.si();
    }
}

impl RotatingTelemetry for Fake {
    fn bearing(&self) -> Reading<Angle> {
        Reading::valid(Angle::from_si(self.rotator), self.now)
    }
}

impl TouchSensor for Fake {
    fn touched(&self) -> Reading<bool> {
        reading(self.dead_switches, self.touched, self.now)
    }
}

impl InfraredSensor for Fake {
    fn glow(&self) -> Reading<Option<Glow>> {
        reading(self.millis() >= self.infrared_dies, self.glow, self.now)
    }

    fn field_of_view(&self) -> Angle {
        Angle::from_deg(120.0)
    }
}

impl ColorSensor for Fake {
    fn color(&self) -> Reading<Color> {
        reading(self.dead_color, self.floor, self.now)
    }
}

impl Battery for Fake {
    fn charge(&self) -> Reading<Charge> {
        let charge = Charge { voltage: Voltage::from_si(7.4), left: self.charge };
        reading(self.dead_battery, charge, self.now)
    }
}

impl Buttons for Fake {
    fn pressed(&self, _: Button) -> Reading<bool> {
        reading(self.dead_switches, self.escape, self.now)
    }
}
