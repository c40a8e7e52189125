//! The Carbot's worlds for sessions, pictures and logs.

use super::{FARTHEST, Mobility, Obstacle, Outline, World, WorldError};
use crate::chassis::Chassis;
use crate::truth::Pose;
use afp_session::frames::{BODY, WORLD};
use afp_session::{Drawing, Patch, Shape, Thing};

/// The minimum width of a box with a visible name, in metres.
const ROOM_FOR_NAME: f64 = 0.2;

impl afp_session::World for World {
    const DEFAULT: &'static str = include_str!("../../../../worlds/wall_following.toml");

    fn read(text: &str) -> Result<Self, WorldError> {
        World::parse(text)
    }

    fn made_up(seed: u64) -> Option<String> {
        Some(World::random_text(seed))
    }

    fn picture_of_map(map: &str) -> Result<String, WorldError> {
        World::map_picture(map)
    }

    fn text_of_map(name: &str, map: &str, picture: &[u8]) -> Result<String, WorldError> {
        World::map_text(name, map, picture)
    }

    fn name(&self) -> &str {
        &self.name
    }

    fn started_at(&self, start: Pose) -> Result<Self, WorldError> {
        self.started_with(&self.measures.chassis(), start)
    }

    fn scene(&self) -> Vec<Shape> {
        self.scene_with(&self.measures.chassis())
    }

    fn drawing(&self) -> Drawing {
        self.drawing_with(&self.measures.chassis())
    }
}

impl World {
    /// The same world with a robot's body at another start.
    pub(super) fn started_with(&self, robot: &Chassis, start: Pose) -> Result<World, WorldError> {
        let near = |value: f64| value.abs() <= FARTHEST;
        if ![start.x, start.y, start.heading.to_degrees()].into_iter().all(near) {
            let why = format!("the start is not within {FARTHEST} m and {FARTHEST} deg of zero");
            return Err(WorldError::new(None, why));
        }
        match self.no_start(robot, start) {
            Some(why) => Err(WorldError::new(None, why)),
            None => Ok(World { start, ..self.clone() }),
        }
    }

    pub(super) fn scene_with(&self, robot: &Chassis) -> Vec<Shape> {
        let obstacles = self.obstacles.iter().enumerate();
        let body = Shape {
            id: "robot".to_owned(),
            frame: BODY,
            outline: robot.outline(Pose::default()),
            height: robot.height,
            color: [0.15, 0.45, 0.75, 0.9],
        };
        obstacles.map(|(index, obstacle)| shape(index, obstacle)).chain([body]).collect()
    }

    pub(super) fn drawing_with(&self, robot: &Chassis) -> Drawing {
        let patch =
            |patch: &super::Patch| Patch { corners: patch.corners.clone(), color: patch.color };
        let things = self.obstacles.iter().enumerate();
        Drawing {
            start: self.start,
            body: robot.outline(Pose::default()),
            things: things.map(|(index, it)| thing(index, it, robot)).collect(),
            patches: self.patches.iter().map(patch).collect(),
            lights: self.lights.iter().map(|light| light.position).collect(),
        }
    }
}

/// An obstacle at the start.
pub(crate) fn shape(index: usize, obstacle: &Obstacle) -> Shape {
    let [red, green, blue] = obstacle.look.color.map(|part| f64::from(part) / 255.0);
    Shape {
        id: format!("{index} {}", obstacle.name),
        frame: WORLD,
        outline: obstacle.outline.corners(),
        height: obstacle.height,
        color: [red, green, blue, 0.9],
    }
}

fn thing(index: usize, obstacle: &Obstacle, robot: &Chassis) -> Thing {
    let Shape { id, outline, .. } = shape(index, obstacle);
    let count = outline.len() as f64;
    let sum = outline.iter().fold([0.0, 0.0], |sum, at| [sum[0] + at[0], sum[1] + at[1]]);
    let middle = [sum[0] / count, sum[1] / count];
    let path = match &obstacle.mobility {
        Mobility::Scripted(path) => {
            path.places().map(|by| [middle[0] + by[0], middle[1] + by[1]]).collect()
        }
        Mobility::Fixed | Mobility::Movable { .. } => Vec::new(),
    };
    let least = match &obstacle.outline {
        Outline::Box { half, .. } => 2.0 * half[0].min(half[1]),
        Outline::Polygon(_) => f64::INFINITY,
    };
    Thing {
        id,
        name: obstacle.name.clone(),
        outline,
        end: None,
        low: !robot.hears(obstacle.height),
        movable: matches!(obstacle.mobility, Mobility::Movable { .. }),
        labelled: least > ROOM_FOR_NAME,
        path,
    }
}
