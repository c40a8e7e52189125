//! The computer's end of a serial line with frames of [`afp_wire`].

use std::hash::{BuildHasher, RandomState};
use std::io;

use afp_core::Instant;
use afp_platform::{LastResort, RealTime};
use afp_wire::{Received, Receiver, Rejected, Sender};
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::port::Port;

/// The most bytes of one read.
const CHUNK: usize = 512;

/// The computer's end of a serial line, for frames of up to `LONGEST` bytes. Neither reading nor
/// writing waits: bytes that the line does not take at once are lost.
#[derive(Debug)]
pub struct Link<const LONGEST: usize> {
    port: Port,
    sender: Sender,
    receiver: Receiver<LONGEST>,
    version: u16,
    /// Whether the controller has restarted since the connection.
    restarted: bool,
}

/// A message of the controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Heard<T> {
    /// A message, and its arrival.
    Message(T, Instant),
    /// The controller has restarted since the connection, so that it is in an unknown state.
    Restarted,
    /// The controller uses another version of the messages.
    Version(u16),
}

impl<const LONGEST: usize> Link<LONGEST> {
    /// Opens a port in both directions, without waiting, for only this program. A serial line gets
    /// the speed in baud, and does not edit or echo. `version` is the messages' version.
    ///
    /// # Errors
    /// The port cannot be opened or set up.
    pub fn open(port: &str, baud: u32, version: u16) -> io::Result<Self> {
        Ok(Link::over(Port::open(port, baud, 0)?, version))
    }

    /// A link over an open port.
    pub(crate) fn over(port: Port, version: u16) -> Self {
        // The keys of a hasher are random, and differ at each call.
        let boot = RandomState::new().hash_one(std::process::id()) as u32;
        let (sender, receiver) = (Sender::new(boot, version), Receiver::new(version));
        Link { port, sender, receiver, version, restarted: false }
    }

    /// Begins a connection.
    pub fn hello(&mut self) {
        let mut buffer = [0; LONGEST];
        let length = self.sender.hello(&mut buffer).map_or(0, <[u8]>::len);
        self.port.write(buffer.get(..length).unwrap_or_default());
    }

    /// Sends a message. If the line is broken or full, nothing is sent: the controller stops, and
    /// its silence is noticed.
    pub fn send<T: Serialize>(&mut self, message: &T) {
        let mut buffer = [0; LONGEST];
        let length = self.sender.send(message, &mut buffer).map_or(0, <[u8]>::len);
        self.port.write(buffer.get(..length).unwrap_or_default());
    }

    /// Discards everything in the output queue, so that the next message overtakes it.
    pub fn discard(&mut self) {
        self.port.discard();
    }

    /// Reads everything that has arrived, and returns the last message for which `is_possible`
    /// holds. Damaged frames do not count. Nothing follows a restart.
    pub fn hear<T: DeserializeOwned>(
        &mut self,
        time: &RealTime,
        is_possible: impl Fn(&T) -> bool,
    ) -> Option<Heard<T>> {
        let mut last = None;
        let mut bytes = [0; CHUNK];
        loop {
            let read = self.port.read(&mut bytes);
            let now = time.now();
            for byte in bytes.get(..read).unwrap_or_default() {
                match self.receiver.receive::<T>(*byte, now) {
                    Some(Ok(Received::Message { message, .. })) if is_possible(&message) => {
                        last = Some(Heard::Message(message, now));
                    }
                    Some(Err(Rejected::Restarted)) => self.restarted = true,
                    Some(Err(Rejected::Version { theirs })) => last = Some(Heard::Version(theirs)),
                    _ => {}
                }
            }
            // Fewer bytes than fit: the line is empty, or has ended.
            if read < CHUNK {
                break;
            }
        }
        if self.restarted { Some(Heard::Restarted) } else { last }
    }

    /// Stops the controller even if the sending thread hangs: a controller stops on a different
    /// boot id of the computer.
    pub fn last_resort(&self) -> Option<LastResort> {
        let mut link = Link::<LONGEST>::over(self.port.copy()?, self.version);
        Some(Box::new(move || {
            link.discard();
            link.hello();
        }))
    }

    /// Lets other programs open the port.
    pub fn release(&self) {
        self.port.release();
    }
}
