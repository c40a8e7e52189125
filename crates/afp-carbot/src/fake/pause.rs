//! Runs of actors that are suspended in the middle.

use super::Fake;
use afp_core::{ActorTemplate, Duration, Fault, Poll, Resumable};

/// Time before the suspension, and time until the actor must be ready after it, milliseconds.
const BEFORE: u64 = 1_000;
const AFTER: u64 = 20_000;
/// Length of the suspension, milliseconds.
const AWAY: u64 = 5_000;

impl Fake {
    /// Runs an actor with a suspension in the middle, during which `change` acts on the robot.
    /// Checks that the robot is not driven while the actor is suspended, and that it starts from a
    /// standstill afterwards.
    pub(crate) fn run_with_a_pause<'a, T: ActorTemplate, A: Resumable<T, Fake>>(
        &mut self,
        inputs: T::Inputs<'_>,
        live: impl Fn() -> T::Live<'a>,
        change: impl FnOnce(&mut Fake),
    ) -> Result<Option<T::State>, Fault> {
        let now = self.now;
        let mut actor = A::start(inputs, self, now)?;
        for _ in 0..BEFORE / 10 {
            self.tick();
            assert!(actor.poll(live(), self, self.now)?.is_pending());
        }
        actor.suspend(self, self.now)?;
        for _ in 0..AWAY / 10 {
            assert_eq!(self.command, (0.0, 0.0), "a suspended actor drives");
            self.tick();
        }
        change(self);
        actor.resume(self, self.now, Duration::from_millis(AWAY))?;
        assert_eq!(self.command, (0.0, 0.0), "'resume' drives");
        self.gains = (0.0, 0.0);
        for _ in 0..AFTER / 10 {
            self.tick();
            if let Poll::Ready(state) = actor.poll(live(), self, self.now)? {
                assert!(self.gains.0 < 0.02 && self.gains.1 < 0.1, "{:?}", self.gains);
                return Ok(Some(state));
            }
        }
        actor.interrupt(self, self.now)?;
        Ok(None)
    }
}
