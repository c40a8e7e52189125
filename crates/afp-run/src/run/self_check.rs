//! `--self-check`: a short simulated run, to compare two machines.

use std::io::Write;

use afp_core::{Duration, Instant};
use afp_session::{AnySession, Open};

use crate::error::{EXIT_OK, RunError};
use crate::inputs;
use crate::run::STANDARD_OUTPUT;

/// The length of the simulated run.
const LENGTH: Duration = Duration::from_secs(1);

/// Simulates the start of the plan and prints the hash of its trace: the plan, its values and the
/// build decide it, the machine does not.
///
/// # Errors
/// An input has no value, or the output cannot be written.
pub(super) fn check(session: &mut dyn AnySession) -> Result<u8, RunError> {
    let ran = session.run(Instant::ZERO + LENGTH, &mut Open, &mut []);
    ran.map_err(|error| inputs::missing(error, session.names()))?;
    let trace = session.trace();
    session.end();
    let written = writeln!(std::io::stdout(), "trace {trace}");
    written.map_err(RunError::file("cannot write to", STANDARD_OUTPUT.as_ref()))?;
    Ok(EXIT_OK)
}
