//! One case: a plan, a room, a seed and stimuli.

use std::fmt;

use afp_core::{Duration, Instant};
use afp_sim::World;

use crate::chance::{Chance, Dice};
use crate::plans::{Plan, plans};

/// The length of a case.
const SECONDS: u64 = 30;

/// A plan in a room, with stimuli.
#[derive(Clone, Debug)]
pub struct Case {
    pub plan: &'static Plan,
    /// The room.
    pub world: World,
    /// The seed of the robot's noise.
    pub seed: u64,
    /// The plan's inputs by name, with values in plan syntax.
    pub inputs: Vec<(&'static str, String)>,
    /// The stimuli.
    pub chance: Chance,
    pub until: Instant,
}

impl Case {
    /// The case with a number: room `random:N`, a plan, and random stimuli.
    pub fn random(number: u64) -> Case {
        let plan = &plans()[Dice::new(number, 2).below(plans().len())];
        Case {
            chance: Chance::random(&mut Dice::new(number, 1), SECONDS as f64),
            ..Case::quiet(plan, World::random(number), number)
        }
    }

    /// A plan in a given room, without stimuli.
    pub fn quiet(plan: &'static Plan, world: World, seed: u64) -> Case {
        let until = Instant::ZERO + Duration::from_secs(SECONDS);
        Case { plan, world, seed, inputs: Vec::new(), chance: Chance::default(), until }
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Case { plan, world, seed, chance, .. } = self;
        writeln!(f, "plan {}, world '{}', seed {seed}", plan.name, world.name)?;
        write!(f, "{chance}")
    }
}
