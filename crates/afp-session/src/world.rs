//! Worlds of simulated robots of all kinds.

use std::any::Any;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use afp_excerpt::Mistake;

use crate::sample::{Pose2, Shape};

/// The world of a simulated robot, read from a text.
///
/// ```
/// use afp_session::{Drawing, Pose2, Shape, World, WorldError};
///
/// #[derive(Clone, Debug)]
/// struct Hall {
///     length: f64,
///     start: Pose2,
/// }
///
/// impl World for Hall {
///     const DEFAULT: &'static str = "10";
///
///     fn read(text: &str) -> Result<Self, WorldError> {
///         let wrong = |_| WorldError::new(Some(0..text.len()), "expected a length in metres");
///         Ok(Hall { length: text.parse().map_err(wrong)?, start: Pose2::default() })
///     }
///
///     fn name(&self) -> &str {
///         "hall"
///     }
///
///     fn started_at(&self, start: Pose2) -> Result<Self, WorldError> {
///         match (0.0..self.length).contains(&start.x) {
///             true => Ok(Hall { start, ..self.clone() }),
///             false => Err(WorldError::new(None, "the robot starts outside of the hall")),
///         }
///     }
///
///     fn scene(&self) -> Vec<Shape> {
///         Vec::new()
///     }
///
///     fn drawing(&self) -> Drawing {
///         Drawing { start: self.start, ..Drawing::default() }
///     }
/// }
/// # let hall = Hall::read(Hall::DEFAULT)?;
/// # assert!(hall.started_at(Pose2 { x: 12.0, ..Pose2::default() }).is_err());
/// # assert!(Hall::read("long").is_err());
/// # Ok::<(), WorldError>(())
/// ```
pub trait World: Clone + fmt::Debug + Send + Sync + 'static {
    /// The text of the default world.
    const DEFAULT: &'static str;

    /// Reads a world.
    ///
    /// # Errors
    /// The first mistake, with its place.
    fn read(text: &str) -> Result<Self, WorldError>;

    /// The text of a world generated from a seed; `None` if that is not supported.
    fn made_up(seed: u64) -> Option<String> {
        let _ = seed;
        None
    }

    /// The name of the picture file of a map (a file of `map_server`).
    ///
    /// # Errors
    /// The map is wrong, or worlds of this kind cannot be maps.
    fn picture_of_map(map: &str) -> Result<String, WorldError> {
        let _ = map;
        Err(WorldError::new(None, "this robot's worlds are not maps"))
    }

    /// The text of the world that a map and its picture show.
    ///
    /// # Errors
    /// As [`World::picture_of_map`].
    fn text_of_map(name: &str, map: &str, picture: &[u8]) -> Result<String, WorldError> {
        let _ = (name, picture);
        Self::picture_of_map(map)
    }

    /// Its name.
    fn name(&self) -> &str;

    /// The same world with another start of the robot.
    ///
    /// # Errors
    /// The robot cannot start there.
    fn started_at(&self, start: Pose2) -> Result<Self, WorldError>;

    /// The things of the world and the robot's body at the start, for a scene.
    fn scene(&self) -> Vec<Shape>;

    /// The content of a picture of it.
    fn drawing(&self) -> Drawing;
}

/// A world of any kind of robot.
pub trait AnyWorld: fmt::Debug + Send + Sync {
    /// Its name.
    fn name(&self) -> &str;

    /// The same world with another start of the robot.
    ///
    /// # Errors
    /// The robot cannot start there.
    fn started_at(&self, start: Pose2) -> Result<Arc<dyn AnyWorld>, WorldError>;

    /// The things of the world and the robot's body at the start, for a scene.
    fn scene(&self) -> Vec<Shape>;

    /// The content of a picture of it.
    fn drawing(&self) -> Drawing;

    /// The world itself, for a downcast.
    fn as_any(&self) -> &dyn Any;
}

/// The content of a picture of a world from above: metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// The start of the robot.
    pub start: Pose2,
    /// The outline of the robot at the origin, counter-clockwise.
    pub body: Vec<[f64; 2]>,
    /// Fixed and moving things.
    pub things: Vec<Thing>,
    /// Patches of colour on the floor.
    pub patches: Vec<Patch>,
    /// Sources of light.
    pub lights: Vec<[f64; 2]>,
}

/// Outlines of things in metres, by their ids in scenes.
pub type Outlines = BTreeMap<String, Vec<[f64; 2]>>;

/// The least distance of a corner that counts as a move of the thing, metres.
const ELSEWHERE: f64 = 0.004;

impl Drawing {
    /// The drawing after a run, with the final places of things.
    pub fn ended(mut self, places: &Outlines) -> Drawing {
        let far =
            |(a, b): (&[f64; 2], &[f64; 2])| libm::hypot(a[0] - b[0], a[1] - b[1]) > ELSEWHERE;
        for thing in &mut self.things {
            let end = places.get(&thing.id);
            thing.end = end.filter(|end| thing.outline.iter().zip(*end).any(far)).cloned();
        }
        self
    }
}

impl Thing {
    /// The outline at the end of a run, if known; else at the start.
    pub fn last(&self) -> &[[f64; 2]] {
        self.end.as_ref().unwrap_or(&self.outline)
    }
}

/// A thing on the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// Its id in scenes.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Its outline at the start, counter-clockwise.
    pub outline: Vec<[f64; 2]>,
    /// Its outline at the end of a run, if it has moved.
    pub end: Option<Vec<[f64; 2]>>,
    /// Whether sensors look over it.
    pub low: bool,
    /// Whether it can be placed by hand.
    pub movable: bool,
    /// Whether it has room for its name.
    pub labelled: bool,
    /// The path of its centre; empty if it does not move by itself.
    pub path: Vec<[f64; 2]>,
}

/// A patch of colour on the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Its corners.
    pub corners: Vec<[f64; 2]>,
    /// Red, green and blue.
    pub color: [u8; 3],
}

/// A mistake in the text of a world or map.
pub type WorldError = Mistake;

impl<W: World> AnyWorld for W {
    fn name(&self) -> &str {
        self.name()
    }

    fn started_at(&self, start: Pose2) -> Result<Arc<dyn AnyWorld>, WorldError> {
        Ok(Arc::new(self.started_at(start)?))
    }

    fn scene(&self) -> Vec<Shape> {
        self.scene()
    }

    fn drawing(&self) -> Drawing {
        self.drawing()
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}
