//! What can break on a Carbot. How it is called stands in [`crate::table`].

use crate::table;

pub use afp_core::devices::Defect;

/// Something that is broken for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// A sensor tells something else than it measures.
    Sensor(Sensor, Defect),
    /// The rotator does not move; its telemetry says so.
    StuckRotator,
    /// A wheel's motor is blocked: the wheel steers but does not roll.
    StalledMotor(Side),
    /// The floor is slippery: this share of the grip is left, 0 to 1.
    Slip(f64),
    /// The drive controller hears no command and counts no wheel. It stops the robot once its
    /// dead-man time is over.
    DeadController,
    /// The battery has no more than this share of its charge left, 0 to 1.
    LowBattery(f64),
}

/// What measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sensor {
    /// The range sensor.
    Ultrasonic,
    /// The rotator's telemetry.
    Rotator,
    /// The wheels' counters.
    Odometry,
    /// The bumper.
    Touch,
    /// The buttons.
    Buttons,
    /// The infrared direction sensor.
    Infrared,
    /// The colour sensor.
    Color,
    /// The camera.
    Camera,
    /// The battery's gauge.
    Battery,
}

/// A side of the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left.
    Left,
    /// Right.
    Right,
}

impl Sensor {
    /// Every sensor.
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
    /// What it is called: that of its row, since sensors come first in the table.
    pub fn name(self) -> &'static str {
        table::TABLE.get(self as usize).map_or("", |row| row.name)
    }
}
