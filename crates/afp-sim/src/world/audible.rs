//! What the range sensor should hear on the map of a world: computed once for all simulations of that world.

use super::{Obstacle, World};
use crate::devices::sonar;
use afp_maps::{EchoField, Map};
use std::fmt;
use std::sync::{Arc, OnceLock};

impl World {
    /// The map that the robot has: what it shows and what is high enough for the range sensor.
    pub fn audible_map(&self) -> Map {
        map(&self.obstacles)
    }
}

/// Made for the first who asks; copies of a world share it. It says nothing of a world that its obstacles do not say.
#[derive(Clone, Default)]
pub(crate) struct Audible(Arc<OnceLock<EchoField>>);

impl Audible {
    /// What should be heard where these obstacles stand.
    pub(crate) fn field(&self, obstacles: &[Obstacle]) -> EchoField {
        let map = map(obstacles);
        let made = |map| EchoField::new(map, &sonar::beam());
        let known = self.0.get_or_init(|| made(map.clone()));
        // Whoever changed a copy of a world has obstacles of another one.
        if *known.map() == map { known.clone() } else { made(map) }
    }
}

impl fmt::Debug for Audible {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Audible")
    }
}

impl PartialEq for Audible {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

fn map(obstacles: &[Obstacle]) -> Map {
    let heard = obstacles.iter().filter(|it| it.mapped && it.height >= sonar::HEIGHT);
    Map::new(heard.map(|it| it.outline.corners()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_share_what_is_heard_until_their_obstacles_differ() {
        let world = World::random(3);
        let of = |world: &World| world.audible.field(&world.obstacles);
        let (one, other) = (of(&world), of(&world.clone()));
        assert!(one.shares_with(&other));
        let mut emptier = world.clone();
        emptier.obstacles.truncate(1);
        assert!(!one.shares_with(&of(&emptier)));
        assert_eq!(*of(&emptier).map(), emptier.audible_map());
    }
}
