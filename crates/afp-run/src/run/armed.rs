//! `--disarmed`: a run that waits until an operator arms the robot; and messages to service managers.

use std::io::{self, BufRead};

use crate::error::RunError;

/// The line that starts the run.
const ARM: &str = "arm";

/// Reports that the program is ready, and waits for the line `arm` on standard input. Returns
/// whether it came before the end of the input.
///
/// # Errors
/// Standard input cannot be read.
pub(super) fn wait() -> Result<bool, RunError> {
    ready();
    for line in io::stdin().lock().lines() {
        if line.map_err(RunError::file("cannot read", "standard input".as_ref()))? == ARM {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Tells the service manager that the program is ready.
pub(super) fn ready() {
    notify("READY=1");
}

/// Sends a state such as `READY=1` to the service manager, if `NOTIFY_SOCKET` names one, as
/// `sd_notify` does. A manager that does not listen waits for nothing.
pub fn notify(state: &str) {
    #[cfg(unix)]
    if let Some(path) = std::env::var_os("NOTIFY_SOCKET")
        && let Ok(socket) = std::os::unix::net::UnixDatagram::unbound()
    {
        socket.send_to(state.as_bytes(), path).ok();
    }
    #[cfg(not(unix))]
    let _ = state;
}
