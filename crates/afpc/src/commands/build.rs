//! `afpc build`: a readable Rust crate from a plan, and the binary that it makes.

mod cargo;
mod folder;

use std::path::{Path, PathBuf};

use afp_dsl::codegen::{CrateOptions, Origin, crate_files};
use afp_dsl::graph::Graph;
use afp_run::RunError;
use afp_run::settings::{Afp, Settings};
use clap::{Args, ValueEnum};

use super::print;
use crate::cli::PlanArgument;
use crate::plan_file::{NoPlan, PlanFile};

/// Arguments of `afpc build`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    plan: PlanArgument,

    /// What the binary runs on
    #[arg(long, default_value = "host")]
    target: Target,

    /// Where the crate goes [default: target/afp/<plan>]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,

    /// Makes a library alone, without the program that runs the plan in simulation
    #[arg(long)]
    lib: bool,
}

/// What a binary runs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Target {
    /// This machine
    Host,
    /// Raspberry Pi, 64 bit (not in this release)
    Pi,
    /// Raspberry Pi, 32 bit (not in this release)
    Pi32,
    /// Cortex-M (not in this release)
    Mcu,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc build plans/wall_following.afp
  $(afpc build plans/wall_following.afp) --seed 7
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
    if arguments.target != Target::Host {
        let message = "'--target' builds only for 'host' in this release";
        let help = "the other targets come with the Raspberry Pi and microcontroller drivers";
        return Err(RunError::usage(message, help).into());
    }
    let (file, graph) = PlanFile::graph(&arguments.plan.plan)?;
    refuse_own_toolboxes(&graph)?;
    let here = file.path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let origin = origin(&Settings::find(here.unwrap_or(Path::new(".")))?)?;
    let stem = file.path.file_stem().unwrap_or("plan".as_ref());
    let folder = arguments.output.clone().unwrap_or_else(|| Path::new(BUILDS).join(stem));
    let options = CrateOptions {
        file: file.path.display().to_string(),
        texts: file.compiled.plan_texts(),
        origin: origin.clone(),
        dependencies: Vec::new(),
        lib: arguments.lib,
    };
    folder::write(&folder, &crate_files(&graph, &options), &origin)?;
    anstream::eprintln!("generated {}", folder.display());
    // Plans beside one another share what they are built from.
    let shared = arguments.output.is_none().then(|| Path::new(BUILDS).join("build"));
    let binary = cargo::build(&folder, shared.as_deref())?;
    let made = binary.unwrap_or(folder);
    let made = std::path::absolute(&made).unwrap_or(made);
    print(&format!("{}\n", made.display()))
}

fn refuse_own_toolboxes(graph: &Graph) -> Result<(), RunError> {
    let built_in = |name: &str| afp_toolboxes::ALL.iter().any(|toolbox| toolbox.name == name);
    match graph.toolboxes.iter().find(|toolbox| !built_in(&toolbox.name)) {
        None => Ok(()),
        Some(toolbox) => Err(RunError::usage(
            format!("'afpc build' cannot link the toolbox '{}'", toolbox.name),
            "crates for toolboxes of one's own come with a later release",
        )),
    }
}

/// Where the manifest takes the `afp` crates from.
fn origin(settings: &Settings) -> Result<Origin, RunError> {
    let Some(Afp { path, git, version }) = &settings.afp else { return checkout() };
    match (path, git, version) {
        (Some(path), None, None) => {
            Ok(Origin::Path(settings.folder.join(path).display().to_string()))
        }
        (None, Some(git), None) => Ok(Origin::Git(git.clone())),
        (None, None, Some(version)) => Ok(Origin::Version(version.clone())),
        _ => Err(RunError::usage(
            "'[afp]' in afp.toml wants exactly one of 'path', 'git' and 'version'",
            "path = \"../afp\" takes the crates from a checkout",
        )),
    }
}

/// The checkout that built this program.
fn checkout() -> Result<Origin, RunError> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2);
    match root.filter(|root| root.join("crates/afp/Cargo.toml").is_file()) {
        Some(root) => Ok(Origin::Path(root.display().to_string())),
        None => Err(RunError::Missing {
            message: concat!(
                "the checkout that afpc was built from is no longer at '",
                env!("CARGO_MANIFEST_DIR"),
                "/../..'"
            )
            .to_owned(),
            help: "say where the afp crates are: '[afp] path = \"...\"' in afp.toml".to_owned(),
        }),
    }
}
