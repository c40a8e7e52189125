//! Live observation of a run through Foxglove's [WebSocket protocol].
//!
//! [`Live`] is a server for a few clients. They see the channels of a log, entries of the plan as
//! parameters, and buttons and faults of the robot as services. The driver of the run passes
//! [`Live::messages`] to a log, and calls [`Live::is_asked`] between two steps. [`Live::serve`]
//! handles the clients' requests.
//!
//! Clients cost the run no time: each client has a bounded queue. A slow client loses the oldest
//! messages and gets their number. A client that does not read at all loses its connection.
//!
//! Other users of the machine and pages in a browser can reach the port. A token admits a client,
//! for watching or for steering; the names of host and page are checked first. A connection without
//! a token takes no client's place and ends after a moment.
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
