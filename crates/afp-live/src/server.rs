//! The port: a thread that waits for clients, and one for each client.

use std::io::{self, ErrorKind, Write};
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant as Wall};

use crate::admission::Tokens;
use crate::client;
use crate::hub::Hub;

/// So many clients at most.
const CLIENTS: usize = 8;
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

/// Lets clients in until nothing comes any more, then waits for those who still read.
fn listen(listener: &TcpListener, hub: &Arc<Hub>, tokens: &Arc<Tokens>) {
    let mut clients: Vec<JoinHandle<()>> = Vec::new();
    while !hub.is_over() {
        match listener.accept() {
            Ok((stream, _)) => {
                clients.retain(|client| !client.is_finished());
                match clients.len() < CLIENTS {
                    true => clients.extend(let_in(stream, hub, tokens)),
                    false => send_away(stream),
                }
            }
            Err(why) if why.kind() == ErrorKind::WouldBlock => thread::sleep(LOOK),
            // A client that was gone before it was let in.
            Err(_) => thread::sleep(LOOK),
        }
    }
    // One that is still at its handshake, however slowly, is not waited for.
    let since = Wall::now();
    while since.elapsed() < GOODBYE && !clients.iter().all(JoinHandle::is_finished) {
        thread::sleep(LOOK);
    }
}

fn let_in(stream: TcpStream, hub: &Arc<Hub>, tokens: &Arc<Tokens>) -> Option<JoinHandle<()>> {
    let (hub, tokens) = (Arc::clone(hub), Arc::clone(tokens));
    let name = "afp-live-client".into();
    thread::Builder::new().name(name).spawn(move || client::serve(stream, &hub, &tokens)).ok()
}

fn send_away(mut stream: TcpStream) {
    let text = "too many clients watch already\n";
    let length = text.len();
    // Who does not read it is sent away all the same.
    let _ = write!(stream, "HTTP/1.1 503 Busy\r\nContent-Length: {length}\r\n\r\n{text}");
}
