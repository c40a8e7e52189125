//! Worlds for other robots.

use std::fmt::Debug;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::{World, WorldError};
use crate::chassis::Chassis;
use afp_session::{Drawing, Pose2, Shape};

/// A robot's body for worlds.
///
/// ```
/// use afp_session::World;
/// use afp_sim::parts::{Body, Chassis, Footprint, NoTables, WorldOf};
///
/// /// A round robot, 30 cm wide.
/// #[derive(Clone, Debug)]
/// struct Round;
///
/// impl Body for Round {
///     const CHASSIS: Chassis = Chassis {
///         shape: Footprint::Round(0.15),
///         mass: 2.0,
///         height: 0.1,
///         ranging_height: 0.05,
///     };
///     const DEFAULT: &'static str = "version = 1\n[robot]\npose_m_deg = [0, 0, 0]";
///     type Own = NoTables;
/// }
///
/// let world = WorldOf::<Round>::read(Round::DEFAULT)?;
/// # assert_eq!(world.drawing().start, afp_session::Pose2::default());
/// # Ok::<(), afp_session::WorldError>(())
/// ```
pub trait Body: Clone + Debug + Send + Sync + 'static {
    /// The robot's body.
    const CHASSIS: Chassis;
    /// The text of the default world.
    const DEFAULT: &'static str;
    /// The tables of this robot's files; [`NoTables`] if there are none.
    type Own: OwnTables;
}

/// The keys of world files for only one robot, in addition to the common keys, read by serde.
///
/// ```
/// #[derive(Clone, Debug, serde::Deserialize)]
/// struct Dirt {
///     #[serde(default)]
///     dirt: Vec<Spot>,
/// }
///
/// #[derive(Clone, Debug, serde::Deserialize)]
/// #[serde(deny_unknown_fields)]
/// struct Spot {
///     at_m: [f64; 2],
/// }
///
/// impl afp_sim::parts::OwnTables for Dirt {
///     const KEYS: &'static [&'static str] = &["dirt"];
/// }
/// ```
pub trait OwnTables: DeserializeOwned + Clone + Debug + Send + Sync + 'static {
    /// The robot's own keys at the top of a file. A key that is neither one of these nor a common
    /// key is an error.
    const KEYS: &'static [&'static str];

    /// The error in the values, if there is one.
    fn wrong(&self) -> Option<String> {
        None
    }

    /// Adds the tables to a drawing.
    fn draw(&self, drawing: &mut Drawing) {
        let _ = drawing;
    }

    /// The shapes of the tables in a scene, at the start.
    fn scene(&self) -> Vec<Shape> {
        Vec::new()
    }
}

/// The tables of a robot without its own tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub struct NoTables {}

impl OwnTables for NoTables {
    const KEYS: &'static [&'static str] = &[];
}

/// A world in the Carbot's format, for a robot with another body.
#[derive(Clone, Debug)]
pub struct WorldOf<B: Body> {
    /// The world.
    pub world: World,
    /// The robot's own tables.
    pub own: B::Own,
}

impl<B: Body> afp_session::World for WorldOf<B> {
    const DEFAULT: &'static str = B::DEFAULT;

    fn read(text: &str) -> Result<Self, WorldError> {
        let (world, own) = World::parse_with::<B::Own>(&B::CHASSIS, text)?;
        match own.wrong() {
            Some(message) => Err(WorldError::new(None, message)),
            None => Ok(WorldOf { world, own }),
        }
    }

    fn name(&self) -> &str {
        &self.world.name
    }

    fn started_at(&self, start: Pose2) -> Result<Self, WorldError> {
        let world = self.world.started_with(&B::CHASSIS, start)?;
        Ok(WorldOf { world, own: self.own.clone() })
    }

    fn scene(&self) -> Vec<Shape> {
        let mut scene = self.world.scene_with(&B::CHASSIS);
        scene.extend(self.own.scene());
        scene
    }

    fn drawing(&self) -> Drawing {
        let mut drawing = self.world.drawing_with(&B::CHASSIS);
        self.own.draw(&mut drawing);
        drawing
    }
}
