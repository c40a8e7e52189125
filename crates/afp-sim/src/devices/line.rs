//! The line from a sensor to the plan, which a fault can cut, delay or freeze.

use afp_carbot::devices::{Invalid, Reading};
use afp_carbot::fault::Defect;
use afp_core::{Duration, Instant};
use std::collections::VecDeque;

/// What the plan reads of one sensor.
#[derive(Clone, Debug)]
pub(crate) struct Line<T> {
    defect: Option<Defect>,
    /// What a broken line holds; none while it is sound.
    held: Option<Reading<T>>,
    /// What is under way, with when it arrives.
    under_way: VecDeque<(Instant, Reading<T>)>,
}

impl<T> Default for Line<T> {
    fn default() -> Self {
        Line { defect: None, held: None, under_way: VecDeque::new() }
    }
}

impl<T: Clone> Line<T> {
    /// Breaks or mends the line whose sensor says `raw` at the moment.
    pub(crate) fn set(&mut self, defect: Option<Defect>, raw: Reading<T>) {
        if self.defect == defect {
            return;
        }
        self.held = defect.map(|_| self.read(raw));
        self.under_way.clear();
        self.defect = defect;
    }

    /// Notes what the sensor says; to be called often while the line is slow.
    pub(crate) fn note(&mut self, raw: Reading<T>, now: Instant) {
        let Some(Defect::Delayed(delay)) = self.defect else { return };
        self.under_way.push_back((now + delay, raw));
        while let Some((_, arrived)) = self.under_way.pop_front_if(|(arrival, _)| *arrival <= now) {
            self.held = Some(arrived);
        }
    }

    /// What arrives of what the sensor says.
    pub(crate) fn read(&self, raw: Reading<T>) -> Reading<T> {
        let Reading { time, value } = self.look(&raw);
        Reading { time, value: value.cloned() }
    }

    /// The same without a copy.
    pub(crate) fn look<'a>(&'a self, raw: &'a Reading<T>) -> Reading<&'a T> {
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

    /// What one use costs.
    pub(crate) fn cost(&self) -> Option<Duration> {
        match self.defect {
            Some(Defect::Slow(cost)) => Some(cost),
            _ => None,
        }
    }
}
