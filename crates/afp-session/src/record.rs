//! Trace records that own their data, small enough for a queue and made without allocation; and
//! sinks that keep them.

use std::sync::Arc;

use afp_core::trace::{ComponentId, NoTrace, Record, RecordOf, Sink, Verdict};
use afp_core::{Instant, Value, ValueRef};

use crate::watch::Pulse;

/// The initial capacity for the records of a step on a real robot.
const ROOM: usize = 2048;

/// A record with its time; its texts are kept in place.
#[derive(Clone, Debug)]
pub struct OwnedRecord {
    /// The time of the step.
    pub at: Instant,
    record: RecordOf<Value>,
}

impl OwnedRecord {
    /// Copies a record.
    pub fn new(at: Instant, record: &Record<'_>) -> Self {
        // Texts of a plan always fit into an entry.
        let owned = |value: &ValueRef<'_>| value.to_value().unwrap_or_default();
        OwnedRecord { at, record: record.map(owned) }
    }

    /// The record with borrowed values.
    pub fn get(&self) -> Record<'_> {
        self.record.map(Value::as_deref)
    }
}

/// A sink that keeps the records of a step until it is over.
pub trait Keep: Sink {
    /// Sets whether polls that found no event are kept.
    fn keep_clear_polls(&mut self, wanted: bool);

    /// Whether nothing is kept.
    fn is_empty(&self) -> bool;

    /// Takes all kept records.
    fn take(&mut self) -> Vec<OwnedRecord>;

    /// Returns the buffer of taken records for reuse.
    fn give_back(&mut self, records: Vec<OwnedRecord>);
}

/// Keeps records in memory; polls that found no event only on request.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    records: Vec<OwnedRecord>,
    clear_polls: bool,
    /// Tells another thread which component is called.
    pulse: Option<Arc<Pulse>>,
}

impl Kept {
    /// Keeps the records of a step without an allocation, unless the step is close to the limit of
    /// transitions.
    pub(crate) fn with_room(pulse: Arc<Pulse>) -> Self {
        Kept { records: Vec::with_capacity(ROOM), pulse: Some(pulse), ..Kept::default() }
    }

    /// Keeps all records.
    pub fn all() -> Self {
        Kept { clear_polls: true, ..Kept::default() }
    }

    /// The kept records.
    pub fn records(&self) -> &[OwnedRecord] {
        &self.records
    }
}

impl Sink for Kept {
    #[inline]
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        if self.clear_polls || !is_clear(record) {
            self.records.push(OwnedRecord::new(at, record));
        }
    }

    #[inline]
    fn calls(&mut self, component: ComponentId) {
        if let Some(pulse) = &self.pulse {
            pulse.calls(component);
        }
    }
}

impl Keep for Kept {
    #[inline]
    fn keep_clear_polls(&mut self, wanted: bool) {
        self.clear_polls = wanted;
    }

    #[inline]
    fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    fn take(&mut self) -> Vec<OwnedRecord> {
        std::mem::take(&mut self.records)
    }

    fn give_back(&mut self, mut records: Vec<OwnedRecord>) {
        records.clear();
        self.records = records;
    }
}

impl Keep for NoTrace {
    #[inline]
    fn keep_clear_polls(&mut self, _: bool) {}

    #[inline]
    fn is_empty(&self) -> bool {
        true
    }

    fn take(&mut self) -> Vec<OwnedRecord> {
        Vec::new()
    }

    fn give_back(&mut self, _: Vec<OwnedRecord>) {}
}

/// Whether a record is a poll that found no event.
#[inline]
pub(crate) fn is_clear(record: &Record<'_>) -> bool {
    matches!(record, Record::Polled { verdict: Verdict::Clear, .. })
}

#[cfg(test)]
mod tests {
    use afp_core::trace::{Author, TraceEntryId};

    use super::*;

    #[test]
    fn values_are_read_back_unchanged() {
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
