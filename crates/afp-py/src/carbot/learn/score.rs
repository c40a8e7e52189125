//! What driving is worth: terms that a reward weighs, from what only a judge may know.

use afp_core::Instant;
use afp_sim::{Pose, Simulation, World};

/// The names of the terms, in their order.
pub const TERMS: [&str; 6] = ["ahead", "crash", "wall", "nearer", "reached", "time"];
const CRASH: usize = 1;
const WALL: usize = 2;
const NEARER: usize = 3;
const REACHED: usize = 4;

/// What to say where something is asked of a target.
pub const NOTHING_TO_REACH: &str =
    "there is nothing to reach: say reach=\"goal\" or reach=\"light\"";

/// The distance to the wall at its right that the robot should keep, metres.
const KEEP: f64 = 0.3;
/// A goal is reached from so near, metres.
const AT_GOAL: f64 = 0.3;
/// A source of infrared light is reached from so near, metres: the robot's length is part of it.
const AT_LIGHT: f64 = 0.8;
/// A goal that is made up is so far from the start, metres.
const APART: f64 = 1.0;

/// What there is to reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The first source of infrared light.
    Light,
    /// A place.
    Goal,
}

impl Kind {
    /// The kind of that name.
    pub fn named(name: &str) -> Option<Kind> {
        match name {
            "light" => Some(Kind::Light),
            "goal" => Some(Kind::Goal),
            _ => None,
        }
    }
}

/// A place to be reached.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Where it is, metres.
    pub at: [f64; 2],
    within: f64,
}

impl Target {
    /// What is to be reached in a world: a given goal, or one that the seed makes up.
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
                let none = || format!("'{}' has no infrared source to be found", world.name);
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

/// How the terms are weighed, and which of them end an episode.
#[derive(Clone, Debug)]
pub struct Weights {
    weights: [f64; TERMS.len()],
    ends: [bool; TERMS.len()],
}

impl Weights {
    /// Weights by the names of their terms; those that are not named weigh nothing.
    ///
    /// # Errors
    /// No such term; a weight that is not finite; a term that ends nothing; one of what there is to reach where there is
    /// nothing.
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

    /// What the terms come to, and whether they end the episode.
    pub fn weigh(&self, terms: &[f64; TERMS.len()]) -> (f64, bool) {
        let each = terms.iter().zip(&self.weights);
        // What weighs nothing adds no zero, so that no sign of it is seen.
        let reward = each.filter(|(_, weight)| **weight != 0.0).map(|(term, weight)| term * weight);
        let ended = terms.iter().zip(&self.ends).any(|(term, ends)| *ends && *term > 0.0);
        (reward.sum(), ended)
    }

    fn wants_wall(&self) -> bool {
        self.weights[WALL] != 0.0
    }
}

/// What a judge remembers from one look to the next.
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
    /// From this instant on.
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

    /// The terms since the last look.
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

    /// By how much the target is nearer, and whether it was reached for the first time.
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
