//! Implements the templates of `{{name}}.afp`.

pub mod templates {
    //! The declarations of the toolbox, in Rust.
    afp::toolbox!("{{name}}.afp", robot: super::Navigator);
}

use afp::quantity::{AngularSpeed, Speed};
use afp::{Actor, Duration, Fault, Instant, Poll, Resumable};
use afp_carbot::devices::Navigator;
use templates::wag;

/// Turns left and right.
#[derive(Clone, Debug)]
pub struct Wag {
    inputs: wag::Inputs,
    began: Instant,
}

// For every robot with a drive.
impl<E: Navigator + ?Sized> Actor<templates::Wag, E> for Wag {
    fn start(inputs: wag::Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        Ok(Wag { inputs, began: now })
    }

    fn poll(
        &mut self,
        _: wag::Live,
        env: &mut E,
        now: Instant,
    ) -> Result<Poll<wag::State>, Fault> {
        let done = (now.since(self.began).as_secs_f64() / self.inputs.period.si()) as i64;
        if done >= self.inputs.times {
            env.halt(now);
            return Ok(Poll::Ready(wag::State::Wagged));
        }
        let side = if done % 2 == 0 { 1.0 } else { -1.0 };
        let rate = AngularSpeed::from_si(side * self.inputs.rate.si());
        env.drive(Speed::from_si(0.0), rate, now);
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }
}

/// `suspend` in a plan stops the robot. The time until `return` does not count.
impl<E: Navigator + ?Sized> Resumable<templates::Wag, E> for Wag {
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        Ok(())
    }

    fn resume(&mut self, _: &mut E, _: Instant, away: Duration) -> Result<(), Fault> {
        self.began += away;
        Ok(())
    }
}
