//! Signal by light and sound.

use crate::devices::{Navigator, Signals};
use crate::templates;
use crate::templates::signal_::{Inputs, Live, State};
use afp_core::quantity::Frequency;
use afp_core::{Actor, Duration, Fault, Instant, Poll, Resumable};
use core::mem;

/// Blinks and beeps a number of times while the robot is stationary.
#[derive(Clone, Debug)]
pub struct Signal {
    light: bool,
    tone: Option<Frequency>,
    half: Duration,
    /// Remaining changes between on and off, and the time of the next one.
    left: i64,
    next: Instant,
    /// Whether the lamp and the tone are still off after a suspension.
    resumed: bool,
}

impl<E: Navigator + Signals + ?Sized> Actor<templates::Signal, E> for Signal {
    fn start(inputs: Inputs, env: &mut E, now: Instant) -> Result<Self, Fault> {
        env.halt(now);
        let half = Duration::from_secs_f64(inputs.period.si() / 2.0);
        let mut signal = Signal {
            light: inputs.light,
            tone: Some(inputs.tone).filter(|_| inputs.sound),
            half,
            left: 2 * inputs.times,
            next: now,
            resumed: false,
        };
        signal.change(env, now);
        Ok(signal)
    }

    fn poll(&mut self, _: Live, env: &mut E, now: Instant) -> Result<Poll<State>, Fault> {
        env.halt(now);
        if now >= self.next {
            if self.left == 0 {
                return Ok(Poll::Ready(State::Signalled));
            }
            self.change(env, now);
        } else if mem::take(&mut self.resumed) {
            self.show(env, now);
        }
        Ok(Poll::Pending)
    }

    fn interrupt(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        env.signal(false, None, now);
        Ok(())
    }
}

/// The lamp and the tone are off meanwhile.
impl<E: Navigator + Signals + ?Sized> Resumable<templates::Signal, E> for Signal {
    fn suspend(&mut self, env: &mut E, now: Instant) -> Result<(), Fault> {
        env.halt(now);
        env.signal(false, None, now);
        Ok(())
    }

    fn resume(&mut self, _: &mut E, _: Instant, away: Duration) -> Result<(), Fault> {
        self.next += away;
        self.resumed = true;
        Ok(())
    }
}

impl Signal {
    fn change<E: Signals + ?Sized>(&mut self, env: &mut E, now: Instant) {
        self.left -= 1;
        self.next += self.half;
        self.resumed = false;
        self.show(env, now);
    }

    fn show<E: Signals + ?Sized>(&self, env: &mut E, now: Instant) {
        let on = self.left % 2 == 1;
        env.signal(on && self.light, self.tone.filter(|_| on), now);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::Fake;
    use afp_core::quantity::Time;

    fn inputs(light: bool, sound: bool, times: i64) -> Inputs {
        let (period, tone) = (Time::from_si(0.4), Frequency::from_si(880.0));
        Inputs { light, sound, tone, times, period }
    }

    #[test]
    fn it_blinks_and_beeps_as_often_as_wanted_and_ends_dark_and_silent() {
        let mut robot = Fake::new(&[]);
        let state = robot.run::<templates::Signal, Signal>(inputs(true, true, 3), || Live {}, 5);
        assert_eq!(state, Ok(Some(State::Signalled)));
        let on = (true, Some(Frequency::from_si(880.0)));
        let off = (false, None);
        assert_eq!(robot.signals, [on, off, on, off, on, off]);
        assert_eq!(robot.millis(), 1200);
    }

    #[test]
    fn only_light_and_only_sound() {
        for (light, sound) in [(true, false), (false, true)] {
            let mut robot = Fake::new(&[]);
            let inputs = inputs(light, sound, 1);
            robot.run::<templates::Signal, Signal>(inputs, || Live {}, 5).unwrap();
            let tone = sound.then(|| Frequency::from_si(880.0));
            assert_eq!(robot.signals, [(light, tone), (false, None)]);
        }
    }

    #[test]
    fn an_interrupt_leaves_it_dark_silent_and_stopped() {
        let mut robot = Fake::new(&[]);
        let state = robot.run::<templates::Signal, Signal>(inputs(true, true, 100), || Live {}, 1);
        assert_eq!((state, robot.signals.last()), (Ok(None), Some(&(false, None))));
    }
}
