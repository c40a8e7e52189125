//! The project file `afp.toml`: your own toolboxes and robot, targets, the world, the origin of the
//! afp crates.
//!
//! Macros, the command line and generated programs read it with this crate. [`read`] converts a
//! text to a [`Project`] without I/O; [`ProjectFile`] finds the file and its crates.
//!
//! ```toml
//! [run]
//! world = "worlds/hall.toml"
//!
//! [toolboxes]
//! gripper = { path = "gripper/gripper.afp" } # the crate around the file
//! lamps = { path = "lamps.afp", crate = { git = "https://example.org/lamps" } }
//!
//! [target.arm]
//! tick = "1 ms"
//! capacity = 0.5
//! slowdown = 4
//! budgets.gripper.Grip = "30 us"
//!
//! [robot]
//! toolbox = "gripper" # its crate also has the robot
//! sim = "Arm"
//! hardware = { type = "Board", crate = { path = "board" }, settings = { port = "/dev/ttyUSB0" } }
//!
//! [afp]
//! path = "../afp"
//! ```

mod file;
mod key;
mod keys;
mod krate;
mod path;
mod profile;
mod project;
mod read;
mod realtime;
mod spot;
mod time;
mod tree;

pub use afp_excerpt::Mistake;
pub use file::{CALIBRATION, ProjectError, ProjectFile, ToolboxFile};
pub use key::Key;
pub use keys::keys;
pub use krate::{CrateLink, HardwareLink, RobotLink};
pub use path::shown;
pub use profile::{Of, PROFILES, Profile, ProfileRobot, Section, Setting, Wire, WireKind};
pub use project::{Crate, Hardware, Origin, Project, Robot, Target, Toolbox};
pub use read::{read, read_calibration};
pub use realtime::Realtime;
pub use spot::{Spot, SpotKind, headings, spot};
pub use time::duration;
pub use tree::{Listing, Unread, all_files, files, list, scenario_files};
