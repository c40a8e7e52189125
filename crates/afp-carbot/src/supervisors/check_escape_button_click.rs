//! Watch for presses of the escape button.

use crate::devices::{Button, Buttons};
use crate::helpers::guard::{Guard, NO_BUTTON};
use crate::helpers::press::Press;
use crate::templates;
use crate::templates::check_escape_button_click::{Event, Inputs, Live};
use afp_core::{Events, Fault, Instant, Supervisor};

/// Reports each press of the escape button once.
#[derive(Clone, Debug)]
pub struct CheckEscapeButtonClick {
    guard: Guard,
    press: Press,
}

impl<E: Buttons + ?Sized> Supervisor<templates::CheckEscapeButtonClick, E>
    for CheckEscapeButtonClick
{
    fn start(_: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckEscapeButtonClick { guard: Guard::new(NO_BUTTON, now), press: Press::default() })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let held = self.guard.current(env.pressed(Button::Escape), now)?;
        Ok((self.press.begins(held) && wanted.contains(0)).then_some(Event::EscapeButtonClicked))
    }
}

#[cfg(test)]
mod tests {
    use std::vec;

    use super::*;
    use crate::fake::Fake;

    #[test]
    fn each_press_that_is_wanted_is_reported_once() {
        let held = |robot: &mut Fake, held| robot.escape = held;
        let clicks = |polls: &[(bool, u64)]| {
            let mut robot = Fake::new(&[]);
            robot.clicks::<templates::CheckEscapeButtonClick, CheckEscapeButtonClick>(
                Inputs {},
                || Live {},
                held,
                polls,
            )
        };
        let polls = [false, true, true, false, true].map(|held| (held, 1));
        assert_eq!(clicks(&polls), Ok(vec![false, true, false, false, true]));
        // What is held from the start on, and what was not wanted, is no press.
        assert_eq!(clicks(&[(true, 1), (true, 1)]), Ok(vec![false, false]));
        assert_eq!(clicks(&[(false, 1), (true, 0), (true, 1)]), Ok(vec![false, false, false]));
    }
}
