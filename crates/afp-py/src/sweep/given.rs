//! What a sweep is asked for, as Python gives it.

use afp::load::PlanNames;
use afp_core::trace::{Names, TraceEntryId};
use afp_run::options::{self, Failure, Press};
use afp_sweep::{Axis, Point, Seeds, Sweep, WorldChoice, columns};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::simulation::{control, fault};
use crate::value::unfit;
use crate::world::World;

/// A world: none for that of the plan, the name that `--world` takes, or one that was made here.
#[derive(FromPyObject)]
pub enum GivenWorld {
    #[pyo3(transparent)]
    Named(Option<String>),
    #[pyo3(transparent)]
    Made(Py<World>),
}

/// Seeds.
#[derive(FromPyObject)]
pub enum GivenSeeds {
    /// From the first up to, and without, the second.
    Range(u64, u64),
    /// These.
    #[pyo3(transparent)]
    List(Vec<u64>),
}

/// The values of something that is varied.
#[derive(FromPyObject)]
pub enum GivenValues {
    /// As the command line takes them: `20cm..60cm:5cm`.
    #[pyo3(transparent)]
    Text(String),
    /// One by one, each with its unit: an empty one for a bare number, which is in SI units, none for a text.
    #[pyo3(transparent)]
    List(Vec<(String, Option<String>)>),
}

/// The worlds of a sweep; those that were made are told apart by their names, and by numbers where they have the same.
pub fn rooms(worlds: Vec<GivenWorld>) -> Vec<WorldChoice> {
    let mut rooms: Vec<WorldChoice> = Vec::with_capacity(worlds.len());
    for world in worlds {
        let room = match world {
            GivenWorld::Named(None) => WorldChoice::OfPlan,
            GivenWorld::Named(Some(name)) => WorldChoice::Named(name),
            GivenWorld::Made(world) => {
                let loaded = world.get().loaded.clone();
                let name = loaded.world.name().to_owned();
                WorldChoice::Made(another(&rooms, name), loaded)
            }
        };
        rooms.push(room);
    }
    rooms
}

/// A name that none of the rooms has.
fn another(rooms: &[WorldChoice], name: String) -> String {
    let known = |name: &str| rooms.iter().any(|room| room.name() == Some(name));
    if !known(&name) {
        return name;
    }
    let others = (2_usize..).map(|number| format!("{name} {number}"));
    others.into_iter().find(|other| !known(other)).unwrap_or(name)
}

/// What is pressed in each run: `escape@1s`.
///
/// # Errors
/// It is not written so, or the robot has no such control.
pub fn presses(texts: &[String]) -> PyResult<Vec<Press>> {
    let read = |text: &String| {
        let press = options::press(text).map_err(|why| wrong("press", text, &why))?;
        control(Some(&press.control)).map(|_| press)
    };
    texts.iter().map(read).collect()
}

/// What fails in each run: `ultrasonic.frozen@5s..7s`.
///
/// # Errors
/// It is not written so, or the robot has no such fault.
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

/// Refuses figures that are called as a column of every sweep is.
///
/// # Errors
/// There is such a column.
pub fn check_metrics(names: &[String], sweep: &Sweep) -> PyResult<()> {
    let columns = columns(sweep, &[]);
    let Some(name) = names.iter().find(|name| columns.iter().any(|it| it.name == **name)) else {
        return Ok(());
    };
    let text = format!("there is a column '{name}' of every run; choose another name");
    Err(PyValueError::new_err(text))
}

impl GivenSeeds {
    /// The seeds.
    ///
    /// # Errors
    /// One that is there twice.
    pub fn seeds(self) -> PyResult<Seeds> {
        match self {
            GivenSeeds::Range(first, end) => Ok(Seeds::new(first..end)),
            GivenSeeds::List(seeds) => Seeds::list(seeds).map_err(PyValueError::new_err),
        }
    }
}

impl GivenValues {
    /// What is varied.
    ///
    /// # Errors
    /// A text that is no range, a quantity of another unit than the entry's.
    pub fn axis(self, names: &PlanNames, name: String) -> PyResult<Axis> {
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
        Ok(Axis { name, points: values.into_iter().map(point).collect::<PyResult<_>>()? })
    }
}
