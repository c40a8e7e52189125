//! New projects as files: a plan for the Carbot, a toolbox, a robot, or a robot made of parts.
//!
//! Each project can be checked, run and tested without changes. Nothing here writes a file: the
//! command line and editors do.

mod manifest;
mod name;

use afp_project::Origin;
use afp_run::RunError;

use name::Names;

/// The kinds of projects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A plan for the Carbot, with a world and scenarios.
    Plan,
    /// A toolbox with its own crate, for the Carbot, and a plan that uses it.
    Toolbox,
    /// A simulated robot with its toolbox, and a plan for it.
    Robot,
    /// A robot made of parts, and a plan for it.
    Carbot,
    /// A robot made of parts at the pins of a Raspberry Pi, and a plan for it.
    Pi,
    /// A Waveshare UGV, and a plan for it.
    Ugv,
    /// A PiCar-X, and a plan for it.
    PicarX,
}

impl Kind {
    pub fn of_profile(name: &str) -> Option<Kind> {
        match name {
            "carbot" => Some(Kind::Carbot),
            "pi" => Some(Kind::Pi),
            "ugv" => Some(Kind::Ugv),
            "picarx" => Some(Kind::PicarX),
            _ => None,
        }
    }

    /// Whether the project contains Rust.
    pub fn has_crate(self) -> bool {
        matches!(self, Kind::Toolbox | Kind::Robot)
    }

    /// Whether the project describes a real robot.
    pub fn has_profile(self) -> bool {
        matches!(self, Kind::Carbot | Kind::Pi | Kind::Ugv | Kind::PicarX)
    }
}

/// A file of a project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its path below the project's folder, with '/'.
    pub path: String,
    pub text: String,
}

/// A template of a file: path and text, with names in double braces.
type Draft = (&'static str, &'static str);

macro_rules! drafts {
    ($kind:literal: $($path:literal from $file:literal),* $(,)?) => {
        &[$(($path, include_str!(concat!("../../../projects/", $kind, "/", $file)))),*]
    };
}

const PLAN: &[Draft] = drafts! { "plan":
    "afp.toml" from "afp.toml",
    "plans/{{name}}.afp" from "plan.afp",
    "plans/tests/{{name}}.afp" from "scenarios.afp",
    "worlds/{{name}}.toml" from "world.toml",
};

const CARBOT: &[Draft] = drafts! { "carbot":
    "afp.toml" from "afp.toml",
    "plans/{{name}}.afp" from "../plan/plan.afp",
    "plans/tests/{{name}}.afp" from "../plan/scenarios.afp",
    "worlds/{{name}}.toml" from "../plan/world.toml",
};

const PI: &[Draft] = drafts! { "pi":
    "afp.toml" from "afp.toml",
    "plans/{{name}}.afp" from "../plan/plan.afp",
    "plans/tests/{{name}}.afp" from "../plan/scenarios.afp",
    "worlds/{{name}}.toml" from "../plan/world.toml",
};

const PICARX: &[Draft] = drafts! { "picarx":
    "afp.toml" from "afp.toml",
    "plans/{{name}}.afp" from "plan.afp",
    "plans/tests/{{name}}.afp" from "scenarios.afp",
    "worlds/{{name}}.toml" from "world.toml",
};

const UGV: &[Draft] = drafts! { "ugv":
    "afp.toml" from "afp.toml",
    "plans/{{name}}.afp" from "plan.afp",
    "plans/tests/{{name}}.afp" from "scenarios.afp",
    "worlds/{{name}}.toml" from "../plan/world.toml",
};

const TOOLBOX: &[Draft] = drafts! { "toolbox":
    "afp.toml" from "afp.toml",
    "{{name}}.afp" from "toolbox.afp",
    "src/lib.rs" from "lib.rs",
    "plans/{{name}}_plan.afp" from "plan.afp",
    "plans/tests/{{name}}.afp" from "scenarios.afp",
    "tests/scenarios.rs" from "scenarios.rs",
};

const ROBOT: &[Draft] = drafts! { "robot":
    "afp.toml" from "afp.toml",
    "{{name}}.afp" from "toolbox.afp",
    "src/lib.rs" from "lib.rs",
    "src/sim.rs" from "sim.rs",
    "src/work.rs" from "work.rs",
    "floors/room.txt" from "room.txt",
    "plans/{{name}}_plan.afp" from "plan.afp",
    "plans/tests/{{name}}.afp" from "scenarios.afp",
    "tests/scenarios.rs" from "scenarios.rs",
};

/// The files of a new project with that name. `afp` is the source of the afp crates in its
/// manifest; a path is that of the checkout.
///
/// # Errors
/// The name is not valid for files, a crate and a plan.
pub fn files(name: &str, kind: Kind, afp: &Origin) -> Result<Vec<File>, RunError> {
    let names = Names::new(name)?;
    let drafts = match kind {
        Kind::Plan => PLAN,
        Kind::Toolbox => TOOLBOX,
        Kind::Robot => ROBOT,
        Kind::Carbot => CARBOT,
        Kind::Pi => PI,
        Kind::Ugv => UGV,
        Kind::PicarX => PICARX,
    };
    let file = |(path, text): &Draft| File { path: names.fill(path), text: names.fill(text) };
    let mut files: Vec<_> = drafts.iter().map(file).collect();
    let add = |path: &str, text: String| File { path: path.to_owned(), text };
    files.push(add(".gitignore", "target/\n".to_owned()));
    if kind.has_crate() {
        files.push(add("Cargo.toml", manifest::text(&names.name, kind, afp)));
    }
    Ok(files)
}

#[cfg(test)]
mod tests;
