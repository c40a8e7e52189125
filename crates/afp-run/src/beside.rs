//! A debugger next to a run, on its own thread.

use afp_session::{AnySession, Observer, Steering, Wire};

use crate::error::RunError;

/// Starts a debugger next to a run.
pub trait Beside {
    /// Starts it for a session that has not started.
    ///
    /// # Errors
    /// It cannot serve clients.
    fn start(&self, session: &dyn AnySession) -> Result<Debugger, RunError>;
}

/// The parts of a debugger on the threads of a run.
pub struct Debugger {
    /// Passes the run's events on. It never waits.
    pub relay: Box<dyn Observer + Send>,
    /// Stops the plan, on the control thread.
    pub wire: Wire,
    /// The requests of clients.
    pub steering: Steering,
    /// Sends the last messages and ends the service, after the end of the run.
    pub end: Box<dyn FnOnce()>,
}

/// The parts of a debugger by their users; empty without a debugger.
#[derive(Default)]
pub(crate) struct DebuggerParts {
    pub(crate) relay: Option<Box<dyn Observer + Send>>,
    /// The parts on the control thread.
    pub(crate) control: Option<(Wire, Steering)>,
    pub(crate) end_service: Option<Box<dyn FnOnce()>>,
}

impl From<Debugger> for DebuggerParts {
    fn from(Debugger { relay, wire, steering, end }: Debugger) -> Self {
        let control = Some((wire, steering));
        DebuggerParts { relay: Some(relay), control, end_service: Some(end) }
    }
}

/// Parts of a run that not every program has.
#[derive(Clone, Copy, Default)]
pub struct Extras<'a> {
    /// Makes PNG pictures; without it pictures can only be SVG.
    pub rasterizer: Option<crate::Rasterizer<'a>>,
    /// A debugger, for runs in real time.
    pub debugger: Option<&'a dyn Beside>,
}
