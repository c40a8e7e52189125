//! Faults begin and end.

use super::Simulation;
use crate::devices::camera::Exposure;
use crate::devices::line::Line;
use crate::fault::{Defect, Fault, Sensor, Side};
use crate::vehicle::drive::Health;
use afp_carbot::devices::{Charge, Color, Echo, Glow, Motion, Reading};
use afp_core::quantity::Angle;
use afp_core::{Duration, Instant};
use std::sync::Arc;

/// From each sensor to the plan.
#[derive(Debug, Default)]
pub(super) struct Lines {
    pub(super) ultrasonic: Line<Echo>,
    pub(super) rotator: Line<Angle>,
    pub(super) odometry: Line<Motion>,
    pub(super) touch: Line<bool>,
    pub(super) buttons: Line<bool>,
    pub(super) infrared: Line<Option<Glow>>,
    pub(super) color: Line<Color>,
    pub(super) camera: Line<Arc<Exposure>>,
    pub(super) battery: Line<Charge>,
}

impl Simulation {
    /// Breaks something from an instant, or from now if that is over, for a while;
    /// [`Duration::MAX`] is for good.
    ///
    /// At one instant physics comes first, then the fault, then what reads. Of two defects of one
    /// sensor that which began last counts.
    pub fn inject(&mut self, fault: Fault, from: Instant, during: Duration) {
        let from = from.max(self.now);
        self.faults.add(fault, from, from + during);
        if from == self.now {
            self.break_and_mend();
        }
    }

    /// Passes on what has begun and what is over by now.
    pub(super) fn break_and_mend(&mut self) {
        self.faults.look(self.now);
        self.drive.set_health(Health {
            dead: self.faults.controller_dead(),
            stalled: [Side::Left, Side::Right].map(|side| self.faults.stalled(side)),
            grip: self.faults.grip(),
        });
        self.rotator.set_stuck(self.faults.rotator_stuck());
        self.battery.limit(self.faults.charge());
        let defect = |sensor| self.faults.defect(sensor);
        let defects = Sensor::ALL.map(defect);
        for (sensor, defect) in Sensor::ALL.into_iter().zip(defects) {
            self.set_defect(sensor, defect);
        }
        self.delayed = defects.iter().any(|defect| matches!(defect, Some(Defect::Delayed(_))));
    }

    fn set_defect(&mut self, sensor: Sensor, defect: Option<Defect>) {
        let raw = self.raw();
        let lines = &mut self.lines;
        match sensor {
            Sensor::Ultrasonic => lines.ultrasonic.set(defect, raw.echo),
            Sensor::Rotator => lines.rotator.set(defect, raw.bearing),
            Sensor::Odometry => lines.odometry.set(defect, raw.motion),
            Sensor::Touch => lines.touch.set(defect, raw.touched),
            Sensor::Buttons => lines.buttons.set(defect, raw.escape),
            Sensor::Infrared => lines.infrared.set(defect, raw.glow),
            Sensor::Color => lines.color.set(defect, raw.color),
            Sensor::Camera => lines.camera.set(defect, raw.exposure),
            Sensor::Battery => lines.battery.set(defect, raw.charge),
        }
    }

    /// Lets the lines that delay know what the sensors say now.
    pub(super) fn note(&mut self) {
        if !self.delayed {
            return;
        }
        let (raw, now) = (self.raw(), self.now);
        let lines = &mut self.lines;
        lines.ultrasonic.note(raw.echo, now);
        lines.rotator.note(raw.bearing, now);
        lines.odometry.note(raw.motion, now);
        lines.touch.note(raw.touched, now);
        lines.buttons.note(raw.escape, now);
        lines.infrared.note(raw.glow, now);
        lines.color.note(raw.color, now);
        lines.camera.note(raw.exposure, now);
        lines.battery.note(raw.charge, now);
    }

    fn raw(&self) -> Raw {
        Raw {
            echo: self.echo,
            bearing: self.raw_bearing(),
            motion: self.raw_motion(),
            touched: self.raw_touched(),
            escape: self.raw_escape(),
            glow: self.glow,
            color: self.color,
            exposure: self.exposure.clone(),
            charge: self.raw_charge(),
        }
    }
}

/// What the sensors themselves say.
struct Raw {
    echo: Reading<Echo>,
    bearing: Reading<Angle>,
    motion: Reading<Motion>,
    touched: Reading<bool>,
    escape: Reading<bool>,
    glow: Reading<Option<Glow>>,
    color: Reading<Color>,
    exposure: Reading<Arc<Exposure>>,
    charge: Reading<Charge>,
}
