//! The rooms of the simulation: floors drawn with letters, `*` for dirt and `o` for a drop.

use afp_platform::Grid;
use afp_session::{Drawing, Pose2, Shape, World, WorldError};

/// Radius and height of the robot's body, metres.
pub const RADIUS: f64 = 0.17;
const HEIGHT: f64 = 0.09;

/// The letter of dirt.
pub const DIRT: char = '*';
/// The letter of a place without floor.
pub const DROP: char = 'o';

/// A room.
#[derive(Clone, Debug)]
pub struct Room(pub Grid);

impl World for Room {
    const DEFAULT: &'static str = include_str!("../rooms/flat.txt");

    fn read(text: &str) -> Result<Self, WorldError> {
        Ok(Room(Grid::read(text, &[DIRT, DROP].iter().collect::<String>())?))
    }

    fn made_up(seed: u64) -> Option<String> {
        Some(Grid::made_up(seed, 24, 14, &[('#', 6), (DIRT, 6)]))
    }

    fn name(&self) -> &str {
        &self.0.name
    }

    fn started_at(&self, start: Pose2) -> Result<Self, WorldError> {
        self.0.started_at(start, RADIUS).map(Room)
    }

    fn scene(&self) -> Vec<Shape> {
        self.0.scene(RADIUS, HEIGHT)
    }

    fn drawing(&self) -> Drawing {
        self.0.drawing(RADIUS, &[(DIRT, [214, 188, 148]), (DROP, [70, 70, 80])])
    }
}
