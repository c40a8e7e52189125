//! The devices of the Carbot as a table: what can be pressed, how each of them fails, what it signals.
//!
//! Nowhere else stand these names. Sensors come first, in the order of [`Sensor::ALL`].

use afp_core::devices::{
    AmountRow, ControlId, ControlRow, DeviceRow, Devices, FaultId, FaultRow, SignalId, SignalRow,
    SignalType, controls, faults,
};
use afp_core::{Duration, devices};

use crate::fault::{Defect, Fault, Sensor, Side};

/// The devices of the Carbot.
#[derive(Clone, Copy, Debug)]
pub struct Carbot;

/// What can be held down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// The bumper, as if something stood there.
    Touch,
    /// The escape button.
    Escape,
}

/// The table.
pub const TABLE: &[DeviceRow] = &[
    sensor(
        "ultrasonic",
        "the range sensor",
        &SENSOR,
        &[
            signal("echo", SignalType::Range, "the latest echo"),
            signal("frame", SignalType::Pose, "where the sensor looks"),
        ],
    ),
    sensor(
        "rotator",
        "what turns the range sensor, with its telemetry",
        &ROTATOR,
        &[signal("bearing", SignalType::Float("rad"), "where it points, against the heading")],
    ),
    sensor(
        "odometry",
        "the counters of the wheels",
        &SENSOR,
        &[signal("pose", SignalType::Pose, "where the robot takes itself to be")],
    ),
    DeviceRow {
        controls: &[ControlRow { name: "touch", help: "the bumper" }],
        ..sensor(
            "touch",
            "the bumper",
            &SENSOR,
            &[signal("touched", SignalType::Bool, "whether it is pressed")],
        )
    },
    DeviceRow {
        controls: &[ControlRow { name: "escape", help: "the button that ends plans" }],
        ..sensor(
            "buttons",
            "the buttons",
            &SENSOR,
            &[signal("escape", SignalType::Bool, "whether the escape button is down")],
        )
    },
    sensor("infrared", "the infrared direction sensor", &SENSOR, &[]),
    sensor("color", "the colour sensor", &SENSOR, &[]),
    sensor(
        "camera",
        "the camera",
        &SENSOR,
        &[signal("picture", SignalType::Image, "the latest picture")],
    ),
    sensor(
        "battery",
        "the battery with its gauge",
        &BATTERY,
        &[signal("left", SignalType::Float(""), "the share of a full charge that is left")],
    ),
    sensor("left_motor", "the motor of the left wheel", &MOTOR, &[]),
    sensor("right_motor", "the motor of the right wheel", &MOTOR, &[]),
    sensor("wheels", "the wheels on the floor", &WHEELS, &[]),
    sensor("controller", "the controller of the drive", &CONTROLLER, &[]),
    sensor(
        "robot",
        "the robot as a whole",
        &[],
        &[
            truth("pose", SignalType::Pose, "where it is"),
            truth(
                "halted",
                SignalType::Bool,
                "whether the drive was told to stand, or nothing yet",
            ),
            truth("standing", SignalType::Bool, "whether it does not move"),
            truth("collision", SignalType::Bool, "whether it touches anything"),
        ],
    ),
    sensor(
        "world",
        "what is around the robot",
        &[],
        &[truth("outline", SignalType::Outline, "where what moves is, one after the other")],
    ),
];

/// The latest echo of the range sensor.
pub const ECHO: SignalId = SignalId(0);
/// Where the range sensor looks.
pub const ECHO_FRAME: SignalId = SignalId(1);
/// Where the rotator points.
pub const BEARING: SignalId = SignalId(2);
/// Where the robot takes itself to be.
pub const BELIEVED: SignalId = SignalId(3);
/// Whether the bumper is pressed.
pub const TOUCHED: SignalId = SignalId(4);
/// Whether the escape button is down.
pub const ESCAPE: SignalId = SignalId(5);
/// The camera's latest picture.
pub const PICTURE: SignalId = SignalId(6);
/// The share of the charge that is left.
pub const CHARGE: SignalId = SignalId(7);
/// Where the robot is.
pub const POSE: SignalId = SignalId(8);
/// Whether the drive was told to stand.
pub const HALTED: SignalId = SignalId(9);
/// Whether the robot does not move.
pub const STANDING: SignalId = SignalId(10);
/// Whether the robot touches anything.
pub const COLLISION: SignalId = SignalId(11);
/// Where what moves is.
pub const OUTLINE: SignalId = SignalId(12);

const FROZEN: FaultRow = fault("frozen", None, "it repeats its last value as if it were new");
const LOST: FaultRow = fault("lost", None, "it does not answer");
const NAN: FaultRow = fault("nan", None, "it delivers what is no number");
const DELAYED: FaultRow = fault("delayed", Some(time(0.2)), "its readings arrive so much later");
const SLOW: FaultRow = fault("slow", Some(time(0.02)), "each use takes so long");

const SENSOR: [FaultRow; 5] = [FROZEN, LOST, NAN, DELAYED, SLOW];
const ROTATOR: [FaultRow; 6] =
    [FROZEN, LOST, NAN, DELAYED, SLOW, fault("stuck", None, "it does not move and says so")];
const BATTERY: [FaultRow; 6] =
    [FROZEN, LOST, NAN, DELAYED, SLOW, fault("low", Some(share(0.05)), "so much is left at most")];
const MOTOR: [FaultRow; 1] = [fault("stalled", None, "its wheel steers but does not roll")];
const WHEELS: [FaultRow; 1] = [fault("slip", Some(share(0.1)), "so much of the grip is left")];
const CONTROLLER: [FaultRow; 1] = [fault("dead", None, "it hears nothing and counts no wheel")];

/// A day: no sensor is later than that.
const LONGEST: f64 = 86_400.0;

const fn sensor(
    name: &'static str,
    help: &'static str,
    faults: &'static [FaultRow],
    signals: &'static [SignalRow],
) -> DeviceRow {
    DeviceRow { name, help, controls: &[], faults, signals }
}

const fn signal(name: &'static str, ty: SignalType, help: &'static str) -> SignalRow {
    SignalRow { name, ty, truth: false, help }
}

const fn truth(name: &'static str, ty: SignalType, help: &'static str) -> SignalRow {
    SignalRow { name, ty, truth: true, help }
}

const fn fault(name: &'static str, amount: Option<AmountRow>, help: &'static str) -> FaultRow {
    FaultRow { name, amount, help }
}

const fn time(default: f64) -> AmountRow {
    AmountRow { name: "time", unit: "s", default, from: 0.0, to: LONGEST }
}

const fn share(default: f64) -> AmountRow {
    AmountRow { name: "share", unit: "", default, from: 0.0, to: 1.0 }
}

impl Devices for Carbot {
    const TABLE: &'static [DeviceRow] = TABLE;
    type Control = Control;
    type Fault = Fault;

    fn control(id: ControlId) -> Option<Control> {
        let (_, device, _) = controls(TABLE).find(|(known, ..)| *known == id)?;
        match device.name {
            "touch" => Some(Control::Touch),
            "buttons" => Some(Control::Escape),
            _ => None,
        }
    }

    fn fault(id: FaultId, amount: Option<f64>) -> Option<Fault> {
        let (_, device, row) = faults(TABLE).find(|(known, ..)| *known == id)?;
        let amount = match row.amount {
            Some(of) => of.checked(amount)?,
            None if amount.is_none() => 0.0,
            None => return None,
        };
        match (device.name, row.name) {
            ("rotator", "stuck") => Some(Fault::StuckRotator),
            ("left_motor", "stalled") => Some(Fault::StalledMotor(Side::Left)),
            ("right_motor", "stalled") => Some(Fault::StalledMotor(Side::Right)),
            ("wheels", "slip") => Some(Fault::Slip(amount)),
            ("controller", "dead") => Some(Fault::DeadController),
            ("battery", "low") => Some(Fault::LowBattery(amount)),
            (name, kind) => {
                let sensor = Sensor::ALL.into_iter().find(|sensor| sensor.name() == name)?;
                Some(Fault::Sensor(sensor, defect(kind, Duration::from_secs_f64(amount))?))
            }
        }
    }
}

fn defect(kind: &str, time: Duration) -> Option<Defect> {
    match kind {
        "frozen" => Some(Defect::Frozen),
        "lost" => Some(Defect::Lost),
        "nan" => Some(Defect::NotANumber),
        "delayed" => Some(Defect::Delayed(time)),
        "slow" => Some(Defect::Slow(time)),
        _ => None,
    }
}

/// A fault by its words, `wheels.slip`, without an amount or with one.
pub fn named(device: &str, fault: &str, amount: Option<f64>) -> Option<Fault> {
    Carbot::fault(devices::find_fault(TABLE, device, fault)?, amount)
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use afp_core::devices::{find_control, find_signal, signals};

    use super::*;

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
        assert_eq!(all, [Some(Control::Touch), Some(Control::Escape)]);
        assert_eq!(find_control(TABLE, "escape"), find_control(TABLE, "buttons.escape"));
        assert_eq!(find_control(TABLE, "touch"), Some(ControlId(0)));
    }

    #[test]
    fn sensors_come_first() {
        for (sensor, row) in Sensor::ALL.into_iter().zip(TABLE) {
            assert_eq!((sensor.name(), row.faults.len() >= 5), (row.name, true));
        }
    }

    #[test]
    fn signals_have_the_numbers_of_their_rows() {
        for (id, device, name) in [
            (ECHO, "ultrasonic", "echo"),
            (ECHO_FRAME, "ultrasonic", "frame"),
            (BEARING, "rotator", "bearing"),
            (BELIEVED, "odometry", "pose"),
            (TOUCHED, "touch", "touched"),
            (ESCAPE, "buttons", "escape"),
            (PICTURE, "camera", "picture"),
            (CHARGE, "battery", "left"),
            (POSE, "robot", "pose"),
            (HALTED, "robot", "halted"),
            (STANDING, "robot", "standing"),
            (COLLISION, "robot", "collision"),
            (OUTLINE, "world", "outline"),
        ] {
            assert_eq!(find_signal(TABLE, device, name), Some(id), "{device}.{name}");
        }
        assert_eq!(signals(TABLE).count(), 13);
    }
}
