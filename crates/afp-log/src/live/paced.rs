//! A connection that is written to for a bounded time in one turn, so that what a client says is heard however slowly it reads.

use std::io::{self, ErrorKind, Read, Write};
use std::net::TcpStream;
use std::time::{Duration, Instant as Wall};

/// How long is written in one turn; one write more may rest until the stream's own limit.
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
    /// A connection that is written to without a bound before the first turn.
    pub fn new(stream: TcpStream) -> Paced {
        Paced { stream, turn: None }
    }

    pub fn begin_turn(&mut self) {
        self.turn = Some(Turn { begun: Wall::now(), has_written: false });
    }

    /// Whether the client has taken anything in this turn.
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
    /// As that of the stream; `WouldBlock` once the turn is over.
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
