//! The port: a thread that waits for clients, and one for each client.

use std::io;
use std::net::{Shutdown, SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant as Wall};

use super::admission::Tokens;
use super::client;
use super::hub::Hub;

/// So many who have not been let in at most; then the one that has waited longest is sent away.
const STRANGERS: usize = 16;
/// How long a handshake may take.
const HANDSHAKE: Duration = Duration::from_secs(5);
/// How long clients may take for the rest when the run is over.
const GOODBYE: Duration = Duration::from_secs(2);
/// How often a client that wants in is looked for.
const LOOK: Duration = Duration::from_millis(20);

/// Waits for clients on an address; gives the one that it is in the end, and the thread.
///
/// # Errors
/// The address is taken or none of this machine.
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

/// Somebody who came to the port.
struct Visitor {
    stream: TcpStream,
    since: Wall,
    /// Whether it is a client.
    admitted: Arc<AtomicBool>,
    /// Whether it was sent away: its thread may take a while to notice.
    sent_away: bool,
    thread: JoinHandle<()>,
}

impl Visitor {
    /// Begins to talk with whoever came; nobody where there is no thread for it.
    fn new(stream: TcpStream, hub: &Arc<Hub>, tokens: &Arc<Tokens>) -> Option<Visitor> {
        let (hub, tokens) = (Arc::clone(hub), Arc::clone(tokens));
        let (admitted, since) = (Arc::<AtomicBool>::default(), Wall::now());
        let (told, own) = (Arc::clone(&admitted), stream.try_clone().ok()?);
        let named = thread::Builder::new().name("afp-live-client".into());
        let thread = named.spawn(move || client::serve(own, &hub, &tokens, &told)).ok()?;
        Some(Visitor { stream, since, admitted, sent_away: false, thread })
    }

    /// Whether it is still to be let in.
    fn is_stranger(&self) -> bool {
        !self.sent_away && !self.admitted.load(Ordering::Acquire)
    }

    fn is_gone(&self) -> bool {
        self.thread.is_finished()
    }

    /// Ends the connection, at whatever its thread is.
    fn send_away(&mut self) {
        self.sent_away = true;
        // One that is gone already does not mind.
        let _ = self.stream.shutdown(Shutdown::Both);
    }
}

/// Lets clients in until nothing comes any more, then waits for those who still read.
fn listen(listener: &TcpListener, hub: &Arc<Hub>, tokens: &Arc<Tokens>) {
    let mut visitors: Vec<Visitor> = Vec::new();
    while !hub.is_over() {
        visitors.retain(|visitor| !visitor.is_gone());
        let late = |it: &&mut Visitor| it.is_stranger() && it.since.elapsed() > HANDSHAKE;
        visitors.iter_mut().filter(late).for_each(Visitor::send_away);
        match listener.accept() {
            Ok((stream, _)) => {
                // In the order in which they came.
                let many = visitors.iter().filter(|it| it.is_stranger()).count() >= STRANGERS;
                if many && let Some(first) = visitors.iter_mut().find(|it| it.is_stranger()) {
                    first.send_away();
                }
                visitors.extend(Visitor::new(stream, hub, tokens));
            }
            // Nobody came, or somebody who is gone already.
            Err(_) => thread::sleep(LOOK),
        }
    }
    visitors.iter_mut().filter(|visitor| visitor.is_stranger()).for_each(Visitor::send_away);
    let since = Wall::now();
    while since.elapsed() < GOODBYE && !visitors.iter().all(Visitor::is_gone) {
        thread::sleep(LOOK);
    }
}
