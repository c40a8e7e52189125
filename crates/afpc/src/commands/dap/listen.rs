//! Clients on a socket. All clients share one adapter: one client launches a run and others join.

use std::collections::BTreeMap;
use std::io::{Read, Write};
use std::net::{Ipv4Addr, Shutdown, TcpListener, TcpStream};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use afp_debug::{Adapter, ClientId, Outgoing};
use afp_output::frames::{Frames, WireError, frame};
use afp_run::{RunError, say};
use afp_token::Token;

use super::Simulator;
use super::incoming::wait;
use super::talk::Clock;
use crate::Linked;
use crate::commands::stream::read;

/// The maximum number of clients.
const CLIENTS: usize = 8;
/// The maximum number of clients without a token. If there are more, the oldest one is
/// disconnected.
const STRANGERS: usize = 16;
/// The time in which a client must present the token.
const ADMISSION: Duration = Duration::from_secs(5);
/// The maximum number of unread arrivals.
const ARRIVALS: usize = 64;
/// The maximum number of messages that wait for a client.
const WAITING: usize = 1024;
/// The time that a simulated run waits for a client that does not read. After it, the client is
/// disconnected. The run does not wait for clients without a token, and a robot for no client.
const PATIENCE: Duration = Duration::from_secs(5);
/// The longest time for the last messages of a run.
const LAST: Duration = Duration::from_millis(500);
/// The interval between two checks of such a client.
const LOOK: Duration = Duration::from_millis(1);

/// A connection of a client.
pub(super) trait Stream: Read + Write + Send + Sized + 'static {
    /// Another handle to the connection.
    fn copy(&self) -> std::io::Result<Self>;

    /// Ends one or both directions.
    fn close(&self, how: Shutdown);
}

impl Stream for TcpStream {
    fn copy(&self) -> std::io::Result<Self> {
        // Without it, small messages wait.
        let _ = self.set_nodelay(true);
        self.try_clone()
    }

    fn close(&self, how: Shutdown) {
        let _ = self.shutdown(how);
    }
}

/// An event from outside.
pub(super) enum Arrival<S> {
    Client(S),
    Bytes(usize, Vec<u8>),
    Gone(usize),
    /// The run next to the adapter is over.
    End,
}

/// A connected client.
struct Peer<S> {
    id: ClientId,
    since: Instant,
    stream: S,
    frames: Frames,
    /// The channel to the writer thread.
    to: SyncSender<Vec<u8>>,
    writer: JoinHandle<()>,
}

/// All clients, by connection number.
pub(super) struct Peers<'a, S> {
    adapter: Adapter<'a>,
    clock: Clock,
    all: BTreeMap<usize, Peer<S>>,
    connected: usize,
    sender: SyncSender<Arrival<S>>,
    /// The time that the run waits for a client that does not read.
    patience: Duration,
}

/// Serves clients on a port of this machine, without end.
///
/// # Errors
/// The port is taken; no token can be generated.
pub(super) fn listen(port: u16, linked: &Linked<'_>) -> Result<(), RunError> {
    let wanted = format!("127.0.0.1:{port}");
    let failed = RunError::file("cannot listen on", wanted.as_ref());
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(failed)?;
    let token = Token::new().map_err(RunError::file("cannot make", "a token".as_ref()))?;
    let port = listener.local_addr().map_or(port, |address| address.port());
    say(format!("listening on 127.0.0.1:{port}, token {}", token.word()));
    let (sender, arrived) = arrivals();
    let connected = sender.clone();
    thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            if connected.send(Arrival::Client(stream)).is_err() {
                return;
            }
        }
    });
    let adapter = Adapter::guarded(Box::new(Simulator::new(linked)), &token, CLIENTS);
    Peers::new(adapter, sender, PATIENCE).serve(&arrived);
    Ok(())
}

/// A channel for arrivals.
pub(super) fn arrivals<S>() -> (SyncSender<Arrival<S>>, Receiver<Arrival<S>>) {
    sync_channel(ARRIVALS)
}

impl<'a, S: Stream> Peers<'a, S> {
    pub(super) fn new(
        adapter: Adapter<'a>,
        sender: SyncSender<Arrival<S>>,
        patience: Duration,
    ) -> Self {
        let all = BTreeMap::new();
        Peers { adapter, clock: Clock::new(), all, connected: 0, sender, patience }
    }

    /// Serves clients until the end of the run next to the adapter, or without end.
    pub(super) fn serve(&mut self, arrived: &Receiver<Arrival<S>>) {
        loop {
            let run = self.clock.rest(&self.adapter);
            let arrival = wait(arrived, run.into_iter().chain(self.admission_due()).min());
            let has_arrived = arrival.is_ok();
            match arrival {
                Ok(Arrival::Client(stream)) => self.connect(stream),
                Ok(Arrival::Bytes(from, bytes)) => self.on_bytes(from, &bytes),
                Ok(Arrival::Gone(from)) => self.forget(from),
                Ok(Arrival::End) => return self.finish(),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
            let outgoing = self.clock.tick(&mut self.adapter, has_arrived);
            self.send(outgoing);
            // The queued messages may contain the token.
            let patience = if has_arrived { 2 * ADMISSION } else { ADMISSION };
            let late = self.strangers().find(|(_, peer)| peer.since.elapsed() >= patience);
            let late = late.map(|(number, _)| number);
            if let Some(number) = late {
                self.send_away(number, "it has not sent the token");
            }
        }
    }

    /// Sends the last messages to all clients.
    fn finish(&mut self) {
        while !self.adapter.has_ended() {
            let outgoing = self.adapter.tick(self.clock.now());
            self.send(outgoing);
        }
        let writers: Vec<_> =
            std::mem::take(&mut self.all).into_values().map(|peer| peer.writer).collect();
        let since = Instant::now();
        while writers.iter().any(|writer| !writer.is_finished()) && since.elapsed() < LAST {
            thread::sleep(LOOK);
        }
    }

    /// The clients without a token, in order of arrival.
    fn strangers(&self) -> impl Iterator<Item = (usize, &Peer<S>)> {
        let all = self.all.iter().map(|(number, peer)| (*number, peer));
        all.filter(|(_, peer)| !self.adapter.is_admitted(peer.id))
    }

    /// The time left for the oldest of them.
    fn admission_due(&self) -> Option<Duration> {
        let (_, first) = self.strangers().next()?;
        Some(ADMISSION.saturating_sub(first.since.elapsed()))
    }

    fn connect(&mut self, stream: S) {
        let strangers: Vec<_> = self.strangers().map(|(number, _)| number).collect();
        if strangers.len() >= STRANGERS {
            self.send_away(strangers[0], "too many connections without a token");
        }
        let (Ok(from), Ok(back)) = (stream.copy(), stream.copy()) else { return };
        self.connected += 1;
        let (number, sender) = (self.connected, self.sender.clone());
        thread::spawn(move || {
            read(from, |bytes| sender.send(Arrival::Bytes(number, bytes)).is_ok());
            // If the server is gone, nobody needs the message.
            let _ = sender.send(Arrival::Gone(number));
        });
        let (to, messages) = sync_channel(WAITING);
        let writer = thread::spawn(move || write(back, &messages));
        let (id, since) = (self.adapter.join(), Instant::now());
        let peer = Peer { id, since, stream, frames: Frames::default(), to, writer };
        self.all.insert(number, peer);
    }

    fn on_bytes(&mut self, from: usize, bytes: &[u8]) {
        let Some(peer) = self.all.get_mut(&from) else { return };
        let id = peer.id;
        peer.frames.push(bytes);
        loop {
            // A client can be disconnected while other clients receive messages.
            let Some(peer) = self.all.get_mut(&from) else { return };
            match peer.frames.next_message() {
                Ok(Some(message)) => {
                    let outgoing = self.adapter.handle(id, &message, self.clock.now());
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

    /// Removes a client that is gone.
    fn forget(&mut self, from: usize) {
        if let Some(peer) = self.all.get_mut(&from)
            && let Err(why) = std::mem::take(&mut peer.frames).finish()
        {
            warn(why);
        }
        self.drop_client(from);
    }

    /// Ends a connection immediately.
    fn send_away(&mut self, number: usize, why: &str) {
        say(format_args!("warning: a client was disconnected: {why}"));
        if let Some(peer) = self.all.get(&number) {
            peer.stream.close(Shutdown::Both);
        }
        self.drop_client(number);
    }

    /// Ends a connection after its last messages have arrived.
    fn drop_client(&mut self, number: usize) {
        let Some(Peer { id, stream, to, .. }) = self.all.remove(&number) else { return };
        drop(to);
        // The reader ends now, and the writer ends after the last message.
        stream.close(Shutdown::Read);
        let outgoing = self.adapter.leave(id);
        self.send(outgoing);
    }

    /// Sends messages. Waits for a client that does not read, then disconnects the client.
    fn send(&mut self, outgoing: Vec<Outgoing>) {
        for Outgoing { to, message } in outgoing {
            let found = self.all.iter().find(|(_, peer)| peer.id == to);
            let Some((&number, peer)) = found else { continue };
            let is_known = self.adapter.is_admitted(to);
            let patience = if is_known { self.patience } else { Duration::ZERO };
            if !is_sent(&peer.to, frame(&message), patience) {
                self.send_away(number, "it reads no messages");
            }
        }
    }
}

/// Whether the client accepted some bytes in time.
fn is_sent(to: &SyncSender<Vec<u8>>, mut bytes: Vec<u8>, patience: Duration) -> bool {
    let since = Instant::now();
    loop {
        bytes = match to.try_send(bytes) {
            Ok(()) => return true,
            Err(TrySendError::Full(bytes)) if since.elapsed() < patience => bytes,
            Err(_) => return false,
        };
        thread::sleep(LOOK);
    }
}

/// Writes each message in one piece.
fn write(mut to: impl Stream, messages: &Receiver<Vec<u8>>) {
    for message in messages {
        if to.write_all(&message).is_err() {
            return;
        }
    }
    to.close(Shutdown::Both);
}

fn warn(why: WireError) {
    say(format_args!("warning: a client was disconnected: {why}"));
}
