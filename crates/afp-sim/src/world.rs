//! Worlds: the robot's start, obstacles, patches, lights and moving objects.
//!
//! Worlds are TOML files with the units in the keys. An unknown key is an error with its name and
//! line, so that misspelled keys are found.

mod audible;
mod error;
mod file;
mod limits;
mod look;
mod map;
mod outline;
mod path;
mod place;
mod random;
mod session;
mod world_of;

pub use afp_session::WorldError;
pub use look::{Look, Rgb, Texture};
pub use outline::Outline;
pub use path::Path;

pub(crate) use audible::Audible;
use error::at_key;
pub(crate) use limits::FARTHEST;
pub(crate) use outline::isometry;
pub(crate) use session::shape;
pub use world_of::{Body, NoTables, OwnTables, WorldOf};

use crate::chassis::{Chassis, Measures};
use crate::truth::Pose;
use rapier2d::parry::query;

/// A world as read from its file.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// The name.
    pub name: String,
    /// The robot's start.
    pub start: Pose,
    /// The battery's charge at the start, above 0 up to 1.
    pub charge: f64,
    /// The robot's measures: the Carbot's, unless the file has others.
    pub measures: Measures,
    /// The appearance of the floor outside of patches.
    pub floor: Look,
    /// All obstacles, in the order of the file: walls, boxes, polygons.
    pub obstacles: Vec<Obstacle>,
    /// Coloured patches on the floor; the last one is on top.
    pub patches: Vec<Patch>,
    /// Sources of infrared light.
    pub lights: Vec<Light>,
    /// The corners of the map's area, a convex polygon, in metres, counter-clockwise. Empty if the
    /// world is not a map.
    pub map: Vec<[f64; 2]>,
    /// The expected readings of the range sensor among the obstacles, shared by all simulations.
    pub(crate) audible: Audible,
}

/// A fixed or moving obstacle on the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its name, or a generated name such as `wall 3`.
    pub name: String,
    /// Its outline at the start.
    pub outline: Outline,
    /// Its height, in metres. The range sensor does not detect obstacles below 15 cm.
    pub height: f64,
    /// Whether it moves.
    pub mobility: Mobility,
    /// Its appearance.
    pub look: Look,
    /// The share of the sound that it returns, above 0 up to 1.
    pub echo: f64,
    /// Whether the robot's map shows it; always false for moving obstacles.
    pub mapped: bool,
}

/// Whether and how an obstacle moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Mobility {
    /// It never moves.
    Fixed,
    /// It can be pushed.
    Movable {
        /// Kilograms.
        mass: f64,
    },
    /// It follows its path and pushes obstacles away.
    Scripted(Path),
}

/// A patch of colour on the floor: a convex polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Its name, or a generated name such as `patch 1`.
    pub name: String,
    /// Its corners, metres, counter-clockwise.
    pub corners: Vec<[f64; 2]>,
    /// Its colour.
    pub color: Rgb,
}

/// A source of infrared light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its name, or a generated name such as `infrared 1`.
    pub name: String,
    /// Where it is, metres.
    pub position: [f64; 2],
    /// Its height above the floor, in metres.
    pub height: f64,
    /// Its strength; 1 gives a reading of 1 at one metre.
    pub strength: f64,
}

impl World {
    /// The JSON schema of world files.
    pub const SCHEMA: &str = include_str!("../../../worlds/world.schema.json");

    /// Reads a world from the text of its file.
    ///
    /// # Errors
    /// The first error and its place: invalid TOML, an unknown or missing key, an invalid value, a
    /// robot that starts inside an obstacle or beyond the map.
    pub fn parse(text: &str) -> Result<World, WorldError> {
        let (world, _) = file::read::<NoTables>(text)?;
        let chassis = world.measures.chassis();
        world.with_room_for(&chassis, text)
    }

    /// Like [`World::parse`], for a robot with another body.
    ///
    /// # Errors
    /// Those of [`World::parse`].
    pub fn parse_for(robot: &Chassis, text: &str) -> Result<World, WorldError> {
        World::parse_with::<NoTables>(robot, text).map(|(world, _)| world)
    }

    /// Like [`World::parse_for`], for files with tables of only that robot.
    fn parse_with<O: OwnTables>(robot: &Chassis, text: &str) -> Result<(World, O), WorldError> {
        let (world, own) = file::read(text)?;
        if world.measures != Measures::CARBOT {
            let why = "this robot has its own measures";
            return Err(at_key(text, &["robot"], why.to_owned())
                .with_help("write only 'pose_m_deg' and 'charge' here"));
        }
        Ok((world.with_room_for(robot, text)?, own))
    }

    /// The world, if the robot can start in it.
    fn with_room_for(self, robot: &Chassis, text: &str) -> Result<World, WorldError> {
        match self.no_start(robot, self.start) {
            Some(why) => Err(at_key(text, &["robot", "pose_m_deg"], why).with_help(
                "choose another place for it, metres and degrees: 'pose_m_deg = [1.0, 2.0, 90]'",
            )),
            None => Ok(self),
        }
    }

    /// The reason why a robot cannot start at a pose, if there is one.
    fn no_start(&self, robot: &Chassis, start: Pose) -> Option<String> {
        match self.obstacle_in_way_of(robot, start) {
            Some(obstacle) => Some(format!("the robot starts inside of '{}'", obstacle.name)),
            None if self.is_beyond([start.x, start.y]) => {
                Some("the robot starts beyond the edge of the map".to_owned())
            }
            None => None,
        }
    }

    /// Whether a place is beyond the map; always false if the world is not a map.
    pub fn is_beyond(&self, place: [f64; 2]) -> bool {
        is_beyond(&self.map, place)
    }

    /// The first obstacle that overlaps a robot at this pose, at the start.
    pub fn obstacle_at(&self, pose: Pose) -> Option<&Obstacle> {
        self.obstacle_in_way_of(&self.measures.chassis(), pose)
    }

    /// Like [`World::obstacle_at`], for a robot with another body.
    pub fn obstacle_in_way_of(&self, robot: &Chassis, pose: Pose) -> Option<&Obstacle> {
        let robot = robot.shared();
        let start = isometry(pose);
        self.obstacles.iter().find(|obstacle| {
            let Some((at, shape)) = obstacle.outline.shape() else { return false };
            query::intersection_test(&start, &*robot, &at, &*shape)
                .is_ok_and(|test| test.intersecting)
        })
    }
}

/// Whether a place is outside of a convex polygon with corners in counter-clockwise order; always
/// false for an empty polygon.
pub(crate) fn is_beyond(corners: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).any(|([x0, y0], [x1, y1])| (x1 - x0) * (y - y0) < (y1 - y0) * (x - x0))
}
