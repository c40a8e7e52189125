//! Worlds of robots that are no Carbot.

use std::fmt::Debug;
use std::marker::PhantomData;

use super::{World, WorldError};
use crate::chassis::Chassis;
use afp_session::{Drawing, Pose2, Shape};

/// What a robot is to its worlds.
pub trait Body: Clone + Debug + Send + Sync + 'static {
    /// Its body.
    const CHASSIS: Chassis;
    /// The text of the world for plans that come without one.
    const DEFAULT: &'static str;
}

/// A world, written as those of the Carbot are, for a robot with another body.
#[derive(Clone, Debug)]
pub struct WorldOf<B> {
    /// The world.
    pub world: World,
    body: PhantomData<fn() -> B>,
}

impl<B> WorldOf<B> {
    fn new(world: World) -> Self {
        WorldOf { world, body: PhantomData }
    }
}

impl<B: Body> afp_session::World for WorldOf<B> {
    const DEFAULT: &'static str = B::DEFAULT;

    fn read(text: &str) -> Result<Self, WorldError> {
        World::parse_for(&B::CHASSIS, text).map(Self::new)
    }

    fn name(&self) -> &str {
        &self.world.name
    }

    fn started_at(&self, start: Pose2) -> Result<Self, String> {
        self.world.started_with(&B::CHASSIS, start).map(Self::new)
    }

    fn scene(&self) -> Vec<Shape> {
        self.world.scene_with(&B::CHASSIS)
    }

    fn drawing(&self) -> Drawing {
        self.world.drawing_with(&B::CHASSIS)
    }
}
