//! `afpc new`: creates a working project.

mod files;

use std::fs;
use std::path::{Path, PathBuf};

use afp_build::{crate_folder, origin};
use afp_codegen::Origin;
use afp_excerpt::words::{instead, shell_file};
use afp_project::{PROFILES, ProjectFile};
use afp_run::{EXIT_OK, RunError, write_whole};
use clap::Args;

use super::print;
use crate::no_plan::NoPlan;
use files::Kind;

/// Arguments of `afpc new`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// New folder for the project; its name becomes the project's name
    #[arg(value_name = "NAME")]
    folder: PathBuf,

    /// Add a toolbox for the Carbot, in Rust
    #[arg(long, conflicts_with = "robot")]
    toolbox: bool,

    /// Add a robot, in Rust: its toolbox and its simulation
    #[arg(long)]
    robot: bool,

    /// Describe a real robot without Rust: 'carbot', 'pi', 'ugv' or 'picarx'
    #[arg(long, value_name = "NAME", conflicts_with_all = ["robot", "toolbox"])]
    profile: Option<String>,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc new patrol
  afpc new greeter --toolbox
  afpc new rover --robot
  afpc new mycar --profile carbot";

/// Creates the project.
///
/// # Errors
/// The name is invalid, the folder exists, a file cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let kind = kind(arguments)?;
    let folder = &arguments.folder;
    // '.' and '..' get the name of the folder that they lead to.
    let whole = folder.canonicalize().ok().filter(|_| folder.file_name().is_none());
    let whole = whole.as_ref().unwrap_or(folder);
    let name = whole.file_name().unwrap_or_default().to_string_lossy();
    // A plan needs no crate, and therefore no path to the afp crates.
    let afp = match kind {
        kind if !kind.has_crate() => Origin::Version(env!("CARGO_PKG_VERSION").to_owned()),
        _ => origin::of_afp(&around(folder)?)?,
    };
    let files = files::files(&name, kind, &origin::as_written(afp.clone()))?;
    let is_there = folder.symlink_metadata().is_ok();
    // An empty folder is allowed. An unreadable folder is an error.
    if is_there && fs::read_dir(folder).map_or(true, |mut entries| entries.next().is_some()) {
        let message = format!("'{}' already exists and is not empty", folder.display());
        let help = "write the name of a new folder, such as 'afpc new patrol'";
        return Err(RunError::usage(message, help).into());
    }
    if let Err(why) = write(folder, &files) {
        // Half a project would block the next try. The first error is reported.
        if !is_there {
            let _ = fs::remove_dir_all(folder);
        }
        return Err(why.into());
    }
    let pinned = if kind.has_crate() { crate_folder::pin(folder, &afp)? } else { None };
    print(&next(folder, &files, pinned, kind))?;
    Ok(EXIT_OK)
}

/// The kind of the project.
///
/// # Errors
/// There is no such profile.
fn kind(arguments: &Arguments) -> Result<Kind, RunError> {
    let Some(name) = &arguments.profile else {
        return Ok(match (arguments.toolbox, arguments.robot) {
            (true, _) => Kind::Toolbox,
            (_, true) => Kind::Robot,
            _ => Kind::Plan,
        });
    };
    Kind::of_profile(name).ok_or_else(|| {
        let help = instead(name, PROFILES.iter().map(|profile| profile.name));
        RunError::usage(format!("no profile '{name}'"), help)
    })
}

/// Writes the files below a folder, and creates the folder.
fn write(folder: &Path, files: &[files::File]) -> Result<(), RunError> {
    for file in files {
        let path = folder.join(&file.path);
        let parent = path.parent().unwrap_or(folder);
        fs::create_dir_all(parent).map_err(RunError::file("cannot make the folder", parent))?;
        write_whole("cannot write", &path, &file.text)?;
    }
    Ok(())
}

/// The project around a new folder, which may define the path of the afp crates.
fn around(folder: &Path) -> Result<ProjectFile, RunError> {
    let folder = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    Ok(ProjectFile::find(folder.parent().unwrap_or(&folder))?)
}

/// The list of new files and the next commands.
fn next(folder: &Path, files: &[files::File], pinned: Option<&str>, kind: Kind) -> String {
    let is_plan = |path: &str| path.starts_with("plans/") && !path.starts_with("plans/tests/");
    let plan = files.iter().find(|file| is_plan(&file.path)).map_or("", |file| &file.path);
    let paths = files.iter().map(|file| &*file.path).chain(pinned);
    let mut text: String = paths.map(|path| format!("{}\n", folder.join(path).display())).collect();
    let folder = shell_file(&folder.display().to_string());
    text += &format!("\nNext:\n  cd {folder}\n  afpc run {plan}\n  afpc test\n");
    if kind.has_crate() {
        text += "  cargo test\n";
    }
    if kind.has_profile() {
        text += &format!("  afpc run {plan} --robot hardware\n");
    }
    text
}
