//! `read_log`: the contents of an MCAP log.

use std::path::PathBuf;

use afp_log::LogData;
use afp_log::robot::Pose2;
use afp_run::RunError;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::attach::in_background;
use crate::errors::{error, log_error, run_error};
use crate::link::link;
use crate::sensed::table;
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
    dict.set_item("cut_short", log.cut_short)?;
    Ok(dict)
}

/// Paths and texts of a plan's files, the plan's name, the world, the seed.
type Made = (Vec<(String, String)>, String, World, u64);

/// The inputs of a logged run.
#[pyfunction]
pub fn read_recipe(py: Python<'_>, path: PathBuf) -> PyResult<Made> {
    let log = py.detach(|| afp_log::read(&path)).map_err(|why| log_error(&why))?;
    let recipe = log.recipe();
    if recipe.texts.is_empty() || !log.has_world() {
        return Err(error(format!("'{}' does not say which plan ran where", path.display())));
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
