//! `Courses`: some episodes side by side, stepped on all cores with the interpreter free for others.

use std::sync::{Arc, Mutex, MutexGuard, TryLockError};

use afp_carbot::table::Carbot as Table;
use afp_core::devices::Devices;
use afp_core::{Duration, Instant};
use afp_sim::Pose;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use rayon::prelude::*;

use super::course::{Brief, Course, Outcome, Start};
use super::judge::{kind, room};
use super::part::Part;
use super::pool::pool;
use super::score::Weights;
use crate::errors::error;
use crate::link::link;
use crate::simulation::{duration, fault, instant};
use crate::value::no_pickle;
use crate::world::{World, table};

/// What breaks: device, fault, delay, share, from when on, for how long.
type GivenFault = (String, String, Option<f64>, Option<f64>, Option<f64>, Option<f64>);
/// How an episode begins: the world, the seeds of room and noise, the robot's pose, the goal, what breaks.
type GivenStart<'py> = (
    Option<Bound<'py, World>>,
    u64,
    u64,
    Option<(f64, f64, f64)>,
    Option<(f64, f64)>,
    Vec<GivenFault>,
);
/// What came of a step: observations, rewards, which episodes have ended, which are too late.
type Stepped<'py> = (
    Bound<'py, PyArray2<f32>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<bool>>,
);

/// Some episodes side by side.
#[pyclass(module = "afp", frozen)]
pub struct Courses {
    brief: Arc<Brief>,
    bounds: Vec<(f32, f32)>,
    places: Mutex<Vec<Place>>,
}

/// Where an episode is, and what is to be done with it.
#[derive(Default)]
struct Place {
    course: Option<Course>,
    start: Option<Start>,
    outcome: Outcome,
    failed: Option<String>,
}

#[pymethods]
impl Courses {
    /// So many episodes of a task: what is observed, where the range sensor looks in turns, whether actions point it, what
    /// is worth how much, what ends an episode, what there is to reach, after how many steps it is over.
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
            let text = "an action cannot point the range sensor while the fan is observed; leave one of them out";
            return Err(PyValueError::new_err(text));
        }
        let target = reach.map(kind).transpose()?;
        if target.is_none() && parts.contains(&Part::Target) {
            return Err(PyValueError::new_err(
                "'target' is observed and there is none: say reach=\"goal\" or reach=\"light\"",
            ));
        }
        let weights = Weights::new(&reward, &ends).map_err(PyValueError::new_err)?;
        let brief = Brief { parts, fan, points, weights, target, steps };
        let places = (0..count).map(|_| Place::default()).collect();
        let bounds = brief.bounds();
        Ok(Courses { brief: Arc::new(brief), bounds, places: Mutex::new(places) })
    }

    /// The least and the greatest of what is observed.
    #[getter]
    fn bounds<'py>(
        &self,
        py: Python<'py>,
    ) -> (Bound<'py, PyArray1<f32>>, Bound<'py, PyArray1<f32>>) {
        let (low, high): (Vec<_>, Vec<_>) = self.bounds.iter().copied().unzip();
        (low.into_pyarray(py), high.into_pyarray(py))
    }

    /// How many numbers an action has.
    #[getter]
    fn commands(&self) -> usize {
        self.brief.commands()
    }

    /// Lets some of the episodes begin anew; what is observed in all of them.
    fn reset<'py>(
        &self,
        py: Python<'py>,
        starts: Vec<(usize, GivenStart<'py>)>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let mut held = self.lock()?;
        let places = &mut held[..];
        begin(places, starts)?;
        let seen = py.detach(|| self.each(places, |place| place.begin(&self.brief)))?;
        failed(places)?;
        seen.into_pyarray(py).reshape([places.len(), self.bounds.len()])
    }

    /// Makes a step in all of them, an action each; those that are named begin anew instead.
    fn step<'py>(
        &self,
        py: Python<'py>,
        actions: PyReadonlyArray2<'py, f64>,
        again: Vec<(usize, GivenStart<'py>)>,
    ) -> PyResult<Stepped<'py>> {
        let mut held = self.lock()?;
        let places = &mut held[..];
        let shape = [places.len(), self.brief.commands()];
        let actions = actions.as_array();
        if actions.shape() != shape {
            let text = format!("actions must be {} x {} numbers", shape[0], shape[1]);
            return Err(PyValueError::new_err(text));
        }
        if actions.iter().any(|share| !share.is_finite()) {
            return Err(PyValueError::new_err("an action must be finite numbers"));
        }
        let actions: Vec<f64> = actions.iter().copied().collect();
        begin(places, again)?;
        let idle = places.iter().position(|place| place.course.is_none() && place.start.is_none());
        if idle.is_some() {
            return Err(PyRuntimeError::new_err("call reset() before step()"));
        }
        let width = self.brief.commands();
        let seen = py.detach(|| {
            self.each_with(places, &actions, width, |place, action| match place.start {
                Some(_) => place.begin(&self.brief),
                None => place.step(action),
            })
        })?;
        failed(places)?;
        let outcomes = places.iter().map(|place| place.outcome);
        let rewards: Vec<f64> = outcomes.clone().map(|outcome| outcome.reward).collect();
        let ended: Vec<bool> = outcomes.clone().map(|outcome| outcome.ended).collect();
        let late: Vec<bool> = outcomes.map(|outcome| outcome.late).collect();
        let seen = seen.into_pyarray(py).reshape([places.len(), self.bounds.len()])?;
        Ok((seen, rewards.into_pyarray(py), ended.into_pyarray(py), late.into_pyarray(py)))
    }

    /// Of all of them the time, the robot's true pose, and how often it ran into something.
    #[expect(clippy::type_complexity, reason = "three arrays")]
    fn info<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<i64>>)>
    {
        let places = self.lock()?;
        let (mut times, mut poses, mut hits) = (Vec::new(), Vec::new(), Vec::new());
        for place in &*places {
            let sim = &begun(place)?.sim;
            let (truth, time) = (sim.truth(), sim.now().as_secs_f64());
            let Pose { x, y, heading } = truth.pose();
            times.push(time);
            poses.push([x, y, heading]);
            hits.push(i64::try_from(truth.collisions().len()).unwrap_or(i64::MAX));
        }
        Ok((times.into_pyarray(py), table(py, &poses)?, hits.into_pyarray(py)))
    }

    /// Where an episode takes place, and where there is something to reach.
    fn place(&self, index: usize) -> PyResult<(String, Option<(f64, f64)>)> {
        let places = self.lock()?;
        let course = begun(places.get(index).ok_or_else(|| none(index))?)?;
        let target = course.target.map(|target| (target.at[0], target.at[1]));
        Ok((course.world.name.clone(), target))
    }

    /// What moves in one of them: the numbers of the obstacles, and their corners as they are now.
    fn moving<'py>(
        &self,
        py: Python<'py>,
        index: usize,
    ) -> PyResult<Vec<(usize, Bound<'py, PyArray2<f64>>)>> {
        let places = self.lock()?;
        let sim = &begun(places.get(index).ok_or_else(|| none(index))?)?.sim;
        let moving =
            sim.movers().map(|obstacle| Ok((obstacle, table(py, &sim.outline(obstacle))?)));
        moving.collect()
    }

    /// What a sensor of one of them says.
    fn sense<'py>(&self, py: Python<'py>, index: usize, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let places = self.lock()?;
        let course = begun(places.get(index).ok_or_else(|| none(index))?)?;
        link().sense(&course.sim, name, true)?.into_bound(py)
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(no_pickle("running episode", "make the environment anew"))
    }
}

impl Courses {
    fn lock(&self) -> PyResult<MutexGuard<'_, Vec<Place>>> {
        self.places.try_lock().map_err(|why| match why {
            TryLockError::WouldBlock => {
                PyRuntimeError::new_err("another thread steps these episodes")
            }
            TryLockError::Poisoned(_) => {
                PyRuntimeError::new_err("an episode broke in an earlier call; make them anew")
            }
        })
    }

    /// Does something with each episode; what is observed then, one row each.
    fn each(&self, places: &mut [Place], work: impl Fn(&mut Place) + Sync) -> PyResult<Vec<f32>> {
        let none = vec![0.0; places.len()];
        self.each_with(places, &none, 1, |place, _| work(place))
    }

    /// Does something with each episode and its action.
    fn each_with(
        &self,
        places: &mut [Place],
        actions: &[f64],
        width: usize,
        work: impl Fn(&mut Place, &[f64]) + Sync,
    ) -> PyResult<Vec<f32>> {
        let size = self.bounds.len().max(1);
        let mut seen = vec![0.0; places.len() * size];
        let one = |((place, action), seen): ((&mut Place, &[f64]), &mut [f32])| {
            work(place, action);
            if let Some(course) = &place.course {
                course.observe(&self.bounds, seen);
            }
        };
        if places.len() < 2 {
            places.iter_mut().zip(actions.chunks(width)).zip(seen.chunks_mut(size)).for_each(one);
        } else {
            let pool = pool().map_err(|why| PyRuntimeError::new_err(why.to_string()))?;
            let each = places.par_iter_mut().with_max_len(1);
            let each = each.zip(actions.par_chunks(width)).zip(seen.par_chunks_mut(size));
            pool.install(|| each.for_each(one));
        }
        seen.truncate(places.len() * self.bounds.len());
        Ok(seen)
    }
}

impl Place {
    /// Begins the episode that is about to.
    fn begin(&mut self, brief: &Arc<Brief>) {
        let Some(start) = self.start.take() else { return };
        self.outcome = Outcome::default();
        match Course::new(brief, start) {
            Ok(course) => self.course = Some(course),
            Err(why) => (self.course, self.failed) = (None, Some(why)),
        }
    }

    fn step(&mut self, action: &[f64]) {
        if let Some(course) = &mut self.course {
            self.outcome = course.step(action);
        }
    }
}

/// Notes which episodes are about to begin, all or none of them.
fn begin(places: &mut [Place], starts: Vec<(usize, GivenStart<'_>)>) -> PyResult<()> {
    let read = |(index, given)| Ok((index, start(given)?));
    let starts: Vec<(usize, Start)> = starts.into_iter().map(read).collect::<PyResult<_>>()?;
    if let Some((index, _)) = starts.iter().find(|(index, _)| *index >= places.len()) {
        return Err(none(*index));
    }
    for (index, start) in starts {
        if let Some(place) = places.get_mut(index) {
            place.start = Some(start);
        }
    }
    Ok(())
}

/// What an episode begins with.
fn start((world, seed, noise, pose, goal, faults): GivenStart<'_>) -> PyResult<Start> {
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

/// What breaks, when, for how long.
fn broken(
    (device, kind, delay, share, at, lasting): GivenFault,
) -> PyResult<(afp_carbot::table::Fault, Instant, Duration)> {
    let (id, amount) = fault(&device, &kind, delay, share)?;
    let fault = Table::fault(id, amount);
    let fault =
        fault.ok_or_else(|| PyValueError::new_err(format!("'{device}' has no '{kind}'")))?;
    let from = at.map_or(Ok(Instant::ZERO), instant)?;
    Ok((fault, from, lasting.map_or(Ok(Duration::MAX), duration)?))
}

/// Raises what the first episode that could not begin lacks.
fn failed(places: &mut [Place]) -> PyResult<()> {
    let mut why = places.iter_mut().filter_map(|place| place.failed.take());
    let first = why.next();
    why.for_each(drop);
    first.map_or(Ok(()), |why| Err(error(why)))
}

fn begun(place: &Place) -> PyResult<&Course> {
    place.course.as_ref().ok_or_else(|| PyRuntimeError::new_err("call reset() first"))
}

fn none(index: usize) -> PyErr {
    PyIndexError::new_err(format!("there is no episode {index}"))
}
