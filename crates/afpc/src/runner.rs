//! Runners: this program with a robot and toolboxes of one's own linked in.
//!
//! A plan is interpreted, but robots and templates are Rust. So the first command that runs a plan of a project with
//! a robot or toolboxes of its own builds such a program, keeps it, and becomes it; later ones become it at
//! once, until something that it was built from changes. Arguments, exit code, terminal and signals
//! are those of the one process.

mod folder;
mod fresh;

use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use afp_codegen::{RunnerOptions, runner_files};
use afp_dsl::graph::Graph;
use afp_project::{CrateLink, ProjectFile, RobotLink};
use afp_run::{RunError, hash, say};

use crate::cargo::{self, Blame, Job};
use crate::plan_file::NoPlan;
use crate::toolboxes::{OwnToolbox, OwnToolboxes};
use crate::{Linked, crate_folder, origin};

/// Comes back when this program has the robot and the toolboxes of all of these plans; otherwise builds, if need be,
/// the one runner that has them, and goes on as that, with the arguments of this process.
///
/// # Errors
/// A robot or a toolbox without a crate, two robots, two toolboxes of one name, no cargo, a crate that does not
/// build, a file that cannot be written.
pub fn become_one_for<'a>(
    plans: impl IntoIterator<Item = (&'a OwnToolboxes, &'a Graph)>,
    linked: &Linked<'_>,
) -> Result<(), NoPlan> {
    let mut parts: Option<Parts<'a>> = None;
    for (own, graph) in plans {
        let (robot, toolboxes) = (own.project.robot()?, own.used_by(graph)?);
        let parts = parts.get_or_insert_with(|| Parts::new(&own.project, robot.clone()));
        parts.add(robot.as_ref(), toolboxes)?;
    }
    parts.map_or(Ok(()), |parts| parts.become_one(linked))
}

/// Comes back when this program has the robot of a project; otherwise goes on as one that has.
///
/// # Errors
/// As [`become_one_for`].
pub fn become_one_of(project: &ProjectFile, linked: &Linked<'_>) -> Result<(), NoPlan> {
    Parts::new(project, project.robot()?).become_one(linked)
}

/// What a runner links in.
struct Parts<'a> {
    project: &'a ProjectFile,
    robot: Option<RobotLink>,
    toolboxes: Vec<OwnToolbox>,
}

impl<'a> Parts<'a> {
    fn new(project: &'a ProjectFile, robot: Option<RobotLink>) -> Self {
        Parts { project, robot, toolboxes: Vec::new() }
    }

    /// Adds the toolboxes of a plan for a robot.
    fn add(
        &mut self,
        robot: Option<&RobotLink>,
        toolboxes: Vec<OwnToolbox>,
    ) -> Result<(), RunError> {
        if self.robot.as_ref() != robot {
            let name = |robot: Option<&RobotLink>| {
                robot.map_or("the Carbot".to_owned(), |robot| format!("'{}'", robot.rust_type()))
            };
            let (one, other) = (name(self.robot.as_ref()), name(robot));
            return Err(RunError::usage(
                format!("these plans are for two robots: {one} and {other}"),
                "run those of each project apart",
            ));
        }
        for toolbox in toolboxes {
            match self.toolboxes.iter().find(|known| known.name == toolbox.name) {
                None => self.toolboxes.push(toolbox),
                Some(known) if known.krate == toolbox.krate => {}
                Some(known) => return Err(two_of_one_name(known, &toolbox)),
            }
        }
        Ok(())
    }

    /// Comes back when this program has all of it; otherwise goes on as one that has.
    fn become_one(mut self, linked: &Linked<'_>) -> Result<(), NoPlan> {
        let robot = self.robot.as_ref().map(RobotLink::rust_type);
        let has = |own: &OwnToolbox| linked.toolboxes.contains(&&*own.name);
        if robot.as_deref() == linked.own_robot && self.toolboxes.iter().all(has) {
            return Ok(());
        }
        if linked.is_runner() {
            let message = format!("this runner was built for other parts than {}", self.names());
            return Err(RunError::usage(message, "start 'afpc' instead").into());
        }
        // The same runner whatever the order of the plans.
        self.toolboxes.sort_by(|one, other| one.name.cmp(&other.name));
        let runner = Runner::new(&self)?;
        let program = match fresh::program(&runner.folder, &self.manifests()) {
            Some(program) => program,
            None => runner.build(&self)?,
        };
        Err(turn_into(&program).into())
    }

    fn crates(&self) -> impl Iterator<Item = &CrateLink> {
        let robot = self.robot.iter().map(|robot| &robot.krate);
        self.toolboxes.iter().map(|own| &own.krate).chain(robot)
    }

    /// What a runner is built from beside Rust: the manifests of its crates.
    fn manifests(&self) -> Vec<PathBuf> {
        let folders = self.crates().filter_map(|krate| krate.folder.as_ref());
        folders.map(|folder| folder.join("Cargo.toml")).collect()
    }

    /// `the toolbox 'a'`, `the robot 'b' with the toolboxes 'c' and 'd'`.
    fn names(&self) -> String {
        let names: Vec<_> = self.toolboxes.iter().map(|own| format!("'{}'", own.name)).collect();
        let toolboxes = match names.as_slice() {
            [] => String::new(),
            [one] => format!("the toolbox {one}"),
            _ => format!("the toolboxes {}", names.join(" and ")),
        };
        let robot = self.robot.as_ref().map(|robot| format!("the robot '{}'", robot.rust_type()));
        match (robot, toolboxes.is_empty()) {
            (None, _) => toolboxes,
            (Some(robot), true) => robot,
            (Some(robot), false) => format!("{robot} with {toolboxes}"),
        }
    }
}

fn two_of_one_name(one: &OwnToolbox, other: &OwnToolbox) -> RunError {
    let (path, another) = (&one.source.name, &other.source.name);
    RunError::usage(
        format!("'{path}' and '{another}' are two toolboxes called '{}'", one.name),
        "one program cannot have both: run what uses them apart",
    )
}

/// A runner and where it is kept.
struct Runner {
    options: RunnerOptions,
    folder: PathBuf,
    /// Where cargo builds.
    target: PathBuf,
}

impl Runner {
    fn new(parts: &Parts<'_>) -> Result<Runner, RunError> {
        let mut options = RunnerOptions {
            package: String::new(),
            origin: origin::of_afp(parts.project)?,
            robot: parts.robot.as_ref().map(RobotLink::rust_type),
            toolboxes: Vec::new(),
            dependencies: parts.crates().map(origin::dependency).collect(),
        };
        for own in &parts.toolboxes {
            options.toolboxes.push((own.name.clone(), own.krate.rust_path()));
        }
        let inputs = hash(&format!("{} {options:?}", env!("CARGO_PKG_VERSION")));
        options.package = format!("afp-runner-{inputs}");
        let below = Path::new("runner").join(&inputs);
        let folder::Folder { kept, build } = folder::find(&parts.project.folder, &below)?;
        Ok(Runner { options, folder: kept.join(below), target: build })
    }

    fn build(&self, parts: &Parts<'_>) -> Result<PathBuf, NoPlan> {
        let names = parts.names();
        let no_cargo = RunError::Missing {
            message: format!(
                "the plan needs {names}, whose Rust has to be built first: there is no cargo"
            ),
            help:
                "install Rust from https://rustup.rs, then run the same command again; plans that \
                   use built-in toolboxes alone run without it"
                    .to_owned(),
        };
        let files = runner_files(&self.options).map_err(|path| {
            RunError::usage(format!("'{path}' is no path of a module"), "mend 'module' in afp.toml")
        })?;
        let texts: Vec<_> = files.iter().map(|(path, text)| (&**path, &**text)).collect();
        crate_folder::write(&self.folder, &texts, &self.options.origin)?;
        say(format_args!("building a runner for {names} (once) ..."));
        let begun = fresh::begin(&self.folder)?;
        let built = cargo::build(Job {
            folder: &self.folder,
            target: Some(&self.target),
            toolchain: None,
            blame: Blame { generated: None, toolboxes: &parts.toolboxes },
            no_cargo,
        })?;
        let program = built.ok_or(NoPlan::Wrong)?;
        fresh::done(&self.folder, &program, begun)?;
        Ok(program)
    }
}

/// Goes on as another program with the same arguments; comes back only when that fails.
#[cfg(unix)]
fn turn_into(program: &Path) -> RunError {
    use std::os::unix::process::CommandExt;
    let error = Command::new(program).args(arguments()).exec();
    RunError::file("cannot start", program)(error)
}

/// Runs another program with the same arguments to its end, and ends as it ends.
#[cfg(not(unix))]
fn turn_into(program: &Path) -> RunError {
    match Command::new(program).args(arguments()).status() {
        Ok(status) => std::process::exit(status.code().unwrap_or(1)),
        Err(error) => RunError::file("cannot start", program)(error),
    }
}

fn arguments() -> impl Iterator<Item = OsString> {
    env::args_os().skip(1)
}
