//! A serial line to a controller. Neither reading nor writing waits.

use std::fs::File;
use std::hash::{BuildHasher, RandomState};
use std::io::{self, Read, Write};
use std::os::unix::fs::OpenOptionsExt;

use afp_core::Instant;
use afp_platform::{LastResort, RealTime, open_device, release_device};
use afp_wire::{Received, Receiver, Rejected, Sender};
use rustix::fs::OFlags;
use rustix::termios::{OptionalActions, QueueSelector, isatty, tcflush, tcgetattr, tcsetattr};
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The most bytes of one write and of one read.
const CHUNK: usize = 512;

/// The computer's end of a serial line, for frames of up to `LONGEST` bytes. Bytes that the line
/// does not take at once are lost.
#[derive(Debug)]
pub struct Link<const LONGEST: usize> {
    port: File,
    sender: Sender,
    receiver: Receiver<LONGEST>,
    version: u16,
    /// Whether the last write was complete.
    whole: bool,
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
    /// the speed in baud, and does not edit or echo. `version` is that of the messages.
    ///
    /// # Errors
    /// The port cannot be opened or set up.
    pub fn open(port: &str, baud: u32, version: u16) -> io::Result<Self> {
        // The port must not become the controlling terminal of this process.
        let flags = (OFlags::NONBLOCK | OFlags::NOCTTY).bits() as i32;
        let port = open_device(File::options().read(true).write(true).custom_flags(flags), port)?;
        if isatty(&port) {
            let mut modes = tcgetattr(&port)?;
            modes.make_raw();
            modes.set_speed(baud)?;
            tcsetattr(&port, OptionalActions::Now, &modes)?;
            // Earlier messages do not count.
            tcflush(&port, QueueSelector::IFlush)?;
        }
        Ok(Link::new(port, version))
    }

    fn new(port: File, version: u16) -> Self {
        // The keys of a hasher are random, and differ at each call.
        let boot = RandomState::new().hash_one(std::process::id()) as u32;
        let (sender, receiver) = (Sender::new(boot, version), Receiver::new(version));
        Link { port, sender, receiver, version, whole: false, restarted: false }
    }

    /// Begins a connection.
    pub fn hello(&mut self) {
        let mut buffer = [0; LONGEST];
        let length = self.sender.hello(&mut buffer).map_or(0, <[u8]>::len);
        self.write(buffer.get(..length).unwrap_or_default());
    }

    /// Sends a message. If the line is broken or full, nothing is sent: the controller stops, and
    /// its silence is noticed.
    pub fn send<T: Serialize>(&mut self, message: &T) {
        let mut buffer = [0; LONGEST];
        let length = self.sender.send(message, &mut buffer).map_or(0, <[u8]>::len);
        self.write(buffer.get(..length).unwrap_or_default());
    }

    /// Discards everything in the output queue, so that the next message overtakes it.
    pub fn discard(&mut self) {
        // A line without a queue has nothing to discard.
        let _ = tcflush(&self.port, QueueSelector::OFlush);
        self.whole = false;
    }

    fn write(&mut self, frame: &[u8]) {
        let mut bytes = [0; CHUNK];
        // A frame that was cut ends here, damaged, and does not run into the next one.
        let start = usize::from(!self.whole);
        let Some(room) = bytes.get_mut(start..start + frame.len()) else { return };
        room.copy_from_slice(frame);
        let all = bytes.get(..start + frame.len()).unwrap_or_default();
        self.whole = matches!(self.port.write(all), Ok(written) if written == all.len());
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
        while let Ok(read) = self.port.read(&mut bytes) {
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
        let mut link = Link::<LONGEST>::new(self.port.try_clone().ok()?, self.version);
        Some(Box::new(move || {
            link.discard();
            link.hello();
        }))
    }

    /// Lets other programs open the port.
    pub fn release(&self) {
        release_device(&self.port);
    }
}
