//! Runners: this program with toolboxes of one's own linked in.
//!
//! A plan is interpreted, but its templates are Rust. So the first command that runs a plan with a
//! toolbox of the project builds such a program, keeps it, and becomes it; later ones become it at
//! once, until something that it was built from changes. Arguments, exit code, terminal and signals
//! are those of the one process.

mod fresh;

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use afp_codegen::{RunnerOptions, runner_files};
use afp_dsl::graph::Graph;
use afp_project::ProjectFile;
use afp_run::{RunError, hash, say};

use crate::cargo::{self, Blame, Job};
use crate::plan_file::NoPlan;
use crate::toolboxes::{OwnToolbox, OwnToolboxes};
use crate::{Linked, crate_folder, origin};

/// Where runners are kept, below the project's folder or the user's cache.
const HOME: &str = "target/afp";

/// Comes back when this program has the toolboxes of all of these plans; otherwise builds, if need be,
/// the one runner that has them, and goes on as that, with the arguments of this process.
///
/// # Errors
/// A toolbox without a crate, two toolboxes of one name, no cargo, a crate that does not build, a file
/// that cannot be written.
pub fn become_one_for<'a>(
    plans: impl IntoIterator<Item = (&'a OwnToolboxes, &'a Graph)>,
    linked: &[Linked],
) -> Result<(), NoPlan> {
    let mut all: Vec<OwnToolbox> = Vec::new();
    let mut project = None;
    for (own, graph) in plans {
        for toolbox in own.used_by(graph)? {
            project = project.or(Some(&own.project));
            match all.iter().find(|known| known.name == toolbox.name) {
                None => all.push(toolbox),
                Some(known) if known.krate == toolbox.krate => {}
                Some(known) => return Err(two_of_one_name(known, &toolbox).into()),
            }
        }
    }
    // The same runner whatever the order of the plans.
    all.sort_by(|one, other| one.name.cmp(&other.name));
    project.map_or(Ok(()), |project| become_one_with(&all, linked, project))
}

fn two_of_one_name(one: &OwnToolbox, other: &OwnToolbox) -> RunError {
    let (path, another) = (&one.source.name, &other.source.name);
    RunError::usage(
        format!("'{path}' and '{another}' are two toolboxes called '{}'", one.name),
        "one program cannot have both: run what uses them apart",
    )
}

/// Comes back when this program has all of the toolboxes; otherwise goes on as one that has.
fn become_one_with(
    toolboxes: &[OwnToolbox],
    linked: &[Linked],
    project: &ProjectFile,
) -> Result<(), NoPlan> {
    let has = |own: &OwnToolbox| linked.iter().any(|known| known.toolbox == own.name);
    if toolboxes.iter().all(has) {
        return Ok(());
    }
    if !linked.is_empty() {
        let names = names(toolboxes);
        let message = format!("this runner was built for other toolboxes than {names}");
        return Err(RunError::usage(message, "start 'afpc' instead").into());
    }
    let runner = Runner::new(toolboxes, project)?;
    let program = match fresh::program(&runner.folder, &runner.manifests(toolboxes)) {
        Some(program) => program,
        None => runner.build(toolboxes)?,
    };
    Err(turn_into(&program).into())
}

/// A runner and where it is kept.
struct Runner {
    options: RunnerOptions,
    folder: PathBuf,
    /// Where cargo builds.
    target: PathBuf,
}

impl Runner {
    fn new(toolboxes: &[OwnToolbox], project: &ProjectFile) -> Result<Runner, RunError> {
        let mut options = RunnerOptions {
            package: String::new(),
            origin: origin::of_afp(project)?,
            toolboxes: Vec::new(),
            dependencies: Vec::new(),
        };
        for own in toolboxes {
            options.toolboxes.push((own.name.clone(), own.krate.rust_path()));
            options.dependencies.push(origin::dependency(&own.krate));
        }
        let inputs = hash(&format!("{} {options:?}", env!("CARGO_PKG_VERSION")));
        options.package = format!("afp-runner-{inputs}");
        let below = Path::new("runner").join(&inputs);
        let home = writable(&project.folder.join(HOME), &below)?;
        Ok(Runner { options, folder: home.join(below), target: home.join("build") })
    }

    /// What it is built from beside Rust: the manifests of its crates.
    fn manifests(&self, toolboxes: &[OwnToolbox]) -> Vec<PathBuf> {
        let folders = toolboxes.iter().filter_map(|own| own.krate.folder.as_ref());
        folders.map(|folder| folder.join("Cargo.toml")).collect()
    }

    fn build(&self, toolboxes: &[OwnToolbox]) -> Result<PathBuf, NoPlan> {
        let names = names(toolboxes);
        let no_cargo = RunError::Missing {
            message: format!(
                "the plan uses {names}, whose Rust has to be built first: there is no cargo"
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
            blame: Blame { generated: None, toolboxes },
            no_cargo,
        })?;
        let program = built.ok_or(NoPlan::Wrong)?;
        fresh::done(&self.folder, &program, begun)?;
        Ok(program)
    }
}

/// `the toolbox 'a'`, `the toolboxes 'a' and 'b'`.
fn names(toolboxes: &[OwnToolbox]) -> String {
    let names: Vec<_> = toolboxes.iter().map(|own| format!("'{}'", own.name)).collect();
    match names.as_slice() {
        [one] => format!("the toolbox {one}"),
        _ => format!("the toolboxes {}", names.join(" and ")),
    }
}

/// The project's folder if `below` can be made in it, else the user's cache.
fn writable(project: &Path, below: &Path) -> Result<PathBuf, RunError> {
    let folder = project.join(below);
    let Err(error) = fs::create_dir_all(&folder) else { return Ok(project.to_owned()) };
    let home = || Some(Path::new(&env::var_os("HOME")?).join(".cache"));
    let cache = env::var_os("XDG_CACHE_HOME").map(PathBuf::from).or_else(home);
    let cache = cache.map(|cache| cache.join("afp"));
    match cache.filter(|cache| fs::create_dir_all(cache.join(below)).is_ok()) {
        Some(cache) => Ok(cache),
        None => Err(RunError::file("cannot make the folder", &folder)(error)),
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
