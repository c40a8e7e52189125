//! Requests to stop from outside: Ctrl-C, SIGTERM.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether somebody asked the process to stop.
#[derive(Clone, Debug, Default)]
pub struct StopFlag(Arc<AtomicBool>);

impl StopFlag {
    /// A flag that Ctrl-C and SIGTERM raise. A second one ends the process at once.
    #[cfg(unix)]
    ///
    /// # Errors
    /// Signals cannot be handled.
    pub fn on_signals() -> std::io::Result<Self> {
        use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
        use signal_hook::flag;
        let stop = StopFlag::default();
        for signal in [SIGINT, SIGTERM, SIGHUP] {
            // The order matters: the first signal finds the flag down and raises it.
            flag::register_conditional_shutdown(signal, 130, Arc::clone(&stop.0))?;
            flag::register(signal, Arc::clone(&stop.0))?;
        }
        Ok(stop)
    }

    /// A flag that nothing raises: there are no signals here.
    #[cfg(not(unix))]
    ///
    /// # Errors
    /// None.
    pub fn on_signals() -> std::io::Result<Self> {
        Ok(StopFlag::default())
    }

    /// Whether it was raised.
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// The flag itself, for other threads to look at.
    pub fn flag(&self) -> &AtomicBool {
        &self.0
    }
}
