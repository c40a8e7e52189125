//! Reward terms with weights, computed from ground truth.

use afp_core::Instant;
use afp_sim::{Pose, Simulation, World};

/// The names of the terms, in order.
pub const TERMS: [&str; 6] = ["ahead", "crash", "wall", "nearer", "reached", "time"];
const CRASH: usize = 1;
const WALL: usize = 2;
const NEARER: usize = 3;
const REACHED: usize = 4;

/// The error for a term without a target.
pub const NOTHING_TO_REACH: &str =
    "there is nothing to reach: set reach=\"goal\" or reach=\"light\"";

/// The distance that the robot should keep to the wall at its right, in metres.
const KEEP: f64 = 0.3;
/// The distance at which a goal is reached, in metres.
const AT_GOAL: f64 = 0.3;
/// The distance at which an infrared source is reached, in metres; it includes the robot's length.
const AT_LIGHT: f64 = 0.8;
/// The distance of a random goal from the start, in metres.
const APART: f64 = 1.0;

/// The kind of target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The first source of infrared light.
    Light,
    /// A point.
    Goal,
}

impl Kind {
    /// Finds a kind by name.
    pub fn named(name: &str) -> Option<Kind> {
        match name {
            "light" => Some(Kind::Light),
            "goal" => Some(Kind::Goal),
            _ => None,
        }
    }
}

/// A target.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its position in metres.
    pub at: [f64; 2],
    within: f64,
}

impl Target {
    /// Finds the target of a world: the given goal, or a random one from the seed.
    ///
    /// # Errors
    /// The world has none.
    pub fn of(
        world: &World,
        kind: Kind,
        goal: Option<[f64; 2]>,
        seed: u64,
    ) -> Result<Target, String> {
        match kind {
            Kind::Light => {
                let none = || format!("'{}' has no infrared source", world.name);
                let light = world.lights.first().ok_or_else(none)?;
                Ok(Target { at: light.position, within: AT_LIGHT })
            }
            Kind::Goal => {
                let made_up = || world.free_pose(seed, APART).map(|pose| [pose.x, pose.y]);
                let none = || format!("'{}' has no free place for a goal; give one", world.name);
                let at = goal.or_else(made_up).ok_or_else(none)?;
                Ok(Target { at, within: AT_GOAL })
            }
        }
    }

    fn far(self, pose: Pose) -> f64 {
        libm::hypot(pose.x - self.at[0], pose.y - self.at[1])
    }
}

/// The weights of the terms, and the terms that end an episode.
#[derive(Clone, Debug)]
pub struct Weights {
    weights: [f64; TERMS.len()],
    ends: [bool; TERMS.len()],
}

impl Weights {
    /// Makes weights from names; other terms have the weight 0.
    ///
    /// # Errors
    /// An unknown term, an infinite weight, a term that cannot end an episode, or a term that needs
    /// a target.
    pub fn new(
        weights: &[(String, f64)],
        ends: &[String],
        can_reach: bool,
    ) -> Result<Weights, String> {
        let term = |name: &str| {
            let known = TERMS.iter().position(|term| *term == name);
            known.ok_or_else(|| format!("no term '{name}'; there are: {}", TERMS.join(", ")))
        };
        let mut made = Weights { weights: [0.0; TERMS.len()], ends: [false; TERMS.len()] };
        for (name, weight) in weights {
            if !weight.is_finite() {
                return Err(format!("'{name}' weighs {weight}; give a finite number"));
            }
            let term = term(name)?;
            if (term == NEARER || term == REACHED) && *weight != 0.0 && !can_reach {
                return Err(format!("'{name}' is rewarded and {NOTHING_TO_REACH}"));
            }
            made.weights[term] = *weight;
        }
        for name in ends {
            let term = term(name)?;
            if term != CRASH && term != REACHED {
                return Err(format!("'{name}' ends no episode; 'crash' and 'reached' may"));
            }
            if term == REACHED && !can_reach {
                return Err(format!("'{name}' ends the episode and {NOTHING_TO_REACH}"));
            }
            made.ends[term] = true;
        }
        Ok(made)
    }

    /// Computes the reward, and whether the terms end the episode.
    pub fn weigh(&self, terms: &[f64; TERMS.len()]) -> (f64, bool) {
        let each = terms.iter().zip(&self.weights);
        // A term without a weight adds nothing, so the sum never becomes a negative zero.
        let reward = each.filter(|(_, weight)| **weight != 0.0).map(|(term, weight)| term * weight);
        let ended = terms.iter().zip(&self.ends).any(|(term, ends)| *ends && *term > 0.0);
        (reward.sum(), ended)
    }

    fn wants_wall(&self) -> bool {
        self.weights[WALL] != 0.0
    }
}

/// A judge's memory between looks.
#[derive(Clone, Debug)]
pub struct Score {
    target: Option<Target>,
    wants_wall: bool,
    at: Instant,
    pose: Pose,
    hits: usize,
    far: f64,
    reached: bool,
}

impl Score {
    /// Starts at this instant.
    pub fn new(sim: &Simulation, target: Option<Target>, weights: &Weights) -> Score {
        let pose = sim.truth().pose();
        Score {
            target,
            wants_wall: weights.wants_wall(),
            at: sim.now(),
            pose,
            hits: sim.truth().collisions().len(),
            far: target.map_or(0.0, |target| target.far(pose)),
            reached: false,
        }
    }

    /// Returns the terms since the last look.
    pub fn look(&mut self, sim: &Simulation) -> [f64; TERMS.len()] {
        let truth = sim.truth();
        let (pose, hits) = (truth.pose(), truth.collisions().len());
        let (sin, cos) = libm::sincos(self.pose.heading);
        let ahead = (pose.x - self.pose.x) * cos + (pose.y - self.pose.y) * sin;
        let near = match self.wants_wall {
            true => truth.right_side_gap().map_or(0.0, |gap| 1.0 - (gap - KEEP).abs() / KEEP),
            false => 0.0,
        };
        let crash = f64::from(u8::from(hits > self.hits));
        let time = sim.now().since(self.at).as_secs_f64();
        let (nearer, reached) = self.approach(pose);
        (self.at, self.pose, self.hits) = (sim.now(), pose, hits);
        [ahead, crash, ahead * near.max(0.0), nearer, reached, time]
    }

    /// The decrease of the target's distance, and whether it was reached for the first time.
    fn approach(&mut self, pose: Pose) -> (f64, f64) {
        let Some(target) = self.target else { return (0.0, 0.0) };
        let far = target.far(pose);
        let nearer = self.far - far;
        let reached = !self.reached && far <= target.within;
        self.far = far;
        self.reached |= reached;
        (nearer, f64::from(u8::from(reached)))
    }
}
