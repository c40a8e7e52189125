//! A live stream of a run for clients that watch it, with the feature `live`.

use std::net::SocketAddr;

use afp_core::Instant;
use afp_log::SessionLog;
use afp_session::{AnySession, Shape};

use crate::error::RunError;

#[cfg(feature = "live")]
pub(crate) use served::Live;

/// No program that was built without the feature `live` has one.
#[cfg(not(feature = "live"))]
pub(crate) enum Live {}

#[cfg(not(feature = "live"))]
impl Live {
    pub(crate) fn begin(
        asked: Option<SocketAddr>,
        _: &str,
        _: &dyn AnySession,
    ) -> Result<Option<Live>, RunError> {
        match asked {
            None => Ok(None),
            Some(_) => Err(RunError::usage(
                "'--live' is not in this program: it was built without the feature 'live'",
                "'afpc build --live' builds a plan with it, 'cargo install --path crates/afpc --features live' an afpc",
            )),
        }
    }

    pub(crate) fn log(
        &self,
        _: &dyn AnySession,
        _: Vec<Shape>,
        _: bool,
    ) -> Result<SessionLog, RunError> {
        match *self {}
    }

    pub(crate) fn is_asked(&self) -> bool {
        match *self {}
    }

    pub(crate) fn serve(&self, _: &mut dyn AnySession, _: Instant) {
        match *self {}
    }

    pub(crate) fn finish(self) {
        match self {}
    }
}

#[cfg(feature = "live")]
mod served {
    use super::{AnySession, Instant, RunError, SessionLog, Shape, SocketAddr};
    use crate::stderr::{say, warn};
    use afp_log::OwnedNames;

    /// A server over a run.
    pub(crate) struct Live(afp_log::live::Live);

    impl Live {
        /// Begins to serve where that is asked for, and says at which addresses.
        pub(crate) fn begin(
            asked: Option<SocketAddr>,
            name: &str,
            session: &dyn AnySession,
        ) -> Result<Option<Live>, RunError> {
            let Some(at) = asked else { return Ok(None) };
            let live = afp_log::live::Live::start(at, name, session)
                .map_err(|why| RunError::file("cannot serve on", at.to_string().as_ref())(why))?;
            let [operator, watcher] = live.addresses();
            say(format!("live: {operator}\nwatching alone: {watcher}\n"));
            if live.is_open() {
                warn(
                    "nothing on its way is encrypted: serve on 127.0.0.1 and go there with 'ssh -L'",
                );
            }
            Ok(Some(Live(live)))
        }

        /// What sends the run to those who watch.
        pub(crate) fn log(
            &self,
            session: &dyn AnySession,
            scene: Vec<Shape>,
            camera: bool,
        ) -> Result<SessionLog, RunError> {
            let (names, devices) = (OwnedNames::new(session.names()), session.devices());
            Ok(SessionLog::stream(self.0.messages(), names, devices, scene, camera)?)
        }

        pub(crate) fn is_asked(&self) -> bool {
            self.0.is_asked()
        }

        pub(crate) fn serve(&self, session: &mut dyn AnySession, at: Instant) {
            self.0.serve(session, at);
        }

        pub(crate) fn finish(self) {
            self.0.finish();
        }
    }
}
