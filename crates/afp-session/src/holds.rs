//! The holds of controls and their ends.

use afp_core::Instant;
use afp_core::devices::ControlId;

use crate::request::RequestId;

/// All holds, in the order of their begin.
#[derive(Clone, Debug)]
pub(crate) struct Holds {
    holds: Vec<Hold>,
    /// The next end of a hold.
    next: Instant,
}

/// A hold of a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Hold {
    pub(crate) control: ControlId,
    /// The request that began it.
    pub(crate) by: RequestId,
    /// Its end; [`Instant::MAX`] until the control is released.
    pub(crate) until: Instant,
}

impl Default for Holds {
    fn default() -> Self {
        Holds { holds: Vec::new(), next: Instant::MAX }
    }
}

impl Holds {
    /// Adds a hold; one control may have several.
    pub(crate) fn add(&mut self, hold: Hold) {
        self.holds.push(hold);
        self.find_next();
    }

    /// Ends all holds of a control.
    pub(crate) fn end(&mut self, control: ControlId) {
        self.holds.retain(|hold| hold.control != control);
        self.find_next();
    }

    /// The next end of a hold.
    pub(crate) fn next_change(&self) -> Instant {
        self.next
    }

    /// Removes the holds that have ended. Returns the last hold of each control that has no hold
    /// left.
    pub(crate) fn advance(&mut self, now: Instant) -> Vec<Hold> {
        let (mut over, left): (Vec<_>, Vec<_>) =
            self.holds.drain(..).partition(|hold| hold.until <= now);
        self.holds = left;
        self.find_next();
        over.sort_by_key(|hold| hold.until);
        let is_held = |hold: &Hold| self.holds.iter().any(|other| other.control == hold.control);
        let mut let_go: Vec<Hold> = Vec::new();
        for hold in over.into_iter().filter(|hold| !is_held(hold)) {
            let_go.retain(|other| other.control != hold.control);
            let_go.push(hold);
        }
        let_go
    }

    fn find_next(&mut self) {
        self.next = self.holds.iter().map(|hold| hold.until).min().unwrap_or(Instant::MAX);
    }
}

#[cfg(test)]
mod tests {
    use afp_core::Duration;

    use super::*;

    fn at(millis: u64) -> Instant {
        Instant::ZERO + Duration::from_millis(millis)
    }

    #[test]
    fn a_control_is_released_when_its_last_holder_releases_it() {
        let mut holds = Holds::default();
        let hold =
            |control, by, until| Hold { control: ControlId(control), by: RequestId(by), until };
        holds.add(hold(0, 0, at(1500)));
        holds.add(hold(0, 1, at(1200)));
        holds.add(hold(1, 2, at(1300)));
        holds.add(hold(2, 3, Instant::MAX));
        for (millis, let_go, next) in [
            (1000, vec![], at(1200)),
            (1200, vec![], at(1300)),
            (1300, vec![hold(1, 2, at(1300))], at(1500)),
            (1500, vec![hold(0, 0, at(1500))], Instant::MAX),
        ] {
            assert_eq!(
                (holds.advance(at(millis)), holds.next_change()),
                (let_go, next),
                "{millis}"
            );
        }
        holds.add(hold(2, 4, at(2000)));
        holds.end(ControlId(2));
        assert_eq!(holds.advance(at(3000)), [], "it was let go before");
    }
}
