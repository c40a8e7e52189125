//! The Carbot's devices as declared in its toolbox file: controls, faults, signals.

use afp_core::devices::{self, DeviceRow};

pub use crate::templates::devices::{Control, Devices as Carbot, Fault};
pub use crate::templates::signal;
pub use afp_core::devices::Defect;

/// The table.
pub const TABLE: &[DeviceRow] = <Carbot as devices::Devices>::TABLE;

/// Looks up a fault by its name, such as `wheels.slip`, with an optional amount.
pub fn named(device: &str, fault: &str, amount: Option<f64>) -> Option<Fault> {
    <Carbot as devices::Devices>::fault(devices::find_fault(TABLE, device, fault)?, amount)
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use afp_core::Duration;
    use afp_core::devices::{
        ControlId, Devices as _, controls, faults, find_control, find_stop, signals,
    };

    use super::*;

    #[test]
    fn every_row_is_a_different_fault() {
        let all: Vec<_> = faults(TABLE).map(|(id, ..)| Carbot::fault(id, None).unwrap()).collect();
        for (n, fault) in all.iter().enumerate() {
            assert!(!all[..n].contains(fault), "{fault:?} twice");
        }
        assert_eq!(all.len(), 5 * 9 + 8);
        let second = Duration::from_secs(1);
        let late = Fault::Odometry(Defect::Delayed(second));
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
    fn every_row_is_a_different_control() {
        let all: Vec<_> = controls(TABLE).map(|(id, ..)| Carbot::control(id)).collect();
        assert_eq!(all, [Some(Control::Touch), Some(Control::ButtonsEscape)]);
        assert_eq!(find_control(TABLE, "escape"), find_control(TABLE, "buttons.escape"));
        assert_eq!(find_control(TABLE, "touch"), Some(ControlId(0)));
        assert_eq!(find_stop(TABLE), Some(ControlId(1)));
    }

    #[test]
    fn signals_have_the_order_of_the_toolbox() {
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
            ("localisation", "pose"),
            ("localisation", "belief"),
            ("localisation", "off"),
            ("localisation", "heading_off"),
            ("signals", "light"),
            ("signals", "tone"),
        ];
        assert_eq!(names.collect::<Vec<_>>(), expected);
        assert_eq!((signal::POSE.0, signal::WORLD_OUTLINE.0), (16, 21));
    }
}
