//! Clients that connect: all share one adapter, so that one launches and others join it.

use std::collections::BTreeMap;
use std::io::Write;
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::sync::mpsc::{
    Receiver, RecvTimeoutError, Sender, SyncSender, TrySendError, channel, sync_channel,
};
use std::thread;
use std::time::{Duration, Instant};

use afp_debug::wire::{Frames, WireError, frame};
use afp_debug::{Adapter, ClientId, Outgoing};
use afp_run::{RunError, say};
use afp_token::Token;

use super::Simulator;
use super::talk::read;
use crate::Linked;

/// So many clients at most.
const CLIENTS: usize = 8;
/// So many messages wait for a client at most.
const WAITING: usize = 1024;
/// How long the run waits for a client that does not read; then it loses its connection.
const PATIENCE: Duration = Duration::from_secs(5);
/// How often such a client is looked at.
const LOOK: Duration = Duration::from_millis(1);

/// What comes from outside.
enum Arrival {
    /// A client.
    Client(TcpStream),
    /// Bytes of one.
    Bytes(usize, Vec<u8>),
    /// One has gone.
    Gone(usize),
}

/// A client that is connected.
struct Peer {
    id: ClientId,
    stream: TcpStream,
    frames: Frames,
    /// To the thread that writes.
    to: SyncSender<Vec<u8>>,
}

/// All of them, by the number of their connection.
struct Peers<'a> {
    adapter: Adapter<'a>,
    begin: Instant,
    all: BTreeMap<usize, Peer>,
    connected: usize,
    sender: Sender<Arrival>,
}

/// Serves clients on a port of this machine, for ever.
///
/// # Errors
/// The port is taken; there is no token to be had.
pub(super) fn listen(port: u16, linked: &Linked<'_>) -> Result<(), RunError> {
    let wanted = format!("127.0.0.1:{port}");
    let failed = RunError::file("cannot listen on", wanted.as_ref());
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(failed)?;
    let token = Token::new().map_err(RunError::file("cannot make", "a token".as_ref()))?;
    let port = listener.local_addr().map_or(port, |address| address.port());
    say(format!("listening on 127.0.0.1:{port}, token {}", token.word()));
    let (sender, arrived) = channel();
    let connected = sender.clone();
    thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            if connected.send(Arrival::Client(stream)).is_err() {
                return;
            }
        }
    });
    let adapter = Adapter::guarded(Box::new(Simulator::new(linked)), &token);
    let all = BTreeMap::new();
    Peers { adapter, begin: Instant::now(), all, connected: 0, sender }.serve(&arrived);
    Ok(())
}

impl Peers<'_> {
    fn serve(&mut self, arrived: &Receiver<Arrival>) {
        loop {
            let arrival = match self.adapter.due() {
                None => arrived.recv().map_err(|_| RecvTimeoutError::Disconnected),
                Some(due) => arrived.recv_timeout(due),
            };
            match arrival {
                Ok(Arrival::Client(stream)) => self.connect(stream),
                Ok(Arrival::Bytes(from, bytes)) => self.on_bytes(from, &bytes),
                Ok(Arrival::Gone(from)) => self.forget(from),
                Err(RecvTimeoutError::Timeout) => {
                    let outgoing = self.adapter.tick(self.begin.elapsed());
                    self.send(outgoing);
                }
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    fn connect(&mut self, stream: TcpStream) {
        if self.all.len() >= CLIENTS {
            say(format_args!("warning: a client was sent away: {CLIENTS} are there already"));
            return;
        }
        let _ = stream.set_nodelay(true);
        let (Ok(from), Ok(back)) = (stream.try_clone(), stream.try_clone()) else { return };
        self.connected += 1;
        let (number, sender) = (self.connected, self.sender.clone());
        thread::spawn(move || {
            read(from, |bytes| sender.send(Arrival::Bytes(number, bytes)).is_ok());
            // Without a server nobody is told.
            let _ = sender.send(Arrival::Gone(number));
        });
        let (to, messages) = sync_channel(WAITING);
        thread::spawn(move || write(back, &messages));
        let peer = Peer { id: self.adapter.join(), stream, frames: Frames::default(), to };
        self.all.insert(number, peer);
    }

    fn on_bytes(&mut self, from: usize, bytes: &[u8]) {
        let Some(peer) = self.all.get_mut(&from) else { return };
        let id = peer.id;
        peer.frames.push(bytes);
        loop {
            // A client may be sent away over what others are told.
            let Some(peer) = self.all.get_mut(&from) else { return };
            match peer.frames.next_message() {
                Ok(Some(message)) => {
                    let outgoing = self.adapter.handle(id, &message, self.begin.elapsed());
                    self.send(outgoing);
                }
                Ok(None) => break,
                Err(why) => {
                    warn(why);
                    return self.drop_client(from);
                }
            }
        }
        if self.adapter.is_over(id) {
            self.drop_client(from);
        }
    }

    /// A client has gone.
    fn forget(&mut self, from: usize) {
        if let Some(peer) = self.all.get_mut(&from)
            && let Err(why) = std::mem::take(&mut peer.frames).finish()
        {
            warn(why);
        }
        self.drop_client(from);
    }

    /// Ends a connection; what it was told last still arrives.
    fn drop_client(&mut self, number: usize) {
        let Some(Peer { id, stream, to, .. }) = self.all.remove(&number) else { return };
        drop(to);
        // Its reader ends, its writer once all is written.
        let _ = stream.shutdown(Shutdown::Read);
        let outgoing = self.adapter.leave(id);
        self.send(outgoing);
    }

    /// Sends messages; a client that does not read is waited for, then it loses its connection.
    fn send(&mut self, outgoing: Vec<Outgoing>) {
        for Outgoing { to, message } in outgoing {
            let found = self.all.iter().find(|(_, peer)| peer.id == to);
            let Some((&number, peer)) = found else { continue };
            if !is_sent(&peer.to, frame(&message)) {
                say("warning: a client was sent away: it does not read");
                let _ = peer.stream.shutdown(Shutdown::Both);
                self.drop_client(number);
            }
        }
    }
}

/// Whether somebody has taken some bytes, sooner or later.
fn is_sent(to: &SyncSender<Vec<u8>>, mut bytes: Vec<u8>) -> bool {
    let since = Instant::now();
    loop {
        bytes = match to.try_send(bytes) {
            Ok(()) => return true,
            Err(TrySendError::Full(bytes)) if since.elapsed() < PATIENCE => bytes,
            Err(_) => return false,
        };
        thread::sleep(LOOK);
    }
}

/// Writes each message in one piece.
fn write(mut to: TcpStream, messages: &Receiver<Vec<u8>>) {
    for message in messages {
        if to.write_all(&message).is_err() {
            return;
        }
    }
    let _ = to.shutdown(Shutdown::Both);
}

fn warn(why: WireError) {
    say(format_args!("warning: a client was sent away: {why}"));
}
