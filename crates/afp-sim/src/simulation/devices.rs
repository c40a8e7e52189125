//! The simulation as the Carbot's devices.

use super::Simulation;
use crate::devices::{camera, infrared, sonar};
use crate::vehicle::drive::reduced;
use crate::vehicle::{HALF_LENGTH, HALF_WIDTH};
use afp_carbot::Path;
use afp_carbot::devices::{
    Battery, Beam, Belief, Body, Bump, Button, Buttons, Camera, Charge, Color, ColorSensor, Echo,
    Flow, FlowCamera, Frame, Glow, InfraredSensor, Lens, Localisation, Motion, Navigator, Odometry,
    PathPlanner, Reading, RotatingTelemetry, Rotator, Signals, TouchSensor, Trip, Ultrasonic,
};
use afp_carbot::trail::Trail;
use afp_core::quantity::{Angle, AngularSpeed, Frequency, Length, Speed};
use afp_core::{Environment, Fault, Instant, Poll, Ticket};
use afp_platform::Line;

impl Environment for Simulation {
    fn stop(&mut self, now: Instant) {
        self.drive.command(0.0, 0.0, now);
        self.rotator.hold();
        self.shown = (false, None);
    }

    /// Blocks the wheels at once. They and the rotator obey nobody until
    /// [`Simulation::reset_emergency_stop`].
    fn emergency_stop(&mut self) {
        self.stopped = true;
        self.drive.block();
        self.rotator.hold();
        self.shown = (false, None);
    }
}

impl Simulation {
    /// Lets the robot obey again after an emergency stop.
    pub fn reset_emergency_stop(&mut self) {
        self.stopped = false;
    }

    /// Whether the robot has been stopped and obeys nobody.
    pub fn emergency_stopped(&self) -> bool {
        self.stopped
    }

    /// A reading as it arrives at the plan.
    fn deliver<T: Clone>(&self, line: &Line<T>, raw: Reading<T>) -> Reading<T> {
        line.sense(raw, self.now, &self.clock)
    }

    /// Takes the time that one use of a sensor costs.
    fn charge_for<T: Clone>(&self, line: &Line<T>) {
        if let Some(cost) = line.cost() {
            self.clock.spend(self.now, cost);
        }
    }

    fn measured<T>(&self, value: T) -> Reading<T> {
        Reading { time: self.grid(self.steps), value: Ok(value) }
    }

    pub(super) fn raw_bearing(&self) -> Reading<Angle> {
        self.measured(self.rotator.telemetry())
    }

    pub(super) fn raw_motion(&self) -> Reading<Motion> {
        self.measured(self.odometer.motion())
    }

    pub(super) fn raw_touched(&self) -> Reading<bool> {
        self.measured(self.is_touched())
    }

    pub(super) fn raw_escape(&self) -> Reading<bool> {
        Reading::valid(self.escape, self.now)
    }

    pub(super) fn raw_charge(&self) -> Reading<Charge> {
        self.measured(self.battery.charge())
    }
}

impl Navigator for Simulation {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant) {
        if !self.stopped {
            self.drive.command(speed.si(), turn.si(), now);
        }
    }

    fn reduced(&self, speed: Speed, turn: AngularSpeed) -> (Speed, AngularSpeed) {
        let (speed, turn) = reduced(speed.si(), turn.si());
        (Speed::from_si(speed), AngularSpeed::from_si(turn))
    }

    fn note_blocked(&mut self, now: Instant) {
        self.plan_round(now);
    }

    fn body(&self) -> Body {
        Body {
            front: Length::from_si(HALF_LENGTH),
            rear: Length::from_si(HALF_LENGTH),
            half_width: Length::from_si(HALF_WIDTH),
        }
    }
}

impl Odometry for Simulation {
    fn motion(&self) -> Reading<Motion> {
        self.deliver(&self.lines.odometry, self.raw_motion())
    }

    fn last_bump(&self) -> Option<Bump> {
        self.bump
    }

    fn trail(&self) -> Trail {
        self.trail
    }
}

impl Ultrasonic for Simulation {
    fn echo(&self) -> Reading<Echo> {
        self.deliver(&self.lines.ultrasonic, self.echo)
    }

    fn beam(&self) -> Beam {
        sonar::beam()
    }
}

impl Rotator for Simulation {
    fn point(&mut self, bearing: Angle, _: Instant) {
        if !self.stopped {
            self.rotator.aim(bearing.si());
        }
    }
}

impl RotatingTelemetry for Simulation {
    fn bearing(&self) -> Reading<Angle> {
        self.deliver(&self.lines.rotator, self.raw_bearing())
    }
}

impl TouchSensor for Simulation {
    fn touched(&self) -> Reading<bool> {
        self.deliver(&self.lines.touch, self.raw_touched())
    }
}

impl Buttons for Simulation {
    fn pressed(&self, button: Button) -> Reading<bool> {
        match button {
            Button::Escape => self.deliver(&self.lines.buttons, self.raw_escape()),
        }
    }
}

impl InfraredSensor for Simulation {
    fn glow(&self) -> Reading<Option<Glow>> {
        self.deliver(&self.lines.infrared, self.glow)
    }

    fn field_of_view(&self) -> Angle {
        Angle::from_si(infrared::FIELD)
    }
}

impl ColorSensor for Simulation {
    fn color(&self) -> Reading<Color> {
        self.deliver(&self.lines.color, self.color)
    }
}

impl Camera for Simulation {
    fn frame(&self) -> Reading<Frame<'_>> {
        self.charge_for(&self.lines.camera);
        let Reading { time, value } = self.lines.camera.look(&self.exposure);
        Reading { time, value: value.map(|exposure| exposure.frame()) }
    }

    fn lens(&self) -> Lens {
        camera::lens()
    }
}

impl FlowCamera for Simulation {
    fn flow(&mut self, now: Instant) -> Result<Reading<Flow<'_>>, Fault> {
        self.charge_for(&self.lines.camera);
        let Reading { time, value } = self.lines.camera.look(&self.exposure);
        let frame = Reading { time, value: value.map(|exposure| exposure.frame()) };
        let sensor = self.flow.get_or_insert_with(|| Box::new(camera::flow_sensor()));
        sensor.look(frame, now)
    }
}

impl Localisation for Simulation {
    fn belief(&mut self, now: Instant) -> Result<Reading<Belief>, Fault> {
        let motion = Odometry::motion(self);
        self.locator().belief(motion, now)
    }
}

impl PathPlanner for Simulation {
    fn search(&mut self, trip: &Trip<'_>, now: Instant) -> Result<Option<Ticket>, Fault> {
        self.planner().search(trip, now)
    }

    fn found(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<Option<Path>>, Fault> {
        self.planner().found(ticket, now)
    }
}

impl Signals for Simulation {
    fn signal(&mut self, light: bool, tone: Option<Frequency>, _: Instant) {
        if !self.stopped {
            self.shown = (light, tone);
        }
    }
}

impl Battery for Simulation {
    fn charge(&self) -> Reading<Charge> {
        self.deliver(&self.lines.battery, self.raw_charge())
    }
}
