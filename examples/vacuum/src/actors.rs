//! The robot's actors.

use std::f64::consts::TAU;

use afp::quantity::{AngularSpeed, Speed};
use afp::{Actor, Duration, Fault, Instant, Poll, Reason, Resumable};

use crate::supervisors::current;
use crate::templates::{self, roll, spin, spiral, suction};
use crate::{Nozzle, Way, Wheels};

/// The wheels do not turn although they are commanded to.
const BLOCKED: Fault =
    Fault::new(&Reason { code: "wheels-blocked", text: "the wheels have not turned for 2 s" });
/// The time after which this is a fault.
const PATIENCE: Duration = Duration::from_secs(2);
/// The wheels have moved the robot away from the place where its actor was suspended.
const MOVED: Fault = Fault::new(&Reason {
    code: "moved-away",
    text: "the robot moved by more than 10 cm or 15 deg while its action was suspended",
});
/// This is the largest motion, in metres and radians.
const FARTHEST: f64 = 0.1;
const WIDEST: f64 = 15.0 / 360.0 * TAU;
/// The smallest motion that counts as turning, in metres or radians.
const PROGRESS: f64 = 0.01;

/// Measures how far the wheels have turned since an actor began.
#[derive(Clone, Debug)]
struct Counted {
    from: Way,
    last: f64,
    since: Instant,
    /// The counters at a suspension, until they are compared.
    aside: Option<Way>,
}

impl Counted {
    fn new(env: &(impl Wheels + ?Sized), now: Instant) -> Result<Self, Fault> {
        Ok(Counted { from: current(env.way(), now)?, last: 0.0, since: now, aside: None })
    }

    fn suspend(&mut self, env: &(impl Wheels + ?Sized), now: Instant) {
        self.aside = current(env.way(), now).ok();
    }

    /// Continues after a suspension. The counters still show how much is left.
    fn resume(&mut self, now: Instant) {
        self.since = now;
    }

    /// Returns the distance and the angle so far; a fault if `which` of them has not changed for
    /// too long.
    fn so_far(
        &mut self,
        env: &(impl Wheels + ?Sized),
        which: fn(Way) -> f64,
        now: Instant,
    ) -> Result<f64, Fault> {
        let way = current(env.way(), now)?;
        if let Some(before) = self.aside.take()
            && ((way.ahead - before.ahead).si().abs() > FARTHEST
                || (way.turned - before.turned).si().abs() > WIDEST)
        {
            return Err(MOVED);
        }
        let so_far = which(way) - which(self.from);
        if (so_far - self.last).abs() > PROGRESS {
            (self.last, self.since) = (so_far, now);
        }
        if now.since(self.since) > PATIENCE { Err(BLOCKED) } else { Ok(so_far) }
    }
}

/// Stops the wheels on suspension, and continues by the counters.
macro_rules! resumable {
    ($actor:ident) => {
        impl<E: Wheels + ?Sized> Resumable<templates::$actor, E> for $actor {
            fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
                env.halt();
                self.counted.suspend(env, now);
                Ok(())
            }

            fn resume(&mut self, _: &mut E, now: Instant, _: Duration) -> Result<(), Fault> {
                self.counted.resume(now);
                Ok(())
            }
        }
    };
}

resumable!(Roll);
resumable!(Spin);
resumable!(Spiral);

/// Drives a distance.
#[derive(Clone, Debug)]
pub struct Roll {
    inputs: roll::Inputs,
    counted: Counted,
}

impl<E: Wheels + ?Sized> Actor<templates::Roll, E> for Roll {
    fn start(inputs: roll::Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Roll { inputs, counted: Counted::new(env, now)? })
    }

    fn poll(
        &mut self,
        _: roll::Live,
        env: &mut E,
        now: Instant,
    ) -> Result<Poll<roll::State>, Fault> {
        let driven = self.counted.so_far(env, |way| way.ahead.si(), now)?;
        let distance = self.inputs.distance.si();
        let rest = distance.abs() - driven * distance.signum();
        if rest <= 0.0 {
            env.halt();
            return Ok(Poll::Ready(roll::State::Arrived));
        }
        // Slower near the end, because the motors have a lag.
        let speed = self.inputs.speed.si().min(0.02 + 3.0 * rest).copysign(distance);
        env.drive(Speed::from_si(speed), AngularSpeed::from_si(0.0));
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, _: Instant) -> Result<(), Fault> {
        env.halt();
        Ok(())
    }
}

/// Turns by an angle.
#[derive(Clone, Debug)]
pub struct Spin {
    inputs: spin::Inputs,
    counted: Counted,
}

impl<E: Wheels + ?Sized> Actor<templates::Spin, E> for Spin {
    fn start(inputs: spin::Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Spin { inputs, counted: Counted::new(env, now)? })
    }

    fn poll(
        &mut self,
        _: spin::Live,
        env: &mut E,
        now: Instant,
    ) -> Result<Poll<spin::State>, Fault> {
        let turned = self.counted.so_far(env, |way| way.turned.si(), now)?;
        let angle = self.inputs.angle.si();
        let rest = angle.abs() - turned * angle.signum();
        if rest <= 0.0 {
            env.halt();
            return Ok(Poll::Ready(spin::State::Turned));
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

/// The first radius of a spiral and its growth per turn, in metres.
const BEGIN: f64 = 0.1;
const GROWTH: f64 = 0.12;

/// Drives a spiral.
#[derive(Clone, Debug)]
pub struct Spiral {
    inputs: spiral::Inputs,
    counted: Counted,
}

impl<E: Wheels + ?Sized> Actor<templates::Spiral, E> for Spiral {
    fn start(inputs: spiral::Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Spiral { inputs, counted: Counted::new(env, now)? })
    }

    fn poll(
        &mut self,
        _: spiral::Live,
        env: &mut E,
        now: Instant,
    ) -> Result<Poll<spiral::State>, Fault> {
        let turned = self.counted.so_far(env, |way| way.turned.si(), now)?;
        let radius = BEGIN + GROWTH * turned.max(0.0) / TAU;
        if radius >= self.inputs.radius.si() {
            env.halt();
            return Ok(Poll::Ready(spiral::State::Done));
        }
        env.drive(self.inputs.speed, AngularSpeed::from_si(self.inputs.speed.si() / radius));
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, _: Instant) -> Result<(), Fault> {
        env.halt();
        Ok(())
    }
}

/// Switches the suction motor.
#[derive(Clone, Debug)]
pub struct Suction;

impl<E: Nozzle + ?Sized> Actor<templates::Suction, E> for Suction {
    fn start(inputs: suction::Inputs, env: &mut E, _: Instant) -> Result<Self, Fault> {
        env.suck(inputs.on);
        Ok(Suction)
    }

    fn poll(
        &mut self,
        _: suction::Live,
        _: &mut E,
        _: Instant,
    ) -> Result<Poll<suction::State>, Fault> {
        Ok(Poll::Ready(suction::State::Set))
    }

    fn interrupt(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }
}

/// The motor keeps running or stays off meanwhile.
impl<E: Nozzle + ?Sized> Resumable<templates::Suction, E> for Suction {
    fn suspend(&mut self, _: &mut E, _: Instant) -> Result<(), Fault> {
        Ok(())
    }

    fn resume(&mut self, _: &mut E, _: Instant, _: Duration) -> Result<(), Fault> {
        Ok(())
    }
}
