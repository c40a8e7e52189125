//! One module per command.

pub mod build;
pub mod check;
pub mod completions;
#[cfg(feature = "dap")]
pub mod dap;
#[cfg(any(feature = "lsp", feature = "studio"))]
mod disk;
pub mod explain;
pub mod fmt;
pub mod graph;
pub mod later;
pub mod log;
#[cfg(feature = "lsp")]
pub mod lsp;
pub mod new;
pub mod run;
#[cfg(feature = "studio")]
pub mod studio;
pub mod sweep;
pub mod templates;
pub mod test;

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

use afp_run::{EXIT_FAILED, EXIT_OK, RunError};

use crate::Linked;
use crate::cli::Command;
use crate::plan_file::NoPlan;

/// The exit code of what does many runs and was stopped before all of them were done.
const EXIT_STOPPED: u8 = 130;

/// Runs a command.
pub fn dispatch(command: &Command, linked: &Linked<'_>) -> ExitCode {
    let result = match command {
        Command::Check(arguments) => check::run(arguments),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Fmt(arguments) => fmt::run(arguments),
        Command::Graph(arguments) => graph::run(arguments),
        Command::Run(arguments) => run::run(arguments, linked),
        Command::Test(arguments) => test::run(arguments, linked),
        Command::Sweep(arguments) => sweep::run(arguments, linked),
        Command::Build(arguments) => build::run(arguments),
        Command::Log(arguments) => log::run(arguments, linked),
        #[cfg(feature = "lsp")]
        Command::Lsp => lsp::run(),
        #[cfg(feature = "studio")]
        Command::Studio(arguments) => studio::run(arguments, linked),
        Command::New(arguments) => new::run(arguments),
        Command::Templates(arguments) => templates::run(arguments),
        #[cfg(feature = "dap")]
        Command::Dap(arguments) => dap::run(arguments, linked),
        Command::Completions(arguments) => completions::run(arguments),
    };
    match result {
        Ok(code) => ExitCode::from(code),
        Err(NoPlan::File(error)) => error.report(),
        Err(NoPlan::Wrong | NoPlan::NotBuilt(_)) => ExitCode::from(EXIT_FAILED),
    }
}

/// Prints a result on standard output; a reader that has seen enough is no error.
pub(crate) fn print(text: &str) -> Result<u8, NoPlan> {
    print_to(anstream::stdout().lock(), text.as_bytes())
}

/// Prints bytes that are no text on standard output, as [`print`] does.
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
