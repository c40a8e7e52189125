//! The line from a sensor to the plan, which a fault can cut, delay or freeze.

use std::collections::VecDeque;

use afp_core::devices::Defect;
use afp_core::{Duration, Instant, Invalid, Reading};

use crate::virtual_clock::VirtualClock;

/// The plan's reading of one sensor, with the faults of every sensor.
#[derive(Clone, Debug)]
pub struct Line<T> {
    defect: Option<Defect>,
    /// The constant reading of a broken line; `None` while it works.
    held: Option<Reading<T>>,
    /// Delayed readings with their times of arrival.
    under_way: VecDeque<(Instant, Reading<T>)>,
}

impl<T> Default for Line<T> {
    fn default() -> Self {
        Line { defect: None, held: None, under_way: VecDeque::new() }
    }
}

impl<T: Clone> Line<T> {
    /// Breaks or repairs the line; `raw` is the sensor's current reading.
    pub fn set(&mut self, defect: Option<Defect>, raw: Reading<T>) {
        if self.defect == defect {
            return;
        }
        self.held = defect.map(|_| self.read(raw));
        self.under_way.clear();
        self.defect = defect;
    }

    /// Records a sensor's reading. Call this often, because a delayed line only delivers recorded
    /// readings.
    pub fn note(&mut self, raw: Reading<T>, now: Instant) {
        let Some(Defect::Delayed(delay)) = self.defect else { return };
        self.under_way.push_back((now + delay, raw));
        while let Some((_, arrived)) = self.under_way.pop_front_if(|(arrival, _)| *arrival <= now) {
            self.held = Some(arrived);
        }
    }

    /// The reading that arrives for `raw`.
    pub fn read(&self, raw: Reading<T>) -> Reading<T> {
        let Reading { time, value } = self.look(&raw);
        Reading { time, value: value.cloned() }
    }

    /// [`Line::read`] for a template; also spends the time of one use of the sensor.
    pub fn sense(&self, raw: Reading<T>, now: Instant, clock: &VirtualClock) -> Reading<T> {
        if let Some(cost) = self.cost() {
            clock.spend(now, cost);
        }
        self.read(raw)
    }

    /// [`Line::read`] without a copy.
    pub fn look<'a>(&'a self, raw: &'a Reading<T>) -> Reading<&'a T> {
        let of = |reading: &'a Reading<T>| reading.value.as_ref().map_err(|reason| *reason);
        let (time, value) = match (self.defect, &self.held) {
            (Some(Defect::Frozen), Some(held)) => (raw.time, of(held)),
            (Some(Defect::Lost), _) => (raw.time, Err(Invalid::NoAnswer)),
            (Some(Defect::NotANumber), _) => (raw.time, Err(Invalid::NotFinite)),
            (Some(Defect::Delayed(_)), Some(held)) => (held.time, of(held)),
            _ => (raw.time, of(raw)),
        };
        Reading { time, value }
    }

    /// Time of one use.
    pub fn cost(&self) -> Option<Duration> {
        match self.defect {
            Some(Defect::Slow(cost)) => Some(cost),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(millis: u64) -> Instant {
        Instant::ZERO + Duration::from_millis(millis)
    }

    #[test]
    fn each_defect_has_its_effect() {
        let mut line = Line::default();
        let (then, later) = (Reading::valid(1, at(0)), Reading::valid(2, at(300)));
        let mut broken = |defect| {
            line.set(None, then);
            line.set(Some(defect), then);
            line.read(later)
        };
        assert_eq!(broken(Defect::Frozen), Reading::valid(1, at(300)), "as if it were new");
        assert_eq!(broken(Defect::Lost).value, Err(Invalid::NoAnswer));
        assert_eq!(broken(Defect::NotANumber).value, Err(Invalid::NotFinite));
        assert_eq!(broken(Defect::Slow(Duration::from_millis(20))), later);
        let clock = VirtualClock::default();
        assert_eq!(line.sense(later, at(300), &clock), later);
        assert_eq!((line.cost(), clock.free()), (Some(Duration::from_millis(20)), at(320)));
        line.set(None, later);
        assert_eq!((line.read(later), line.cost()), (later, None));
    }

    #[test]
    fn a_delayed_reading_arrives_with_its_own_time() {
        let mut line = Line::default();
        line.set(Some(Defect::Delayed(Duration::from_millis(200))), Reading::valid(0, at(0)));
        for millis in (0..=400).step_by(100) {
            line.note(Reading::valid(millis, at(millis)), at(millis));
        }
        assert_eq!(line.read(Reading::valid(9, at(400))), Reading::valid(200, at(200)));
    }
}
