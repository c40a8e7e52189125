//! `afpc build`: a readable Rust crate from a plan, and the binary that it makes.

use std::path::{Path, PathBuf};

use afp_build::cargo::{self, Artifact, Blame, Generated, Job};
use afp_build::{crate_folder, origin};
use afp_codegen::{CrateOptions, crate_files};
use afp_dsl::graph::Graph;
use afp_dsl::timing::check_target;
use afp_project::RobotLink;
use afp_run::{RunError, say};
use afp_syntax::diagnostics::Diagnostics;
use clap::Args;

use super::print;
use crate::cli::PlanArgument;
use crate::plan_file::{NoPlan, PlanFile};
use crate::targets;
use crate::toolchain::{self, Machine};

/// Arguments of `afpc build`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    plan: PlanArgument,

    /// What the binary runs on
    #[arg(long, default_value = "host")]
    target: Machine,

    /// Where the crate goes [default: target/afp/<plan>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Makes a library alone, without the program that runs the plan in simulation
    #[arg(long)]
    lib: bool,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc build plans/wall_following.afp
  $(afpc build plans/wall_following.afp) --seed 7
  afpc build plans/wall_following.afp --target pi
  afpc build plans/wall_following.afp -o wall --lib

The last line on standard output is the absolute path of the binary (with --lib, of the crate).
Generated manifests take the afp crates from the checkout that built afpc; [afp] path, git or
version in afp.toml says otherwise.";

/// Where plans are built unless told otherwise.
const BUILDS: &str = "target/afp";

/// Generates and builds.
///
/// # Errors
/// The plan is wrong, the folder cannot be written, there is no cargo, cargo fails.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    if arguments.target == Machine::Mcu {
        let message = "'--target mcu' is not in this release";
        let help = "name 'host', 'pi' or 'pi32'; 'mcu' comes with the microcontroller drivers";
        return Err(RunError::usage(message, help).into());
    }
    let (file, graph) = PlanFile::graph(&arguments.plan.plan)?;
    is_fast_enough(arguments.target, &file, &graph)?;
    let linux = arguments.target.linux();
    let build = Path::new(BUILDS).join("build");
    let toolchain = linux.map(|linux| toolchain::find(linux, &build.join("zig"))).transpose()?;
    let toolboxes = file.own.used_by(&graph)?;
    let origin = origin::of_afp(&file.own.project)?;
    let stem = file.path.file_stem().unwrap_or("plan".as_ref());
    let folder = arguments.output.clone().unwrap_or_else(|| Path::new(BUILDS).join(stem));
    let robot = file.own.project.robot()?;
    let crates = toolboxes.iter().map(|own| &own.krate);
    let crates = crates.chain(robot.iter().map(|robot| &robot.krate));
    let options = CrateOptions {
        file: file.path.display().to_string(),
        texts: file.compiled.plan_texts(),
        origin: origin.clone(),
        dependencies: crates.map(origin::dependency).collect(),
        robot: robot.as_ref().map(RobotLink::rust_type),
        lib: arguments.lib,
    };
    let files = crate_files(&graph, &options);
    let texts: Vec<_> = files.iter().map(|file| (&*file.path, &*file.text)).collect();
    crate_folder::write(&folder, &texts, &origin)?;
    say(format_args!("generated {}", folder.display()));
    // Plans beside one another share what they are built from.
    let shared = arguments.output.is_none().then_some(build);
    let no_cargo = RunError::Missing {
        message: "there is no cargo to build the crate with".to_owned(),
        help:
            "install Rust from https://rustup.rs; with built-in toolboxes alone, 'afpc run' works \
               without it"
                .to_owned(),
    };
    let generated = Generated { folder: &folder, files: &files, sources: &file.compiled.sources };
    let binary = cargo::build(Job {
        folder: &folder,
        target: shared.as_deref(),
        toolchain: toolchain.as_ref(),
        artifact: Artifact::Program,
        blame: Blame { generated: Some(generated), toolboxes: &toolboxes },
        no_cargo,
    })?;
    let made = binary.unwrap_or(folder);
    let made = std::path::absolute(&made).unwrap_or(made);
    print(&format!("{}\n", made.display()))
}

/// Checks that a machine has the time that the plan needs.
fn is_fast_enough(machine: Machine, file: &PlanFile, graph: &Graph) -> Result<(), NoPlan> {
    let mut diags = Diagnostics::default();
    for target in targets::choose(&file.own.project.project, Some(machine.name()))? {
        diags.extend(check_target(graph, &target));
    }
    if !diags.is_empty() {
        say(diags.render(&file.compiled.sources, true));
    }
    if diags.has_errors() { Err(NoPlan::Wrong) } else { Ok(()) }
}
