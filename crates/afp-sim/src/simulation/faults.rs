//! Faults begin and end.

use super::Simulation;
use crate::devices::camera::Exposure;
use crate::vehicle::drive::Health;
use afp_carbot::devices::{Charge, Color, Echo, Glow, Motion, Reading};
use afp_carbot::table::{Defect, Fault};
use afp_core::quantity::Angle;
use afp_core::{Duration, Instant};
use afp_platform::Line;
use afp_session::Active;
use std::sync::Arc;

/// From each sensor to the plan.
#[derive(Clone, Debug, Default)]
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
        let mut faults = std::mem::take(&mut self.faults);
        self.apply_faults(&faults.advance(self.now));
        self.faults = faults;
    }

    /// Breaks exactly these.
    pub(crate) fn apply_faults(&mut self, active: &Active<'_, Fault>) {
        self.drive.set_health(Health {
            dead: active.any(|fault| fault == Fault::ControllerDead),
            stalled: [Fault::LeftMotorStalled, Fault::RightMotorStalled]
                .map(|stalled| active.any(|fault| fault == stalled)),
            grip: least(active, Fault::wheels_slip),
        });
        self.rotator.set_stuck(active.any(|fault| fault == Fault::RotatorStuck));
        self.battery.limit(least(active, Fault::battery_low));
        let raw = self.raw();
        let (lines, delayed) = (&mut self.lines, &mut self.delayed);
        *delayed = false;
        // Of two defects that which began last counts.
        let mut defect = |of: fn(Fault) -> Option<Defect>| {
            let defect = active.find(of);
            *delayed |= matches!(defect, Some(Defect::Delayed(_)));
            defect
        };
        lines.ultrasonic.set(defect(Fault::ultrasonic), raw.echo);
        lines.rotator.set(defect(Fault::rotator), raw.bearing);
        lines.odometry.set(defect(wheel_counters), raw.motion);
        lines.touch.set(defect(Fault::touch), raw.touched);
        lines.buttons.set(defect(Fault::buttons), raw.escape);
        lines.infrared.set(defect(Fault::infrared), raw.glow);
        lines.color.set(defect(Fault::color), raw.color);
        lines.camera.set(defect(Fault::camera), raw.exposure);
        lines.battery.set(defect(Fault::battery), raw.charge);
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

/// What a fault does to the odometry: the controller counts the wheels.
fn wheel_counters(fault: Fault) -> Option<Defect> {
    match fault {
        Fault::ControllerDead => Some(Defect::Lost),
        fault => fault.odometry(),
    }
}

/// The least of some shares, within 0 to 1; what is no number leaves nothing.
fn least(active: &Active<'_, Fault>, share: fn(Fault) -> Option<f64>) -> f64 {
    let shares = active.iter().filter_map(share);
    shares.fold(1.0, |least, share| if share > 0.0 { least.min(share) } else { 0.0 })
}
