//! The watched sensors.

use afp_carbot::table::TABLE;
use afp_core::Duration;

/// The sensors, in the order of the Carbot's devices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sensor {
    Ultrasonic,
    Rotator,
    Odometry,
    Touch,
    Buttons,
    Infrared,
    Color,
    Camera,
    Battery,
}

impl Sensor {
    pub const ALL: [Sensor; 9] = [
        Sensor::Ultrasonic,
        Sensor::Rotator,
        Sensor::Odometry,
        Sensor::Touch,
        Sensor::Buttons,
        Sensor::Infrared,
        Sensor::Color,
        Sensor::Camera,
        Sensor::Battery,
    ];

    /// The longest interval between two readings by a supervisor or an actor.
    pub fn asked_every(self) -> Duration {
        Duration::from_millis(if self == Sensor::Battery { 100 } else { 50 })
    }

    pub fn name(self) -> &'static str {
        TABLE.get(self as usize).map_or("", |row| row.name)
    }
}

#[test]
fn sensors_are_the_first_devices() {
    for (sensor, row) in Sensor::ALL.into_iter().zip(TABLE) {
        assert!(format!("{sensor:?}").eq_ignore_ascii_case(row.name), "{sensor:?}: {}", row.name);
        assert_eq!(sensor.name(), row.name);
    }
}
