//! The world file as serde sees it, and what its values must satisfy.

use super::{Obstacle, Outline, World, WorldError};
use crate::truth::Pose;
use serde::Deserialize;

/// A wall is this thick where the file does not say, metres.
const THICKNESS: f64 = 0.1;
/// A wall is this high where the file does not say, metres.
const WALL_HEIGHT: f64 = 2.5;
/// Nothing lies farther from the origin than this, metres: beyond it single precision is coarse.
const FARTHEST: f64 = 1000.0;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: u32,
    #[serde(default)]
    name: String,
    robot: Robot,
    #[serde(default)]
    wall: Vec<Wall>,
    #[serde(default, rename = "box")]
    boxes: Vec<Box>,
    #[serde(default)]
    polygon: Vec<Polygon>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Robot {
    pose_m_deg: [f64; 3],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Wall {
    name: Option<String>,
    points_m: Vec<[f64; 2]>,
    #[serde(default)]
    closed: bool,
    thickness_m: Option<f64>,
    height_m: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Box {
    name: Option<String>,
    pose_m_deg: [f64; 3],
    size_m: [f64; 2],
    height_m: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Polygon {
    name: Option<String>,
    points_m: Vec<[f64; 2]>,
    height_m: f64,
}

/// Reads a file and checks each value by itself.
pub(super) fn read(text: &str) -> Result<World, WorldError> {
    let file: File = toml_edit::de::from_str(text)
        .map_err(|error| WorldError::at_span(text, error.span(), error.message().to_owned()))?;
    let check = Check { text };
    if file.version != 1 {
        let message = format!("version {} is unknown; this is version 1", file.version);
        return Err(WorldError::at_key(text, &["version"], message));
    }
    let start = check.pose(&["robot", "pose_m_deg"], file.robot.pose_m_deg)?;
    let mut obstacles = Vec::new();
    for (i, wall) in file.wall.into_iter().enumerate() {
        check.wall(i, wall, &mut obstacles)?;
    }
    for (i, the_box) in file.boxes.into_iter().enumerate() {
        obstacles.push(check.the_box(i, the_box)?);
    }
    for (i, polygon) in file.polygon.into_iter().enumerate() {
        obstacles.push(check.polygon(i, polygon)?);
    }
    Ok(World { name: file.name, start, obstacles })
}

/// Checks values and reports them at their keys.
struct Check<'a> {
    text: &'a str,
}

impl Check<'_> {
    fn wall(&self, i: usize, wall: Wall, into: &mut Vec<Obstacle>) -> Result<(), WorldError> {
        let index = i.to_string();
        let key = |name| ["wall", &index, name].map(str::to_owned);
        let thickness = wall.thickness_m.unwrap_or(THICKNESS);
        let height = wall.height_m.unwrap_or(WALL_HEIGHT);
        self.positive(&key("thickness_m"), &[thickness])?;
        self.positive(&key("height_m"), &[height])?;
        let mut points = wall.points_m;
        self.near(&key("points_m"), points.as_flattened())?;
        if points.len() < 2 {
            return Err(self.error(&key("points_m"), "a wall needs at least two points"));
        }
        if wall.closed {
            points.push(points[0]);
        }
        let name = wall.name.unwrap_or_else(|| format!("wall {}", i + 1));
        for ends in points.windows(2) {
            let (dx, dy) = (ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
            let length = libm::hypot(dx, dy);
            if length < 0.001 {
                let message = "two points of the wall that follow each other are the same";
                return Err(self.error(&key("points_m"), message));
            }
            let pose = Pose {
                x: (ends[0][0] + ends[1][0]) / 2.0,
                y: (ends[0][1] + ends[1][1]) / 2.0,
                heading: libm::atan2(dy, dx),
            };
            // Half a thickness longer at either end, so that corners are closed.
            let half = [(length + thickness) / 2.0, thickness / 2.0];
            let outline = Outline::Box { pose, half };
            into.push(Obstacle { name: name.clone(), outline, height });
        }
        Ok(())
    }

    fn the_box(&self, i: usize, the_box: Box) -> Result<Obstacle, WorldError> {
        let index = i.to_string();
        let key = |name| ["box", &index, name].map(str::to_owned);
        self.positive(&key("size_m"), &the_box.size_m)?;
        self.positive(&key("height_m"), &[the_box.height_m])?;
        Ok(Obstacle {
            name: the_box.name.unwrap_or_else(|| format!("box {}", i + 1)),
            outline: Outline::Box {
                pose: self.pose(&["box", &index, "pose_m_deg"], the_box.pose_m_deg)?,
                half: the_box.size_m.map(|size| size / 2.0),
            },
            height: the_box.height_m,
        })
    }

    fn polygon(&self, i: usize, polygon: Polygon) -> Result<Obstacle, WorldError> {
        let index = i.to_string();
        let key = |name| ["polygon", &index, name].map(str::to_owned);
        self.positive(&key("height_m"), &[polygon.height_m])?;
        let mut points = polygon.points_m;
        self.near(&key("points_m"), points.as_flattened())?;
        match turning(&points) {
            Some(true) => {}
            Some(false) => points.reverse(),
            None => {
                let message = "the polygon is not convex; draw it as several";
                return Err(self.error(&key("points_m"), message));
            }
        }
        Ok(Obstacle {
            name: polygon.name.unwrap_or_else(|| format!("polygon {}", i + 1)),
            outline: Outline::Polygon(points),
            height: polygon.height_m,
        })
    }

    fn pose(&self, path: &[&str], [x, y, degrees]: [f64; 3]) -> Result<Pose, WorldError> {
        let path: Vec<String> = path.iter().map(|&part| part.to_owned()).collect();
        self.near(&path, &[x, y])?;
        self.near(&path, &[degrees])?;
        Ok(Pose { x, y, heading: degrees * (std::f64::consts::PI / 180.0) })
    }

    fn positive(&self, path: &[String], values: &[f64]) -> Result<(), WorldError> {
        self.near(path, values)?;
        match values.iter().find(|value| **value <= 0.0) {
            Some(value) => Err(self.error(path, &format!("{value} must be greater than 0"))),
            None => Ok(()),
        }
    }

    fn near(&self, path: &[String], values: &[f64]) -> Result<(), WorldError> {
        match values.iter().find(|value| !value.is_finite() || value.abs() > FARTHEST) {
            Some(value) => {
                Err(self.error(path, &format!("{value} is not within {FARTHEST} of zero")))
            }
            None => Ok(()),
        }
    }

    fn error(&self, path: &[String], message: &str) -> WorldError {
        let keys: Vec<&str> = path.iter().map(String::as_str).collect();
        let key = keys.last().copied().unwrap_or_default();
        WorldError::at_key(self.text, &keys, format!("{key}: {message}"))
    }
}

/// Whether a convex polygon's corners go counter-clockwise; none if it is not convex.
fn turning(points: &[[f64; 2]]) -> Option<bool> {
    let n = points.len();
    let mut left = None;
    // The edges of a convex polygon turn by one full turn in all; a star by more.
    let mut turned = 0.0;
    for i in 0..n {
        let [a, b, c] = [points[i], points[(i + 1) % n], points[(i + 2) % n]];
        let (ux, uy, vx, vy) = (b[0] - a[0], b[1] - a[1], c[0] - b[0], c[1] - b[1]);
        let cross = ux * vy - uy * vx;
        if cross.abs() < 1e-9 || *left.get_or_insert(cross > 0.0) != (cross > 0.0) {
            return None;
        }
        turned += libm::atan2(cross, ux * vx + uy * vy);
    }
    left.filter(|_| n >= 3 && turned.abs() < 7.0)
}
