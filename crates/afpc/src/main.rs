//! The command line of Action Flow Plans, with the Carbot and the built-in toolboxes alone.

use std::process::ExitCode;

use afpc::Linked;

fn main() -> ExitCode {
    afpc::main(&Linked { robot: &afpc::carbot(|_| {}), own_robot: None, toolboxes: &[] })
}
