//! The sink of a run: everything to the log, what is worth telling kept for after the step.

use afp_core::trace::{Record, Sink, TraceEntryId, Verdict};
use afp_core::{Instant, Value, ValueRef};
use afp_log::{OwnedRecord, Recorder};

/// Takes the records of a step.
pub struct Tracer {
    /// The log, where there is one.
    pub log: Option<Recorder>,
    /// What happened since it was last read, without polls that saw nothing.
    pub news: Vec<OwnedRecord>,
    /// The records of the start, which the log gets after the initial configuration.
    held: Option<Vec<OwnedRecord>>,
}

impl Tracer {
    /// A run about to start.
    pub fn new(log: Option<Recorder>) -> Self {
        Tracer { log, news: Vec::new(), held: Some(Vec::new()) }
    }

    /// The start is over; `entries` are the values of the plan's own entries after it.
    ///
    /// Commits of the start are undone to get at the configuration that it began with.
    pub fn started(&mut self, at: Instant, entries: impl Iterator<Item = Value>) {
        let held = self.held.take().unwrap_or_default();
        let Some(log) = &mut self.log else { return };
        let mut entries: Vec<Value> = entries.collect();
        for owned in held.iter().rev() {
            if let Record::Committed { entry, old, .. } = owned.get()
                && let Some(value) = entries.get_mut(entry.0 as usize)
            {
                *value = old.to_owned();
            }
        }
        for (id, value) in (0..).zip(&entries) {
            if value.borrow() != ValueRef::Unset {
                log.initial(TraceEntryId(id), value.borrow());
            }
        }
        log.started(at);
        for owned in &held {
            log.record(owned.at, &owned.get());
        }
    }
}

impl Sink for Tracer {
    fn record(&mut self, at: Instant, record: &Record<'_>) {
        match (&mut self.held, &mut self.log) {
            (Some(held), _) => held.push(OwnedRecord::new(at, record)),
            (None, Some(log)) => log.record(at, record),
            (None, None) => {}
        }
        if !matches!(record, Record::Polled { verdict: Verdict::Clear, .. }) {
            self.news.push(OwnedRecord::new(at, record));
        }
    }
}
