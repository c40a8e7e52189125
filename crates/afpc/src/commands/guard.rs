//! `afpc guard`: holds the enable line of a robot's motors as long as a run lives.

use afp_pi::guard::{keep, stream};
use afp_run::{EXIT_OK, RunError};
use clap::Args;

use crate::no_plan::NoPlan;

/// Arguments of `afpc guard`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// GPIO chip of the line, such as /dev/gpiochip0
    chip: String,
    /// Number of the line
    line: u32,
}

pub const EXAMPLES: &str = "\
A run with the profile 'pi' or 'picarx' starts it. The motors are off:
  before the first byte on standard input, a socket
  after the end of file, and after 100 ms without a byte";

/// Keeps the motors on as long as the run sends bytes.
///
/// # Errors
/// No run has started it, or the line cannot be opened or set.
pub fn run(arguments: &Arguments) -> Result<u8, NoPlan> {
    let failed = |why: std::io::Error| {
        RunError::usage(format!("the guard failed: {why}"), "see 'docs/robot-from-parts.md'")
    };
    let run = stream().map_err(failed)?;
    let mut line = afp_pi::enable_line(&arguments.chip, arguments.line).map_err(failed)?;
    keep(run, &mut line).map_err(failed)?;
    Ok(EXIT_OK)
}
