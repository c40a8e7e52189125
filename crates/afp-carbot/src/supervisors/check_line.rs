//! Watch for the robot's return to its initial line.

use crate::devices::{Motion, Odometry};
use crate::helpers::guard::{Guard, NO_ODOMETRY};
use crate::helpers::motion::wrap;
use crate::templates;
use crate::templates::check_line::{Event, Inputs, Live};
use afp_core::quantity::Angle;
use afp_core::{Events, Fault, Instant, Supervisor};

/// Stores the initial position and heading by odometry, and reports when the robot is on that line
/// again, farther ahead.
///
/// At this point the algorithm Bug2 leaves an obstacle's boundary (Lumelsky and Stepanov, 1987).
#[derive(Clone, Debug)]
pub struct CheckLine {
    guard: Guard,
    ahead: f64,
    tolerance: f64,
    /// Start of the line; `None` until the first reading.
    from: Option<Motion>,
}

impl<E: Odometry + ?Sized> Supervisor<templates::CheckLine, E> for CheckLine {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let mut guard = Guard::new(NO_ODOMETRY, now);
        let from = guard.current(env.motion(), now)?;
        Ok(CheckLine { guard, ahead: inputs.ahead.si(), tolerance: inputs.tolerance.si(), from })
    }

    fn poll(
        &mut self,
        _: Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<Event>, Fault> {
        let Some(motion) = self.guard.current(env.motion(), now)? else { return Ok(None) };
        let from = *self.from.get_or_insert(motion);
        let (ahead, aside) = motion.seen_from(&from);
        let reached = ahead.si() >= self.ahead && aside.si().abs() <= self.tolerance;
        // The shorter turn; full turns do not matter.
        let turn = Angle::from_si(wrap((from.heading - motion.heading).si()));
        Ok((reached && wanted.contains(0)).then_some(Event::LineReached { turn }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::devices::Navigator;
    use crate::fake::Fake;
    use afp_core::quantity::{AngularSpeed, Length, Speed};

    /// Drives a circle of 1 m to the left after a turn by `first` radians. Returns the report's
    /// time in milliseconds and its turn in degrees.
    fn circle(ahead: f64, first: f64, wanted: u64) -> Option<(u64, i64)> {
        let mut robot = Fake::new(&[]);
        let inputs = Inputs { ahead: Length::from_si(ahead), tolerance: Length::from_si(0.05) };
        let now = robot.now;
        let mut watch: CheckLine =
            Supervisor::<templates::CheckLine, Fake>::start(inputs, &mut robot, now).unwrap();
        robot.motion.heading = Angle::from_si(first);
        (0..3000).find_map(|_| {
            let now = robot.now;
            robot.drive(Speed::from_si(0.5), AngularSpeed::from_si(0.5), now);
            robot.tick();
            let (now, wanted) = (robot.now, Events::from_bits(wanted));
            let event = Supervisor::<templates::CheckLine, Fake>::poll(
                &mut watch,
                Live {},
                wanted,
                &mut robot,
                now,
            );
            let Event::LineReached { turn } = event.unwrap()?;
            Some((robot.millis(), turn.si().to_degrees().round() as i64))
        })
    }

    #[test]
    fn the_line_is_reached_again_ahead_and_not_behind() {
        // A circle from -90 deg meets the line again 2 m ahead, at 90 deg.
        let right = -core::f64::consts::FRAC_PI_2;
        let Some((millis, turn)) = circle(0.5, right, 1) else { panic!("it does not report") };
        assert!((6100..6300).contains(&millis), "{millis}");
        assert!((-91..=-87).contains(&turn), "{turn}");
        // The other circle meets it behind.
        assert_eq!(circle(0.5, -right, 1), None);
        assert_eq!(circle(2.5, right, 1), None);
    }

    #[test]
    fn an_ignored_event_is_not_reported() {
        assert_eq!(circle(0.5, -1.5, 0), None);
    }

    #[test]
    fn a_dead_odometer_is_a_fault() {
        let mut robot = Fake::new(&[]);
        robot.dead_odometry = true;
        let inputs = Inputs { ahead: Length::from_si(0.5), tolerance: Length::from_si(0.05) };
        let seen = robot.watch::<templates::CheckLine, CheckLine>(inputs, || Live {}, 1, 1000);
        assert_eq!(seen, Err(NO_ODOMETRY));
    }
}
