//! A run that others watch while it goes on: Foxglove's [WebSocket protocol].
//!
//! [`Live`] is a server for a few clients. They see the channels of a log, entries of the plan as parameters, buttons
//! and faults of the robot as services. Whoever drives the run hands [`Live::messages`] to a log that is sent, and
//! between two steps asks [`Live::is_asked`]; what clients want is then done by [`Live::serve`].
//!
//! Nobody who watches costs the run time: messages go through a bounded queue for each client. One that reads too
//! slowly loses the oldest ones and is told how many; one that does not read at all loses its connection.
//!
//! Whoever can reach the port, other users of the machine and pages in a browser among them, is admitted by a token
//! alone, that of watching or that of steering; names of hosts and of pages are checked before. Whoever has none takes no
//! place of a client, and is gone after a moment.
//!
//! [WebSocket protocol]: https://github.com/foxglove/ws-protocol/blob/main/docs/spec.md

mod admission;
mod client;
mod handshake;
mod hub;
mod paced;
mod protocol;
mod queue;
mod run;
mod server;

pub use run::Live;
