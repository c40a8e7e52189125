//! Turn in place.

use crate::devices::{Navigator, Odometry};
use crate::guard::{Guard, NO_ODOMETRY};
use crate::motion::Ramp;
use crate::templates;
use crate::templates::turn::{Inputs, Live, State};
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_core::{Actor, Fault, Instant, Poll};

/// Turn rate is gained and lost at this many radians a second squared.
const ACCELERATION: f64 = 3.0;
/// The angle counts as turned when less than this many radians are left.
const CLOSE: f64 = 0.008;

/// Turns by an angle against the heading it starts with, by odometry.
#[derive(Debug)]
pub struct Turn {
    angle: f64,
    speed: f64,
    ramp: Ramp,
    odometry: Guard,
    /// The heading at the beginning; none until the first reading.
    from: Option<Angle>,
}

impl<E: Navigator + Odometry + ?Sized> Actor<templates::Turn, E> for Turn {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        let mut odometry = Guard::new(NO_ODOMETRY, now);
        let from = odometry.current(env.motion(), now)?.map(|motion| motion.heading);
        Ok(Turn {
            angle: inputs.angle.si(),
            speed: inputs.speed.si(),
            ramp: Ramp::new(ACCELERATION, now),
            odometry,
            from,
        })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        let Some(motion) = self.odometry.current(env.motion(), now)? else {
            env.halt(now);
            return Ok(Poll::Pending);
        };
        let turned = motion.heading - *self.from.get_or_insert(motion.heading);
        let left = if self.angle < 0.0 { -1.0 } else { 1.0 };
        let rest = left * (self.angle - turned.si());
        if rest < CLOSE {
            env.halt(now);
            return Ok(if motion.stands() {
                Poll::Ready(State::TurnSuccessful { turned })
            } else {
                Poll::Pending
            });
        }
        let rate = self.ramp.rate(rest, self.speed, now);
        env.drive(Speed::from_si(0.0), AngularSpeed::from_si(left * rate), now);
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }
}
