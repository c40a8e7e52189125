//! Runs that are kept until their metrics are computed.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use afp_dsl::Compiled;
use afp_dsl::graph::Graph;
use afp_session::{AnySession, Track};
use afp_sweep::{Drive, Ending, Outcome, Row, Setting, Sweep, Watch};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::callout;
use crate::errors::run_error;
use crate::simulation::{Keeper, Run, Runner};
use crate::world::World;

/// Runs by number, until their metrics are computed.
#[derive(Default)]
pub struct Kept(Mutex<BTreeMap<u64, Run>>);

impl Kept {
    fn lock(&self) -> MutexGuard<'_, BTreeMap<u64, Run>> {
        // Each insertion or removal is atomic.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Keeps finished runs.
pub struct Keeping<'a> {
    pub graph: &'a Graph,
    pub kept: &'a Kept,
}

impl Watch for Keeping<'_> {
    fn run(
        &self,
        row: &Row<'_>,
        mut session: Box<dyn AnySession>,
        drive: Drive<'_>,
    ) -> Option<Outcome> {
        let (mut keeper, mut track) = (Keeper::default(), Track::new(session.devices()));
        let outcome = drive(&mut *session, &mut [&mut keeper, &mut track])?;
        let mut run = Run::new(session, self.graph);
        (run.keeper, run.track) = (keeper, track);
        run.stopped_by = (outcome.ending == Ending::TimeLimit).then_some("until");
        self.kept.lock().insert(row.run, run);
        Some(outcome)
    }
}

/// Computes the metrics of finished runs.
pub struct Judging<'a> {
    pub sweep: &'a Sweep,
    pub setting: &'a Setting<'a>,
    pub compiled: &'a Arc<Compiled>,
    /// The function that computes a run's metrics.
    pub judge: &'a Py<PyAny>,
    /// The names of the metrics.
    pub metrics: &'a [String],
    pub kept: &'a Kept,
}

impl Judging<'_> {
    /// Adds a run's metrics to its outcome; a run that did not start has no values.
    ///
    /// # Errors
    /// The judge's exception, or a duplicate name.
    pub fn judge(&self, py: Python<'_>, outcome: &mut Outcome) -> PyResult<()> {
        let Some(run) = self.kept.lock().remove(&outcome.run) else {
            outcome.figures.extend(self.metrics.iter().map(|name| (name.clone(), None)));
            return Ok(());
        };
        let row = self.sweep.row(outcome.run);
        let loaded = self.setting.world(&row).map_err(|why| run_error(&why))?;
        let runner = Runner::new(run, None, self.compiled);
        let figures = callout::call(self.judge.bind(py), (runner, World::new(loaded), row.seed))?;
        let figures: BTreeMap<String, Option<f64>> = figures.extract()?;
        if let Some(name) = figures.keys().find(|name| outcome.figures.contains_key(*name)) {
            let text = format!("every run has a result '{name}'; choose another name");
            return Err(PyValueError::new_err(text));
        }
        outcome.figures.extend(figures);
        Ok(())
    }
}
