//! The lamp and the buzzer.

use afp_core::Instant;
use afp_core::quantity::Frequency;

/// A lamp and a loudspeaker.
pub trait Signals {
    /// Switches the lamp, and starts or stops a tone, until the next command.
    fn signal(&mut self, light: bool, tone: Option<Frequency>, now: Instant);
}
