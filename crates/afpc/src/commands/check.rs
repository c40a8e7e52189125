//! `afpc check`: reports all errors in plans and toolboxes.

mod toolbox;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use afp_dsl::Compiled;
use afp_dsl::files::normalised;
use afp_dsl::timing::{Target, timing};
use afp_run::{EXIT_FAILED, EXIT_OK, EXIT_USAGE};
use afp_syntax::diagnostics::{Code, Message};
use afp_syntax::source::Span;
use clap::Args;
use serde_json::json;

use super::print;
use crate::no_plan::NoPlan;
use crate::plan_file::{PlanFile, PlanText};
use crate::reader::Reader;
use crate::targets;
use toolbox::ToolboxFile;

/// Arguments of `afpc check`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Files to check; append ':Plan' to select a plan other than the first
    #[arg(value_name = "FILE", required = true)]
    files: Vec<String>,

    /// Print each error, warning and note as a JSON object
    #[arg(long)]
    json: bool,

    /// Print each supervisor's response and interruption bounds, and their parts
    #[arg(long)]
    timing: bool,

    /// Target: host, pi, pi32, mcu or a target of afp.toml [default: all of afp.toml]
    #[arg(long, value_name = "NAME")]
    target: Option<String>,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc check plans/wall_following.afp
  afpc check plans/*.afp --json
  afpc check plans/wall_following.afp --timing --target pi";

/// Checks all files; the worst exit code wins.
///
/// # Errors
/// An unknown target, a closed standard output.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let mut code = EXIT_OK;
    let mut told = HashSet::new();
    let reader = Reader::of(arguments.json);
    for name in &arguments.files {
        match check(name, arguments, &mut told) {
            Ok(one) => code = code.max(one),
            Err(why) => return reader.end(why),
        }
    }
    debug_assert!(code < EXIT_USAGE);
    Ok(code)
}

/// The diagnostics that were already printed: file, place, message.
type Told = HashSet<(PathBuf, Span, Code, Message)>;

fn check(name: &str, arguments: &Arguments, told: &mut Told) -> Result<u8, NoPlan> {
    let reader = Reader::of(arguments.json);
    // The check continues with the other files.
    let text = match PlanText::read(name) {
        Ok(text) => text,
        Err(error) => {
            reader.error(&error)?;
            return Ok(EXIT_FAILED);
        }
    };
    if let Some(file) = ToolboxFile::of(&text) {
        let (diags, sources) = (file.toolboxes.diagnostics(), file.toolboxes.sources());
        reader.tell(diags, sources)?;
        return conclude(diags.has_errors(), &file.path, arguments.json);
    }
    let mut file = match text.compile() {
        Ok(file) => file,
        Err(error) => {
            reader.error(&error)?;
            return Ok(EXIT_FAILED);
        }
    };
    let targets = targets::choose(&file.own.project.project, arguments.target.as_deref())?;
    let compiled = &mut file.compiled;
    if let Some(graph) = &compiled.graph {
        compiled.diags.extend(targets::check(graph, &file.own, &targets)?);
        compiled.diags.sort();
    }
    let wrong = compiled.diags.has_errors();
    // Several files can share an included file.
    if arguments.files.len() > 1 {
        leave_out_told(compiled, told);
    }
    reader.tell(&compiled.diags, &compiled.sources)?;
    if arguments.timing {
        show_timing(&file, &targets, arguments.json)?;
    }
    conclude(wrong, &file.path, arguments.json)
}

/// The exit code of one file; prints a summary for people.
fn conclude(wrong: bool, path: &Path, json: bool) -> Result<u8, NoPlan> {
    if wrong {
        return Ok(EXIT_FAILED);
    }
    if !json {
        print(&format!("{}: no errors\n", path.display()))?;
    }
    Ok(EXIT_OK)
}

fn leave_out_told(compiled: &mut Compiled, told: &mut Told) {
    let sources = &compiled.sources;
    compiled.diags.retain(|diagnostic| {
        let name = sources.get(diagnostic.span.file).map_or("", |source| &source.name);
        let path = std::path::absolute(normalised(name)).unwrap_or_else(|_| name.into());
        let place = Span { file: 0, ..diagnostic.span };
        told.insert((path, place, diagnostic.code, diagnostic.message().clone()))
    });
}

/// Prints a table for each target, or one table without a target. Prints nothing for a plan with
/// errors in names, types or flow: its timing is undefined.
fn show_timing(file: &PlanFile, targets: &[Target], json: bool) -> Result<(), NoPlan> {
    let Some(graph) = &file.compiled.graph else { return Ok(()) };
    let path = file.path.display();
    let all = match targets {
        [] => vec![None],
        some => some.iter().map(Some).collect(),
    };
    for target in all {
        let timing = timing(graph, target);
        let name = target.map(|target| target.name.as_str());
        if json {
            let line = json!({ "file": path.to_string(), "target": name, "timing": timing.json() });
            print(&format!("{line}\n"))?;
            continue;
        }
        let on = match target {
            Some(target) => format!("target '{}'", target.name),
            None => {
                "no target: ticks and capacity are not checked; name one with '--target', or add \
                 '[target.NAME]' to afp.toml"
                    .to_owned()
            }
        };
        print(&format!("{path}: timing of '{}', {on}\n\n{}\n", timing.plan, timing.text()))?;
    }
    Ok(())
}
