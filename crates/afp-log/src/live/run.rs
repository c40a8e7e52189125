//! A server over one run.

use std::fmt;
use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::thread::JoinHandle;

use crate::Messages;
use afp_core::Instant;
use afp_core::trace::TraceEntryId;
use afp_session::{AnySession, Holder, Stimulus};

use super::admission::Tokens;
use super::hub::{Hub, Question, Service, Stream, Written};
use super::server;

/// A run with live clients.
pub struct Live {
    hub: Arc<Hub>,
    inbox: Receiver<Question>,
    thread: Option<JoinHandle<()>>,
    at: SocketAddr,
    tokens: Tokens,
}

impl Live {
    /// Starts a server for a run that is about to start; port 0 is any free port.
    ///
    /// # Errors
    /// The address is taken or does not belong to this machine.
    pub fn start(at: SocketAddr, name: &str, session: &dyn AnySession) -> io::Result<Live> {
        let (ask, inbox) = channel();
        let hub = Arc::new(Hub::new(name, session.names(), Service::all(session), ask));
        let tokens = Tokens::new()?;
        let (at, thread) = server::start(at, Arc::clone(&hub), tokens.clone())?;
        Ok(Live { hub, inbox, thread: Some(thread), at, tokens })
    }

    /// The addresses for clients: for steering, and for watching.
    pub fn addresses(&self) -> [String; 2] {
        let mut at = self.at;
        if at.ip().is_unspecified() {
            at.set_ip(std::net::Ipv4Addr::LOCALHOST.into());
        }
        let Tokens { operator, watcher } = &self.tokens;
        [operator, watcher].map(|token| format!("ws://{at}/?token={}", token.word()))
    }

    /// Whether other machines can reach it.
    pub fn is_open(&self) -> bool {
        !self.at.ip().is_loopback()
    }

    /// The number of clients.
    pub fn clients(&self) -> usize {
        self.hub.clients()
    }

    /// The receiver for the messages of the run.
    pub fn messages(&self) -> Box<dyn Messages> {
        Box::new(Stream(Arc::clone(&self.hub)))
    }

    /// Whether a question is open.
    pub fn is_asked(&self) -> bool {
        self.hub.is_asked()
    }

    /// Answers the open questions at the present instant or later.
    pub fn serve(&self, session: &mut dyn AnySession, at: Instant) {
        while let Ok(question) = self.inbox.try_recv() {
            match question {
                Question::Do { what, answer } => answer(ask(session, at, &what)),
                Question::Write { entries, answer } => {
                    let written = entries.iter().map(|(name, text)| write(session, name, text));
                    answer(written.collect());
                }
            }
            self.hub.answered();
        }
    }

    /// Ends the message stream; clients still receive queued messages.
    pub fn finish(mut self) {
        self.close();
    }

    fn close(&mut self) {
        self.hub.end();
        if let Some(thread) = self.thread.take() {
            // A thread that has panicked has no result.
            let _ = thread.join();
        }
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        self.close();
    }
}

impl fmt::Debug for Live {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Live").field("at", &self.at).finish_non_exhaustive()
    }
}

/// Writes an entry and returns its new value.
fn write(session: &mut dyn AnySession, entry: &str, text: &str) -> Written {
    let text = text.trim();
    match session.set(entry, text) {
        Ok(value) => {
            let names = session.names();
            let mut ids = (0..names.entries()).map(TraceEntryId);
            let id = ids.find(|id| names.entry(*id).path == entry);
            Ok(id.map_or(Holder::Unknown, Holder::Entry).named(names, value.as_deref()))
        }
        Err(why) => Err(why.to_string()),
    }
}

/// Applies a stimulus to a run.
fn ask(session: &mut dyn AnySession, at: Instant, what: &Stimulus) -> Result<(), String> {
    let request = what.request(session.devices(), session.names());
    let asked = request.and_then(|request| session.at(at, request));
    asked.map(|_| ()).map_err(|why| why.to_string())
}
