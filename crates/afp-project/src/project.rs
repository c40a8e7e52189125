//! The content of a project file.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::profile::ProfileRobot;
use crate::realtime::Realtime;

/// The content of `afp.toml`. Paths are relative to the file's folder.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Project {
    /// The default world of runs.
    pub world: Option<String>,
    /// Additional measures of the robot for runs.
    pub measures: Vec<String>,
    /// The origin of the `afp` crates for generated crates.
    pub afp: Option<Origin>,
    /// The robot; defaults to the Carbot.
    pub robot: Option<Robot>,
    /// Toolboxes of the project, in the order of the file.
    pub toolboxes: Vec<Toolbox>,
    /// The targets, in the order of the file.
    pub targets: Vec<Target>,
}

impl Project {
    /// The profile of the robot, if it is made of parts.
    pub fn profile(&self) -> Option<&ProfileRobot> {
        self.robot.as_ref()?.profile.as_ref()
    }
}

/// The origin of a crate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A folder.
    Path(String),
    /// A repository.
    Git(String),
    /// A registry, by version.
    Version(String),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Toolbox {
    /// The name after `use`.
    pub name: String,
    /// Its `.afp` file.
    pub path: String,
    /// The Rust crate that implements it.
    pub krate: Crate,
    /// Byte range of the name.
    pub span: Range<usize>,
}

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Robot {
    /// The profile of a robot made of parts; it then has neither crate nor toolbox of its own.
    pub profile: Option<ProfileRobot>,
    /// The toolbox with its devices.
    pub toolbox: Option<String>,
    /// The type that implements `afp_session::Simulated`, relative to its crate's root; `None` if
    /// there is only the real robot.
    pub sim: Option<String>,
    /// Its crate; defaults to the toolbox's, then to the crate around the project file.
    pub krate: Option<Crate>,
    pub hardware: Option<Hardware>,
    /// Settings of the control loop: names of [`Realtime`](crate::Realtime) and values, in the
    /// order of the file.
    pub realtime: Vec<(String, String)>,
    /// Whether the robot is armed when it boots.
    pub autostart: bool,
    /// The most bytes of all logs on the robot together.
    pub logs: Option<u64>,
    /// Byte range of the heading.
    pub span: Range<usize>,
}

impl Robot {
    /// The name of its type in Rust: the simulated robot, or else the hardware. `None` for a robot
    /// with a profile.
    pub fn rust_type(&self) -> Option<&str> {
        let hardware = self.hardware.as_ref().map(|hardware| hardware.ty.as_str());
        self.sim.as_deref().or(hardware)
    }

    /// The settings of the control loop with their prefix.
    pub(crate) fn of_control_loop(&self) -> impl Iterator<Item = (String, String)> {
        let named = |(name, value): &(String, String)| {
            (format!("{}{name}", Realtime::PREFIX), value.clone())
        };
        self.realtime.iter().map(named)
    }

    /// The settings of the real robot of a profile: its values, and those of the control loop with
    /// their prefix.
    pub fn profile_settings(&self) -> Option<Vec<(String, String)>> {
        let values = &self.profile.as_ref()?.values;
        Some(values.iter().cloned().chain(self.of_control_loop()).collect())
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hardware {
    /// The type that implements `afp_session::Hardware`, relative to its crate's root.
    pub ty: String,
    /// Its crate; defaults to the simulated robot's.
    pub krate: Option<Crate>,
    /// Settings for opening it, by name, in the order of the file.
    pub settings: Vec<(String, String)>,
    /// Byte range of the key.
    pub span: Range<usize>,
}

/// The Rust crate of a toolbox or robot, as far as given.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Crate {
    /// Name of its package; defaults to the manifest's.
    pub package: Option<String>,
    /// Its origin; defaults to the nearest folder around the toolbox file with a manifest.
    pub origin: Option<Origin>,
    /// The module with `templates` and the implementing types; defaults to the root.
    pub module: Option<String>,
}

/// A target machine; unset values are those of the built-in target with this name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Target {
    pub name: String,
    /// Time resolution in nanoseconds, greater than 0.
    pub tick: Option<u64>,
    /// The plan's maximum share of the processor, greater than 0 and at most 1.
    pub capacity: Option<f64>,
    /// The factor on the toolboxes' poll times, greater than 0.
    pub slowdown: Option<f64>,
    /// Maximum time of one poll in nanoseconds, by toolbox and template.
    pub budgets: BTreeMap<String, BTreeMap<String, u64>>,
}
