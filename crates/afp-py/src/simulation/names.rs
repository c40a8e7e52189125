//! `Names`: the names of a plan at its run, for pictures of its results.

use std::sync::Arc;

use afp::load::PlanNames;
use afp_core::Instant;
use afp_log::svg::{SoFar, draw_run, follow};
use afp_session::{Outlines, Pose2};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::event::Event;
use super::time::instant;
use crate::attach::in_background;
use crate::world::World;

/// The names of a plan at its run.
#[pyclass(module = "afp", frozen)]
pub struct Names(pub(super) PlanNames);

#[pymethods]
impl Names {
    /// The path of a run over its world, as SVG: rows of time, x, y, heading, the events, and the
    /// last outlines of moving things.
    #[expect(clippy::too_many_arguments, reason = "a part of a result")]
    fn draw(
        &self,
        py: Python<'_>,
        plan: String,
        world: &World,
        seed: u64,
        time: f64,
        path: PyReadonlyArray2<'_, f64>,
        events: Vec<Bound<'_, Event>>,
        things: Outlines,
    ) -> PyResult<String> {
        let path = path.as_array();
        if path.ncols() != 4 {
            return Err(PyValueError::new_err("a path has rows of time, x, y, heading"));
        }
        let pose = |[x, y, heading]: [f64; 3]| Pose2 { x, y, heading };
        let poses = path
            .rows()
            .into_iter()
            .map(|row| Ok::<_, PyErr>((instant(row[0])?, pose([row[1], row[2], row[3]]))));
        let poses: Vec<(Instant, Pose2)> = poses.collect::<PyResult<_>>()?;
        let events = events.iter().map(|event| event.get().told());
        let (path, marks) = follow(events, &poses, &self.0);
        let (names, time) = (self.0.clone(), instant(time)?);
        let (world, seed) = (Arc::clone(&world.loaded.world), seed.to_string());
        in_background(py, move || {
            let (plan, world, seed) = (&*plan, &*world, &*seed);
            let (path, marks, things) = (&path[..], &marks[..], &things);
            draw_run(&SoFar { plan, world, seed, time, path, marks, things }, &names)
        })
    }
}
