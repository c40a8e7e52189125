//! A witness between robot and plan, which records every reading and every command.

use std::cell::{Cell, RefCell};
use std::fmt;
use std::rc::Rc;

use afp_carbot::Path;
use afp_carbot::devices::{
    Battery, Beam, Belief, Body, Bump, Button, Buttons, Camera, Charge, Color, ColorSensor, Echo,
    Flow, FlowCamera, Frame, Glow, InfraredSensor, Lens, Localisation, Motion, Navigator, Odometry,
    PathPlanner, Reading, RotatingTelemetry, Rotator, Signals, TouchSensor, Trip, Ultrasonic,
};
use afp_carbot::trail::Trail;
use afp_core::quantity::{Angle, AngularSpeed, Frequency, Speed};
use afp_core::{Environment, Fault, Instant, Poll, Ticket};
use afp_session::Robot as _;
use afp_sim::Simulation;

use crate::sensor::Sensor;
use crate::watch::Watch;

/// A simulated robot whose plan is watched.
pub(crate) struct Witness {
    pub(crate) sim: Simulation,
    pub(crate) watch: Rc<RefCell<Watch>>,
    /// The last odometry reading.
    pub(crate) counted: Cell<Option<Motion>>,
}

impl Witness {
    /// The fault that ends the plan at once, without calls of its components.
    pub(crate) fn aborts(&self) -> Option<Fault> {
        let fault = self.sim.broken()?;
        self.watch.borrow_mut().aborted();
        Some(fault)
    }

    /// Records a reading for the plan.
    fn told<T>(&self, sensor: Sensor, reading: Reading<T>) -> Reading<T> {
        let valid = reading.value.is_ok();
        self.watch.borrow_mut().told(sensor, valid, reading.time, self.sim.now());
        reading
    }

    /// An invalid value in a reading violates a rule.
    fn sane(&self, what: &str, value: &dyn fmt::Debug, sane: bool) {
        if !sane {
            let why = format!("a valid reading of {what} is {value:?}");
            self.watch.borrow_mut().breaks(self.sim.now(), why);
        }
    }
}

impl Environment for Witness {
    fn stop(&mut self, now: Instant) {
        self.watch.borrow_mut().commanded(0.0, 0.0, now);
        self.sim.stop(now);
    }

    fn emergency_stop(&mut self) {
        self.watch.borrow_mut().commanded(0.0, 0.0, self.sim.now());
        self.sim.emergency_stop();
    }
}

impl Navigator for Witness {
    fn drive(&mut self, speed: Speed, turn: AngularSpeed, now: Instant) {
        self.watch.borrow_mut().commanded(speed.si(), turn.si(), now);
        self.sim.drive(speed, turn, now);
    }

    fn reduced(&self, speed: Speed, turn: AngularSpeed) -> (Speed, AngularSpeed) {
        self.sim.reduced(speed, turn)
    }

    fn note_blocked(&mut self, now: Instant) {
        self.sim.note_blocked(now);
    }

    fn body(&self) -> Body {
        self.sim.body()
    }
}

impl Odometry for Witness {
    fn motion(&self) -> Reading<Motion> {
        let reading = self.told(Sensor::Odometry, self.sim.motion());
        if let Ok(Motion { x, y, heading, speed, turn }) = reading.value {
            let all = [x.si(), y.si(), heading.si(), speed.si(), turn.si()];
            self.sane("odometry", &all, all.iter().all(|value| value.is_finite()));
        }
        self.counted.set(reading.value.ok());
        reading
    }

    fn last_bump(&self) -> Option<Bump> {
        self.sim.last_bump()
    }

    fn trail(&self) -> Trail {
        self.sim.trail()
    }
}

impl Ultrasonic for Witness {
    fn echo(&self) -> Reading<Echo> {
        let reading = self.told(Sensor::Ultrasonic, self.sim.echo());
        if let Ok(Echo { distance: Some(distance), .. }) = reading.value {
            let beam = self.beam();
            self.sane("range", &distance, beam.min <= distance && distance <= beam.max);
        }
        reading
    }

    fn beam(&self) -> Beam {
        self.sim.beam()
    }
}

impl Rotator for Witness {
    fn point(&mut self, bearing: Angle, now: Instant) {
        self.sim.point(bearing, now);
    }
}

impl RotatingTelemetry for Witness {
    fn bearing(&self) -> Reading<Angle> {
        let reading = self.told(Sensor::Rotator, self.sim.bearing());
        if let Ok(bearing) = reading.value {
            self.sane("the rotator", &bearing, bearing.si().abs() < 4.0);
        }
        reading
    }
}

impl TouchSensor for Witness {
    fn touched(&self) -> Reading<bool> {
        self.told(Sensor::Touch, self.sim.touched())
    }
}

impl Buttons for Witness {
    fn pressed(&self, button: Button) -> Reading<bool> {
        self.told(Sensor::Buttons, self.sim.pressed(button))
    }
}

impl InfraredSensor for Witness {
    fn glow(&self) -> Reading<Option<Glow>> {
        self.told(Sensor::Infrared, self.sim.glow())
    }

    fn field_of_view(&self) -> Angle {
        self.sim.field_of_view()
    }
}

impl ColorSensor for Witness {
    fn color(&self) -> Reading<Color> {
        self.told(Sensor::Color, self.sim.color())
    }
}

impl Camera for Witness {
    fn frame(&self) -> Reading<Frame<'_>> {
        self.told(Sensor::Camera, self.sim.frame())
    }

    fn lens(&self) -> Lens {
        self.sim.lens()
    }
}

impl FlowCamera for Witness {
    fn flow(&mut self, now: Instant) -> Result<Reading<Flow<'_>>, Fault> {
        let reading = self.sim.flow(now)?;
        let valid = reading.value.is_ok();
        self.watch.borrow_mut().told(Sensor::Camera, valid, reading.time, now);
        Ok(reading)
    }
}

impl Localisation for Witness {
    fn belief(&mut self, now: Instant) -> Result<Reading<Belief>, Fault> {
        // It shares the fate of the odometry.
        let Reading { time, value } = self.sim.belief(now)?;
        self.told(Sensor::Odometry, Reading { time, value: value.map(|_| ()) });
        Ok(Reading { time, value })
    }
}

impl PathPlanner for Witness {
    fn search(&mut self, trip: &Trip<'_>, now: Instant) -> Result<Option<Ticket>, Fault> {
        self.sim.search(trip, now)
    }

    fn found(&mut self, ticket: Ticket, now: Instant) -> Result<Poll<Option<Path>>, Fault> {
        self.sim.found(ticket, now)
    }
}

impl Signals for Witness {
    fn signal(&mut self, light: bool, tone: Option<Frequency>, now: Instant) {
        self.sim.signal(light, tone, now);
    }
}

impl Battery for Witness {
    fn charge(&self) -> Reading<Charge> {
        self.told(Sensor::Battery, self.sim.charge())
    }
}
