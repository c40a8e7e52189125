//! The recorded data of a run.

use afp_core::Instant;
use afp_core::trace::Record;
use afp_session::{Applied, NamedRecord, Observer, OwnedRecord, RunEvent};
use pyo3::PyErr;

use crate::errors::error;

/// Records events.
#[derive(Default)]
pub struct Keeper {
    /// Events, without polls that saw nothing.
    pub happened: Vec<Happened>,
    /// A rejected request.
    pub refused: Option<PyErr>,
}

/// An event.
#[derive(Clone)]
pub enum Happened {
    /// In the plan.
    Record(OwnedRecord),
    /// From outside.
    Request(Box<RunEvent>),
}

impl Keeper {
    /// Events in the plan.
    pub fn records(&self) -> impl DoubleEndedIterator<Item = (Instant, Record<'_>)> {
        self.happened.iter().filter_map(|each| match each {
            Happened::Record(record) => Some((record.at, record.get())),
            Happened::Request(_) => None,
        })
    }
}

impl Observer for Keeper {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        self.happened.push(Happened::Record(OwnedRecord::new(named.at, named.record)));
    }

    fn on_request(&mut self, applied: &Applied<'_>) {
        self.happened.push(Happened::Request(Box::new(applied.event())));
        if let Some(why) = applied.refused {
            self.refused = Some(error(format!("at {} s: {why}", applied.now.as_secs_f64())));
        }
    }
}
