//! Watch the colour of the floor.

use crate::devices::{Color, ColorSensor};
use crate::helpers::guard::{Guard, NO_COLOR};
use crate::templates;
use crate::templates::check_color::{Event, Inputs, Live};
use afp_core::{Events, Fault, Instant, Supervisor};

/// Reports while the floor has the colour.
#[derive(Clone, Debug)]
pub struct CheckColor {
    guard: Guard,
    color: Color,
    tolerance: f64,
}

impl<E: ColorSensor + ?Sized> Supervisor<templates::CheckColor, E> for CheckColor {
    fn start(inputs: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        let Inputs { red, green, blue, tolerance } = inputs;
        let guard = Guard::new(NO_COLOR, now);
        Ok(CheckColor { guard, color: Color { red, green, blue }, tolerance })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let color = self.guard.current(env.color(), now)?;
        let seen = color.is_some_and(|color| self.is(color));
        Ok((seen && wanted.contains(0)).then_some(Event::ColorSeen))
    }
}

impl CheckColor {
    fn is(&self, seen: Color) -> bool {
        let near = |seen: f64, wanted: f64| (seen - wanted).abs() <= self.tolerance;
        near(seen.red, self.color.red)
            && near(seen.green, self.color.green)
            && near(seen.blue, self.color.blue)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;

    fn watch(robot: &mut Fake, wanted: u64) -> Result<Option<Event>, Fault> {
        let inputs = Inputs { red: 0.8, green: 0.1, blue: 0.1, tolerance: 0.1 };
        robot.watch::<templates::CheckColor, CheckColor>(inputs, || Live {}, wanted, 1000)
    }

    #[test]
    fn only_the_wanted_colour_is_reported() {
        let mut robot = Fake::new(&[]);
        robot.floor = Color { red: 0.75, green: 0.05, blue: 0.15 };
        assert_eq!(watch(&mut robot, 1), Ok(Some(Event::ColorSeen)));
        assert_eq!(watch(&mut robot, 0), Ok(None));
        robot.floor = Color { red: 0.75, green: 0.3, blue: 0.15 };
        assert_eq!(watch(&mut robot, 1), Ok(None));
    }

    #[test]
    fn a_dead_sensor_is_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.dead_color = true;
        assert_eq!(watch(&mut robot, 1), Err(NO_COLOR));
    }
}
