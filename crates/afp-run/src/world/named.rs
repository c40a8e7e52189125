//! Worlds whose text gives them no name.

use std::any::Any;
use std::sync::Arc;

use afp_session::{AnyWorld, Drawing, Pose2, Shape, WorldError};

/// A world that is called by its file, or as the log of its run says.
#[derive(Debug)]
struct Named {
    world: Arc<dyn AnyWorld>,
    name: String,
}

/// The same world, by a name where it has none of its own.
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
