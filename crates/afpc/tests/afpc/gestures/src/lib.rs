//! Small movements of the Carbot: a toolbox of a project.

use afp::quantity::{Angle, AngularSpeed, Speed, Time};
use afp::{Actor, Duration, Events, Fault, Instant, Poll, Supervisor};
use afp_carbot::devices::{Navigator, Odometry};
use templates::{check_turned, spin};

pub mod templates {
    //! The declarations of `gestures.afp`.
    afp::toolbox!("gestures.afp", robot: super::Navigator + super::Odometry);
}

/// Turns on the spot.
#[derive(Clone)]
pub struct Spin {
    begun: Instant,
    time: Duration,
    speed: AngularSpeed,
}

impl<E: Navigator + ?Sized> Actor<templates::Spin, E> for Spin {
    fn start(inputs: spin::Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Spin { begun: now, time: inputs.time.duration(), speed: inputs.speed })
    }

    fn poll(&mut self, _: spin::Live, env: &mut E, now: Instant) -> Result<Poll<spin::State>, Fault> {
        let spent = now.since(self.begun);
        if spent >= self.time {
            env.halt(now);
            return Ok(Poll::Ready(spin::State::Spun { spent: Time::from_si(spent.as_secs_f64()) }));
        }
        env.drive(Speed::from_si(0.0), self.speed, now);
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }
}

/// Watches the heading.
#[derive(Clone)]
pub struct CheckTurned {
    from: Option<Angle>,
    angle: Angle,
}

impl<E: Odometry + ?Sized> Supervisor<templates::CheckTurned, E> for CheckTurned {
    fn start(
        inputs: check_turned::Inputs,
        env: &mut E,
        _: Instant,
    ) -> Result<Self, Fault> {
        let from = env.motion().value.ok().map(|motion| motion.heading);
        Ok(CheckTurned { from, angle: inputs.angle })
    }

    fn poll(
        &mut self,
        _: check_turned::Live, _: Events,
        env: &mut E,
        _: Instant,
    ) -> Result<Option<check_turned::Event>, Fault> {
        let Ok(motion) = env.motion().value else { return Ok(None) };
        let from = *self.from.get_or_insert(motion.heading);
        let turned = (motion.heading - from).abs() >= self.angle;
        Ok(turned.then_some(check_turned::Event::Turned))
    }
}
