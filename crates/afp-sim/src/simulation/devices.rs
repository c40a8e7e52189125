//! The Carbot's devices in the simulation, except the sensors.

use super::Simulation;
use afp_carbot::Path;
use afp_carbot::devices::{
    Belief, Body, Localisation, Navigator, Odometry, PathPlanner, Reading, Rotator, Signals, Trip,
};
use afp_core::quantity::{Angle, AngularSpeed, Frequency, Length, Speed};
use afp_core::{Environment, Fault, Instant, Poll, Ticket};

impl Environment for Simulation {
    fn stop(&mut self, now: Instant) {
        self.drive.command(0.0, 0.0, now);
        self.sensors.rotator.hold();
        self.shown = (false, None);
    }

    /// Blocks the wheels. Wheels and rotator ignore commands until
    /// [`Simulation::reset_emergency_stop`].
    fn emergency_stop(&mut self) {
        self.stopped = true;
        self.drive.block();
        self.sensors.rotator.hold();
        self.shown = (false, None);
    }
}

impl Simulation {
    /// Ends an emergency stop.
    pub fn reset_emergency_stop(&mut self) {
        self.stopped = false;
    }

    /// Whether the robot is in an emergency stop.
    pub fn emergency_stopped(&self) -> bool {
        self.stopped
    }
}

impl Navigator for Simulation {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant) {
        if !self.stopped {
            self.drive.command(speed.si(), turn.si(), now);
        }
    }

    fn reduced(&self, speed: Speed, turn: AngularSpeed) -> (Speed, AngularSpeed) {
        let (speed, turn) = self.drive.reduced(speed.si(), turn.si());
        (Speed::from_si(speed), AngularSpeed::from_si(turn))
    }

    fn note_blocked(&mut self, now: Instant) {
        self.plan_round(now);
    }

    fn body(&self) -> Body {
        let [length, half_width] = self.measures.half.map(Length::from_si);
        Body { front: length, rear: length, half_width }
    }
}

impl Rotator for Simulation {
    fn point(&mut self, bearing: Angle, _: Instant) {
        if !self.stopped {
            self.sensors.rotator.aim(bearing.si());
        }
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
