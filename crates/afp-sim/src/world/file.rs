//! Reads a world file: its tables and the rules for its values.

mod check;
mod keys;
mod tables;

use super::error::at_key;
use super::look::parse_color;
use super::{
    Audible, Light, Look, Mobility, Obstacle, Outline, OwnTables, Patch, Path, Rgb, Texture, World,
    WorldError,
};
use crate::chassis::Measures;
use crate::truth::Pose;
use afp_excerpt::hidden::hidden;
use afp_excerpt::words::{list, nearest};
use serde::de::DeserializeOwned;
use toml_edit::Document;
use toml_edit::de::{Deserializer, Error};

use check::{Check, Key, number};
use tables::File;

/// The default thickness of a wall, in metres.
const THICKNESS: f64 = 0.1;
/// The default height of a wall, in metres.
const WALL_HEIGHT: f64 = 2.5;
/// The default height of an infrared source, in metres.
const LIGHT_HEIGHT: f64 = 0.15;
/// The maximum speed of an obstacle on a path, in metres a second: the limit of the physics' steps.
const FASTEST: f64 = 5.0;
/// The default colours.
const FLOOR_COLOR: Rgb = [200, 194, 184];
const WALL_COLOR: Rgb = [226, 221, 208];
const BOX_COLOR: Rgb = [176, 141, 87];
const POLYGON_COLOR: Rgb = [127, 143, 166];

/// Reads a file and checks each value. Also returns the tables of the file's robot.
pub(super) fn read<O: OwnTables>(text: &str) -> Result<(World, O), WorldError> {
    if let Some(hidden) = hidden(text).into_iter().next() {
        let message = format!("'{}' {}", hidden.shown, hidden.fault());
        return Err(WorldError::new(Some(hidden.span), message).with_help("remove it"));
    }
    let document = Document::parse(text).map_err(|error| {
        let help = match error.message().starts_with("duplicate key") {
            true => "remove one of them",
            false => "a world is TOML: 'key = value', strings in quotes",
        };
        wrong(&error.into()).with_help(help)
    })?;
    keys::check(document.as_table(), O::KEYS)?;
    let (file, own): (File, O) = (tables(&document)?, tables(&document)?);
    let check = Check::new(text);
    let root = Key::root();
    if file.version != 1 {
        let message = format!("version {} is unknown", file.version);
        return Err(at_key(text, &["version"], message).with_help("write 'version = 1'"));
    }
    let robot = root.at("robot");
    let start = check.pose(&robot.at("pose_m_deg"), file.robot.pose_m_deg)?;
    let charge = check.share(&robot.at("charge"), file.robot.charge)?;
    let measures = check.measures(&robot, &file.robot)?;
    let floor = root.at("floor");
    let floor = check.look(&floor, FLOOR_COLOR, file.floor.color, file.floor.texture)?;
    let mut obstacles = Vec::new();
    for (i, wall) in file.wall.into_iter().enumerate() {
        check.wall(&root.nth("wall", i), i, wall, &mut obstacles)?;
    }
    for (i, the_box) in file.boxes.into_iter().enumerate() {
        obstacles.push(check.the_box(&root.nth("box", i), i, the_box)?);
    }
    for (i, polygon) in file.polygon.into_iter().enumerate() {
        obstacles.push(check.polygon(&root.nth("polygon", i), i, polygon)?);
    }
    let patches = file.patch.into_iter().enumerate();
    let patches = patches.map(|(i, patch)| check.patch(&root.nth("patch", i), i, patch));
    let lights = file.infrared.into_iter().enumerate();
    let lights = lights.map(|(i, light)| check.light(&root.nth("infrared", i), i, light));
    let map = match file.map {
        Some(map) => check.convex(&root.at("map").at("corners_m"), map.corners_m)?,
        None => Vec::new(),
    };
    let world = World {
        map,
        name: file.name,
        start,
        charge,
        measures,
        floor,
        obstacles,
        patches: patches.collect::<Result<_, _>>()?,
        lights: lights.collect::<Result<_, _>>()?,
        audible: Audible::default(),
    };
    Ok((world, own))
}

fn tables<T: DeserializeOwned>(document: &Document<&str>) -> Result<T, WorldError> {
    T::deserialize(Deserializer::from(document.clone())).map_err(|error| wrong(&error))
}

fn wrong(error: &Error) -> WorldError {
    WorldError::new(error.span(), error.message().replace('\n', ", ").replace('`', "'"))
}

impl Check<'_> {
    /// The robot's measures: without a key, the Carbot's. With a track, the wheels do not steer;
    /// with a wheelbase, too, the robot is a car.
    fn measures(&self, key: &Key, robot: &tables::Robot) -> Result<Measures, WorldError> {
        let measure = |name: &str, value: Option<f64>, usual: f64| match value {
            Some(value) => self.positive(&key.at(name), &[value]).map(|()| value),
            None => Ok(usual),
        };
        let usual = Measures::CARBOT;
        let [length, width] = usual.half.map(|half| 2.0 * half);
        let length = measure("length_m", robot.length_m, length)?;
        let width = measure("width_m", robot.width_m, width)?;
        let mut wheels = match robot.track_m {
            Some(track) => [0.0, measure("track_m", Some(track), track)? / 2.0],
            None => usual.wheels,
        };
        let mut narrowest = usual.narrowest;
        if let (Some(base), Some(steering)) = (robot.wheelbase_m, robot.steering_deg) {
            wheels[0] = measure("wheelbase_m", Some(base), base)?;
            if !(1.0..=80.0).contains(&steering) {
                let message = format!("{} is not a steering angle", number(steering));
                let help = "write an angle from 1 to 80".to_owned();
                return Err(self.error(&key.at("steering_deg"), &message, help));
            }
            narrowest = base / libm::tan(steering.to_radians());
        }
        let fastest = measure("fastest_m_s", robot.fastest_m_s, usual.fastest)?;
        if fastest > FASTEST {
            let message = format!("{} is more than {FASTEST}", number(fastest));
            let help = format!("write at most {FASTEST}");
            return Err(self.error(&key.at("fastest_m_s"), &message, help));
        }
        let sonar = robot.sonar_m.unwrap_or(usual.sonar);
        self.not_negative(&key.at("sonar_m"), sonar)?;
        let half = [length / 2.0, width / 2.0];
        let encoders = robot.encoders.unwrap_or(usual.encoders);
        Ok(Measures { half, wheels, narrowest, fastest, sonar, encoders })
    }

    fn wall(
        &self,
        key: &Key,
        i: usize,
        wall: tables::Wall,
        into: &mut Vec<Obstacle>,
    ) -> Result<(), WorldError> {
        let thickness = wall.thickness_m.unwrap_or(THICKNESS);
        let height = wall.height_m.unwrap_or(WALL_HEIGHT);
        self.positive(&key.at("thickness_m"), &[thickness])?;
        self.positive(&key.at("height_m"), &[height])?;
        let look = self.look(key, WALL_COLOR, wall.color, wall.texture)?;
        let echo = self.share(&key.at("echo"), wall.echo)?;
        let mapped = wall.mapped.unwrap_or(true);
        let at_points = key.at("points_m");
        let mut points = wall.points_m;
        self.near(&at_points, points.as_flattened())?;
        if points.len() < 2 {
            let help = "write both of its ends: 'points_m = [[0, 0], [4, 0]]'";
            return Err(self.error(&at_points, "a wall needs at least two points", help));
        }
        if wall.closed {
            points.push(points[0]);
        }
        let name = wall.name.unwrap_or_else(|| format!("wall {}", i + 1));
        for ends in points.windows(2) {
            let Some(outline) = side(ends[0], ends[1], thickness) else {
                let message = "two consecutive points of the wall are equal";
                return Err(self.error(&at_points, message, "remove one of them"));
            };
            let (name, mobility) = (name.clone(), Mobility::Fixed);
            into.push(Obstacle { name, outline, height, mobility, look, echo, mapped });
        }
        Ok(())
    }

    fn the_box(&self, key: &Key, i: usize, it: tables::Box) -> Result<Obstacle, WorldError> {
        self.positive(&key.at("size_m"), &it.size_m)?;
        self.positive(&key.at("height_m"), &[it.height_m])?;
        let mobility = self.mobility(key, it.mass_kg, it.path)?;
        let mapped = self.mapped(key, it.mapped, &mobility)?;
        Ok(Obstacle {
            name: it.name.unwrap_or_else(|| format!("box {}", i + 1)),
            outline: Outline::Box {
                pose: self.pose(&key.at("pose_m_deg"), it.pose_m_deg)?,
                half: it.size_m.map(|size| size / 2.0),
            },
            height: it.height_m,
            mobility,
            look: self.look(key, BOX_COLOR, it.color, it.texture)?,
            echo: self.share(&key.at("echo"), it.echo)?,
            mapped,
        })
    }

    fn polygon(&self, key: &Key, i: usize, it: tables::Polygon) -> Result<Obstacle, WorldError> {
        self.positive(&key.at("height_m"), &[it.height_m])?;
        let mobility = self.mobility(key, it.mass_kg, it.path)?;
        let mapped = self.mapped(key, it.mapped, &mobility)?;
        Ok(Obstacle {
            name: it.name.unwrap_or_else(|| format!("polygon {}", i + 1)),
            outline: Outline::Polygon(self.convex(&key.at("points_m"), it.points_m)?),
            height: it.height_m,
            mobility,
            look: self.look(key, POLYGON_COLOR, it.color, it.texture)?,
            echo: self.share(&key.at("echo"), it.echo)?,
            mapped,
        })
    }

    fn mobility(
        &self,
        key: &Key,
        mass: Option<f64>,
        path: Option<tables::Path>,
    ) -> Result<Mobility, WorldError> {
        match (mass, path) {
            (None, None) => Ok(Mobility::Fixed),
            (Some(mass), None) => {
                self.positive(&key.at("mass_kg"), &[mass])?;
                Ok(Mobility::Movable { mass })
            }
            (None, Some(path)) => self.path(&key.at("path"), path).map(Mobility::Scripted),
            (Some(_), Some(_)) => {
                let message = "an object with a path cannot be pushed";
                Err(self.error(&key.at("mass_kg"), message, "leave out 'mass_kg' or 'path'"))
            }
        }
    }

    /// Whether a map shows it: by default, fixed obstacles.
    fn mapped(
        &self,
        key: &Key,
        mapped: Option<bool>,
        mobility: &Mobility,
    ) -> Result<bool, WorldError> {
        let stands = *mobility == Mobility::Fixed;
        if mapped == Some(true) && !stands {
            let help = "leave out 'mapped'";
            return Err(self.error(
                &key.at("mapped"),
                "a moving object cannot be on the map",
                help,
            ));
        }
        Ok(mapped.unwrap_or(stands))
    }

    fn path(&self, key: &Key, path: tables::Path) -> Result<Path, WorldError> {
        self.near(&key.at("by_m"), path.by_m.as_flattened())?;
        self.positive(&key.at("speed_m_s"), &[path.speed_m_s])?;
        if path.speed_m_s > FASTEST {
            let message = format!("{} is more than {FASTEST}", number(path.speed_m_s));
            let help = format!("write at most {FASTEST}");
            return Err(self.error(&key.at("speed_m_s"), &message, help));
        }
        self.not_negative(&key.at("wait_s"), path.wait_s)?;
        self.not_negative(&key.at("start_s"), path.start_s)?;
        let made = Path::new(&path.by_m, path.closed, path.speed_m_s, path.wait_s, path.start_s);
        let help = "write places relative to its start: 'by_m = [[1, 0]]'";
        made.ok_or_else(|| self.error(&key.at("by_m"), "the path has no length", help))
    }

    fn patch(&self, key: &Key, i: usize, patch: tables::Patch) -> Result<Patch, WorldError> {
        Ok(Patch {
            name: patch.name.unwrap_or_else(|| format!("patch {}", i + 1)),
            corners: self.convex(&key.at("points_m"), patch.points_m)?,
            color: self.color(&key.at("color"), &patch.color)?,
        })
    }

    fn light(&self, key: &Key, i: usize, light: tables::Infrared) -> Result<Light, WorldError> {
        let height = light.height_m.unwrap_or(LIGHT_HEIGHT);
        let strength = light.strength.unwrap_or(1.0);
        self.near(&key.at("position_m"), &light.position_m)?;
        self.not_negative(&key.at("height_m"), height)?;
        self.positive(&key.at("strength"), &[strength])?;
        let name = light.name.unwrap_or_else(|| format!("infrared {}", i + 1));
        Ok(Light { name, position: light.position_m, height, strength })
    }

    fn look(
        &self,
        key: &Key,
        default: Rgb,
        color: Option<String>,
        texture: Option<String>,
    ) -> Result<Look, WorldError> {
        let color = color.map(|text| self.color(&key.at("color"), &text)).transpose()?;
        let texture = texture.map(|name| self.texture(&key.at("texture"), &name)).transpose()?;
        Ok(Look { color: color.unwrap_or(default), texture: texture.unwrap_or_default() })
    }

    fn color(&self, key: &Key, text: &str) -> Result<Rgb, WorldError> {
        let wrong = || self.error(key, &format!("'{text}' is not a colour"), "write '#rrggbb'");
        parse_color(text).ok_or_else(wrong)
    }

    fn texture(&self, key: &Key, name: &str) -> Result<Texture, WorldError> {
        let known = Texture::NAMES.into_iter().find(|(known, _)| *known == name);
        known.map(|(_, texture)| texture).ok_or_else(|| {
            let names = || Texture::NAMES.into_iter().map(|(name, _)| name);
            let help = match nearest(name, names()) {
                Some(meant) => format!("write '{meant}'"),
                None => format!("there are {}", list(names(), "and")),
            };
            self.error(key, &format!("'{name}' is not a texture"), help)
        })
    }
}

/// A side of a wall, half a thickness longer at both ends to close corners; `None` for two equal
/// points.
fn side(from: [f64; 2], to: [f64; 2], thickness: f64) -> Option<Outline> {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = libm::hypot(dx, dy);
    let pose = Pose {
        x: (from[0] + to[0]) / 2.0,
        y: (from[1] + to[1]) / 2.0,
        heading: libm::atan2(dy, dx),
    };
    let half = [(length + thickness) / 2.0, thickness / 2.0];
    (length >= 0.001).then_some(Outline::Box { pose, half })
}
