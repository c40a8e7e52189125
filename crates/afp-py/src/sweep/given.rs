//! The arguments of a sweep in Python's form.

use afp::load::PlanNames;
use afp_core::trace::{Names, TraceEntryId};
use afp_run::options::{self, Failure, Press};
use afp_sweep::{Axis, Point, Seeds, Sweep, WorldChoice, columns, varies_stimuli};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::simulation::{control, fault, unknown_entry};
use crate::value::unfit;
use crate::world::World;

/// A world: `None` for the plan's, a name as in `--world`, or a world object.
#[derive(FromPyObject)]
pub enum GivenWorld {
    #[pyo3(transparent)]
    Named(Option<String>),
    #[pyo3(transparent)]
    Made(Py<World>),
}

#[derive(FromPyObject)]
pub enum GivenSeeds {
    /// From the first up to, but without, the second.
    Range(u64, u64),
    /// A list.
    #[pyo3(transparent)]
    List(Vec<u64>),
}

/// The values of an axis.
#[derive(FromPyObject)]
pub enum GivenValues {
    /// In command-line syntax: `20cm..60cm:5cm`.
    #[pyo3(transparent)]
    Text(String),
    /// One by one, each with its unit: an empty one for a bare number in SI units, `None` for a
    /// string.
    #[pyo3(transparent)]
    List(Vec<(String, Option<String>)>),
}

/// The worlds of a sweep. World objects with the same name get numbers; with one for each seed, the
/// name contains the seed.
pub fn rooms(worlds: Vec<GivenWorld>, by: Option<&Seeds>) -> Vec<WorldChoice> {
    let mut rooms: Vec<WorldChoice> = Vec::with_capacity(worlds.len());
    for (number, world) in (0..).zip(worlds) {
        let room = match world {
            GivenWorld::Named(None) => WorldChoice::OfPlan,
            GivenWorld::Named(Some(name)) => WorldChoice::Named(name),
            GivenWorld::Made(world) => {
                let loaded = world.get().loaded.clone();
                let name = loaded.world.name().to_owned();
                let name = match by {
                    Some(seeds) => format!("{name} of seed {}", seeds.nth(number)),
                    None => another(&rooms, name),
                };
                WorldChoice::Made(name, loaded)
            }
        };
        rooms.push(room);
    }
    rooms
}

/// An unused name.
fn another(rooms: &[WorldChoice], name: String) -> String {
    let known = |name: &str| rooms.iter().any(|room| room.name() == Some(name));
    if !known(&name) {
        return name;
    }
    let others = (2_usize..).map(|number| format!("{name} {number}"));
    others.into_iter().find(|other| !known(other)).unwrap_or(name)
}

/// Presses in each run: `escape@1s`.
///
/// # Errors
/// Invalid syntax, or an unknown control.
pub fn presses(texts: &[String]) -> PyResult<Vec<Press>> {
    let read = |text: &String| {
        let press = options::press(text).map_err(|why| wrong("press", text, &why))?;
        control(Some(&press.control)).map(|_| press)
    };
    texts.iter().map(read).collect()
}

/// Faults in each run: `ultrasonic.frozen@5s..7s`.
///
/// # Errors
/// Invalid syntax, or an unknown fault.
pub fn failures(texts: &[String]) -> PyResult<Vec<Failure>> {
    let read = |text: &String| {
        let failure = options::failure(text).map_err(|why| wrong("fail", text, &why))?;
        fault(&failure.device, &failure.kind, None, None).map(|_| failure)
    };
    texts.iter().map(read).collect()
}

fn wrong(what: &str, text: &str, why: &str) -> PyErr {
    PyValueError::new_err(format!("{what}: '{text}': {why}"))
}

/// Rejects metrics with the name of a fixed column.
///
/// # Errors
/// There is such a column.
pub fn check_metrics(names: &[String], sweep: &Sweep) -> PyResult<()> {
    let columns = columns(sweep, &[]);
    let Some(name) = names.iter().find(|name| columns.iter().any(|it| it.name == **name)) else {
        return Ok(());
    };
    let text = format!("every run has a column '{name}'; choose another name");
    Err(PyValueError::new_err(text))
}

impl GivenSeeds {
    /// The seeds.
    ///
    /// # Errors
    /// A repeated seed.
    pub fn seeds(self) -> PyResult<Seeds> {
        match self {
            GivenSeeds::Range(first, end) => Ok(Seeds::new(first..end)),
            GivenSeeds::List(seeds) => Seeds::list(seeds).map_err(PyValueError::new_err),
        }
    }
}

impl GivenValues {
    /// The axis.
    ///
    /// # Errors
    /// An invalid range, or a quantity with the wrong unit.
    pub fn axis(self, names: &PlanNames, known: &[String], name: String) -> PyResult<Axis> {
        let values = match self {
            GivenValues::Text(range) => {
                let axis = afp_sweep::axis(&format!("{name}={range}"));
                return axis.map_err(PyValueError::new_err);
            }
            GivenValues::List(values) => values,
        };
        let mut ids = (0..names.entries()).map(TraceEntryId);
        let entry = ids.find(|id| names.entry(*id).path == name);
        let about = entry.map(|id| names.entry(id));
        if !known.contains(&name) && !name.starts_with("world.") && !varies_stimuli(&name) {
            return Err(unknown_entry(&name, known));
        }
        let point = |(text, unit): (String, Option<String>)| {
            let text = match (unit, about) {
                (None, _) => text,
                (Some(unit), None) => text + &unit,
                (Some(unit), Some(about)) if unit.is_empty() => text + about.unit,
                (Some(unit), Some(about)) if unit == about.unit => text + &unit,
                (Some(unit), Some(about)) => {
                    return Err(unfit(about, &format!("a quantity in {unit}")));
                }
            };
            Ok(Point { text, si: None })
        };
        let points = values.into_iter().map(point).collect::<PyResult<_>>()?;
        Ok(Axis { name, points, by_seed: false })
    }
}
