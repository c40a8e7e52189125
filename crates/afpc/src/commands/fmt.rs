//! `afpc fmt`: plans and toolboxes in canonical form.

use std::io::Read;
use std::path::Path;

use afp_dsl::files::read_text;
use afp_run::{EXIT_FAILED, EXIT_OK, RunError, say, write_whole};
use afp_syntax::source::{Source, Sources};
use clap::Args;
use similar::TextDiff;

use super::print;
use crate::nearby::unreadable;
use crate::no_plan::NoPlan;

/// Arguments of `afpc fmt`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Files to format in place; '-' formats standard input to standard output
    #[arg(value_name = "FILE", required = true)]
    files: Vec<String>,

    /// Print the changes without writing them; fail if there are any
    #[arg(long)]
    check: bool,
}

pub const EXAMPLES: &str = "\
Examples:
  afpc fmt plans/*.afp
  afpc fmt --check plans/*.afp
  afpc fmt - < plan.afp

Exit codes: 0 all files are formatted, 1 a file has syntax errors or cannot be read or written, or '--check' found a difference";

/// Formats all files; the worst exit code wins.
///
/// # Errors
/// Standard output is closed. An unreadable, invalid or read-only file is reported, and the other
/// files are still formatted.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let mut code = EXIT_OK;
    for name in &arguments.files {
        code = code.max(match one(name, arguments.check) {
            Ok(code) => code,
            Err(NoPlan::File(error)) => {
                error.report();
                EXIT_FAILED
            }
            Err(NoPlan::Wrong | NoPlan::NotBuilt(_)) => EXIT_FAILED,
        });
    }
    Ok(code)
}

fn one(name: &str, check: bool) -> Result<u8, NoPlan> {
    let standard = name == "-";
    let shown = if standard { "<stdin>" } else { name };
    let text = read(name)?;
    let formatted = formatted(shown, &text)?;
    match (check, standard) {
        (true, _) if formatted == text => Ok(EXIT_OK),
        (true, _) => {
            print(&difference(shown, &text, &formatted))?;
            if without_returns(&text) == without_returns(&formatted) {
                say(format_args!(
                    "{shown}: mixed line endings: 'afpc fmt' uses the line ending of the first line"
                ));
            }
            Ok(EXIT_FAILED)
        }
        (false, true) => print(&formatted),
        // An unchanged file keeps its modification time, so that nothing is rebuilt.
        (false, false) if formatted == text => Ok(EXIT_OK),
        (false, false) => {
            write_whole("cannot write the plan", Path::new(name), &formatted)?;
            Ok(EXIT_OK)
        }
    }
}

fn read(name: &str) -> Result<String, RunError> {
    if name != "-" {
        return read_text(name.as_ref()).map_err(unreadable(name.as_ref()));
    }
    let mut text = String::new();
    std::io::stdin()
        .read_to_string(&mut text)
        .map_err(RunError::file("cannot read", "standard input".as_ref()))?;
    Ok(text)
}

fn formatted(shown: &str, text: &str) -> Result<String, NoPlan> {
    afp_format::format(text).map_err(|diags| {
        let mut sources = Sources::default();
        sources.add(Source::new(shown, text).into());
        say(diags.render(&sources, true));
        say(format_args!("{shown}: not formatted because of syntax errors"));
        NoPlan::Wrong
    })
}

/// A text with normalized line ends.
fn without_returns(text: &str) -> String {
    text.replace("\r\n", "\n")
}

/// The changed lines, as a unified diff.
fn difference(shown: &str, text: &str, formatted: &str) -> String {
    let diff = TextDiff::from_lines(text, formatted);
    let formatted_name = format!("{shown} (formatted)");
    diff.unified_diff().context_radius(2).header(shown, &formatted_name).to_string()
}
