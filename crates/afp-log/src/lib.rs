//! MCAP logs of plans and robots.
//!
//! A [`Recorder`] takes trace records and robot data on the control path and writes them on its own
//! thread; [`read`] reads a log back. The files are plain MCAP with the public Foxglove protobuf
//! schemas and AFP's own (`proto/afp.proto`). Other tools can read them.
#![warn(missing_docs)]

mod channels;
mod doctor;
mod encode;
mod error;
mod event;
mod foxglove;
#[cfg(feature = "live")]
pub mod live;
mod messages;
mod names;
mod picture;
mod proto;
mod read;
mod recipe;
mod recorder;
mod recover;
pub mod robot;
mod scan;
mod session;
pub mod statistics;
pub mod svg;
mod wall_clock;
mod write;

pub use afp_session::{Kept, OwnedRecord};
pub use channels::{FRAMES, Signal};
pub use doctor::doctor;
pub use error::LogError;
pub use event::{pack, unpack};
pub use messages::Messages;
pub use names::LogNames;
pub use picture::pixels;
pub use read::{Configured, Heard, LogData, TopicInfo, configuration, read, read_any};
pub use recipe::WORLD;
pub use recorder::{Recorder, WhenFull, Written};
pub use recover::{Missing, Recovered, recover, recovered_name};
pub use session::SessionLog;
pub use write::About;
