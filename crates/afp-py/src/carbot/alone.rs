//! `Carbot`: the simulated robot without a plan, driven step by step from Python.

use std::sync::{Mutex, MutexGuard, TryLockError};

use afp_carbot::devices::Navigator;
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Environment, Instant};
use afp_sim::{HALF_LENGTH, HALF_WIDTH, Simulation, World as Room};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::errors::error;
use crate::link::link;
use crate::pause::{Halt, Pause};
use crate::value::{measured, no_pickle, seed_of};
use crate::world::World;

/// The interval of repeated commands, well within the robot's dead-man time.
const AGAIN: Duration = Duration::from_millis(100);

/// The simulated robot in its world, without a plan.
#[pyclass(module = "afp", frozen)]
pub struct Carbot {
    sim: Mutex<Simulation>,
    obstacles: Vec<String>,
}

#[pymethods]
impl Carbot {
    #[new]
    #[pyo3(signature = (world, seed=None), text_signature = "(world, seed=0)")]
    fn new(world: &World, seed: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let seed = seed.map_or(Ok(0), seed_of)?;
        let other = || error("the world is for another robot");
        let room = world.loaded.world.as_any().downcast_ref::<Room>().ok_or_else(other)?;
        let sim = Simulation::new(room, seed).map_err(|why| error(why.message))?;
        let obstacles = room.obstacles.iter().map(|obstacle| obstacle.name.clone()).collect();
        Ok(Carbot { sim: Mutex::new(sim), obstacles })
    }

    /// Half of the robot's length, in metres.
    #[classattr]
    fn half_length() -> f64 {
        HALF_LENGTH
    }

    /// Half of the robot's width, in metres.
    #[classattr]
    fn half_width() -> f64 {
        HALF_WIDTH
    }

    /// Drive at a speed (m/s) and a turn rate (rad/s, to the left) for some seconds; Ctrl-C
    /// interrupts it.
    fn drive(
        &self,
        py: Python<'_>,
        speed: &Bound<'_, PyAny>,
        turn: &Bound<'_, PyAny>,
        time: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let (speed, turn) = (measured("speed", speed, "m/s")?, measured("turn", turn, "rad/s")?);
        let time = measured("time", time, "s")?;
        let good = speed.is_finite() && turn.is_finite() && time.is_finite() && time >= 0.0;
        if !good {
            return Err(PyValueError::new_err(
                "speed, turn and time must be finite, time not negative",
            ));
        }
        let mut sim = self.lock()?;
        let sim = &mut *sim;
        py.detach(|| drive(sim, speed, turn, Duration::from_secs_f64(time)))
    }

    /// Stop the wheels.
    fn stop(&self) -> PyResult<()> {
        let mut sim = self.lock()?;
        let now = sim.now();
        sim.stop(now);
        Ok(())
    }

    /// The time in seconds.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.lock()?.now().as_secs_f64())
    }

    /// The robot's true pose: x and y in metres, heading in radians.
    #[getter]
    fn pose(&self) -> PyResult<(f64, f64, f64)> {
        let pose = self.lock()?.truth().pose();
        Ok((pose.x, pose.y, pose.heading))
    }

    /// The robot's contacts in order of time; repeated contacts count separately.
    #[getter]
    fn touched(&self) -> PyResult<Vec<String>> {
        let sim = self.lock()?;
        let truth = sim.truth();
        let names =
            truth.collisions().iter().map(|collision| self.obstacles.get(collision.obstacle));
        Ok(names.map(|name| name.cloned().unwrap_or_default()).collect())
    }

    /// The value of a sensor; see `Robot`.
    fn sense<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let sensed = link().sense(&*self.lock()?, name, true)?;
        sensed.into_bound(py)
    }

    fn __repr__(&self) -> PyResult<String> {
        let (time, (x, y, _)) = (self.time()?, self.pose()?);
        Ok(format!("<Carbot at ({x:.2}, {y:.2}) m, {time:.3} s>"))
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(no_pickle("Carbot", "make it again from its world and seed"))
    }
}

impl Carbot {
    fn lock(&self) -> PyResult<MutexGuard<'_, Simulation>> {
        match self.sim.try_lock() {
            Ok(sim) => Ok(sim),
            Err(TryLockError::WouldBlock) => {
                Err(PyRuntimeError::new_err("another thread drives this robot"))
            }
            Err(TryLockError::Poisoned(_)) => Err(PyRuntimeError::new_err(
                "the simulation broke in an earlier call; make a new one",
            )),
        }
    }
}

fn drive(sim: &mut Simulation, speed: f64, turn: f64, time: Duration) -> PyResult<()> {
    let mut pause = Pause::of_signals();
    let end: Instant = sim.now() + time;
    while sim.now() < end {
        let now = sim.now();
        Navigator::drive(sim, Speed::from_si(speed), AngularSpeed::from_si(turn), now);
        sim.advance_to(end.min(now + AGAIN));
        if let Some(Halt::Raised(why)) = pause.look() {
            return Err(why);
        }
    }
    Ok(())
}
