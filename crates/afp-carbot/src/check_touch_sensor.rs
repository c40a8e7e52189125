//! Watch the bumper.

use crate::devices::TouchSensor;
use crate::guard::{Guard, NO_TOUCH};
use crate::templates;
use crate::templates::check_touch_sensor::{Event, Inputs, Live};
use afp_core::{Events, Fault, Instant, Supervisor};

/// Reports while the bumper is pressed.
#[derive(Debug)]
pub struct CheckTouchSensor {
    guard: Guard,
    wanted: bool,
}

impl<E: TouchSensor + ?Sized> Supervisor<templates::CheckTouchSensor, E> for CheckTouchSensor {
    fn start(_: Inputs, wanted: Events, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckTouchSensor { guard: Guard::new(NO_TOUCH, now), wanted: wanted.contains(0) })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Option<Event>, Fault> {
        let pressed = self.guard.current(env.touched(), now)?.unwrap_or(false);
        Ok((pressed && self.wanted).then_some(Event::TouchSensorPressed))
    }
}
