use afp::{Actor, Fault, Instant, Poll};
use templates::blink::{Inputs, Live, State};

pub mod templates {
    afp::toolbox!("tests/readme/signals.afp", robot: super::Lamp);
}

/// What a platform must have for it.
pub trait Lamp {
    fn light(&mut self, on: bool);
}

#[derive(Clone)]
pub struct Blink {
    period: afp::Duration,
    changes_left: i64,
    next: Instant,
}

impl<E: Lamp + ?Sized> Actor<templates::Blink, E> for Blink {
    fn start(inputs: Inputs, _: &mut E, now: Instant) -> Result<Self, Fault> {
        let period = inputs.period.duration();
        Ok(Blink { period, changes_left: 2 * inputs.times, next: now })
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        if now >= self.next && self.changes_left > 0 {
            self.changes_left -= 1;
            self.next += self.period;
            env.light(self.changes_left % 2 == 1);
        }
        Ok(if self.changes_left == 0 { Poll::Ready(State::Blinked) } else { Poll::Pending })
    }

    fn interrupt(&mut self, env: &mut E, _: Instant) -> Result<(), Fault> {
        env.light(false);
        Ok(())
    }
}
