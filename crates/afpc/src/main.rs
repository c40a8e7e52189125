//! The command line of Action Flow Plans: arguments, files, exit codes.

mod cli;
mod commands;
mod plan_file;

use std::process::ExitCode;

fn main() -> ExitCode {
    commands::dispatch(&cli::parse())
}
