//! `afpc check`: everything that is wrong with plans and toolboxes.

use afp_run::{EXIT_FAILED, EXIT_OK, EXIT_USAGE, RunError};
use clap::Args;

use super::print;
use crate::plan_file::{NoPlan, PlanFile};

/// Arguments of `afpc check`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Files to check; FILE:Plan for another than its first plan
    #[arg(value_name = "FILE", required = true)]
    files: Vec<String>,

    /// Prints one JSON object for each diagnostic on standard output
    #[arg(long)]
    json: bool,

    /// Prints what is known of timing (comes with the checks of time)
    #[arg(long)]
    timing: bool,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc check plans/wall_following.afp
  afpc check plans/*.afp --json";

/// Checks all files; the worst exit code wins.
///
/// # Errors
/// An option that is not there yet, a closed standard output.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    if arguments.timing {
        let message = "'--timing' waits for the checks of time";
        return Err(RunError::usage(message, "'afpc check FILE' does all other checks").into());
    }
    let mut code = EXIT_OK;
    for name in &arguments.files {
        code = code.max(check(name, arguments.json)?);
    }
    debug_assert!(code < EXIT_USAGE);
    Ok(code)
}

fn check(name: &str, json: bool) -> Result<u8, NoPlan> {
    let file = match PlanFile::read(name) {
        Ok(file) => file,
        // The other files are still worth checking.
        Err(error) => {
            error.report();
            return Ok(EXIT_FAILED);
        }
    };
    let compiled = &file.compiled;
    match json {
        true => {
            print(&compiled.diags.json_lines(&compiled.sources))?;
        }
        false if compiled.diags.is_empty() => {}
        false => anstream::eprintln!("{}", compiled.render(true)),
    }
    if compiled.diags.has_errors() {
        return Ok(EXIT_FAILED);
    }
    if !json {
        print(&format!("{}: no errors\n", file.path.display()))?;
    }
    Ok(EXIT_OK)
}
