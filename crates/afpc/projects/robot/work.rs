//! The templates of the robot's toolbox: its actions and its supervisors.

use afp::quantity::{Angle, AngularSpeed, Length, Speed};
use afp::{
    Actor, Duration, Events, Fault, Instant, Poll, Reason, Resumable, Supervisor,
};

use crate::templates::{self, check_bumper, drive, turn};
use crate::{Bumper, Wheels};

/// Drives a distance.
#[derive(Clone, Debug)]
pub struct Drive {
    inputs: drive::Inputs,
    from: Length,
}

impl<E: Wheels + ?Sized> Actor<templates::Drive, E> for Drive {
    fn start(inputs: drive::Inputs, env: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(Drive { inputs, from: env.counted().0 })
    }

    fn poll(
        &mut self,
        _: drive::Live,
        env: &mut E,
        _: Instant,
    ) -> Result<Poll<drive::State>, Fault> {
        let (distance, driven) = (self.inputs.distance.si(), (env.counted().0 - self.from).si());
        let rest = distance.abs() - driven * distance.signum();
        if rest <= 0.0 {
            env.halt();
            return Ok(Poll::Ready(drive::State::Driven));
        }
        // The robot slows down near the end because the motors react late.
        let speed = self.inputs.speed.si().min(0.02 + 3.0 * rest).copysign(distance);
        env.drive(Speed::from_si(speed), AngularSpeed::from_si(0.0));
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, _: Instant) -> Result<(), Fault> {
        env.halt();
        Ok(())
    }
}

/// `suspend` in a plan stops the robot. Afterwards the counters still show the distance that is left.
impl<E: Wheels + ?Sized> Resumable<templates::Drive, E> for Drive {
    fn suspend(&mut self, env: &mut E, _: Instant) -> Result<(), Fault> {
        env.halt();
        Ok(())
    }

    fn resume(&mut self, _: &mut E, _: Instant, _: Duration) -> Result<(), Fault> {
        Ok(())
    }
}

/// Turns by an angle.
#[derive(Clone, Debug)]
pub struct Turn {
    inputs: turn::Inputs,
    from: Angle,
}

impl<E: Wheels + ?Sized> Actor<templates::Turn, E> for Turn {
    fn start(inputs: turn::Inputs, env: &mut E, _: Instant) -> Result<Self, Fault> {
        Ok(Turn { inputs, from: env.counted().1 })
    }

    fn poll(
        &mut self,
        _: turn::Live,
        env: &mut E,
        _: Instant,
    ) -> Result<Poll<turn::State>, Fault> {
        let (angle, turned) = (self.inputs.angle.si(), (env.counted().1 - self.from).si());
        let rest = angle.abs() - turned * angle.signum();
        if rest <= 0.0 {
            env.halt();
            return Ok(Poll::Ready(turn::State::Turned));
        }
        let rate = self.inputs.rate.si().min(0.1 + 3.0 * rest).copysign(angle);
        env.drive(Speed::from_si(0.0), AngularSpeed::from_si(rate));
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, _: Instant) -> Result<(), Fault> {
        env.halt();
        Ok(())
    }
}

/// `suspend` in a plan stops the robot. Afterwards the counters still show the angle that is left.
impl<E: Wheels + ?Sized> Resumable<templates::Turn, E> for Turn {
    fn suspend(&mut self, env: &mut E, _: Instant) -> Result<(), Fault> {
        env.halt();
        Ok(())
    }

    fn resume(&mut self, _: &mut E, _: Instant, _: Duration) -> Result<(), Fault> {
        Ok(())
    }
}

/// A sensor that does not answer is a fault.
const SILENT: Fault =
    Fault::new(&Reason { code: "bumper-silent", text: "the bumper does not answer" });
/// Older readings are ignored.
const MAX_AGE: Duration = Duration::from_millis(100);

/// Watches the bumper.
#[derive(Clone, Debug)]
pub struct CheckBumper;

impl<E: Bumper + ?Sized> Supervisor<templates::CheckBumper, E> for CheckBumper {
    fn start(
        _: check_bumper::Inputs,
        _: &mut E,
        _: Instant,
    ) -> Result<Self, Fault> {
        Ok(CheckBumper)
    }

    fn poll(
        &mut self,
        _: check_bumper::Live,
        wanted: Events,
        env: &mut E,
        now: Instant,
    ) -> Result<Option<check_bumper::Event>, Fault> {
        let pressed = env.pressed().fresh(now, MAX_AGE).ok_or(SILENT)?;
        Ok((pressed && wanted.contains(0)).then_some(check_bumper::Event::Bumped))
    }
}
