//! Watch for infrared light.

use crate::devices::{Glow, InfraredSensor, Odometry};
use crate::helpers::guard::{FROZEN_INFRARED, Guard, NO_INFRARED, NO_ODOMETRY, PATIENCE};
use crate::helpers::history::History;
use crate::helpers::motion::wrap;
use crate::helpers::repeats::Repeats;
use crate::templates;
use crate::templates::check_infrared::{Event, Inputs, Live};
use afp_core::quantity::Angle;
use afp_core::{Events, Fault, Instant, Supervisor};

/// Reports while there is light, or after half a second of darkness.
///
/// The bearing is relative to the heading at the report, even for a late reading.
#[derive(Clone, Debug)]
pub struct CheckInfrared {
    guard: Guard,
    odometry: Guard,
    repeats: Repeats<Glow>,
    history: History,
    last_look: Instant,
    /// Time of the last light; initially the start.
    seen: Instant,
}

impl<E: InfraredSensor + Odometry + ?Sized> Supervisor<templates::CheckInfrared, E>
    for CheckInfrared
{
    fn start(_: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let mut history = History::new();
        history.note(env.motion());
        Ok(CheckInfrared {
            guard: Guard::new(NO_INFRARED, now),
            odometry: Guard::new(NO_ODOMETRY, now),
            repeats: Repeats::new(FROZEN_INFRARED, now),
            history,
            last_look: now,
            seen: now,
        })
    }

    fn poll(
        &mut self,
        live: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let counted = env.motion();
        self.history.note(counted);
        let Some(motion) = self.odometry.current(counted, now)? else { return Ok(None) };
        let glow = env.glow();
        self.repeats.check(glow, counted)?;
        let reading = self.history.placed(glow);
        let Some((glow, then)) = self.guard.next(reading, self.last_look, now)? else {
            return Ok(None);
        };
        self.last_look = reading.time;
        match glow.filter(|glow| glow.strength >= live.strength) {
            Some(glow) => {
                self.seen = reading.time;
                let bearing = wrap(then.heading + glow.bearing.si() - motion.heading.si());
                let bearing = Angle::from_si(bearing);
                Ok(wanted.contains(0).then_some(Event::InfraredSeen { bearing }))
            }
            None => {
                let lost = reading.time.since(self.seen) >= PATIENCE;
                Ok((lost && wanted.contains(1)).then_some(Event::InfraredLost))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;

    /// Watches for `millis` milliseconds or until a report.
    fn watch(robot: &mut Fake, wanted: u64, millis: u64) -> Result<Option<Event>, Fault> {
        let live = || Live { strength: 0.5 };
        robot.watch::<templates::CheckInfrared, CheckInfrared>(Inputs {}, live, wanted, millis)
    }

    #[test]
    fn light_is_seen_when_it_is_strong_enough() {
        let mut robot = Fake::new(&[]);
        robot.light = Some((1.0, 0.5));
        let Ok(Some(Event::InfraredSeen { bearing })) = watch(&mut robot, 1, 100) else {
            panic!("nothing seen")
        };
        assert!((bearing.si() - f64::atan2(0.5, 1.0)).abs() < 1e-9);
        robot.light = Some((2.0, 0.0));
        assert_eq!(watch(&mut robot, 1, 2000), Ok(None));
    }

    #[test]
    fn light_is_lost_after_half_a_second_and_not_before() {
        let mut robot = Fake::new(&[]);
        assert_eq!(watch(&mut robot, 2, 490), Ok(None));
        assert_eq!(watch(&mut robot, 2, 600), Ok(Some(Event::InfraredLost)));
        robot.light = Some((1.0, 0.0));
        assert_eq!(watch(&mut robot, 2, 600), Ok(None));
    }

    #[test]
    fn a_dead_sensor_is_a_fault_and_not_darkness() {
        let mut robot = Fake::new(&[]);
        robot.infrared_dies = 0;
        assert_eq!(watch(&mut robot, 3, 1000), Err(NO_INFRARED));
    }

    #[test]
    fn a_sensor_that_repeats_itself_is_a_fault_while_the_robot_moves() {
        for (drifts, seen) in [(0.0, Ok(None)), (1.0, Err(FROZEN_INFRARED))] {
            let mut robot = Fake::new(&[]);
            robot.light = Some((1.0, 0.5));
            (robot.infrared_freezes, robot.drifts) = (300, drifts);
            assert_eq!(watch(&mut robot, 2, 2000), seen);
        }
    }
}
