//! One module per command.

#[cfg(unix)]
pub mod agent;
#[cfg(all(feature = "dap", unix))]
pub mod attach;
pub mod build;
#[cfg(all(unix, feature = "pi"))]
pub mod calibrate;
pub mod check;
pub mod completions;
#[cfg(feature = "dap")]
pub mod dap;
#[cfg(unix)]
pub mod deploy;
#[cfg(any(feature = "lsp", feature = "studio"))]
mod disk;
pub mod explain;
pub mod fmt;
pub mod graph;
#[cfg(all(feature = "pi", unix))]
pub mod guard;
pub mod later;
pub mod log;
#[cfg(feature = "lsp")]
pub mod lsp;
pub mod new;
#[cfg(unix)]
pub mod robot;
pub mod run;
#[cfg(any(feature = "dap", feature = "lsp"))]
mod stream;
#[cfg(feature = "studio")]
pub mod studio;
pub mod sweep;
pub mod templates;
pub mod test;

use std::io::{ErrorKind, Write};

use afp_run::{EXIT_OK, RunError};
use anstyle::{AnsiColor, Style};
use clap::ValueEnum;

use crate::no_plan::NoPlan;

const GOOD: Style = AnsiColor::Green.on_default().bold();
const BAD: Style = AnsiColor::BrightRed.on_default().bold();
const QUIET: Style = Style::new().dimmed();

/// The exit code of a stopped command that does many runs.
const EXIT_STOPPED: u8 = 130;

fn name_of(value: &impl ValueEnum) -> String {
    value.to_possible_value().map(|it| it.get_name().to_owned()).unwrap_or_default()
}

/// Prints a result on standard output; a closed pipe is not an error.
pub(crate) fn print(text: &str) -> Result<u8, NoPlan> {
    print_to(anstream::stdout().lock(), text.as_bytes())
}

/// Prints binary data on standard output, with the same rules as [`print`].
fn print_bytes(bytes: &[u8]) -> Result<u8, NoPlan> {
    print_to(std::io::stdout().lock(), bytes)
}

fn print_to(mut out: impl Write, bytes: &[u8]) -> Result<u8, NoPlan> {
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(RunError::file("cannot write to", "standard output".as_ref())(error).into())
        }
        _ => Ok(EXIT_OK),
    }
}
