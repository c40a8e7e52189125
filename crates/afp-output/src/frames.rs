//! Messages on a stream of bytes, as in the protocols of debuggers and language servers: a header
//! with the length, an empty line, the message. The size bound limits the reader's memory.

use std::fmt;

/// The maximum length of a message from an unknown client, in bytes.
pub const MAX_MESSAGE: usize = 1 << 20;
/// The maximum length of a header.
const MAX_HEADER: usize = 1 << 12;

/// Extracts messages from the received bytes.
#[derive(Debug)]
pub struct Frames {
    arrived: Vec<u8>,
    /// The maximum length of a message, in bytes.
    longest: usize,
}

impl Default for Frames {
    fn default() -> Self {
        Frames::up_to(MAX_MESSAGE)
    }
}

/// The input is not a message; the rest of the stream is unreadable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WireError {
    /// The message does not begin with a header and a length.
    Header,
    /// The message is longer than the maximum.
    TooLong {
        /// The length in its header.
        length: usize,
        /// The maximum length.
        longest: usize,
    },
    /// The message is not valid UTF-8; the next one can be read.
    NoText,
    /// The stream ends within a message.
    CutOff,
}

impl Frames {
    /// A reader of messages up to this length in bytes.
    pub fn up_to(longest: usize) -> Frames {
        Frames { arrived: Vec::new(), longest }
    }

    /// Adds received bytes.
    pub fn push(&mut self, bytes: &[u8]) {
        self.arrived.extend_from_slice(bytes);
    }

    /// The next complete message.
    ///
    /// # Errors
    /// The input is not a message.
    pub fn next_message(&mut self) -> Result<Option<String>, WireError> {
        let end = self.arrived.windows(4).position(|four| four == b"\r\n\r\n");
        let Some(end) = end else {
            return if self.arrived.len() > MAX_HEADER { Err(WireError::Header) } else { Ok(None) };
        };
        let length = length(&self.arrived[..end]).ok_or(WireError::Header)?;
        if length > self.longest {
            return Err(WireError::TooLong { length, longest: self.longest });
        }
        let (from, to) = (end + 4, end + 4 + length);
        if self.arrived.len() < to {
            return Ok(None);
        }
        let rest = self.arrived.split_off(to);
        let whole = std::mem::replace(&mut self.arrived, rest);
        let text = std::str::from_utf8(&whole[from..]).map_err(|_| WireError::NoText)?;
        Ok(Some(text.to_owned()))
    }

    /// Ends the input.
    ///
    /// # Errors
    /// The last message is incomplete or invalid.
    pub fn finish(self) -> Result<(), WireError> {
        match &*self.arrived {
            [] => Ok(()),
            rest if rest.windows(4).any(|four| four == b"\r\n\r\n") => Err(WireError::CutOff),
            _ => Err(WireError::Header),
        }
    }
}

/// The length in a header; `None` if it has none, or two that differ.
fn length(header: &[u8]) -> Option<usize> {
    let header = std::str::from_utf8(header).ok()?;
    let lengths = header.split("\r\n").filter_map(|line| {
        let (name, value) = line.split_once(':')?;
        name.trim().eq_ignore_ascii_case("content-length").then(|| value.trim().parse().ok())
    });
    lengths.reduce(|one, other| one.filter(|_| one == other)).flatten()
}

/// A message with its header.
pub fn frame(message: &str) -> Vec<u8> {
    format!("Content-Length: {}\r\n\r\n{message}", message.len()).into_bytes()
}

impl fmt::Display for WireError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            WireError::Header => {
                f.write_str("it does not speak the protocol, whose messages begin with 'Content-Length: ' and a number of bytes")
            }
            WireError::TooLong { length, longest } => {
                write!(f, "a message of {length} bytes; the longest may have {longest}")
            }
            WireError::NoText => f.write_str("a message that is not UTF-8"),
            WireError::CutOff => f.write_str("its last message ends before its length"),
        }
    }
}

impl std::error::Error for WireError {}

#[cfg(test)]
mod tests {
    use super::{Frames, MAX_MESSAGE, WireError, frame};

    #[test]
    fn messages_are_the_same_for_every_split_of_the_bytes() {
        let sent: Vec<u8> = ["{}", "{\"ä\":1}", ""].iter().flat_map(|text| frame(text)).collect();
        for size in 1..sent.len() {
            let (mut frames, mut got) = (Frames::default(), Vec::new());
            for piece in sent.chunks(size) {
                frames.push(piece);
                while let Some(message) = frames.next_message().expect("all are messages") {
                    got.push(message);
                }
            }
            assert_eq!(got, ["{}", "{\"ä\":1}", ""], "in pieces of {size}");
        }
    }

    #[test]
    fn invalid_messages_are_refused() {
        let long = format!("Content-Length: {}\r\n\r\n", MAX_MESSAGE + 1);
        let babble = "x".repeat(5000);
        for (bytes, error) in [
            ("Hello\r\n\r\n", WireError::Header),
            ("Content-Length: many\r\n\r\n", WireError::Header),
            ("Content-Length: -1\r\n\r\n", WireError::Header),
            ("Content-Length: 99999999999999999999999\r\n\r\n", WireError::Header),
            ("Content-Length: 2\r\nContent-Length: 3\r\n\r\n{}", WireError::Header),
            ("Content-Length: 2\r\nContent-Length: x\r\n\r\n{}", WireError::Header),
            ("Content-Type: x\r\n\r\n{}", WireError::Header),
            (&*long, WireError::TooLong { length: MAX_MESSAGE + 1, longest: MAX_MESSAGE }),
            (&*babble, WireError::Header),
        ] {
            let mut frames = Frames::default();
            frames.push(bytes.as_bytes());
            assert_eq!(frames.next_message(), Err(error));
        }
        let mut frames = Frames::default();
        frames.push(
            b"Content-Length: 2\r\n\r\n\xff\xffcontent-length:2\r\nContent-Length: 2\r\n\r\n{}",
        );
        assert_eq!(frames.next_message(), Err(WireError::NoText));
        assert_eq!(frames.next_message(), Ok(Some("{}".to_owned())));
    }

    #[test]
    fn a_stream_that_ends_within_a_message_is_an_error() {
        for (bytes, ends) in [
            ("", Ok(())),
            ("Content-Length: 2\r\n\r\n{}", Ok(())),
            ("Content-Length: 2\r\n\r\n{", Err(WireError::CutOff)),
            ("Content-Length: 2\r\n\r\n{}Content", Err(WireError::Header)),
            ("hello\n", Err(WireError::Header)),
        ] {
            let mut frames = Frames::default();
            frames.push(bytes.as_bytes());
            while let Ok(Some(_)) = frames.next_message() {}
            assert_eq!(frames.finish(), ends, "{bytes:?}");
        }
    }
}
