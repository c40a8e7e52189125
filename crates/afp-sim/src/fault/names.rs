//! What scenarios and command lines call the faults.

use super::{Defect, Fault, Sensor, Side};
use afp_core::Duration;

/// A delayed sensor is late by this unless said otherwise.
const DELAY: Duration = Duration::from_millis(200);
/// A slow one takes this long.
const COST: Duration = Duration::from_millis(20);
/// A slippery floor leaves this share of the grip.
const GRIP: f64 = 0.1;
/// A low battery has this share of its charge.
const CHARGE: f64 = 0.05;

/// How much of a fault; what is not given has a default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Amount {
    /// For `delayed` (200 ms) and `slow` (20 ms).
    pub time: Option<Duration>,
    /// For `slip` (0.1 of the grip is left) and `low` (0.05 of the charge is left).
    pub share: Option<f64>,
}

/// What can happen to any sensor.
const DEFECTS: [&str; 5] = ["frozen", "lost", "nan", "delayed", "slow"];

/// What can happen to what is no sensor.
const OTHERS: [(&str, &str); 6] = [
    ("rotator", "stuck"),
    ("left_motor", "stalled"),
    ("right_motor", "stalled"),
    ("wheels", "slip"),
    ("controller", "dead"),
    ("battery", "low"),
];

impl Fault {
    /// A fault by its names, as in `fail ultrasonic(kind = "frozen")`; none for names that do not
    /// go together.
    pub fn named(device: &str, kind: &str, amount: Amount) -> Option<Fault> {
        let share = |default| amount.share.unwrap_or(default);
        match (device, kind) {
            ("rotator", "stuck") => Some(Fault::StuckRotator),
            ("left_motor", "stalled") => Some(Fault::StalledMotor(Side::Left)),
            ("right_motor", "stalled") => Some(Fault::StalledMotor(Side::Right)),
            ("wheels", "slip") => Some(Fault::Slip(share(GRIP))),
            ("controller", "dead") => Some(Fault::DeadController),
            ("battery", "low") => Some(Fault::LowBattery(share(CHARGE))),
            _ => {
                let sensor = Sensor::ALL.into_iter().find(|sensor| sensor.name() == device)?;
                Some(Fault::Sensor(sensor, Defect::named(kind, amount.time)?))
            }
        }
    }

    /// Every pair of names that [`Fault::named`] knows: device and kind.
    pub fn names() -> impl Iterator<Item = (&'static str, &'static str)> {
        let of_sensor = |sensor: Sensor| DEFECTS.map(|kind| (sensor.name(), kind));
        Sensor::ALL.into_iter().flat_map(of_sensor).chain(OTHERS)
    }
}

impl Defect {
    fn named(kind: &str, time: Option<Duration>) -> Option<Defect> {
        match kind {
            "frozen" => Some(Defect::Frozen),
            "lost" => Some(Defect::Lost),
            "nan" => Some(Defect::NotANumber),
            "delayed" => Some(Defect::Delayed(time.unwrap_or(DELAY))),
            "slow" => Some(Defect::Slow(time.unwrap_or(COST))),
            _ => None,
        }
    }
}

impl Sensor {
    /// What scenarios call it.
    pub fn name(self) -> &'static str {
        match self {
            Sensor::Ultrasonic => "ultrasonic",
            Sensor::Rotator => "rotator",
            Sensor::Odometry => "odometry",
            Sensor::Touch => "touch",
            Sensor::Buttons => "buttons",
            Sensor::Infrared => "infrared",
            Sensor::Color => "color",
            Sensor::Camera => "camera",
            Sensor::Battery => "battery",
        }
    }
}
