//! What the range sensor should hear on the map of a world: computed once for all simulations of that world.

use super::{Obstacle, World};
use crate::chassis::Chassis;
use afp_carbot::devices::Beam;
use afp_navigation::maps::{EchoField, Map};
use std::fmt;
use std::sync::{Arc, OnceLock};

impl World {
    /// The map that a robot has: what it shows and what is high enough for the robot's range sensor.
    pub fn audible_map(&self, robot: &Chassis) -> Map {
        map(&self.obstacles, robot)
    }
}

/// Made for the first who asks; copies of a world share it. It says nothing of a world that its obstacles do not say.
#[derive(Clone, Default)]
pub(crate) struct Audible(Arc<OnceLock<EchoField>>);

impl Audible {
    /// What the Carbot's sensor, with this beam, should hear on such a chassis where these obstacles stand.
    pub(crate) fn field(&self, obstacles: &[Obstacle], robot: &Chassis, beam: &Beam) -> EchoField {
        let map = map(obstacles, robot);
        let made = |map| EchoField::new(map, beam);
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

fn map(obstacles: &[Obstacle], robot: &Chassis) -> Map {
    let heard = obstacles.iter().filter(|it| it.mapped && robot.hears(it.height));
    Map::new(heard.map(|it| it.outline.corners()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::devices::sonar;

    #[test]
    fn copies_share_what_is_heard_until_their_obstacles_differ() {
        let world = World::random(3);
        let of =
            |world: &World| world.audible.field(&world.obstacles, &Chassis::CARBOT, &sonar::beam());
        let (one, other) = (of(&world), of(&world.clone()));
        assert!(one.shares_with(&other));
        let mut emptier = world.clone();
        emptier.obstacles.truncate(1);
        assert!(!one.shares_with(&of(&emptier)));
        assert_eq!(*of(&emptier).map(), emptier.audible_map(&Chassis::CARBOT));
    }

    #[test]
    fn a_robot_has_on_its_map_what_its_own_sensor_does_not_look_over() {
        let world = World::random(3);
        let of = |ranging_height| world.audible_map(&Chassis { ranging_height, ..Chassis::CARBOT });
        assert_ne!(of(0.1), of(2.0));
        assert_eq!(of(100.0), Map::new([]));
    }
}
