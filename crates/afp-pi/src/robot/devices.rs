//! The devices of the Carbot's toolbox, from the controller's reports.

use afp_carbot::devices::{
    Beam, Body, Bump, Button, Buttons, Echo, Invalid, Motion, Navigator, Odometry, Reading,
    RotatingTelemetry, Rotator, TouchSensor, Ultrasonic,
};
use afp_carbot::table::signal;
use afp_carbot::trail::Trail;
use afp_core::quantity::{Angle, AngularSpeed, Length, Speed};
use afp_core::{Duration, Instant};
use afp_drive::{Ping, Report};
use afp_session::frames::{BODY, BY_ODOMETRY, WORLD};
use afp_session::{Pose2, Ranging, SampleRef, Samples, Transform};

use super::{Line, SerialRobot};
use crate::values::Values;

/// The range of an HC-SR04 in metres, and its opening in degrees.
const RANGE: [f64; 2] = [0.02, 4.0];
const OPENING: f64 = 30.0;
/// The frame of the range sensor in logs.
const SONAR: &str = "sonar";

/// The motion of a report.
pub(super) fn motion(report: &Report) -> Motion {
    let [x, y, heading] = report.pose;
    Motion {
        x: Length::from_si(x),
        y: Length::from_si(y),
        heading: Angle::from_si(heading),
        speed: Speed::from_si(f64::from(report.speed)),
        turn: AngularSpeed::from_si(f64::from(report.turn)),
    }
}

/// The outline of the robot.
pub(super) fn body(values: &Values) -> Body {
    let [length, width] = values.half.map(Length::from_si);
    Body { front: length, rear: length, half_width: width }
}

impl<L: Line> SerialRobot<L> {
    /// A sensor's reading from the last report; none from a sensor that the robot does not have.
    fn sense<T: Copy>(&self, exists: bool, of: impl Fn(&Report) -> T) -> Reading<T> {
        match self.report().and_then(|it| if exists { Ok(it) } else { Err(Invalid::NoAnswer) }) {
            Ok((report, at)) => Reading::valid(of(&report), at),
            Err(why) => Reading::invalid(why, self.time.now()),
        }
    }

    /// The last ping and its time.
    fn ping(&self) -> Result<(Ping, Instant), Invalid> {
        let (report, at) = self.report()?;
        let ping = report.ping.filter(|_| self.values.sonar.is_some()).ok_or(Invalid::NotYet)?;
        let distance = ping.distance.map(|distance| (distance + self.values.echo).max(0.0));
        let ping = Ping { distance, ..ping };
        let age = Duration::from_millis(u64::from(ping.age));
        Ok((ping, Instant::from_nanos(at.as_nanos().saturating_sub(age.as_nanos()))))
    }

    pub(super) fn sample_devices(&self, to: &mut Samples<'_, '_>) {
        let [speed, turn] = self.asked.map(f64::from);
        to.put(signal::NAVIGATOR_ASKED_SPEED, SampleRef::Float(speed));
        to.put(signal::NAVIGATOR_ASKED_TURN, SampleRef::Float(turn));
        let Ok((report, _)) = self.report() else { return };
        let [x, y, heading] = report.pose;
        let pose = Pose2 { x, y, heading };
        let by_wheels = Transform { parent: WORLD, child: BY_ODOMETRY, pose, height: 0.0 };
        to.put(signal::ODOMETRY_POSE, SampleRef::Pose(by_wheels));
        if self.values.bumper {
            to.put(signal::TOUCH_TOUCHED, SampleRef::Bool(report.bumper));
        }
        if self.values.button {
            to.put(signal::BUTTONS_ESCAPE, SampleRef::Bool(report.button));
        }
        let Some(x) = self.values.sonar else { return };
        let bearing = f64::from(report.bearing);
        to.put(signal::ROTATOR_BEARING, SampleRef::Float(bearing));
        let pose = Pose2 { x, y: 0.0, heading: bearing };
        let sensor = Transform { parent: BODY, child: SONAR, pose, height: 0.0 };
        to.put(signal::ULTRASONIC_FRAME, SampleRef::Pose(sensor));
        if let Ok((ping, time)) = self.ping() {
            let pose = Pose2 { heading: f64::from(ping.bearing), ..pose };
            let half_angle = OPENING.to_radians() / 2.0;
            let range = ping.distance.map(f64::from);
            let ranging = Ranging { time, frame: BODY, pose, half_angle, range };
            to.put(signal::ULTRASONIC_ECHO, SampleRef::Range(ranging));
        }
    }
}

impl<L: Line> Navigator for SerialRobot<L> {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, _: Instant) {
        let asked = [speed.si() as f32, turn.si() as f32];
        if asked == [0.0; 2] && self.asked != asked {
            self.halt_at_once();
        }
        self.asked = asked;
    }

    fn reduced(&self, speed: Speed, turn: AngularSpeed) -> (Speed, AngularSpeed) {
        let (speed, turn) = self.values.setup.reduced(speed.si() as f32, turn.si() as f32);
        (Speed::from_si(f64::from(speed)), AngularSpeed::from_si(f64::from(turn)))
    }

    fn body(&self) -> Body {
        body(&self.values)
    }
}

impl<L: Line> Odometry for SerialRobot<L> {
    fn motion(&self) -> Reading<Motion> {
        self.sense(true, motion)
    }

    fn last_bump(&self) -> Option<Bump> {
        self.bump
    }

    fn trail(&self) -> Trail {
        self.trail
    }
}

impl<L: Line> Ultrasonic for SerialRobot<L> {
    fn echo(&self) -> Reading<Echo> {
        let (ping, time) = match self.ping() {
            Ok(ping) => ping,
            Err(why) => return Reading::invalid(why, self.time.now()),
        };
        let bearing = Angle::from_si(f64::from(ping.bearing));
        let value = match ping.distance {
            Some(distance) => self.beam().echo(f64::from(distance), bearing),
            None => Ok(Echo { distance: None, bearing }),
        };
        Reading { time, value }
    }

    fn beam(&self) -> Beam {
        let [min, max] = RANGE.map(Length::from_si);
        let forward = Length::from_si(self.values.sonar.unwrap_or_default());
        Beam { forward, opening: Angle::from_deg(OPENING), min, max }
    }
}

impl<L: Line> Rotator for SerialRobot<L> {
    fn point(&mut self, bearing: Angle, _: Instant) {
        self.bearing = bearing.si() as f32;
    }
}

impl<L: Line> RotatingTelemetry for SerialRobot<L> {
    fn bearing(&self) -> Reading<Angle> {
        let exists = self.values.sonar.is_some();
        self.sense(exists, |report| Angle::from_si(f64::from(report.bearing)))
    }
}

impl<L: Line> TouchSensor for SerialRobot<L> {
    fn touched(&self) -> Reading<bool> {
        self.sense(self.values.bumper, |report| report.bumper)
    }
}

impl<L: Line> Buttons for SerialRobot<L> {
    fn pressed(&self, button: Button) -> Reading<bool> {
        match button {
            // Nobody presses a button that does not exist; the Escape key also ends a run.
            Button::Escape => self.sense(true, |report| self.values.button && report.button),
        }
    }
}
