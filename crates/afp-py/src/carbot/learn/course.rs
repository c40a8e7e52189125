//! One robot in one episode.

use std::sync::Arc;

use afp_carbot::devices::{Navigator, Rotator};
use afp_carbot::table::Fault;
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_core::{Duration, Instant};
use afp_sim::{Pose, Simulation, World};

use super::part::{Part, Senses, seen_from};
use super::score::{Kind, Score, Target, Weights};

/// The speed of a full action, metres a second.
pub const SPEED: f64 = 0.5;
/// The turn rate of a full action, radians a second.
pub const TURN: f64 = 2.0;
/// Where a full action points the range sensor, radians.
pub const BEARING: f64 = core::f64::consts::FRAC_PI_2;
/// An action lasts so many pieces of this. Between two pieces the range sensor has sent a ping.
const PIECE: Duration = Duration::from_millis(50);
const PIECES: u64 = 2;
/// How long an action lasts.
pub const STEP: Duration = Duration::from_nanos(PIECES * PIECE.as_nanos());

/// What all episodes of a task have in common.
#[derive(Debug)]
pub struct Brief {
    /// What is observed.
    pub parts: Vec<Part>,
    /// Where the range sensor looks in turns; empty where it looks ahead, or where actions say.
    pub fan: Vec<f64>,
    /// Whether actions point the range sensor.
    pub points: bool,
    /// What it is worth.
    pub weights: Weights,
    /// What there is to reach.
    pub target: Option<Kind>,
    /// An episode is over after so many steps.
    pub steps: u64,
}

impl Brief {
    /// The bounds of what is observed.
    pub fn bounds(&self) -> Vec<(f32, f32)> {
        self.parts.iter().flat_map(|part| part.bounds(self.fan.len())).collect()
    }

    /// How many numbers an action has.
    pub fn commands(&self) -> usize {
        if self.points { 3 } else { 2 }
    }
}

/// Where and how an episode begins.
#[derive(Clone, Debug)]
pub struct Start {
    /// The room; one that `room` makes up without it.
    pub world: Option<Arc<World>>,
    /// The seed of the room.
    pub room: u64,
    /// The seed of everything else.
    pub noise: u64,
    /// Where the robot starts, unless it is where the world says.
    pub pose: Option<Pose>,
    /// Where to go, unless it is made up.
    pub goal: Option<[f64; 2]>,
    /// What breaks, from when on, for how long.
    pub faults: Vec<(Fault, Instant, Duration)>,
}

/// What came of a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Outcome {
    pub reward: f64,
    pub ended: bool,
    pub late: bool,
}

/// An episode.
pub struct Course {
    brief: Arc<Brief>,
    pub sim: Simulation,
    pub world: Arc<World>,
    /// What there is to reach.
    pub target: Option<Target>,
    score: Score,
    senses: Senses,
    steps: u64,
}

impl Course {
    /// An episode at its start.
    ///
    /// # Errors
    /// The robot has no room there, or the world lacks what the task needs.
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

    /// Does what an action says, shares of what is full, each from -1 to 1.
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

    /// What the policy sees.
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
