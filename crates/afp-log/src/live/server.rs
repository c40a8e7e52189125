//! The port: a thread that accepts clients, and one thread for each client.

use std::io;
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant as Wall};

use super::admission::Tokens;
use super::client;
use super::hub::Hub;

/// The maximum number of connections before admission. Beyond it, the oldest one is disconnected.
const STRANGERS: usize = 16;
/// The time limit of a handshake.
const HANDSHAKE: Duration = Duration::from_secs(5);
/// The time for the remaining messages after the end of the run.
const GOODBYE: Duration = Duration::from_secs(2);
/// The interval of checks for new connections.
const LOOK: Duration = Duration::from_millis(20);

/// Listens on an address; returns the actual address and the thread.
///
/// # Errors
/// The address is taken or does not belong to this machine.
pub(crate) fn start(
    at: SocketAddr,
    hub: Arc<Hub>,
    tokens: Tokens,
) -> io::Result<(SocketAddr, JoinHandle<()>)> {
    let listener = TcpListener::bind(at)?;
    listener.set_nonblocking(true)?;
    let at = listener.local_addr()?;
    let thread = thread::Builder::new()
        .name("afp-live".into())
        .spawn(move || listen(&listener, &hub, &Arc::new(tokens)))?;
    Ok((at, thread))
}

struct Visitor {
    stream: TcpStream,
    since: Wall,
    admitted: Arc<AtomicBool>,
    /// Whether it was disconnected: its thread may notice it later.
    sent_away: bool,
    thread: JoinHandle<()>,
}

impl Visitor {
    /// Starts a thread for a connection; `None` if no thread can be created.
    fn new(stream: TcpStream, hub: &Arc<Hub>, tokens: &Arc<Tokens>) -> Option<Visitor> {
        let (hub, tokens) = (Arc::clone(hub), Arc::clone(tokens));
        let (admitted, since) = (Arc::<AtomicBool>::default(), Wall::now());
        let (told, own) = (Arc::clone(&admitted), stream.try_clone().ok()?);
        let named = thread::Builder::new().name("afp-live-client".into());
        let thread = named.spawn(move || client::serve(own, &hub, &tokens, &told)).ok()?;
        Some(Visitor { stream, since, admitted, sent_away: false, thread })
    }

    fn is_stranger(&self) -> bool {
        !self.sent_away && !self.admitted.load(Ordering::Acquire)
    }

    fn is_gone(&self) -> bool {
        self.thread.is_finished()
    }

    /// Ends the connection in any state of its thread.
    fn send_away(&mut self) {
        self.sent_away = true;
        // The connection may already be closed.
        let _ = self.stream.shutdown(Shutdown::Both);
    }
}

/// Accepts clients until the stream of messages ends, then waits for clients that still read.
fn listen(listener: &TcpListener, hub: &Arc<Hub>, tokens: &Arc<Tokens>) {
    let mut visitors: Vec<Visitor> = Vec::new();
    while !hub.is_over() {
        visitors.retain(|visitor| !visitor.is_gone());
        let late = |it: &&mut Visitor| it.is_stranger() && it.since.elapsed() > HANDSHAKE;
        visitors.iter_mut().filter(late).for_each(Visitor::send_away);
        match listener.accept() {
            Ok((stream, _)) => {
                // In the order of their arrival.
                let many = visitors.iter().filter(|it| it.is_stranger()).count() >= STRANGERS;
                if many && let Some(first) = visitors.iter_mut().find(|it| it.is_stranger()) {
                    first.send_away();
                }
                visitors.extend(Visitor::new(stream, hub, tokens));
            }
            // No new connection, or one that is already closed.
            Err(_) => thread::sleep(LOOK),
        }
    }
    visitors.iter_mut().filter(|visitor| visitor.is_stranger()).for_each(Visitor::send_away);
    let since = Wall::now();
    while since.elapsed() < GOODBYE && !visitors.iter().all(Visitor::is_gone) {
        thread::sleep(LOOK);
    }
}
