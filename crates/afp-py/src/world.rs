//! `World`: a room with its robot's start.

use std::ffi::CString;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use afp_run::world::{LoadedWorld, find};
use afp_session::Pose2;
use numpy::PyArray2;
use pyo3::exceptions::{PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{error, run_error};
use crate::link::{fits, link};
use crate::sensed::table;
use crate::value::{Pickled, seed_of};

/// The pickled form of a world: its text, its path, and a start that overrides the text's.
type Facts<'a> = (&'a str, Option<&'a Path>, Option<(f64, f64, f64)>);

/// A room: the robot's start, and obstacles, floor, lights and moving things around it.
#[pyclass(module = "afp", frozen)]
pub struct World {
    pub loaded: LoadedWorld,
    /// The file that it was read from, even if it was changed later.
    pub read: Option<PathBuf>,
}

#[pymethods]
impl World {
    /// Read a world file, or a map_server map (`.yaml`).
    #[staticmethod]
    fn load(path: PathBuf) -> PyResult<World> {
        let loaded = find(Some(&path), &path, link().kind()).map_err(|why| run_error(&why))?;
        Ok(World::new(loaded))
    }

    /// A random room from a seed, like `--world random:7`.
    #[staticmethod]
    fn random(seed: &Bound<'_, PyAny>) -> PyResult<World> {
        let seed = seed_of(seed)?;
        let name = PathBuf::from(format!("random:{seed}"));
        let loaded = find(Some(&name), &name, link().kind()).map_err(|why| run_error(&why))?;
        Ok(World::new(loaded))
    }

    /// Read a world from the text of a world file.
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

    /// The default world of a plan file, as in `afpc run`.
    #[staticmethod]
    fn of_plan(path: PathBuf) -> PyResult<World> {
        fits(&path)?;
        let loaded = find(None, &path, link().kind()).map_err(|why| run_error(&why))?;
        Ok(World::new(loaded))
    }

    /// A copy with changed values of its file: `world.changed({"robot.charge": 0.5})`. Quantities are
    /// numbers in the unit of the file's key, or strings with a unit.
    fn changed(&self, py: Python<'_>, values: Bound<'_, PyDict>) -> PyResult<World> {
        let spelled = py.import("afp.units")?.getattr("spelled")?;
        let text = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
            Ok((key.extract()?, spelled.call1((value,))?.extract()?))
        };
        let values = values.iter().map(text).collect::<PyResult<_>>()?;
        self._changed(py, values, None)
    }

    /// A copy with changed values of its file, `robot.charge`, and with a different start of the
    /// robot.
    fn _changed(
        &self,
        py: Python<'_>,
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
            let usual = self.loaded.world.drawing().start;
            if let Some(why) = loaded.warning(usual) {
                let text = CString::new(format!("start is ({x}, {y}): {why}"))?;
                // Three calls up is the program that makes the simulation.
                PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 3)?;
            }
        }
        // It differs from the file now.
        loaded.path = None;
        Ok(World { loaded, read: self.read.clone() })
    }

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

    /// The robot's start: x and y in metres, heading in radians.
    #[getter]
    fn start(&self) -> (f64, f64, f64) {
        let start = self.loaded.world.drawing().start;
        (start.x, start.y, start.heading)
    }

    /// The names of its obstacles.
    #[getter]
    fn obstacles(&self) -> Vec<String> {
        self.loaded.world.drawing().things.into_iter().map(|thing| thing.name).collect()
    }

    /// The corners of all obstacles in metres, each an array of n x 2.
    fn outlines<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyArray2<f64>>>> {
        let things = self.loaded.world.drawing().things;
        things.iter().map(|thing| table(py, &thing.outline)).collect()
    }

    /// Whether their texts are equal, and their robots' starts.
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

    /// The picture for a notebook.
    fn _repr_svg_(&self) -> String {
        afp_log::svg::draw_world(&*self.loaded.world)
    }

    /// Restore from a pickle.
    #[staticmethod]
    fn _again(
        py: Python<'_>,
        text: String,
        path: Option<PathBuf>,
        start: Option<(f64, f64, f64)>,
    ) -> PyResult<World> {
        let mut world = World::parse(text)?._changed(py, Vec::new(), start)?;
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
    /// Wraps a loaded world.
    pub fn new(loaded: LoadedWorld) -> World {
        let read = loaded.path.clone();
        World { loaded, read }
    }
}
