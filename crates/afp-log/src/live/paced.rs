//! A connection with a time limit for the writes of one turn, so that slow clients are still heard.

use std::io::{self, ErrorKind, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant as Wall};

/// The time limit of one turn; the last write may also take the stream's own limit.
const TURN: Duration = Duration::from_millis(50);

#[derive(Debug)]
pub(crate) struct Paced {
    stream: TcpStream,
    turn: Option<Turn>,
}

#[derive(Debug)]
struct Turn {
    begun: Wall,
    has_written: bool,
}

impl Paced {
    /// A connection without a limit before the first turn.
    pub fn new(stream: TcpStream) -> Paced {
        Paced { stream, turn: None }
    }

    pub fn begin_turn(&mut self) {
        self.turn = Some(Turn { begun: Wall::now(), has_written: false });
    }

    /// Whether the client has accepted data in this turn.
    pub fn has_written(&self) -> bool {
        self.turn.as_ref().is_some_and(|turn| turn.has_written)
    }

    pub fn stream(&self) -> &TcpStream {
        &self.stream
    }
}

impl Read for Paced {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.stream.read(bytes)
    }
}

impl Write for Paced {
    /// Like the stream's; `WouldBlock` after the end of the turn.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let Some(turn) = &mut self.turn else { return self.stream.write(bytes) };
        if turn.begun.elapsed() > TURN {
            return Err(ErrorKind::WouldBlock.into());
        }
        let written = self.stream.write(bytes)?;
        turn.has_written |= written > 0;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}
