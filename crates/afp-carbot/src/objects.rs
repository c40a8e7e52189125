//! The toolbox's objects: values that only its own templates can read.

mod appearance;
mod distance_map;
pub(crate) mod path;

pub use appearance::Appearance;
pub use distance_map::DistanceMap;
pub use path::Path;
