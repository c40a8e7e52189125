//! `read_log`: the contents of an MCAP log.

use std::collections::BTreeMap;
use std::path::PathBuf;

use afp_core::Instant;
use afp_core::devices::SignalType;
use afp_log::robot::Pose2;
use afp_log::{Heard, LogData};
use afp_run::RunError;
use afp_session::Datum;
use numpy::IntoPyArray;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};

use crate::attach::in_background;
use crate::errors::{error, log_error, run_error};
use crate::link::{devices, link};
use crate::sensed::{Sensed, table};
use crate::simulation::{Event, value};
use crate::world::World;

/// Read a log into a dictionary, up to its first defect.
#[pyfunction]
pub fn read_log<'py>(py: Python<'py>, path: PathBuf) -> PyResult<Bound<'py, PyDict>> {
    let log = py.detach(|| afp_log::read(&path)).map_err(|why| log_error(&why))?;
    let dict = PyDict::new(py);
    dict.set_item("facts", log.facts)?;
    dict.set_item("attachments", log.attachments)?;
    let poses: Vec<_> = log
        .poses
        .iter()
        .map(|(at, Pose2 { x, y, heading })| [at.as_secs_f64(), *x, *y, *heading])
        .collect();
    dict.set_item("path", table(py, &poses)?)?;
    let channels = PyDict::new(py);
    for (topic, info) in &log.topics {
        channels.set_item(topic, (&info.schema, info.messages))?;
    }
    dict.set_item("channels", channels)?;
    let entries = PyList::empty(py);
    for configuration in &log.configurations {
        let values = PyDict::new(py);
        for (name, held) in &configuration.entries {
            values.set_item(name, value(py, Some(held))?)?;
        }
        entries.append((configuration.at.as_secs_f64(), values))?;
    }
    dict.set_item("entries", entries)?;
    let events: Vec<_> = log.events.into_iter().map(Event::logged).collect();
    dict.set_item("events", events)?;
    dict.set_item("signals", signals(py, log.samples, &log.rangings)?)?;
    let frames = log.images.iter().map(|(at, file)| (at.as_secs_f64(), PyBytes::new(py, file)));
    dict.set_item("frames", frames.collect::<Vec<_>>())?;
    dict.set_item("cut_short", log.cut_short)?;
    Ok(dict)
}

/// The times and values of each signal, by device and name. A range sensor has distances in metres,
/// infinite without an echo.
fn signals<'py>(
    py: Python<'py>,
    samples: BTreeMap<String, Vec<(Instant, Datum)>>,
    rangings: &[Heard],
) -> PyResult<Bound<'py, PyDict>> {
    let mut all: BTreeMap<String, Vec<(f64, Py<PyAny>)>> = BTreeMap::new();
    for (topic, samples) in samples {
        let values =
            samples.iter().map(|(at, datum)| Ok((at.as_secs_f64(), value(py, Some(datum))?)));
        all.insert(topic.replace('/', "."), values.collect::<PyResult<_>>()?);
    }
    for Heard { device, at, range, .. } in rangings {
        let far = range.unwrap_or(f64::INFINITY).into_py_any(py)?;
        all.entry(of_range(device)).or_default().push((at.as_secs_f64(), far));
    }
    let dict = PyDict::new(py);
    for (name, values) in all {
        let (times, values): (Vec<f64>, Vec<Py<PyAny>>) = values.into_iter().unzip();
        dict.set_item(name, (times.into_pyarray(py), values))?;
    }
    Ok(dict)
}

/// The name of a device's signal of type `range`.
fn of_range(device: &str) -> String {
    let rows = devices().iter().filter(|row| row.name == device).flat_map(|row| row.signals);
    let named =
        rows.into_iter().find(|row| row.ty == SignalType::Range).map_or("range", |row| row.name);
    format!("{device}.{named}")
}

/// The pixels of a camera's picture from a log, as rows x columns x 3; `None` for another file.
#[pyfunction]
pub fn pixels<'py>(py: Python<'py>, file: &[u8]) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Some((width, height, rgb)) = afp_log::pixels(file) else { return Ok(None) };
    let size = |pixels| usize::try_from(pixels).unwrap_or(usize::MAX);
    let (rows, columns) = (size(height), size(width));
    Sensed::Picture { rows, columns, rgb }.into_bound(py).map(Some)
}

/// Paths and texts of a plan's files, the plan's name, the world, the seed.
type Made = (Vec<(String, String)>, String, World, u64);

/// The inputs of a logged run.
#[pyfunction]
pub fn read_recipe(py: Python<'_>, path: PathBuf) -> PyResult<Made> {
    let log = py.detach(|| afp_log::read(&path)).map_err(|why| log_error(&why))?;
    let recipe = log.recipe();
    if recipe.texts.is_empty() || !log.has_world() {
        return Err(error(format!("'{}' has no description of its run", path.display())));
    }
    let texts = recipe.texts.into_iter().map(|file| (file.name, file.text)).collect();
    let mut world = World::parse(recipe.world.text)?;
    if let Some(start) = recipe.start {
        world.loaded = world.loaded.started_at(start).map_err(|why| error(why.message))?;
    }
    Ok((texts, recipe.plan, world, recipe.seed))
}

/// A picture of a log as SVG: `path`, `sonar` or `film`.
#[pyfunction]
pub fn draw_log(py: Python<'_>, path: PathBuf, what: &str) -> PyResult<String> {
    let draw = match what {
        "path" => |log: &LogData| afp_run::draw_log(log, link().kind()),
        "sonar" => |log: &LogData| afp_run::draw_sonar(log, link().kind()),
        "film" => afp_run::draw_film,
        other => return Err(PyValueError::new_err(format!("no picture '{other}' of a log"))),
    };
    let drawn = in_background(py, move || {
        let log = afp_log::read(&path).map_err(RunError::from)?;
        draw(&log)
    })?;
    drawn.map_err(|why| run_error(&why))
}
