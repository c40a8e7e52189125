//! The expected readings of the range sensor in a world, computed once for all its simulations.

use super::{Obstacle, World};
use crate::chassis::Chassis;
use afp_carbot::devices::Beam;
use afp_navigation::maps::{EchoField, Map};
use std::fmt;
use std::sync::{Arc, OnceLock};

impl World {
    /// The robot's map: the obstacles on the map that are high enough for its range sensor.
    pub fn audible_map(&self, robot: &Chassis) -> Map {
        map(&self.obstacles, robot)
    }
}

/// Computed on first use and shared by copies of a world. It depends only on the obstacles.
#[derive(Clone, Default)]
pub(crate) struct Audible(Arc<OnceLock<EchoField>>);

impl Audible {
    /// The expected readings of the Carbot's sensor, with this beam and chassis, among these
    /// obstacles.
    pub(crate) fn field(&self, obstacles: &[Obstacle], robot: &Chassis, beam: &Beam) -> EchoField {
        let map = map(obstacles, robot);
        let made = |map| EchoField::new(map, beam);
        let known = self.0.get_or_init(|| made(map.clone()));
        // A changed copy of a world has other obstacles.
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

fn map(obstacles: &[Obstacle], robot: &Chassis) -> Map {
    let heard = obstacles.iter().filter(|it| it.mapped && robot.hears(it.height));
    Map::new(heard.map(|it| it.outline.corners()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::chassis::Measures;
    use crate::devices::sonar;

    #[test]
    fn copies_share_the_field_until_their_obstacles_differ() {
        let world = World::random(3);
        let of = |world: &World| {
            world.audible.field(
                &world.obstacles,
                &Chassis::CARBOT,
                &sonar::beam(Measures::CARBOT.sonar),
            )
        };
        let (one, other) = (of(&world), of(&world.clone()));
        assert!(one.shares_with(&other));
        let mut emptier = world.clone();
        emptier.obstacles.truncate(1);
        assert!(!one.shares_with(&of(&emptier)));
        assert_eq!(*of(&emptier).map(), emptier.audible_map(&Chassis::CARBOT));
    }

    #[test]
    fn a_map_has_the_obstacles_that_the_robots_own_sensor_detects() {
        let world = World::random(3);
        let of = |ranging_height| world.audible_map(&Chassis { ranging_height, ..Chassis::CARBOT });
        assert_ne!(of(0.1), of(2.0));
        assert_eq!(of(100.0), Map::new([]));
    }
}
