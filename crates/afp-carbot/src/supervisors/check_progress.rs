//! Watch whether the robot makes progress.

use crate::devices::{Motion, Odometry};
use crate::helpers::guard::{Guard, NO_ODOMETRY};
use crate::templates;
use crate::templates::check_progress::{Event, Inputs, Live};
use afp_core::{Duration, Events, Fault, Instant, Supervisor};

/// Reports if the robot has neither moved far nor turned much for a while, by odometry.
#[derive(Clone, Debug)]
pub struct CheckProgress {
    guard: Guard,
    distance: f64,
    angle: f64,
    within: Duration,
    /// Time and place of the last progress.
    last: Option<(Instant, Motion)>,
}

impl<E: Odometry + ?Sized> Supervisor<templates::CheckProgress, E> for CheckProgress {
    fn start(inputs: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(CheckProgress {
            guard: Guard::new(NO_ODOMETRY, now),
            distance: inputs.distance.si(),
            angle: inputs.angle.si(),
            within: inputs.within.duration(),
            last: None,
        })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let Some(motion) = self.guard.current(env.motion(), now)? else { return Ok(None) };
        let (since, from) = *self.last.get_or_insert((now, motion));
        let gone = libm::hypot((motion.x - from.x).si(), (motion.y - from.y).si());
        let turned = (motion.heading - from.heading).si().abs();
        if gone >= self.distance || turned >= self.angle {
            self.last = Some((now, motion));
            return Ok(None);
        }
        let late = now.since(since) >= self.within;
        Ok((late && wanted.contains(0)).then_some(Event::NoProgress))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::devices::Navigator;
    use crate::fake::Fake;
    use afp_core::quantity::{Angle, AngularSpeed, Length, Speed, Time};

    /// The report's time in milliseconds under a constant command.
    fn watch(speed: f64, turn: f64, wanted: u64) -> Option<u64> {
        let mut robot = Fake::new(&[]);
        let inputs = Inputs {
            distance: Length::from_si(0.1),
            angle: Angle::from_deg(20.0),
            within: Time::from_si(2.0),
        };
        let now = robot.now;
        let mut watch: CheckProgress =
            Supervisor::<templates::CheckProgress, Fake>::start(inputs, &mut robot, now).unwrap();
        (0..1000).find_map(|_| {
            let now = robot.now;
            robot.drive(Speed::from_si(speed), AngularSpeed::from_si(turn), now);
            robot.tick();
            let now = robot.now;
            let event = Supervisor::<templates::CheckProgress, Fake>::poll(
                &mut watch,
                Live {},
                Events::from_bits(wanted),
                &mut robot,
                now,
            );
            event.unwrap().map(|_| robot.millis())
        })
    }

    #[test]
    fn driving_and_turning_are_progress_but_standing_and_creeping_are_not() {
        assert_eq!(watch(0.2, 0.0, 1), None);
        assert_eq!(watch(0.0, 0.5, 1), None);
        assert_eq!(watch(0.0, 0.0, 1), Some(2010));
        assert_eq!(watch(0.03, 0.0, 1), Some(2010));
        assert_eq!(watch(0.0, 0.0, 0), None);
    }
}
