//! Report the distance in one direction.

use super::check_distance::Pointed;
use crate::devices::{Navigator, Odometry, Rotator, Ultrasonic};
use crate::templates;
use crate::templates::measure_distance::{Event, Inputs, Live};
use afp_core::quantity::Length;
use afp_core::{Events, Fault, Instant, Supervisor};

/// The reported distance without an echo, metres.
const NOTHING: f64 = 4.0;

/// Reports every echo.
#[derive(Clone, Debug)]
pub struct MeasureDistance {
    sensor: Pointed,
}

impl<E> Supervisor<templates::MeasureDistance, E> for MeasureDistance
where
    E: Navigator + Odometry + Ultrasonic + Rotator + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(MeasureDistance { sensor: Pointed::new(inputs.bearing, env, now) })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let clear = self.sensor.echo(env, now)?;
        let distance = clear.map(|clear| Length::from_si(clear.si().min(NOTHING)));
        let event = distance.map(|distance| Event::DistanceMeasured { distance });
        Ok(event.filter(|_| wanted.contains(0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::{Fake, plane};
    use afp_core::quantity::Angle;

    fn watch(robot: &mut Fake) -> Result<Option<Event>, Fault> {
        let inputs = Inputs { bearing: Angle::from_deg(0.0) };
        robot.watch::<templates::MeasureDistance, MeasureDistance>(inputs, || Live {}, 1, 2000)
    }

    #[test]
    fn a_wall_ahead_is_measured_from_the_robots_front() {
        let Ok(Some(Event::DistanceMeasured { distance })) =
            watch(&mut Fake::new(&[plane(0.0, 1.0)]))
        else {
            panic!("no echo")
        };
        let front = Fake::new(&[]).body().front.si();
        assert!((distance.si() - (1.0 - front)).abs() < 0.02, "{distance:?}");
    }

    #[test]
    fn no_echo_is_the_longest_distance() {
        let distance = Length::from_si(NOTHING);
        assert_eq!(watch(&mut Fake::new(&[])), Ok(Some(Event::DistanceMeasured { distance })));
    }
}
