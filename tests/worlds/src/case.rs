//! One case: a plan, a room, a seed and what happens.

use std::fmt;

use afp_core::{Duration, Instant};
use afp_sim::World;

use crate::chance::{Chance, Dice};
use crate::plans::{Plan, plans};

/// How long a case lasts.
const SECONDS: u64 = 30;

/// What is driven where, and what happens meanwhile.
#[derive(Clone, Debug)]
pub struct Case {
    /// The plan.
    pub plan: &'static Plan,
    /// The room.
    pub world: World,
    /// The seed of the robot's noise.
    pub seed: u64,
    /// What the plan is given: its inputs by name, the values as they would stand in a plan.
    pub inputs: Vec<(&'static str, String)>,
    /// What happens.
    pub chance: Chance,
    /// When the case is over.
    pub until: Instant,
}

impl Case {
    /// The case of a number: room `random:N`, one of the plans, and its own chances.
    pub fn random(number: u64) -> Case {
        let plan = &plans()[Dice::new(number, 2).below(plans().len())];
        Case {
            chance: Chance::random(&mut Dice::new(number, 1), SECONDS as f64),
            ..Case::quiet(plan, World::random(number), number)
        }
    }

    /// A plan in a given room, in which nothing happens.
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
