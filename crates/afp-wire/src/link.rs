//! One end of a line: its frames, the other end, and the checks of received frames.

use core::fmt;

use afp_types::{Duration, Instant};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::frame::{self, Frame, Packet, TooLong};

/// The sending half of an end. It has no port: the caller writes its bytes.
#[derive(Debug)]
pub struct Sender {
    boot: u32,
    version: u16,
    next: u16,
}

/// The receiving half of an end, for frames of up to `LONGEST` bytes. It has no port: the caller
/// passes each byte that arrives.
#[derive(Debug)]
pub struct Receiver<const LONGEST: usize> {
    version: u16,
    peer: Option<Peer>,
    inbox: [u8; LONGEST],
    length: usize,
    /// Whether the frame in the inbox has more bytes than fit.
    overflows: bool,
}

/// The other end of a line, after its hello.
#[derive(Clone, Copy, Debug)]
struct Peer {
    boot: u32,
    /// The sequence number of its last frame.
    last: u16,
    /// The time of that frame.
    heard: Instant,
}

/// A frame from the other end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Received<T> {
    /// The other end is connected and has the same message version.
    Hello,
    /// A message.
    Message {
        /// The message.
        message: T,
        /// Number of frames that were lost since the last one.
        lost: u16,
    },
}

/// Why a frame is rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rejected {
    /// Bytes were lost, added or changed.
    Damaged,
    /// The other end has not sent a hello.
    Stranger,
    /// The messages of the other end have another version.
    Version {
        /// The version of the other end.
        theirs: u16,
    },
    /// The frame is older than one that was received.
    Repeated,
    /// The other end has restarted since its hello. Call [`Receiver::forget`] to accept its next hello.
    Restarted,
}

impl fmt::Display for Rejected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Rejected::Damaged => f.write_str("a frame is damaged"),
            Rejected::Stranger => f.write_str("a message came before the hello"),
            Rejected::Version { theirs } => {
                write!(f, "the other end has version {theirs} of the protocol")
            }
            Rejected::Repeated => f.write_str("a frame came twice"),
            Rejected::Restarted => f.write_str("the other end has restarted"),
        }
    }
}

impl core::error::Error for Rejected {}

impl Sender {
    /// An end with its own boot id and a message version.
    ///
    /// `boot` must differ from those of earlier starts of the same end: a random number, or a
    /// counter in persistent memory.
    pub const fn new(boot: u32, version: u16) -> Self {
        Sender { boot, version, next: 0 }
    }

    /// Writes a hello into a buffer and returns its bytes. Repeat it until the other end has sent a
    /// hello, too.
    ///
    /// # Errors
    /// The buffer is too short; 20 bytes suffice.
    pub fn hello<'b>(&mut self, buffer: &'b mut [u8]) -> Result<&'b [u8], TooLong> {
        self.write(Packet::Hello::<()> { version: self.version }, buffer)
    }

    /// Writes a message into a buffer and returns its bytes.
    ///
    /// # Errors
    /// The buffer is too short. The message counts as not sent then.
    pub fn send<'b, T: Serialize>(
        &mut self,
        message: &T,
        buffer: &'b mut [u8],
    ) -> Result<&'b [u8], TooLong> {
        self.write(Packet::Message(message), buffer)
    }

    fn write<'b, T: Serialize>(
        &mut self,
        packet: Packet<T>,
        buffer: &'b mut [u8],
    ) -> Result<&'b [u8], TooLong> {
        let bytes = frame::write(&Frame { boot: self.boot, sequence: self.next, packet }, buffer)?;
        self.next = self.next.wrapping_add(1);
        Ok(bytes)
    }
}

impl<const LONGEST: usize> Receiver<LONGEST> {
    /// An end that accepts messages of a version.
    pub const fn new(version: u16) -> Self {
        Receiver { version, peer: None, inbox: [0; LONGEST], length: 0, overflows: false }
    }

    /// Takes a byte from the line. Returns the frame that it completes, or why the frame is
    /// rejected.
    pub fn receive<T: DeserializeOwned>(
        &mut self,
        byte: u8,
        now: Instant,
    ) -> Option<Result<Received<T>, Rejected>> {
        if byte != 0 {
            self.keep(byte);
            return None;
        }
        let length = core::mem::take(&mut self.length);
        if core::mem::take(&mut self.overflows) {
            return Some(Err(Rejected::Damaged));
        }
        // An end without a frame clears the rest of a frame that was cut.
        let bytes = self.inbox.get_mut(..length).filter(|bytes| !bytes.is_empty())?;
        let frame = frame::read(bytes).ok_or(Rejected::Damaged);
        Some(frame.and_then(|frame| self.accept(frame, now)))
    }

    fn keep(&mut self, byte: u8) {
        match self.inbox.get_mut(self.length) {
            Some(place) => {
                *place = byte;
                self.length += 1;
            }
            None => self.overflows = true,
        }
    }

    fn accept<T>(&mut self, frame: Frame<T>, now: Instant) -> Result<Received<T>, Rejected> {
        let Frame { boot, sequence, packet } = frame;
        let known = Peer { boot, last: sequence, heard: now };
        match (packet, self.peer) {
            (_, Some(peer)) if peer.boot != boot => Err(Rejected::Restarted),
            (Packet::Hello { version }, _) if version != self.version => {
                Err(Rejected::Version { theirs: version })
            }
            (Packet::Hello { .. }, _) => {
                self.peer = Some(known);
                Ok(Received::Hello)
            }
            (Packet::Message(_), None) => Err(Rejected::Stranger),
            (Packet::Message(message), Some(peer)) => {
                let step = sequence.wrapping_sub(peer.last);
                if step == 0 || step > u16::MAX / 2 {
                    return Err(Rejected::Repeated);
                }
                self.peer = Some(known);
                Ok(Received::Message { message, lost: step - 1 })
            }
        }
    }

    /// Whether the other end has sent a hello.
    pub fn is_connected(&self) -> bool {
        self.peer.is_some()
    }

    /// Whether the other end has been silent for longer than `limit`, or always.
    pub fn is_silent(&self, now: Instant, limit: Duration) -> bool {
        self.peer.is_none_or(|peer| now.since(peer.heard) > limit)
    }

    /// Forgets the other end: its next hello begins a new connection, after any restart.
    pub fn forget(&mut self) {
        self.peer = None;
    }
}
