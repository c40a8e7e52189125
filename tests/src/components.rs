//! The components of `toolbox/testing.afp`, one per file.

mod glance;
mod maps;
mod pick;
mod stay;
mod task;
mod watch;
mod work;

pub use glance::Glance;
pub use maps::{MakeMap, Map, ReadMap};
pub use pick::Pick;
pub use stay::Stay;
pub use task::Task;
pub use watch::Watch;
pub use work::Work;
