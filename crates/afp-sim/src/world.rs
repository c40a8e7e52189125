//! Worlds: where the robot starts and what stands around it.
//!
//! Written in TOML with the units in the keys; a key that does not exist is an error that names it
//! and its line, so a misspelt one cannot be overlooked.

mod error;
mod file;

pub use error::WorldError;

use crate::truth::Pose;
use crate::vehicle::{HALF_LENGTH, HALF_WIDTH};
use rapier2d::math::{Pose as Isometry, Rotation, Vector};
use rapier2d::parry::query;
use rapier2d::parry::shape::{Cuboid, SharedShape};

/// A world as read from its file.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// What it is called.
    pub name: String,
    /// Where the robot starts.
    pub start: Pose,
    /// Everything that stands in it, in the order of the file: walls, boxes, polygons.
    pub obstacles: Vec<Obstacle>,
}

/// Something that stands still.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle {
    /// Its name, or `wall 3` and the like where the file gives none.
    pub name: String,
    /// Its outline.
    pub outline: Outline,
    /// How high it is, metres. The range sensor looks over what is lower than 15 cm.
    pub height: f64,
}

/// The outline of an obstacle, seen from above.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A rectangle around its middle, turned by the pose's heading.
    Box {
        /// Where its middle is.
        pose: Pose,
        /// Half its length and width, metres.
        half: [f64; 2],
    },
    /// A convex polygon, metres in the world's frame, counter-clockwise.
    Polygon(Vec<[f64; 2]>),
}

impl Outline {
    /// The corners in the world's frame, metres, counter-clockwise.
    pub fn corners(&self) -> Vec<[f64; 2]> {
        match self {
            Outline::Box { pose, half } => rectangle(*pose, *half).to_vec(),
            Outline::Polygon(corners) => corners.clone(),
        }
    }

    /// The outline as parry's shape and where it is; none for a polygon without an area.
    pub(crate) fn shape(&self) -> Option<(Isometry, SharedShape)> {
        match self {
            Outline::Box { pose, half } => {
                Some((isometry(*pose), SharedShape::cuboid(half[0] as f32, half[1] as f32)))
            }
            Outline::Polygon(corners) => {
                let corners = corners.iter().map(|c| Vector::new(c[0] as f32, c[1] as f32));
                let shape = SharedShape::convex_polyline(corners.collect())?;
                Some((Isometry::identity(), shape))
            }
        }
    }
}

/// The corners of a rectangle, counter-clockwise.
fn rectangle(pose: Pose, [x, y]: [f64; 2]) -> [[f64; 2]; 4] {
    let (sin, cos) = libm::sincos(pose.heading);
    [[x, y], [-x, y], [-x, -y], [x, -y]]
        .map(|[x, y]| [pose.x + x * cos - y * sin, pose.y + x * sin + y * cos])
}

/// A pose for rapier; through `libm`, like all trigonometry here.
pub(crate) fn isometry(pose: Pose) -> Isometry {
    let (sin, cos) = libm::sincos(pose.heading);
    Isometry::from_parts(
        Vector::new(pose.x as f32, pose.y as f32),
        Rotation::from_cos_sin_unchecked(cos as f32, sin as f32),
    )
}

impl World {
    /// Reads a world from the text of its file.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place: not TOML, an unknown or a missing key, a
    /// value that makes no sense, a robot that starts inside of something.
    pub fn parse(text: &str) -> Result<World, WorldError> {
        let world = file::read(text)?;
        match world.obstacle_at_start() {
            Some(obstacle) => Err(WorldError::at_key(
                text,
                &["robot", "pose_m_deg"],
                format!("the robot starts inside of '{}'", obstacle.name),
            )),
            None => Ok(world),
        }
    }

    /// The outline of the robot at a pose, metres, counter-clockwise; for pictures.
    pub fn robot_outline(pose: Pose) -> [[f64; 2]; 4] {
        rectangle(pose, [HALF_LENGTH, HALF_WIDTH])
    }

    fn obstacle_at_start(&self) -> Option<&Obstacle> {
        let robot = Cuboid::new(Vector::new(HALF_LENGTH as f32, HALF_WIDTH as f32));
        let start = isometry(self.start);
        self.obstacles.iter().find(|obstacle| {
            let Some((at, shape)) = obstacle.outline.shape() else { return false };
            query::intersection_test(&start, &robot, &at, &*shape)
                .is_ok_and(|test| test.intersecting)
        })
    }
}
