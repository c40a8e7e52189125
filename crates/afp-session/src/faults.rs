//! Faults by time.

use afp_core::Instant;

/// A fault from an instant (included) to another (excluded).
#[derive(Clone, Copy, Debug)]
struct Spell<F> {
    fault: F,
    from: Instant,
    until: Instant,
}

/// Present and future faults, ordered by their begin.
#[derive(Clone, Debug)]
pub struct Faults<F> {
    spells: Vec<Spell<F>>,
    now: Instant,
    next: Instant,
    /// The active faults, latest begin first.
    active: Vec<F>,
}

/// The active faults, latest begin first.
#[derive(Clone, Copy, Debug)]
pub struct Active<'a, F>(&'a [F]);

impl<F: Copy> Default for Faults<F> {
    fn default() -> Self {
        Faults { spells: Vec::new(), now: Instant::ZERO, next: Instant::MAX, active: Vec::new() }
    }
}

impl<F: Copy> Faults<F> {
    /// Adds a fault, after those that begin at the same instant.
    pub fn add(&mut self, fault: F, from: Instant, until: Instant) {
        self.spells.push(Spell { fault, from, until });
        self.spells.sort_by_key(|spell| spell.from);
        self.find_next();
    }

    /// The next begin or end of a fault.
    pub fn next_change(&self) -> Instant {
        self.next
    }

    /// Advances to an instant and removes faults that have ended.
    pub fn advance(&mut self, now: Instant) -> Active<'_, F> {
        self.now = now;
        self.spells.retain(|spell| spell.until > now);
        self.find_next();
        let begun = self.spells.iter().rev().filter(|spell| spell.from <= now);
        self.active = begun.map(|spell| spell.fault).collect();
        Active(&self.active)
    }

    fn find_next(&mut self) {
        let now = self.now;
        let edges = self.spells.iter().map(|s| if s.from > now { s.from } else { s.until });
        self.next = edges.min().unwrap_or(Instant::MAX);
    }
}

impl<'a, F: Copy> Active<'a, F> {
    /// Active faults, which must be ordered latest begin first.
    pub fn new(faults: &'a [F]) -> Self {
        Active(faults)
    }

    /// All active faults, latest begin first.
    pub fn iter(&self) -> impl Iterator<Item = F> + 'a {
        self.0.iter().copied()
    }

    /// The first result of `of`, in the order of [`Active::iter`].
    pub fn find<T>(&self, of: impl FnMut(F) -> Option<T>) -> Option<T> {
        self.iter().find_map(of)
    }

    /// Whether `is` holds for an active fault.
    pub fn any(&self, is: impl FnMut(F) -> bool) -> bool {
        self.iter().any(is)
    }
}

#[cfg(test)]
mod tests {
    use afp_core::Duration;

    use super::*;

    fn at(seconds: u64) -> Instant {
        Instant::ZERO + Duration::from_secs(seconds)
    }

    #[test]
    fn the_latest_fault_wins_until_it_ends() {
        let mut faults = Faults::default();
        faults.add('b', at(2), at(4));
        faults.add('a', at(1), Instant::MAX);
        faults.add('c', at(2), at(3));
        for (seconds, active, next) in [
            (0, "", at(1)),
            (1, "a", at(2)),
            (2, "cba", at(3)),
            (3, "ba", at(4)),
            (4, "a", Instant::MAX),
        ] {
            let now: String = faults.advance(at(seconds)).iter().collect();
            assert_eq!((now.as_str(), faults.next_change()), (active, next), "{seconds} s");
        }
    }
}
