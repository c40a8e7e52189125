//! The tactile bumper.

use super::Reading;

/// A bumper in front of the robot.
pub trait TouchSensor {
    /// Whether the bumper is pressed.
    fn touched(&self) -> Reading<bool>;
}
