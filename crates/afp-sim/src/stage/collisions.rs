//! The robot's collisions and their durations.

use super::STEP;
use afp_core::Instant;

/// A period in which the robot touched one obstacle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Collision {
    /// The obstacle's index in [`crate::World::obstacles`].
    pub obstacle: usize,
    /// The time of the first touch.
    pub begin: Instant,
    /// The time of the last touch.
    pub end: Instant,
}

/// Touches of one obstacle within this time are one collision, in nanoseconds.
const APART: u64 = 300_000_000;

/// Oldest first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Collisions(Vec<Collision>);

impl Collisions {
    pub(crate) fn touch(&mut self, obstacle: usize, now: Instant) {
        let last = self.0.iter_mut().rev().find(|c| c.obstacle == obstacle);
        match last {
            Some(last) if now.since(last.end).as_nanos() <= APART => last.end = now,
            _ => self.0.push(Collision { obstacle, begin: now, end: now }),
        }
    }

    pub(crate) fn all(&self) -> &[Collision] {
        &self.0
    }

    /// The collisions that last at `now`. A touch lasts until the end of its physics step.
    pub(crate) fn lasting(&self, now: Instant) -> impl DoubleEndedIterator<Item = &Collision> {
        self.0.iter().filter(move |touch| now.since(touch.end) < STEP)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_two_touches_outlasts_the_second() {
        let at = |step: u64| Instant::from_nanos(step * STEP.as_nanos());
        let mut touches = Collisions::default();
        let lasting = |touches: &Collisions, now| -> Vec<usize> {
            touches.lasting(now).map(|touch| touch.obstacle).collect()
        };
        assert_eq!(lasting(&touches, at(0)), [0; 0]);
        touches.touch(7, at(1));
        touches.touch(7, at(2));
        touches.touch(3, at(2));
        assert_eq!(lasting(&touches, at(2)), [7, 3]);
        touches.touch(7, at(3));
        assert_eq!(lasting(&touches, at(3)), [7], "the one that began last is over");
        let between = at(3) + afp_core::Duration::from_nanos(STEP.as_nanos() - 1);
        assert_eq!(lasting(&touches, between), [7], "until the next step looks");
        assert_eq!(lasting(&touches, at(4)), [0; 0]);
        touches.touch(3, at(5));
        assert_eq!(lasting(&touches, at(5)), [3], "as one collision with that before");
        assert_eq!(touches.0.len(), 2);
    }
}
