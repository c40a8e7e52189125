//! Messages of clients.

use std::io::Read;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use afp_output::frames::{Frames, WireError};

use crate::commands::stream::read;

/// The next thing to handle.
pub enum Arrived {
    /// Messages of the client; an empty list if no message is complete yet.
    Messages(Vec<String>),
    /// Time has passed.
    Nothing,
    /// The client is gone.
    End,
}

/// Messages from a stream of bytes.
pub struct Incoming {
    arrived: Receiver<Vec<u8>>,
    frames: Frames,
}

impl Incoming {
    /// Reads a stream on a thread, which ends with the stream or with the program.
    pub fn new(from: impl Read + Send + 'static) -> Incoming {
        let (sender, arrived) = channel();
        thread::spawn(move || read(from, |bytes| sender.send(bytes).is_ok()));
        Incoming { arrived, frames: Frames::default() }
    }

    /// Waits for messages.
    ///
    /// # Errors
    /// The input is not a sequence of messages.
    pub fn next(&mut self, due: Option<Duration>) -> Result<Arrived, WireError> {
        match wait(&self.arrived, due) {
            Ok(bytes) => {
                self.frames.push(&bytes);
                let mut messages = Vec::new();
                while let Some(message) = self.frames.next_message()? {
                    messages.push(message);
                }
                Ok(Arrived::Messages(messages))
            }
            Err(RecvTimeoutError::Timeout) => Ok(Arrived::Nothing),
            Err(RecvTimeoutError::Disconnected) => {
                std::mem::take(&mut self.frames).finish().map(|()| Arrived::End)
            }
        }
    }
}

/// Waits for an arrival until the next step of the run.
pub fn wait<T>(arrived: &Receiver<T>, due: Option<Duration>) -> Result<T, RecvTimeoutError> {
    match due {
        None => arrived.recv().map_err(|_| RecvTimeoutError::Disconnected),
        Some(due) => arrived.recv_timeout(due),
    }
}
