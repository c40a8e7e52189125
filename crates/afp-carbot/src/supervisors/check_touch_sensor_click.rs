//! Watch for presses of the bumper.

use crate::devices::TouchSensor;
use crate::helpers::guard::{Guard, NO_TOUCH};
use crate::helpers::press::Press;
use crate::templates;
use crate::templates::check_touch_sensor_click::{Event, Inputs, Live};
use afp_core::{Events, Fault, Instant, Supervisor};

/// Reports each press of the bumper once.
#[derive(Clone, Debug)]
pub struct CheckTouchSensorClick {
    guard: Guard,
    press: Press,
}

impl<E: TouchSensor + ?Sized> Supervisor<templates::CheckTouchSensorClick, E>
    for CheckTouchSensorClick
{
    fn start(_: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckTouchSensorClick { guard: Guard::new(NO_TOUCH, now), press: Press::default() })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let held = self.guard.current(env.touched(), now)?;
        Ok((self.press.begins(held) && wanted.contains(0)).then_some(Event::TouchSensorClicked))
    }
}

#[cfg(test)]
mod tests {
    use std::vec;

    use super::*;
    use crate::fake::Fake;

    #[test]
    fn each_press_that_is_wanted_is_reported_once() {
        let held = |robot: &mut Fake, held| robot.touched = held;
        let clicks = |polls: &[(bool, u64)]| {
            let mut robot = Fake::new(&[]);
            robot.clicks::<templates::CheckTouchSensorClick, CheckTouchSensorClick>(
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
