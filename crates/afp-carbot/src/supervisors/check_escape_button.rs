//! Watch the escape button.

use crate::devices::{Button, Buttons};
use crate::helpers::guard::{Guard, NO_BUTTON};
use crate::templates;
use crate::templates::check_escape_button::{Event, Inputs, Live};
use afp_core::{Events, Fault, Instant, Supervisor};

/// Reports while the escape button is pressed.
#[derive(Clone, Debug)]
pub struct CheckEscapeButton {
    guard: Guard,
}

impl<E: Buttons + ?Sized> Supervisor<templates::CheckEscapeButton, E> for CheckEscapeButton {
    fn start(_: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckEscapeButton { guard: Guard::new(NO_BUTTON, now) })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let pressed = self.guard.current(env.pressed(Button::Escape), now)?.unwrap_or(false);
        Ok((pressed && wanted.contains(0)).then_some(Event::EscapeButtonPressed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::Duration;

    type Template = templates::CheckEscapeButton;

    fn poll(robot: &mut Fake, wanted: u64, after: u64) -> Result<Option<Event>, Fault> {
        let now = robot.now;
        let mut watch: CheckEscapeButton =
            Supervisor::<Template, Fake>::start(Inputs {}, robot, now)?;
        let now = now + Duration::from_millis(after);
        robot.now = now;
        Supervisor::<Template, Fake>::poll(
            &mut watch,
            Live {},
            Events::from_bits(wanted),
            robot,
            now,
        )
    }

    #[test]
    fn reports_a_wanted_press_only() {
        let mut robot = Fake::new(&[]);
        assert_eq!(poll(&mut robot, 1, 5), Ok(None));
        robot.escape = true;
        assert_eq!(poll(&mut robot, 1, 5), Ok(Some(Event::EscapeButtonPressed)));
        assert_eq!(poll(&mut robot, 0, 5), Ok(None));
    }

    #[test]
    fn a_dead_switch_is_a_fault_after_half_a_second() {
        let mut robot = Fake::new(&[]);
        robot.dead_switches = true;
        assert_eq!(poll(&mut robot, 1, 500), Ok(None));
        assert_eq!(poll(&mut robot, 1, 501), Err(NO_BUTTON));
    }
}
