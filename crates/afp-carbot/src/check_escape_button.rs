//! Watch the escape button.

use crate::devices::{Button, Buttons};
use crate::guard::{Guard, NO_BUTTON};
use crate::templates;
use crate::templates::check_escape_button::{Event, Inputs, Live};
use afp_core::{Events, Fault, Instant, Supervisor};

/// Reports while the escape button is pressed.
#[derive(Debug)]
pub struct CheckEscapeButton {
    guard: Guard,
    wanted: bool,
}

impl<E: Buttons + ?Sized> Supervisor<templates::CheckEscapeButton, E> for CheckEscapeButton {
    fn start(_: Inputs, wanted: Events, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckEscapeButton { guard: Guard::new(NO_BUTTON, now), wanted: wanted.contains(0) })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Option<Event>, Fault> {
        let pressed = self.guard.current(env.pressed(Button::Escape), now)?.unwrap_or(false);
        Ok((pressed && self.wanted).then_some(Event::EscapeButtonPressed))
    }
}
