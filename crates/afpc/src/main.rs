//! The command line of Action Flow Plans, with only the Carbot and the built-in toolboxes.

use std::process::ExitCode;

use afpc::Linked;

fn main() -> ExitCode {
    let robot = afpc::carbot(|_| {});
    afpc::main(&Linked { robot: &robot, own_robot: None, hardware: None, toolboxes: &[] })
}
