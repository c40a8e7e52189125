//! The devices of the Carbot, as its toolbox file declares them, and what is broken by each fault.
//!
//! Sensors come first in the file, in the order of [`Sensor::ALL`].

use afp_core::devices::{self, ControlId, DeviceRow, FaultId};

use crate::fault::{Fault, Sensor, Side};
use crate::templates::devices::{Devices, Fault as Declared};

pub use crate::templates::devices::Control;
pub use crate::templates::signal;

/// The devices of the Carbot.
#[derive(Clone, Copy, Debug)]
pub struct Carbot;

/// The table.
pub const TABLE: &[DeviceRow] = <Devices as devices::Devices>::TABLE;

impl devices::Devices for Carbot {
    const TABLE: &'static [DeviceRow] = TABLE;
    type Control = Control;
    type Fault = Fault;

    fn control(id: ControlId) -> Option<Control> {
        Devices::control(id)
    }

    fn fault(id: FaultId, amount: Option<f64>) -> Option<Fault> {
        Devices::fault(id, amount).map(Fault::from)
    }
}

impl From<Declared> for Fault {
    fn from(fault: Declared) -> Fault {
        match fault {
            Declared::Ultrasonic(defect) => Fault::Sensor(Sensor::Ultrasonic, defect),
            Declared::Rotator(defect) => Fault::Sensor(Sensor::Rotator, defect),
            Declared::Odometry(defect) => Fault::Sensor(Sensor::Odometry, defect),
            Declared::Touch(defect) => Fault::Sensor(Sensor::Touch, defect),
            Declared::Buttons(defect) => Fault::Sensor(Sensor::Buttons, defect),
            Declared::Infrared(defect) => Fault::Sensor(Sensor::Infrared, defect),
            Declared::Color(defect) => Fault::Sensor(Sensor::Color, defect),
            Declared::Camera(defect) => Fault::Sensor(Sensor::Camera, defect),
            Declared::Battery(defect) => Fault::Sensor(Sensor::Battery, defect),
            Declared::RotatorStuck => Fault::StuckRotator,
            Declared::BatteryLow { share } => Fault::LowBattery(share),
            Declared::LeftMotorStalled => Fault::StalledMotor(Side::Left),
            Declared::RightMotorStalled => Fault::StalledMotor(Side::Right),
            Declared::WheelsSlip { share } => Fault::Slip(share),
            Declared::ControllerDead => Fault::DeadController,
        }
    }
}

/// A fault by its words, `wheels.slip`, without an amount or with one.
pub fn named(device: &str, fault: &str, amount: Option<f64>) -> Option<Fault> {
    <Carbot as devices::Devices>::fault(devices::find_fault(TABLE, device, fault)?, amount)
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use afp_core::Duration;
    use afp_core::devices::{Devices as _, controls, faults, find_control, find_stop, signals};

    use super::*;
    use crate::fault::Defect;

    #[test]
    fn every_row_is_a_fault_of_its_own() {
        let all: Vec<_> = faults(TABLE).map(|(id, ..)| Carbot::fault(id, None).unwrap()).collect();
        for (n, fault) in all.iter().enumerate() {
            assert!(!all[..n].contains(fault), "{fault:?} twice");
        }
        assert_eq!(all.len(), 5 * 9 + 6);
        let second = Duration::from_secs(1);
        let late = Fault::Sensor(Sensor::Odometry, Defect::Delayed(second));
        assert_eq!(named("odometry", "delayed", Some(1.0)), Some(late));
        for (device, fault, amount) in [
            ("ultrasonic", "stuck", None),
            ("sonar", "frozen", None),
            ("wheels", "slip", Some(1.5)),
            ("touch", "lost", Some(0.5)),
        ] {
            assert_eq!(named(device, fault, amount), None, "{device}.{fault}");
        }
    }

    #[test]
    fn every_row_is_a_control_of_its_own() {
        let all: Vec<_> = controls(TABLE).map(|(id, ..)| Carbot::control(id)).collect();
        assert_eq!(all, [Some(Control::Touch), Some(Control::ButtonsEscape)]);
        assert_eq!(find_control(TABLE, "escape"), find_control(TABLE, "buttons.escape"));
        assert_eq!(find_control(TABLE, "touch"), Some(ControlId(0)));
        assert_eq!(find_stop(TABLE), Some(ControlId(1)));
    }

    #[test]
    fn sensors_come_first() {
        for (sensor, row) in Sensor::ALL.into_iter().zip(TABLE) {
            assert_eq!((sensor.name(), row.faults.len() >= 5), (row.name, true));
        }
    }

    #[test]
    fn signals_are_numbered_as_the_toolbox_declares_them() {
        let names = signals(TABLE).map(|(_, device, row)| (device.name, row.name));
        let expected = [
            ("ultrasonic", "echo"),
            ("ultrasonic", "frame"),
            ("rotator", "bearing"),
            ("odometry", "pose"),
            ("touch", "touched"),
            ("buttons", "escape"),
            ("infrared", "direction"),
            ("infrared", "strength"),
            ("color", "red"),
            ("color", "green"),
            ("color", "blue"),
            ("camera", "picture"),
            ("camera", "frame"),
            ("battery", "left"),
            ("navigator", "asked_speed"),
            ("navigator", "asked_turn"),
            ("robot", "pose"),
            ("robot", "halted"),
            ("robot", "standing"),
            ("robot", "collision"),
            ("robot", "contact"),
            ("world", "outline"),
        ];
        assert_eq!(names.collect::<Vec<_>>(), expected);
        assert_eq!((signal::POSE.0, signal::WORLD_OUTLINE.0), (16, 21));
    }
}
