//! `afpc graph`: the drawing of a plan.

use std::path::{Path, PathBuf};

use afp_dsl::draw::{self, Options};
use afp_dsl::toolbox::Toolbox;
use afp_run::{EXIT_OK, RunError, write_whole};
use clap::{Args, ValueEnum};

use super::print;
use crate::cli::PlanArgument;
use crate::plan_file::{NoPlan, PlanFile};

/// Arguments of `afpc graph`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    plan: PlanArgument,

    /// Where the drawing goes [default: standard output]
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Its format [default: as the file's name says, else svg]
    #[arg(long)]
    format: Option<Format>,
}

/// How a plan is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// The paper's notation, for browsers and papers
    Svg,
    /// The same as pixels (not in this release)
    Png,
    /// For GraphViz
    Dot,
    /// The checked graph, for programs
    Json,
    /// State Chart XML (not in this release)
    Scxml,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc graph plans/wall_following.afp -o plan.svg
  afpc graph plans/wall_following.afp --format json
  afpc graph plans/wall_following.afp --format dot | dot -Tpdf -o plan.pdf";

/// Draws a plan.
///
/// # Errors
/// The plan is wrong, the format is not there, the file cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let format = format(arguments)?;
    let (file, graph) = PlanFile::graph(&arguments.plan.plan)?;
    let icons = |toolbox: &Toolbox, name: &str| icon(toolbox, name);
    let options = Options {
        sources: Some(&file.compiled.sources),
        icons: Some(&icons),
        ..Options::default()
    };
    let text = match format {
        Format::Json => draw::json(&graph, &options),
        Format::Dot => draw::dot(&graph, &options),
        _ => draw::svg(&graph, &options),
    };
    match &arguments.output {
        Some(path) => {
            write_whole("cannot write the drawing", path, &text)?;
            Ok(EXIT_OK)
        }
        None => print(&text),
    }
}

fn format(arguments: &Arguments) -> Result<Format, RunError> {
    let by_name = || {
        let extension = arguments.output.as_deref().and_then(Path::extension)?;
        Format::from_str(extension.to_str()?, true).ok()
    };
    match arguments.format.or_else(by_name).unwrap_or(Format::Svg) {
        Format::Png => Err(RunError::usage(
            "'--format png' is not in this release",
            "draw SVG and convert it: rsvg-convert plan.svg -o plan.png",
        )),
        Format::Scxml => Err(RunError::usage(
            "'--format scxml' is not in this release",
            "'--format json' holds the whole graph",
        )),
        format => Ok(format),
    }
}

/// The icon of a built-in toolbox. Icons of other toolboxes stand beside their files, which the
/// graph does not name.
fn icon(toolbox: &Toolbox, name: &str) -> Option<String> {
    let built_in = afp_toolboxes::ALL.iter().any(|each| each.name == toolbox.name);
    built_in.then(|| afp_toolboxes::icon(name)).flatten().map(str::to_owned)
}
