//! The start of an episode as given by Python.

use std::sync::Arc;

use afp_carbot::table::{Carbot as Table, Fault};
use afp_core::devices::Devices;
use afp_core::{Duration, Instant};
use afp_sim::Pose;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::course::Start;
use super::judge::room;
use crate::simulation::{duration, fault, instant};
use crate::world::World;

/// A fault: device, kind, delay, share, start, duration.
pub type GivenFault = (String, String, Option<f64>, Option<f64>, Option<f64>, Option<f64>);
/// The start of an episode: world, seeds of room and noise, robot's pose, goal, faults.
pub type GivenStart<'py> = (
    Option<Bound<'py, World>>,
    u64,
    u64,
    Option<(f64, f64, f64)>,
    Option<(f64, f64)>,
    Vec<GivenFault>,
);

/// Converts the start of an episode.
///
/// # Errors
/// The world of a different robot, an invalid place, or an unknown fault.
pub fn start((world, seed, noise, pose, goal, faults): GivenStart<'_>) -> PyResult<Start> {
    let world =
        world.map(|world| Ok::<_, PyErr>(Arc::new(room(world.get())?.clone()))).transpose()?;
    let finite = |numbers: &[f64]| match numbers.iter().all(|number| number.is_finite()) {
        true => Ok(()),
        false => Err(PyValueError::new_err("a place must be finite numbers")),
    };
    if let Some((x, y, heading)) = pose {
        finite(&[x, y, heading])?;
    }
    if let Some((x, y)) = goal {
        finite(&[x, y])?;
    }
    Ok(Start {
        world,
        room: seed,
        noise,
        pose: pose.map(|(x, y, heading)| Pose { x, y, heading }),
        goal: goal.map(|(x, y)| [x, y]),
        faults: faults.into_iter().map(broken).collect::<PyResult<_>>()?,
    })
}

/// Converts faults with their times.
fn broken(
    (device, kind, delay, share, at, lasting): GivenFault,
) -> PyResult<(Fault, Instant, Duration)> {
    let (id, amount) = fault(&device, &kind, delay, share)?;
    let fault = Table::fault(id, amount);
    let fault =
        fault.ok_or_else(|| PyValueError::new_err(format!("'{device}' has no '{kind}'")))?;
    let from = at.map_or(Ok(Instant::ZERO), instant)?;
    Ok((fault, from, lasting.map_or(Ok(Duration::MAX), duration)?))
}
