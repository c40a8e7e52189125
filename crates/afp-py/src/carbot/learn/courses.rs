//! `Courses`: episodes that advance together on all cores, with the interpreter released.

use std::sync::{Arc, LockResult, Mutex, MutexGuard, TryLockError};

use afp_sim::{Pose, Simulation};
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray2, PyReadonlyArrayDyn, ToPyArray};
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::batch::{Batch, Place, Round, Task};
use super::course::{Brief, Course, SPEED, STEP, Start, TURN};
use super::judge::kind;
use super::moment::Moment;
use super::part::{Part, RANGE};
use super::pool;
use super::score::{NOTHING_TO_REACH, Weights};
use super::start::{GivenStart, start};
use crate::errors::error;
use crate::link::link;
use crate::sensed::table;
use crate::value::no_pickle;

/// The result of a step: observations, rewards, terminated and truncated episodes.
type Stepped<'py> = (
    Bound<'py, PyArray2<f32>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
);
/// The result for a single episode, with ground truth.
type SteppedAlone<'py> = (Bound<'py, PyArray1<f32>>, f64, bool, bool, Bound<'py, PyDict>);

/// Episodes that advance together.
#[pyclass(module = "afp", frozen)]
pub struct Courses {
    batch: Arc<Batch>,
    /// Locked during any use.
    use_of: Mutex<()>,
}

#[pymethods]
impl Courses {
    /// Make episodes of a task: their number, observation, range-sensor bearings, whether actions
    /// point the sensor, reward weights, terms that end an episode, target and number of steps.
    #[new]
    fn new(
        count: usize,
        observe: Vec<String>,
        fan: (Vec<f64>, bool),
        reward: Vec<(String, f64)>,
        ends: Vec<String>,
        reach: Option<&str>,
        steps: u64,
    ) -> PyResult<Courses> {
        let parts = observe.iter().map(|name| Part::named(name)).collect::<Result<_, _>>();
        let parts: Vec<Part> = parts.map_err(PyValueError::new_err)?;
        let (fan, points) = fan;
        let fan = if parts.contains(&Part::Fan) { fan } else { Vec::new() };
        if fan.iter().any(|bearing| !bearing.is_finite()) {
            return Err(PyValueError::new_err("the bearings of the fan must be finite numbers"));
        }
        if points && parts.contains(&Part::Fan) {
            let text = "an action cannot point the range sensor while the fan is observed; remove one of them";
            return Err(PyValueError::new_err(text));
        }
        let target = reach.map(kind).transpose()?;
        if target.is_none() && parts.contains(&Part::Target) {
            let text = format!("'target' is observed and {NOTHING_TO_REACH}");
            return Err(PyValueError::new_err(text));
        }
        let weights = Weights::new(&reward, &ends, target.is_some());
        let weights = weights.map_err(PyValueError::new_err)?;
        let brief = Brief { parts, fan, points, weights, target, steps };
        Ok(Courses { batch: Arc::new(Batch::new(brief, count)), use_of: Mutex::new(()) })
    }

    /// The speed of a full action, in metres per second.
    #[classattr]
    fn speed() -> f64 {
        SPEED
    }

    /// The turn rate of a full action, in radians per second.
    #[classattr]
    fn turn() -> f64 {
        TURN
    }

    /// The observed distance if the range sensor has no echo, in metres.
    #[classattr]
    fn range() -> f64 {
        RANGE
    }

    /// The duration of an action, in seconds.
    #[classattr]
    fn step_time() -> f64 {
        STEP.as_secs_f64()
    }

    /// Minimum and maximum of each observed number.
    #[getter]
    fn bounds<'py>(
        &self,
        py: Python<'py>,
    ) -> (Bound<'py, PyArray1<f32>>, Bound<'py, PyArray1<f32>>) {
        let (low, high): (Vec<_>, Vec<_>) = self.batch.bounds.iter().copied().unzip();
        (low.into_pyarray(py), high.into_pyarray(py))
    }

    /// The length of an action.
    #[getter]
    fn commands(&self) -> usize {
        self.batch.brief.commands()
    }

    /// Start some of the episodes again and return all observations.
    fn reset<'py>(
        &self,
        py: Python<'py>,
        starts: Vec<(usize, GivenStart<'py>)>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let _use = self.take()?;
        self.prepare(starts)?;
        self.round(py, Task::Begin)?;
        Ok(self.seen()?.into_pyarray(py))
    }

    /// Make a step with an action in each episode; the named ones start again instead.
    fn step<'py>(
        &self,
        py: Python<'py>,
        actions: PyReadonlyArray2<'py, f64>,
        again: Vec<(usize, GivenStart<'py>)>,
    ) -> PyResult<Stepped<'py>> {
        let _use = self.take()?;
        let shape = [self.batch.len(), self.batch.brief.commands()];
        let actions = actions.as_array();
        if actions.shape() != shape {
            let text = format!("actions must be {} x {} numbers", shape[0], shape[1]);
            return Err(PyValueError::new_err(text));
        }
        finite(actions.iter())?;
        self.prepare(again)?;
        for (place, action) in self.batch.places().zip(actions.rows()) {
            let mut place = unbroken(place)?;
            if place.course.is_none() && place.start.is_none() {
                return Err(PyRuntimeError::new_err("call reset() before step()"));
            }
            place.act(action.iter());
        }
        self.round(py, Task::Step)?;
        let (mut rewards, mut ended, mut late) = (Vec::new(), Vec::new(), Vec::new());
        for place in self.batch.places() {
            let outcome = unbroken(place)?.outcome;
            rewards.push(outcome.reward);
            ended.push(outcome.ended);
            late.push(outcome.late);
        }
        let seen = self.seen()?.into_pyarray(py);
        Ok((seen, rewards.into_pyarray(py), ended.into_pyarray(py), late.into_pyarray(py)))
    }

    /// Make a step in the first episode and return its result and `info`. For a single robot,
    /// arrays would take most of the time.
    fn step_first<'py>(
        &self,
        py: Python<'py>,
        action: PyReadonlyArrayDyn<'py, f64>,
    ) -> PyResult<SteppedAlone<'py>> {
        let _use = self.take()?;
        let commands = self.batch.brief.commands();
        let action = action.as_array();
        if action.len() != commands {
            return Err(PyValueError::new_err(format!("an action must be {commands} numbers")));
        }
        finite(action.iter())?;
        let mut place = self.place_at(0)?;
        begun(&place)?;
        place.act(action.iter());
        let batch = &*self.batch;
        let place = &mut *place;
        py.detach(|| batch.work(place, Task::Step));
        let info = PyDict::new(py);
        let (time, pose, hits) = truth(&begun(place)?.sim);
        info.set_item(intern!(py, "time"), time)?;
        info.set_item(intern!(py, "pose"), pose.to_pyarray(py))?;
        info.set_item(intern!(py, "collisions"), hits)?;
        let outcome = place.outcome;
        Ok((place.seen.to_pyarray(py), outcome.reward, outcome.ended, outcome.late, info))
    }

    /// The time, the robot's true pose and the number of collisions, for all episodes.
    #[expect(clippy::type_complexity, reason = "three arrays")]
    fn info<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i64>>)>
    {
        let _use = self.take()?;
        let (mut times, mut poses, mut hits) = (Vec::new(), Vec::new(), Vec::new());
        for place in self.batch.places() {
            let (time, pose, hit) = truth(&begun(&*unbroken(place)?)?.sim);
            times.push(time);
            poses.push(pose);
            hits.push(hit);
        }
        Ok((times.into_pyarray(py), table(py, &poses)?, hits.into_pyarray(py)))
    }

    /// The world of an episode, and its target.
    fn place(&self, index: usize) -> PyResult<(String, Option<(f64, f64)>)> {
        let _use = self.take()?;
        let place = self.place_at(index)?;
        let course = begun(&place)?;
        let target = course.target.map(|target| (target.at[0], target.at[1]));
        Ok((course.world.name.clone(), target))
    }

    /// The moving obstacles of an episode: their indices and current corners.
    fn moving<'py>(
        &self,
        py: Python<'py>,
        index: usize,
    ) -> PyResult<Vec<(usize, Bound<'py, PyArray2<f64>>)>> {
        let _use = self.take()?;
        let place = self.place_at(index)?;
        let sim = &begun(&place)?.sim;
        let moving =
            sim.movers().map(|obstacle| Ok((obstacle, table(py, &sim.outline(obstacle))?)));
        moving.collect()
    }

    /// The value of a sensor in an episode.
    fn sense<'py>(&self, py: Python<'py>, index: usize, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let _use = self.take()?;
        let place = self.place_at(index)?;
        let course = begun(&place)?;
        link().sense(&course.sim, name, true)?.into_bound(py)
    }

    /// Copy all episodes at this moment.
    fn save(&self) -> PyResult<Moment> {
        let _use = self.take()?;
        Moment::of(&self.batch)
    }

    /// Go back, or forwards, to a moment of episodes of the same task, and return all observations.
    fn restore<'py>(
        &self,
        py: Python<'py>,
        moment: &Moment,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let _use = self.take()?;
        moment.restore(&self.batch)?;
        Ok(self.seen()?.into_pyarray(py))
    }

    /// Copy all episodes for `copy.deepcopy`; the copies continue independently.
    fn __deepcopy__(&self, _memo: &Bound<'_, PyAny>) -> PyResult<Courses> {
        let _use = self.take()?;
        let batch = self.batch.empty_copy();
        Moment::of(&self.batch)?.restore(&batch)?;
        Ok(Courses { batch: Arc::new(batch), use_of: Mutex::new(()) })
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(no_pickle("running episode", "make the environment again"))
    }
}

impl Courses {
    fn take(&self) -> PyResult<MutexGuard<'_, ()>> {
        self.use_of.try_lock().map_err(|why| match why {
            TryLockError::WouldBlock => {
                PyRuntimeError::new_err("another thread runs these episodes")
            }
            TryLockError::Poisoned(_) => broke(),
        })
    }

    fn place_at(&self, index: usize) -> PyResult<MutexGuard<'_, Place>> {
        let none = || PyIndexError::new_err(format!("there is no episode {index}"));
        unbroken(self.batch.place(index).ok_or_else(none)?)
    }

    /// Sets the starts of episodes, all or none.
    fn prepare(&self, starts: Vec<(usize, GivenStart<'_>)>) -> PyResult<()> {
        let read = |(index, given)| Ok((index, start(given)?));
        let starts: Vec<(usize, Start)> = starts.into_iter().map(read).collect::<PyResult<_>>()?;
        for (index, _) in &starts {
            drop(self.place_at(*index)?);
        }
        for (index, start) in starts {
            self.place_at(index)?.start = Some(start);
        }
        Ok(())
    }

    /// Performs a task on each episode with the interpreter released, and raises the first start
    /// error.
    fn round(&self, py: Python<'_>, task: Task) -> PyResult<()> {
        let round = Arc::new(Round::new(&self.batch, task));
        py.detach(|| pool::run(&round))?;
        let mut first = None;
        for place in self.batch.places() {
            first = first.or(unbroken(place)?.failed.take());
        }
        first.map_or(Ok(()), |why| Err(error(why)))
    }

    /// All observations, a row each.
    fn seen(&self) -> PyResult<Array2<f32>> {
        let mut seen = Array2::zeros((self.batch.len(), self.batch.bounds.len()));
        for (place, mut row) in self.batch.places().zip(seen.rows_mut()) {
            row.iter_mut().zip(&unbroken(place)?.seen).for_each(|(to, value)| *to = *value);
        }
        Ok(seen)
    }
}

impl Place {
    /// Sets the action of the next step.
    fn act<'a>(&mut self, action: impl Iterator<Item = &'a f64>) {
        self.action.clear();
        self.action.extend(action);
    }
}

/// The time, the robot's true pose, and the number of collisions.
fn truth(sim: &Simulation) -> (f64, [f64; 3], i64) {
    let truth = sim.truth();
    let Pose { x, y, heading } = truth.pose();
    let hits = i64::try_from(truth.collisions().len()).unwrap_or(i64::MAX);
    (sim.now().as_secs_f64(), [x, y, heading], hits)
}

fn finite<'a>(mut numbers: impl Iterator<Item = &'a f64>) -> PyResult<()> {
    match numbers.all(|share| share.is_finite()) {
        true => Ok(()),
        false => Err(PyValueError::new_err("an action must be finite numbers")),
    }
}

/// A place, unless its episode panicked.
fn unbroken(place: LockResult<MutexGuard<'_, Place>>) -> PyResult<MutexGuard<'_, Place>> {
    place.map_err(|_| broke())
}

fn broke() -> PyErr {
    PyRuntimeError::new_err("an episode broke in an earlier call; make them again")
}

fn begun(place: &Place) -> PyResult<&Course> {
    place.course.as_ref().ok_or_else(|| PyRuntimeError::new_err("call reset() first"))
}
