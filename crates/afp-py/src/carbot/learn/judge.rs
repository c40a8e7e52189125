//! `Judge`: the reward of an episode for a run of a plan.

use std::any::Any;
use std::sync::{Mutex, PoisonError};

use afp_sim::{Simulation, World as Room};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::score::{Kind, Score, Target, Weights};
use crate::errors::error;
use crate::simulation::Runner;
use crate::world::World;

/// Observes a running plan and computes the reward since the last look.
#[pyclass(module = "afp", frozen)]
pub struct Judge {
    score: Mutex<Score>,
    weights: Weights,
}

#[pymethods]
impl Judge {
    /// Start judging at this instant of a run.
    #[new]
    fn new(
        runner: &Runner,
        reward: Vec<(String, f64)>,
        ends: Vec<String>,
        reach: Option<(&str, (f64, f64))>,
        world: &World,
    ) -> PyResult<Judge> {
        let weights = Weights::new(&reward, &ends, reach.is_some());
        let weights = weights.map_err(PyValueError::new_err)?;
        let goal = |(kind, (x, y))| {
            Target::of(room(world)?, self::kind(kind)?, Some([x, y]), 0).map_err(error)
        };
        let target = reach.map(goal).transpose()?;
        let score =
            runner.with_robot(|robot| Some(Score::new(robot_of(robot)?, target, &weights)))?;
        let score = score.ok_or_else(|| error("the robot is of another kind"))?;
        Ok(Judge { score: Mutex::new(score), weights })
    }

    /// The reward since the last look, and whether an episode would be over.
    fn look(&self, runner: &Runner) -> PyResult<(f64, bool)> {
        let mut score = self.score.lock().unwrap_or_else(PoisonError::into_inner);
        let terms = runner.with_robot(|robot| Some(score.look(robot_of(robot)?)))?;
        let terms = terms.ok_or_else(|| error("the robot is of another kind"))?;
        Ok(self.weights.weigh(&terms))
    }
}

fn robot_of(robot: &dyn Any) -> Option<&Simulation> {
    robot.downcast_ref()
}

/// The Carbot's room of a world.
pub fn room(world: &World) -> PyResult<&Room> {
    let room = world.loaded.world.as_any().downcast_ref::<Room>();
    room.ok_or_else(|| error("the world is for another robot"))
}

/// The kind of target with that name.
pub fn kind(name: &str) -> PyResult<Kind> {
    let unknown = || PyValueError::new_err(format!("no target '{name}'; there are: light, goal"));
    Kind::named(name).ok_or_else(unknown)
}

/// The target of a world: the first infrared source (`light`), or a random `goal` from a seed.
#[pyfunction]
pub fn target(world: &World, reach: &str, seed: u64) -> PyResult<(f64, f64)> {
    let [x, y] = Target::of(room(world)?, kind(reach)?, None, seed).map_err(error)?.at;
    Ok((x, y))
}
