//! Worlds: where the robot starts and what stands, lies, shines and moves around it.
//!
//! Written in TOML with the units in the keys; a key that does not exist is an error that names it
//! and its line, so a misspelt one cannot be overlooked.

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

use crate::chassis::Chassis;
use crate::truth::Pose;
use rapier2d::parry::query;

/// A world as read from its file.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// What it is called.
    pub name: String,
    /// Where the robot starts.
    pub start: Pose,
    /// The share of its charge that the battery has at the start, above 0 up to 1.
    pub charge: f64,
    /// What the floor looks like where no patch lies.
    pub floor: Look,
    /// Everything that stands in it, in the order of the file: walls, boxes, polygons.
    pub obstacles: Vec<Obstacle>,
    /// Coloured patches on the floor; the last one lies on top.
    pub patches: Vec<Patch>,
    /// Sources of infrared light.
    pub lights: Vec<Light>,
    /// The corners of what its map shows, a convex polygon, metres, counter-clockwise; nothing is known beyond it. Empty
    /// where the world is no map.
    pub map: Vec<[f64; 2]>,
    /// What the range sensor should hear among the obstacles, kept for all simulations.
    pub(crate) audible: Audible,
}

/// Something that stands or moves on the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its name, or `wall 3` and the like where the file gives none.
    pub name: String,
    /// Its outline at the start.
    pub outline: Outline,
    /// How high it is, metres. The range sensor looks over what is lower than 15 cm.
    pub height: f64,
    /// Whether it moves.
    pub mobility: Mobility,
    /// What it looks like.
    pub look: Look,
    /// How much of the sound that hits it is sent back, above 0 up to 1.
    pub echo: f64,
    /// Whether the robot's map shows it; never so for what moves.
    pub mapped: bool,
}

/// Whether and how an obstacle moves.
#[derive(Clone, Debug, PartialEq)]
pub enum Mobility {
    /// It stands still for good.
    Fixed,
    /// It can be pushed.
    Movable {
        /// Kilograms.
        mass: f64,
    },
    /// It goes its way whatever is in it.
    Scripted(Path),
}

/// A patch of colour on the floor: a convex polygon.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Its name, or `patch 1` and the like.
    pub name: String,
    /// Its corners, metres, counter-clockwise.
    pub corners: Vec<[f64; 2]>,
    /// Its colour.
    pub color: Rgb,
}

/// A source of infrared light.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Its name, or `infrared 1` and the like.
    pub name: String,
    /// Where it is, metres.
    pub position: [f64; 2],
    /// How high above the floor, metres.
    pub height: f64,
    /// How bright it is; 1 gives a reading of 1 at one metre.
    pub strength: f64,
}

impl World {
    /// The JSON schema of world files.
    pub const SCHEMA: &str = include_str!("../../../worlds/world.schema.json");

    /// Reads a world from the text of its file.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place: not TOML, an unknown or a missing key, a
    /// value that makes no sense, a robot that starts inside of something or beyond the map.
    pub fn parse(text: &str) -> Result<World, WorldError> {
        World::parse_for(&Chassis::CARBOT, text)
    }

    /// The same for a robot with another body.
    ///
    /// # Errors
    /// As [`World::parse`].
    pub fn parse_for(robot: &Chassis, text: &str) -> Result<World, WorldError> {
        World::parse_with::<NoTables>(robot, text).map(|(world, _)| world)
    }

    /// The same where files have tables for that robot alone.
    fn parse_with<O: OwnTables>(robot: &Chassis, text: &str) -> Result<(World, O), WorldError> {
        let (world, own) = file::read(text)?;
        match world.no_start(robot, world.start) {
            Some(why) => Err(at_key(text, &["robot", "pose_m_deg"], why).with_help(
                "choose another place for it, metres and degrees: 'pose_m_deg = [1.0, 2.0, 90]'",
            )),
            None => Ok((world, own)),
        }
    }

    /// Why a robot cannot start somewhere; nothing where it can.
    fn no_start(&self, robot: &Chassis, start: Pose) -> Option<String> {
        match self.obstacle_in_way_of(robot, start) {
            Some(obstacle) => Some(format!("the robot starts inside of '{}'", obstacle.name)),
            None if self.is_beyond([start.x, start.y]) => {
                Some("the robot starts beyond the edge of the map".to_owned())
            }
            None => None,
        }
    }

    /// Whether a place is beyond what the map shows; never in a world that is no map.
    pub fn is_beyond(&self, place: [f64; 2]) -> bool {
        is_beyond(&self.map, place)
    }

    /// The first obstacle that a robot at this pose would be inside of, as things stand at the
    /// start.
    pub fn obstacle_at(&self, pose: Pose) -> Option<&Obstacle> {
        self.obstacle_in_way_of(&Chassis::CARBOT, pose)
    }

    /// The same for a robot with another body.
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

/// Whether a place is outside of a convex polygon whose corners go counter-clockwise; never outside of none.
pub(crate) fn is_beyond(corners: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).any(|([x0, y0], [x1, y1])| (x1 - x0) * (y - y0) < (y1 - y0) * (x - x0))
}
