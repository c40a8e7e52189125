//! What a sweep is asked for, as Python gives it.

use afp::load::PlanNames;
use afp_core::trace::{Names, TraceEntryId};
use afp_sweep::{Axis, Point, Seeds, WorldChoice};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

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
    /// One by one, and whether each is a bare number, which is in SI units.
    #[pyo3(transparent)]
    List(Vec<(String, bool)>),
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
    /// A text that is no range.
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
        let unit = entry.map_or("", |id| names.entry(id).unit);
        let point = |(text, bare)| Point { text: if bare { text + unit } else { text }, si: None };
        Ok(Axis { name, points: values.into_iter().map(point).collect() })
    }
}
