//! Events for the room: from clients and jobs.

use afp_lsp::Message;

use crate::outbox::Outbox;
use crate::room::{ClientId, JobId};

pub(crate) enum Event {
    Joined(ClientId, Outbox),
    Said(ClientId, Message),
    Left(ClientId),
    /// A job has printed a line.
    JobSaid(JobId, String),
    /// A job has closed its streams.
    JobEnded(JobId),
    End,
}
