//! Turn in place towards infrared light.

use crate::devices::{InfraredSensor, Navigator, Odometry};
use crate::guard::{Guard, NO_INFRARED, NO_ODOMETRY, PATIENCE};
use crate::history::History;
use crate::motion::Ramp;
use crate::templates;
use crate::templates::turn_to_infrared::{Inputs, Live, State};
use crate::tracking::Tracking;
use afp_core::{Actor, Fault, Instant, Poll};

/// Turn rate is gained and lost at this many radians a second squared.
const ACCELERATION: f64 = 3.0;
/// So many readings in a row must say that the light is ahead.
const SURE: u8 = 3;
/// Without light the robot turns a little more than once around, radians.
const ALL_AROUND: f64 = core::f64::consts::TAU + 0.2;
/// The whole way counts as turned when less than this is left, radians.
const CLOSE: f64 = 0.005;

/// Turns left until it sees light, then towards it.
///
/// Each reading gives the rest of the way anew, so the sensor's noise does not add up. A reading that comes late is
/// about the heading that the robot had when it was measured.
#[derive(Clone, Debug)]
pub struct TurnToInfrared {
    tolerance: f64,
    speed: f64,
    ramp: Ramp,
    tracking: Tracking,
    infrared: Guard,
    odometry: Guard,
    history: History,
    /// When the latest reading was measured.
    last_look: Instant,
    /// The heading at the beginning; none until the first reading.
    from: Option<f64>,
    /// The heading towards the light, by the last reading that saw it, and when that was; radians.
    light: Option<(f64, Instant)>,
    /// Readings in a row with the light ahead.
    ahead: u8,
}

impl<E> Actor<templates::TurnToInfrared, E> for TurnToInfrared
where
    E: Navigator + Odometry + InfraredSensor + ?Sized,
{
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.halt(now);
        let mut history = History::new();
        history.note(env.motion());
        Ok(TurnToInfrared {
            tolerance: inputs.tolerance.si(),
            speed: inputs.speed.si(),
            ramp: Ramp::new(ACCELERATION, now),
            tracking: Tracking::new(now),
            infrared: Guard::new(NO_INFRARED, now),
            odometry: Guard::new(NO_ODOMETRY, now),
            history,
            last_look: now,
            from: None,
            light: None,
            ahead: 0,
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let counted = env.motion();
        self.history.note(counted);
        let Some(motion) = self.odometry.current(counted, now)? else {
            self.tracking.halt(env, now);
            return Ok(Poll::Pending);
        };
        let heading = motion.heading.si();
        self.look(env, heading, now)?;
        let from = *self.from.get_or_insert(heading);
        let (rest, ending) = match self.light {
            Some((towards, seen)) => {
                let lost = self.last_look.since(seen) > PATIENCE;
                let facing = self.ahead >= SURE;
                let state = if lost { State::NoInfraredFound } else { State::FacingInfrared };
                (towards - heading, (lost || facing).then_some(state))
            }
            None => {
                let rest = ALL_AROUND - (heading - from);
                (rest, (rest < CLOSE).then_some(State::NoInfraredFound))
            }
        };
        if let Some(state) = ending {
            self.tracking.halt(env, now);
            return Ok(if motion.stands() { Poll::Ready(state) } else { Poll::Pending });
        }
        let rate = self.ramp.rate(rest.abs(), self.speed, now).copysign(rest);
        self.tracking.drive(env, &motion, (0.0, rate), now)?;
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }
}

impl TurnToInfrared {
    /// Takes in a new reading of the sensor, if there is one.
    fn look<E>(&mut self, env: &E, heading: f64, now: Instant) -> Result<(), Fault>
    where
        E: InfraredSensor + ?Sized,
    {
        let reading = self.history.placed(env.glow());
        let Some((glow, then)) = self.infrared.next(reading, self.last_look, now)? else {
            return Ok(());
        };
        self.last_look = reading.time;
        match glow {
            Some(glow) => {
                let light = then.heading + glow.bearing.si();
                let is_ahead = (light - heading).abs() <= self.tolerance;
                self.ahead = if is_ahead { self.ahead.saturating_add(1) } else { 0 };
                self.light = Some((light, reading.time));
            }
            None => self.ahead = 0,
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::quantity::{Angle, AngularSpeed};

    fn turn(robot: &mut Fake) -> Result<Option<State>, Fault> {
        let inputs =
            Inputs { tolerance: Angle::from_deg(5.0), speed: AngularSpeed::from_deg(45.0) };
        robot.run::<templates::TurnToInfrared, TurnToInfrared>(inputs, || Live {}, 20)
    }

    #[test]
    fn faces_light_on_either_side_and_behind() {
        for (x, y) in [(1.0, 1.0), (1.0, -0.5), (-1.0, 0.2), (2.0, 0.0)] {
            let mut robot = Fake::new(&[]);
            robot.light = Some((x, y));
            assert!(matches!(turn(&mut robot), Ok(Some(State::FacingInfrared))), "{x} {y}");
            let off = robot.motion.heading.si() - f64::atan2(y, x);
            assert!(crate::motion::wrap(off).abs() < 5.0_f64.to_radians(), "{x} {y}: {off}");
        }
    }

    #[test]
    fn without_light_it_turns_once_around() {
        let mut robot = Fake::new(&[]);
        assert!(matches!(turn(&mut robot), Ok(Some(State::NoInfraredFound))));
        assert!(robot.motion.heading.si() > core::f64::consts::TAU);
    }

    #[test]
    fn light_that_goes_out_is_not_waited_for() {
        let mut robot = Fake::new(&[]);
        robot.light = Some((1.0, 1.0));
        robot.light_goes_out = 300;
        assert!(matches!(turn(&mut robot), Ok(Some(State::NoInfraredFound))));
        assert!(robot.motion.heading.si() < 1.0);
    }

    #[test]
    fn a_dead_sensor_is_a_fault_and_not_darkness() {
        let mut robot = Fake::new(&[]);
        robot.dead_infrared = true;
        assert_eq!(turn(&mut robot), Err(NO_INFRARED));
    }
}
