//! Buttons on the robot.

use super::Reading;

/// A button that a plan may watch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// Asks the plan to end.
    Escape,
}

/// Buttons that a person presses.
pub trait Buttons {
    /// Whether the button is held down.
    fn pressed(&self, button: Button) -> Reading<bool>;
}
