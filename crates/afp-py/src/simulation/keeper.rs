//! What is kept of a run.

use afp_session::{Applied, NamedRecord, Observer, OwnedRecord};
use pyo3::PyErr;

use crate::errors::error;

/// Keeps what happens.
#[derive(Default)]
pub struct Keeper {
    /// What happened, without polls that saw nothing.
    pub records: Vec<OwnedRecord>,
    /// What was asked for and cannot be done.
    pub refused: Option<PyErr>,
}

impl Observer for Keeper {
    fn on_record(&mut self, named: &NamedRecord<'_>) {
        self.records.push(OwnedRecord::new(named.at, named.record));
    }

    fn on_request(&mut self, applied: &Applied<'_>) {
        if let Some(why) = applied.refused {
            self.refused = Some(error(format!("at {} s: {why}", applied.now.as_secs_f64())));
        }
    }
}
