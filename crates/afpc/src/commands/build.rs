//! `afpc build`: generates a readable Rust crate from a plan and builds its binary.

use std::path::{Path, PathBuf};

use afp_build::cargo::{self, Artifact, Blame, Generated, Job};
use afp_build::{crate_folder, no_hardware, origin};
use afp_codegen::{CrateFile, CrateOptions, Hardware, crate_files};
use afp_dsl::graph::Graph;
use afp_project::{HardwareLink, RobotLink};
use afp_run::{EXIT_OK, RunError, say};
use afp_toolboxes::project::OwnToolbox;
use clap::Args;
use serde_json::{Value, json};

use super::{name_of, print};
use crate::no_plan::NoPlan;
use crate::plan_file::{PlanArgument, PlanFile};
use crate::reader::Reader;
use crate::targets;
use crate::toolchain::{self, Machine};

/// Arguments of `afpc build`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    plan: PlanArgument,

    /// The machine for the binary
    #[arg(long, default_value = "host")]
    target: Machine,

    /// Folder for the crate [default: target/afp/<plan>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Generate only a library, without the simulation program
    #[arg(long)]
    lib: bool,

    /// Link the hardware robot, too, for '--robot hardware' [default: only for the Raspberry Pi, if
    /// the project has '[robot.hardware]']
    #[arg(long, conflicts_with = "lib")]
    hardware: bool,
    /// Add the option '--live', which lets others watch a run
    #[arg(long, conflicts_with = "lib")]
    live: bool,

    /// Print each error, warning and note, then the result, as JSON objects
    #[arg(long)]
    json: bool,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc build plans/wall_following.afp
  $(afpc build plans/wall_following.afp) --seed 7
  afpc build plans/wall_following.afp --target pi
  afpc build plans/wall_following.afp -o wall --lib
  $(afpc build plans/wall_following.afp --live) --live
  afpc build plans/wall_following.afp --json

The last line on standard output is the absolute path of the binary (with --lib, of the crate);
with --json it is an object with the summary: plan, whether it was built, folder and binary.
Generated manifests take the afp crates from the checkout that built afpc; [afp] path, git or
version in afp.toml change this.";

/// The default folder for builds.
const BUILDS: &str = "target/afp";

/// The results so far.
#[derive(Default)]
struct Made {
    plan: Option<String>,
    folder: Option<PathBuf>,
    binary: Option<PathBuf>,
}

/// Generates and builds the crate.
///
/// # Errors
/// The plan is invalid, the folder cannot be written, cargo is missing, cargo fails.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let (reader, mut made) = (Reader::of(arguments.json), Made::default());
    let code = match build(arguments, reader, &mut made) {
        Ok(()) => EXIT_OK,
        Err(why) => reader.end(why)?,
    };
    match reader {
        Reader::People => {
            let made = made.binary.or(made.folder).unwrap_or_default();
            print(&format!("{}\n", made.display()))?;
        }
        Reader::Tools => {
            print(&format!("{}\n", made.summary(code == EXIT_OK)))?;
        }
    }
    Ok(code)
}

fn build(arguments: &Arguments, reader: Reader, made: &mut Made) -> Result<(), NoPlan> {
    if arguments.target == Machine::Mcu {
        let message = "'--target mcu' is not available yet";
        let help = "name 'host', 'pi' or 'pi32'; 'mcu' comes with the microcontroller drivers";
        return Err(RunError::usage(message, help).into());
    }
    let (file, graph) = PlanFile::read(&arguments.plan.plan)?.checked_for(reader)?;
    made.plan = Some(graph.main().name.clone());
    is_fast_enough(arguments.target, &file, &graph, reader)?;
    let linux = arguments.target.linux();
    let shared = Path::new(BUILDS).join("build");
    let toolchain = linux.map(|linux| toolchain::find(linux, &shared.join("zig"))).transpose()?;
    let toolboxes = file.own.used_by(&graph)?;
    let stem = file.path.file_stem().unwrap_or("plan".as_ref());
    let folder = arguments.output.clone().unwrap_or_else(|| Path::new(BUILDS).join(stem));
    let files = generate(&file, &graph, &toolboxes, arguments, &folder)?;
    made.folder = Some(whole(folder.clone()));
    let no_cargo = RunError::Missing {
        message: "cargo, which builds the crate, is not installed".to_owned(),
        help:
            "install Rust from https://rustup.rs; with only built-in toolboxes, 'afpc run' works without it"
                .to_owned(),
    };
    let generated = Generated { folder: &folder, files: &files, sources: &file.compiled.sources };
    let object = |object: &Value| match print(&format!("{object}\n")) {
        Err(NoPlan::File(error)) => Err(error),
        _ => Ok(()),
    };
    let built = cargo::build(Job {
        folder: &folder,
        caller: None,
        // Plans in the same folder share compiled dependencies.
        target: arguments.output.is_none().then_some(&*shared),
        toolchain: toolchain.as_ref(),
        artifact: Artifact::Program,
        blame: Blame { generated: Some(generated), toolboxes: &toolboxes },
        no_cargo,
        tools: (reader == Reader::Tools).then_some(&object),
    })?;
    made.binary = built.artifact.map(whole);
    Ok(())
}

/// Writes the crate of a plan.
fn generate(
    file: &PlanFile,
    graph: &Graph,
    toolboxes: &[OwnToolbox],
    arguments: &Arguments,
    folder: &Path,
) -> Result<Vec<CrateFile>, NoPlan> {
    let origin = origin::of_afp(&file.own.project)?;
    let hardware = hardware(arguments, file)?;
    let robot = file.own.project.robot()?;
    let crates = toolboxes.iter().map(|own| &own.krate);
    let crates = crates.chain(robot.iter().map(|robot| &robot.krate));
    let crates = crates.chain(hardware.iter().map(|itself| &itself.krate));
    let options = CrateOptions {
        file: file.path.display().to_string(),
        texts: file.compiled.plan_texts(),
        toolboxes: file
            .own
            .texts()
            .map(|(name, text)| (name.to_owned(), text.to_owned()))
            .collect(),
        project: file.own.project.text.clone(),
        origin: origin.clone(),
        dependencies: crates.map(origin::dependency).collect(),
        robot: robot.as_ref().map(RobotLink::rust_type),
        hardware: hardware
            .as_ref()
            .map(|it| Hardware { ty: it.rust_type(), settings: it.settings.clone() }),
        features: arguments.live.then(|| "live".to_owned()).into_iter().collect(),
        lib: arguments.lib,
    };
    let files = crate_files(graph, &options);
    let texts: Vec<_> = files.iter().map(|file| (&*file.path, &*file.text)).collect();
    match arguments.output {
        None => crate_folder::write_own(folder, &texts, &origin)?,
        Some(_) => crate_folder::write(folder, &texts, &origin)?,
    }
    say(format_args!("generated {}", folder.display()));
    Ok(files)
}

/// The hardware robot, if the program needs it.
fn hardware(arguments: &Arguments, file: &PlanFile) -> Result<Option<HardwareLink>, NoPlan> {
    let project = &file.own.project;
    let asked = arguments.hardware || (arguments.target.linux().is_some() && !arguments.lib);
    let itself = if asked { project.hardware().map_err(RunError::from)? } else { None };
    match itself {
        None if arguments.hardware => Err(no_hardware(project).into()),
        itself => Ok(itself),
    }
}

/// Checks that a machine is fast enough for the plan.
fn is_fast_enough(
    machine: Machine,
    file: &PlanFile,
    graph: &Graph,
    reader: Reader,
) -> Result<(), NoPlan> {
    let targets = targets::choose(&file.own.project.project, Some(&name_of(&machine)))?;
    let diags = targets::check(graph, &file.own, &targets)?;
    reader.tell(&diags, &file.compiled.sources)?;
    if diags.has_errors() { Err(NoPlan::Wrong) } else { Ok(()) }
}

fn whole(path: PathBuf) -> PathBuf {
    std::path::absolute(&path).unwrap_or(path)
}

impl Made {
    /// The last line of `--json`.
    fn summary(&self, built: bool) -> Value {
        let text = |path: &Option<PathBuf>| path.as_ref().map(|path| path.display().to_string());
        let (folder, binary) = (text(&self.folder), text(&self.binary));
        json!({ "summary": { "plan": self.plan, "built": built, "folder": folder, "binary": binary } })
    }
}
