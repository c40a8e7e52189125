//! What a project file says, as values.

use std::collections::BTreeMap;
use std::ops::Range;

/// What `afp.toml` says. Paths are as written: relative to the folder of the file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Project {
    /// The world that plans are run in.
    pub world: Option<String>,
    /// The measures of the robot that runs are judged by, too.
    pub measures: Vec<String>,
    /// Where generated crates take the `afp` crates from.
    pub afp: Option<Origin>,
    /// The robot that plans run on; without one it is the Carbot.
    pub robot: Option<Robot>,
    /// Toolboxes of the project, in the order of the file.
    pub toolboxes: Vec<Toolbox>,
    /// What plans shall run on, in the order of the file.
    pub targets: Vec<Target>,
}

/// Where a crate comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A folder.
    Path(String),
    /// A repository.
    Git(String),
    /// A registry, by version.
    Version(String),
}

/// A toolbox of the project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Toolbox {
    /// The name behind `use`.
    pub name: String,
    /// Its `.afp` file.
    pub path: String,
    /// The Rust crate that implements it.
    pub krate: Crate,
    /// The name in the text, in bytes.
    pub span: Range<usize>,
}

/// The robot of the project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Robot {
    /// The toolbox of the project that declares its devices.
    pub toolbox: Option<String>,
    /// The type that implements `afp_session::Simulated`, seen from the root of its crate.
    pub sim: String,
    /// Its crate; else that of its toolbox, else the one around the project file.
    pub krate: Option<Crate>,
    /// The robot itself, beside the simulated one.
    pub hardware: Option<Hardware>,
    /// How the control loop of the robot itself runs: names of [`Realtime`](crate::Realtime) and values, in the order of
    /// the file.
    pub realtime: Vec<(String, String)>,
    /// The heading in the text, in bytes.
    pub span: Range<usize>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hardware {
    /// The type that implements `afp_session::Hardware`, seen from the root of its crate.
    pub ty: String,
    /// Its crate; else that of the simulated robot.
    pub krate: Option<Crate>,
    /// What it is opened with, name and value, in the order of the file.
    pub settings: Vec<(String, String)>,
    /// The key in the text, in bytes.
    pub span: Range<usize>,
}

/// The Rust crate of a toolbox or of the robot, as far as it is said.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Crate {
    /// The name of its package; else that of the manifest.
    pub package: Option<String>,
    /// Where it comes from; else from the nearest folder around the toolbox file that has a
    /// manifest.
    pub origin: Option<Origin>,
    /// The module in it that has `templates` beside the types that implement them; else its root.
    pub module: Option<String>,
}

/// A machine that runs plans, where it differs from the built-in one of its name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Target {
    pub name: String,
    /// The grain of its time in nanoseconds, more than 0.
    pub tick: Option<u64>,
    /// The share of the processor that a plan may ask for, more than 0 and at most 1.
    pub capacity: Option<f64>,
    /// How many times as long as the toolboxes declare a poll takes, more than 0.
    pub slowdown: Option<f64>,
    /// What one poll takes at most in nanoseconds, by toolbox and template.
    pub budgets: BTreeMap<String, BTreeMap<String, u64>>,
}
