//! The command line of Action Flow Plans, with the built-in toolboxes alone.

use std::process::ExitCode;

fn main() -> ExitCode {
    afpc::main(&[])
}
