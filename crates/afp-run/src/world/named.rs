//! Worlds whose text contains no name.

use std::any::Any;
use std::sync::Arc;

use afp_session::{AnyWorld, Drawing, Pose2, Shape, WorldError};

/// A world with the name of its file or of the log.
#[derive(Debug)]
struct Named {
    world: Arc<dyn AnyWorld>,
    name: String,
}

/// The world, with a default name.
pub(crate) fn named(world: Arc<dyn AnyWorld>, name: &str) -> Arc<dyn AnyWorld> {
    match world.name().is_empty() {
        true => Arc::new(Named { world, name: name.to_owned() }),
        false => world,
    }
}

impl AnyWorld for Named {
    fn name(&self) -> &str {
        &self.name
    }

    fn started_at(&self, start: Pose2) -> Result<Arc<dyn AnyWorld>, WorldError> {
        Ok(named(self.world.started_at(start)?, &self.name))
    }

    fn scene(&self) -> Vec<Shape> {
        self.world.scene()
    }

    fn drawing(&self) -> Drawing {
        self.world.drawing()
    }

    fn as_any(&self) -> &dyn Any {
        self.world.as_any()
    }
}
