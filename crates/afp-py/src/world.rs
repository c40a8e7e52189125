//! `World`: a room with its robot's start.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use afp_run::world::{LoadedWorld, find};
use afp_session::Pose2;
use numpy::PyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::{error, run_error};
use crate::link::{fits, link};
use crate::sensed::table;
use crate::value::{Pickled, seed_of};

/// What a world is pickled as: its text, its path, and where the robot starts instead of where the text says.
type Facts<'a> = (&'a str, Option<&'a Path>, Option<(f64, f64, f64)>);

/// A room: where the robot starts and what stands, lies, shines and moves around it.
#[pyclass(module = "afp", frozen)]
pub struct World {
    pub loaded: LoadedWorld,
    /// The file of which it was read, whatever was changed in it since.
    pub read: Option<PathBuf>,
}

#[pymethods]
impl World {
    /// Reads a world file, or a map of map_server (`.yaml`).
    #[staticmethod]
    fn load(path: PathBuf) -> PyResult<World> {
        let loaded = find(Some(&path), &path, link().kind()).map_err(|why| run_error(&why))?;
        Ok(World::new(loaded))
    }

    /// A room made up from a seed, as `--world random:7` is.
    #[staticmethod]
    fn random(seed: &Bound<'_, PyAny>) -> PyResult<World> {
        let seed = seed_of(seed)?;
        let name = PathBuf::from(format!("random:{seed}"));
        let loaded = find(Some(&name), &name, link().kind()).map_err(|why| run_error(&why))?;
        Ok(World::new(loaded))
    }

    /// Reads a world from the text of its file.
    #[staticmethod]
    pub fn parse(text: String) -> PyResult<World> {
        let world = link().kind().world(&text).map_err(|why| match why.span {
            Some(span) => {
                let (line, column) = afp_excerpt::line_column(&text, span.start);
                error(format!("{line}:{column}: {}", why.message))
            }
            None => error(why.message),
        })?;
        Ok(World::new(LoadedWorld { world, text, path: None, start: None }))
    }

    /// The world that `afpc run` would take for the plan of this file.
    #[staticmethod]
    fn of_plan(path: PathBuf) -> PyResult<World> {
        fits(&path)?;
        let loaded = find(None, &path, link().kind()).map_err(|why| run_error(&why))?;
        Ok(World::new(loaded))
    }

    /// The same with values of its file changed, `robot.charge`, and with another start of the robot.
    fn _changed(
        &self,
        values: Vec<(String, String)>,
        start: Option<(f64, f64, f64)>,
    ) -> PyResult<World> {
        let values: Vec<_> = values.iter().map(|(key, text)| (&**key, &**text)).collect();
        let mut loaded = match values.is_empty() {
            true => self.loaded.clone(),
            false => self.loaded.with(&values, link().kind()).map_err(|why| run_error(&why))?,
        };
        if let Some((x, y, heading)) = start {
            loaded = loaded
                .started_at(Pose2 { x, y, heading })
                .map_err(|why| PyValueError::new_err(format!("start: {why}")))?;
        }
        // It is not that of the file any more.
        loaded.path = None;
        Ok(World { loaded, read: self.read.clone() })
    }

    /// What it is called.
    #[getter]
    fn name(&self) -> &str {
        self.loaded.world.name()
    }

    /// The text of its file.
    #[getter]
    fn text(&self) -> &str {
        &self.loaded.text
    }

    /// Its file, or `random:SEED`.
    #[getter]
    fn path(&self) -> Option<&Path> {
        self.loaded.path.as_deref()
    }

    /// Where the robot starts: x and y in metres, heading in radians.
    #[getter]
    fn start(&self) -> (f64, f64, f64) {
        let start = self.loaded.world.drawing().start;
        (start.x, start.y, start.heading)
    }

    /// The names of what stands in it.
    #[getter]
    fn obstacles(&self) -> Vec<String> {
        self.loaded.world.drawing().things.into_iter().map(|thing| thing.name).collect()
    }

    /// The corners of everything that stands in it, metres, each an array of n x 2.
    fn outlines<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let things = self.loaded.world.drawing().things;
        things.iter().map(|thing| table(py, &thing.outline)).collect()
    }

    /// Whether their files say the same, and the robot starts in the same place.
    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let is_same =
            |other: &World| (other.text(), other.loaded.start) == (self.text(), self.loaded.start);
        other.cast::<World>().is_ok_and(|other| is_same(other.get()))
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.text().hash(&mut hasher);
        hasher.finish()
    }

    fn __repr__(&self) -> String {
        format!("<World '{}', {} obstacles>", self.name(), self.loaded.world.drawing().things.len())
    }

    /// What a notebook shows.
    fn _repr_svg_(&self) -> String {
        afp_log::svg::draw_world(&*self.loaded.world)
    }

    /// As it was pickled.
    #[staticmethod]
    fn _again(
        text: String,
        path: Option<PathBuf>,
        start: Option<(f64, f64, f64)>,
    ) -> PyResult<World> {
        let mut world = World::parse(text)?._changed(Vec::new(), start)?;
        world.loaded.path.clone_from(&path);
        world.read = path;
        Ok(world)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Pickled<'py, Facts<'_>> {
        let start = self.loaded.start.map(|Pose2 { x, y, heading }| (x, y, heading));
        Ok((py.get_type::<World>().getattr("_again")?, (self.text(), self.path(), start)))
    }
}

impl World {
    /// A world as it was loaded.
    pub fn new(loaded: LoadedWorld) -> World {
        let read = loaded.path.clone();
        World { loaded, read }
    }
}
