//! Trace records that own what they say, small enough for a queue and made without allocation.

use afp_core::trace::{Record, Sink};
use afp_core::{Instant, Value, ValueRef};

/// A record with its time; its texts are kept in place.
#[derive(Clone, Debug)]
pub struct OwnedRecord {
    /// The time of the step.
    pub at: Instant,
    /// The record with its values taken out.
    fixed: Record<'static>,
    old: Value,
    new: Value,
}

impl OwnedRecord {
    /// Copies a record.
    pub fn new(at: Instant, record: &Record<'_>) -> Self {
        let none = ValueRef::Unset;
        let (fixed, old, new) = match *record {
            Record::Committed { author, entry, old, new } => {
                (Record::Committed { author, entry, old: none, new: none }, old, new)
            }
            Record::Input { component, port, value } => {
                (Record::Input { component, port, value: none }, none, value)
            }
            Record::ClockWentBack { asked } => (Record::ClockWentBack { asked }, none, none),
            Record::StopRequested => (Record::StopRequested, none, none),
            Record::Injected { component, outcome } => {
                (Record::Injected { component, outcome }, none, none)
            }
            Record::Polled { supervisor, verdict } => {
                (Record::Polled { supervisor, verdict }, none, none)
            }
            Record::Missed { supervisor, lateness, cause, skipped } => {
                (Record::Missed { supervisor, lateness, cause, skipped }, none, none)
            }
            Record::Event { supervisor, event } => {
                (Record::Event { supervisor, event }, none, none)
            }
            Record::AlreadyThere { supervisor, event } => {
                (Record::AlreadyThere { supervisor, event }, none, none)
            }
            Record::Interrupted { element } => (Record::Interrupted { element }, none, none),
            Record::Finished { element, state } => {
                (Record::Finished { element, state }, none, none)
            }
            Record::Started { component } => (Record::Started { component }, none, none),
            Record::Diverted { element, supervisor, event } => {
                (Record::Diverted { element, supervisor, event }, none, none)
            }
            Record::Faulted { component, fault } => {
                (Record::Faulted { component, fault }, none, none)
            }
            Record::Ended { plan, ending } => (Record::Ended { plan, ending }, none, none),
        };
        OwnedRecord { at, fixed, old: old.to_owned(), new: new.to_owned() }
    }

    /// The record, its values borrowed.
    pub fn get(&self) -> Record<'_> {
        match self.fixed {
            Record::Committed { author, entry, .. } => {
                let (old, new) = (self.old.borrow(), self.new.borrow());
                Record::Committed { author, entry, old, new }
            }
            Record::Input { component, port, .. } => {
                Record::Input { component, port, value: self.new.borrow() }
            }
            other => other,
        }
    }
}

/// A sink that keeps every record in memory: for tests and for looking back within a step.
#[derive(Clone, Debug, Default)]
pub struct Kept(pub Vec<OwnedRecord>);

impl Sink for Kept {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        self.0.push(OwnedRecord::new(at, record));
    }
}

#[cfg(test)]
mod tests {
    use afp_core::trace::{Author, TraceEntryId};

    use super::*;

    #[test]
    fn values_survive() {
        let record = Record::Committed {
            author: Author::Outside,
            entry: TraceEntryId(3),
            old: ValueRef::Unset,
            new: ValueRef::Text("wall"),
        };
        let owned = OwnedRecord::new(Instant::from_nanos(7), &record);
        assert_eq!(owned.get(), record);
        assert!(size_of::<OwnedRecord>() <= 256, "{} bytes", size_of::<OwnedRecord>());
    }
}
