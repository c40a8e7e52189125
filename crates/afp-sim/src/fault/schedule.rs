//! Which faults there are when.

use super::{Defect, Fault, Sensor, Side};
use afp_core::Instant;

/// A fault from an instant to before another.
#[derive(Clone, Copy, Debug)]
struct Spell {
    fault: Fault,
    from: Instant,
    until: Instant,
}

/// The faults that are and will be, in the order of their beginnings.
#[derive(Debug)]
pub(crate) struct Schedule {
    spells: Vec<Spell>,
    now: Instant,
    next: Instant,
}

impl Schedule {
    pub(crate) fn new() -> Self {
        Schedule { spells: Vec::new(), now: Instant::ZERO, next: Instant::MAX }
    }

    /// Adds a fault; one that begins at the same instant as another comes after it.
    pub(crate) fn add(&mut self, fault: Fault, from: Instant, until: Instant) {
        self.spells.push(Spell { fault, from, until });
        self.spells.sort_by_key(|spell| spell.from);
        self.look(self.now);
    }

    /// When something begins or ends next.
    pub(crate) fn next(&self) -> Instant {
        self.next
    }

    /// Comes to an instant; what is over is forgotten.
    pub(crate) fn look(&mut self, now: Instant) {
        self.now = now;
        self.spells.retain(|spell| spell.until > now);
        let edges = self.spells.iter().map(|s| if s.from > now { s.from } else { s.until });
        self.next = edges.min().unwrap_or(Instant::MAX);
    }

    /// What is broken now, that which began last first.
    fn active(&self) -> impl Iterator<Item = Fault> {
        self.spells.iter().rev().filter(|spell| spell.from <= self.now).map(|spell| spell.fault)
    }

    /// What is wrong with a sensor: that which began last.
    pub(crate) fn defect(&self, of: Sensor) -> Option<Defect> {
        self.active().find_map(|fault| match fault {
            Fault::Sensor(sensor, defect) if sensor == of => Some(defect),
            // The controller counts the wheels.
            Fault::DeadController if of == Sensor::Odometry => Some(Defect::Lost),
            _ => None,
        })
    }

    pub(crate) fn rotator_stuck(&self) -> bool {
        self.active().any(|fault| fault == Fault::StuckRotator)
    }

    pub(crate) fn controller_dead(&self) -> bool {
        self.active().any(|fault| fault == Fault::DeadController)
    }

    pub(crate) fn stalled(&self, side: Side) -> bool {
        self.active().any(|fault| fault == Fault::StalledMotor(side))
    }

    /// The share of the grip that is left: the least that any fault leaves.
    pub(crate) fn grip(&self) -> f64 {
        self.least(|fault| if let Fault::Slip(share) = fault { Some(share) } else { None })
    }

    /// The share of the charge that may be left at most.
    pub(crate) fn charge(&self) -> f64 {
        self.least(|fault| if let Fault::LowBattery(share) = fault { Some(share) } else { None })
    }

    /// The least of some shares, within 0 to 1; what is no number leaves nothing.
    fn least(&self, share: impl Fn(Fault) -> Option<f64>) -> f64 {
        let shares = self.active().filter_map(share);
        shares.fold(1.0, |least, share| if share > 0.0 { least.min(share) } else { 0.0 })
    }
}
