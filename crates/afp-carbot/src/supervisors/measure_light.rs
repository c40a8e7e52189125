//! Report the light that the floor reflects.

use crate::devices::ColorSensor;
use crate::helpers::guard::{Guard, NO_COLOR};
use crate::templates;
use crate::templates::measure_light::{Event, Inputs, Live};
use afp_core::{Events, Fault, Instant, Supervisor};

/// Reports the current reading at every poll.
#[derive(Clone, Debug)]
pub struct MeasureLight {
    guard: Guard,
}

impl<E: ColorSensor + ?Sized> Supervisor<templates::MeasureLight, E> for MeasureLight {
    fn start(_: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(MeasureLight { guard: Guard::new(NO_COLOR, now) })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let color = self.guard.current(env.color(), now)?;
        let event = color.map(|color| Event::LightMeasured { light: color.reflectance() });
        Ok(event.filter(|_| wanted.contains(0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::devices::Color;
    use crate::fake::Fake;

    fn watch(robot: &mut Fake) -> Result<Option<Event>, Fault> {
        robot.watch::<templates::MeasureLight, MeasureLight>(Inputs {}, || Live {}, 1, 1000)
    }

    #[test]
    fn the_light_of_the_floor_is_reported() {
        let mut robot = Fake::new(&[]);
        robot.floor = Color { red: 0.0, green: 1.0, blue: 0.0 };
        assert_eq!(watch(&mut robot), Ok(Some(Event::LightMeasured { light: 0.7152 })));
    }

    #[test]
    fn a_dead_sensor_is_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.dead_color = true;
        assert_eq!(watch(&mut robot), Err(NO_COLOR));
    }
}
