//! The lamp and the buzzer.

use afp_core::Instant;
use afp_core::quantity::Frequency;

/// A lamp and a loudspeaker.
pub trait Signals {
    /// Switches the lamp, and lets a tone sound or none, until further notice.
    fn signal(&mut self, light: bool, tone: Option<Frequency>, now: Instant);
}
