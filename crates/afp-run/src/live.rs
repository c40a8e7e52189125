//! A live stream of a run for other programs, with the feature `live`.

use std::net::SocketAddr;

use afp_core::Instant;
use afp_log::Messages;
use afp_session::AnySession;

use crate::error::RunError;

/// A server for a run. When dropped, it sends the rest to connected clients.
pub(crate) trait Live {
    /// Receives the messages of the run.
    fn messages(&self) -> Box<dyn Messages>;

    /// Whether a client has made a request.
    fn is_asked(&self) -> bool;

    /// Answers requests, at an instant that has not passed.
    fn serve(&self, session: &mut dyn AnySession, at: Instant);
}

/// The error of a program without the feature `live`.
#[cfg(not(feature = "live"))]
pub(crate) fn begin(_: SocketAddr, _: &str, _: &dyn AnySession) -> Result<Box<dyn Live>, RunError> {
    Err(RunError::usage(
        "this program has no '--live': it was built without the feature 'live'",
        "'afpc build --live' builds a plan with it, 'cargo install --path crates/afpc --features live' an afpc",
    ))
}

/// Begins to serve and prints the addresses.
#[cfg(feature = "live")]
pub(crate) fn begin(
    at: SocketAddr,
    name: &str,
    session: &dyn AnySession,
) -> Result<Box<dyn Live>, RunError> {
    let live = afp_log::live::Live::start(at, name, session)
        .map_err(|why| RunError::file("cannot serve on", at.to_string().as_ref())(why))?;
    let [operator, watcher] = live.addresses();
    crate::stderr::say(format!("live: {operator}\nwatching only: {watcher}\n"));
    if live.is_open() {
        crate::stderr::warn(
            "the connection is not encrypted: serve on 127.0.0.1 and connect with 'ssh -L'",
        );
    }
    Ok(Box::new(live))
}

#[cfg(feature = "live")]
impl Live for afp_log::live::Live {
    fn messages(&self) -> Box<dyn Messages> {
        self.messages()
    }

    fn is_asked(&self) -> bool {
        self.is_asked()
    }

    fn serve(&self, session: &mut dyn AnySession, at: Instant) {
        self.serve(session, at);
    }
}
