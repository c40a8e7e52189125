//! One robot in one episode.

use std::sync::Arc;

use afp_carbot::devices::{Navigator, Rotator};
use afp_carbot::table::Fault;
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_core::{Duration, Instant};
use afp_session::Robot;
use afp_sim::{Pose, Simulation, World};

use super::part::{Part, Senses, seen_from};
use super::score::{Kind, Score, Target, Weights};

/// The speed of a full action, in metres per second.
pub const SPEED: f64 = 0.5;
/// The turn rate of a full action, in radians per second.
pub const TURN: f64 = 2.0;
/// The bearing of the range sensor at a full action, in radians.
pub const BEARING: f64 = core::f64::consts::FRAC_PI_2;
/// The unit of an action's duration. In each unit the range sensor sends a ping.
const PIECE: Duration = Duration::from_millis(50);
const PIECES: u64 = 2;
/// The duration of an action.
pub const STEP: Duration = Duration::from_nanos(PIECES * PIECE.as_nanos());

/// The settings of all episodes of a task.
#[derive(Debug)]
pub struct Brief {
    /// The parts of an observation.
    pub parts: Vec<Part>,
    /// The bearings that the range sensor cycles through; empty if it looks ahead or follows
    /// actions.
    pub fan: Vec<f64>,
    /// Whether actions point the range sensor.
    pub points: bool,
    /// The weights of the reward.
    pub weights: Weights,
    pub target: Option<Kind>,
    /// The number of steps in an episode.
    pub steps: u64,
}

impl Brief {
    /// The bounds of each observed number.
    pub fn bounds(&self) -> Vec<(f32, f32)> {
        self.parts.iter().flat_map(|part| part.bounds(self.fan.len())).collect()
    }

    /// The length of an action.
    pub fn commands(&self) -> usize {
        if self.points { 3 } else { 2 }
    }
}

/// The start of an episode.
#[derive(Clone, Debug)]
pub struct Start {
    /// The room; by default a random one from `room`.
    pub world: Option<Arc<World>>,
    /// The seed of the room.
    pub room: u64,
    /// The seed of everything else.
    pub noise: u64,
    /// The robot's start, if it differs from the world's.
    pub pose: Option<Pose>,
    /// The goal; random by default.
    pub goal: Option<[f64; 2]>,
    pub faults: Vec<(Fault, Instant, Duration)>,
}

/// The result of a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Outcome {
    pub reward: f64,
    pub ended: bool,
    pub late: bool,
}

/// An episode.
#[derive(Clone)]
pub struct Course {
    brief: Arc<Brief>,
    pub sim: Simulation,
    pub world: Arc<World>,
    pub target: Option<Target>,
    score: Score,
    senses: Senses,
    steps: u64,
}

impl Course {
    /// An episode at its start.
    ///
    /// # Errors
    /// The robot does not fit at its start, or the world has no target of that kind.
    pub fn new(brief: &Arc<Brief>, start: Start) -> Result<Course, String> {
        let world = start.world.unwrap_or_else(|| Arc::new(World::random(start.room)));
        let world = match start.pose {
            Some(pose) => {
                let world = afp_session::World::started_at(&*world, pose);
                Arc::new(world.map_err(|why| why.message)?)
            }
            None => world,
        };
        let of = |kind| Target::of(&world, kind, start.goal, start.noise);
        let target = brief.target.map(of).transpose()?;
        let mut sim = Simulation::new(&world, start.noise).map_err(|why| why.message)?;
        for (fault, from, during) in start.faults {
            sim.inject(fault, from, during);
        }
        let score = Score::new(&sim, target, &brief.weights);
        let senses = Senses::new(&mut sim, &brief.fan);
        Ok(Course { brief: Arc::clone(brief), sim, world, target, score, senses, steps: 0 })
    }

    /// A copy that continues independently.
    pub fn keyframe(&self) -> Option<Course> {
        Some(Course { sim: Robot::keyframe(&self.sim)?, ..self.clone() })
    }

    /// Performs an action, given as shares from -1 to 1 of full values.
    pub fn step(&mut self, action: &[f64]) -> Outcome {
        let share = |index: usize| action.get(index).copied().unwrap_or(0.0).clamp(-1.0, 1.0);
        let speed = Speed::from_si(share(0) * SPEED);
        let turn = AngularSpeed::from_si(share(1) * TURN);
        if self.brief.points {
            let now = self.sim.now();
            self.sim.point(Angle::from_si(share(2) * BEARING), now);
        }
        for _ in 0..PIECES {
            let now = self.sim.now();
            Navigator::drive(&mut self.sim, speed, turn, now);
            self.sim.advance_to(now + PIECE);
            self.senses.update(&mut self.sim);
        }
        self.senses.look(&self.sim);
        self.steps += 1;
        let (reward, ended) = self.brief.weights.weigh(&self.score.look(&self.sim));
        Outcome { reward, ended, late: self.steps >= self.brief.steps }
    }

    /// Writes the policy's observation.
    pub fn observe(&self, bounds: &[(f32, f32)], into: &mut [f32]) {
        let target = self.target.map(|target| seen_from(self.world.start, target.at));
        let mut seen = Vec::with_capacity(into.len());
        for part in &self.brief.parts {
            self.senses.write(*part, target, &mut seen);
        }
        for ((to, value), (low, high)) in into.iter_mut().zip(seen).zip(bounds) {
            *to = (value as f32).clamp(*low, *high);
        }
    }
}
