//! Worlds of simulated robots, whatever they are.

use std::any::Any;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use afp_excerpt::Mistake;

use crate::sample::{Pose2, Shape};

/// What a simulated robot is put into, as read from a text.
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
    /// The text of the world for plans that come without one.
    const DEFAULT: &'static str;

    /// Reads a world.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place.
    fn read(text: &str) -> Result<Self, WorldError>;

    /// The text of a world made up from a seed; none where there is no such thing.
    fn made_up(seed: u64) -> Option<String> {
        let _ = seed;
        None
    }

    /// The name of the picture that a map (a file of `map_server`) is drawn in.
    ///
    /// # Errors
    /// What is wrong with the map; worlds of this kind are no maps.
    fn picture_of_map(map: &str) -> Result<String, WorldError> {
        let _ = map;
        Err(WorldError::new(None, "this robot's worlds are no maps"))
    }

    /// The text of the world that a map and its picture show.
    ///
    /// # Errors
    /// As [`World::picture_of_map`].
    fn text_of_map(name: &str, map: &str, picture: &[u8]) -> Result<String, WorldError> {
        let _ = (name, picture);
        Self::picture_of_map(map)
    }

    /// What it is called.
    fn name(&self) -> &str;

    /// The same world with the robot at another start.
    ///
    /// # Errors
    /// Why it cannot start there.
    fn started_at(&self, start: Pose2) -> Result<Self, WorldError>;

    /// Everything that stands in it, and the robot's body, as a scene shows them at the start.
    fn scene(&self) -> Vec<Shape>;

    /// What a picture shows of it.
    fn drawing(&self) -> Drawing;
}

/// A world, whatever robot it is for.
pub trait AnyWorld: fmt::Debug + Send + Sync {
    /// What it is called.
    fn name(&self) -> &str;

    /// The same world with the robot at another start.
    ///
    /// # Errors
    /// Why it cannot start there.
    fn started_at(&self, start: Pose2) -> Result<Arc<dyn AnyWorld>, WorldError>;

    /// Everything that stands in it, and the robot's body, as a scene shows them at the start.
    fn scene(&self) -> Vec<Shape>;

    /// What a picture shows of it.
    fn drawing(&self) -> Drawing;

    /// Itself, for who knows what it is.
    fn as_any(&self) -> &dyn Any;
}

/// What a picture shows of a world, seen from above: metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Where the robot starts.
    pub start: Pose2,
    /// The outline of the robot at the origin, counter-clockwise.
    pub body: Vec<[f64; 2]>,
    /// What stands or moves.
    pub things: Vec<Thing>,
    /// Patches of colour on the floor.
    pub patches: Vec<Patch>,
    /// Sources of light.
    pub lights: Vec<[f64; 2]>,
}

/// Outlines of things in metres, by what scenes know them by.
pub type Outlines = BTreeMap<String, Vec<[f64; 2]>>;

/// How far a corner of a thing has to be from where it was for the thing to stand elsewhere, metres.
const ELSEWHERE: f64 = 0.004;

impl Drawing {
    /// The same after a run that left things at these places.
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
    /// Its outline at the end of a run, as far as that is known.
    pub fn last(&self) -> &[[f64; 2]] {
        self.end.as_ref().unwrap_or(&self.outline)
    }
}

/// Something that stands or moves on the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// What scenes know it by.
    pub id: String,
    /// Its name.
    pub name: String,
    /// Its outline at the start, counter-clockwise.
    pub outline: Vec<[f64; 2]>,
    /// The same at the end of a run, where it stands elsewhere then.
    pub end: Option<Vec<[f64; 2]>>,
    /// Whether sensors look over it.
    pub low: bool,
    /// Whether a hand can put it elsewhere.
    pub movable: bool,
    /// Whether there is room for its name.
    pub labelled: bool,
    /// Where its middle goes; empty for what does not go its own way.
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

/// What is wrong with the text of a world, or with that of a map.
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
