//! The messages between the machine that deploys and the robot.
//!
//! Both directions are packets: a letter, a length of four bytes (little-endian), and the content.
//! `m` is a message in JSON and `c` is a part of a file's content. The agent begins with a
//! [`GREETING`], so that other output, such as that of a login shell, is noticed.

use std::io::{self, Read, Write};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::manifest::Manifest;

/// The first bytes of the agent. The number changes if an older side cannot understand a newer one.
pub const GREETING: &[u8] = b"afp-agent 1\n";
/// The longest message, in bytes.
pub const LONGEST_MESSAGE: usize = 256 << 10;
/// The longest part of a content, in bytes.
pub const LONGEST_PART: usize = 32 << 10;

/// A message to the agent.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Request {
    /// Asks for [`Answer::Status`].
    Status,
    /// Begins a deploy. The agent answers [`Answer::Missing`] or [`Answer::Refused`].
    Deploy { manifest: Manifest, stop_first: bool },
    /// Announces the content of a missing file, which follows in parts. There is no answer.
    Content { sha256: String },
    /// All missing files were sent: checks and starts the release. Steps follow, then
    /// [`Answer::Runs`] or [`Answer::Refused`].
    Commit,
    /// Goes back to the release that ran before. Answers as for [`Request::Commit`].
    Rollback { stop_first: bool },
    /// Lets the plan drive, or stops it.
    Arm(bool),
    /// Asks for [`Answer::Logs`].
    Logs,
    /// Asks for the content of a log from this byte on: [`Answer::Content`], then parts.
    Log { name: String, from: u64 },
}

/// A message from the agent.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// The first message.
    Hello(Hello),
    /// The hashes that the robot lacks, without repetition.
    Missing(Vec<String>),
    /// A step of a commit or rollback begins.
    Step(Step),
    /// The release runs. `instead` says why it is not the requested release.
    Runs {
        release: String,
        plan: String,
        instead: Option<String>,
    },
    Status(Status),
    /// The names and lengths of logs.
    Logs(Vec<(String, u64)>),
    /// The number of bytes of the content that follows.
    Content {
        size: u64,
    },
    /// Nothing has changed.
    Done,
    /// The request was not carried out.
    Refused {
        message: String,
        help: String,
    },
}

/// The robot.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hello {
    /// The version of its `afpc`.
    pub version: String,
    /// Its processor, such as `aarch64`.
    pub architecture: String,
    /// Its model: the profile, or else the toolbox with its devices.
    pub model: String,
    /// Free bytes on its disk, if known.
    pub space: Option<u64>,
    #[serde(default)]
    pub calibration: Calibration,
}

/// The calibration of a robot.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Calibration {
    /// This kind of robot has none.
    #[default]
    Unneeded,
    Missing,
    /// The SHA-256 of its text.
    Of(String),
}

/// A step on the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Step {
    Check,
    Switch,
    Start,
}

/// The state of the robot.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Status {
    pub state: State,
    /// The release that runs.
    pub running: Option<Named>,
    /// The release that the next start runs.
    pub current: Option<Named>,
    /// The releases on the robot, the newest first.
    pub releases: Vec<Named>,
    /// A sentence about the last failure.
    pub trouble: Option<String>,
}

/// A release and its plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Named {
    pub release: String,
    pub plan: String,
}

/// The state of the program that runs the release.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum State {
    /// No program runs.
    #[default]
    Stopped,
    /// The program waits to be armed; the robot does not move.
    Disarmed,
    /// The plan drives the robot.
    Armed,
}

/// A packet.
#[derive(Debug, PartialEq, Eq)]
pub enum Packet<M> {
    Message(M),
    Part(Vec<u8>),
}

/// A reason why no packet can be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WireError {
    #[error("the connection ended")]
    Ended,
    #[error("{0}")]
    Io(#[from] io::Error),
    #[error("a packet of {0} bytes is too long")]
    Long(usize),
    #[error("a packet of an unknown kind")]
    Kind,
    #[error("a message that this version does not know: {0}")]
    Message(serde_json::Error),
}

/// Writes a message and flushes.
///
/// # Errors
/// The stream is closed.
pub fn send(to: &mut dyn Write, message: &impl Serialize) -> io::Result<()> {
    let text = serde_json::to_vec(message)?;
    packet(to, b'm', &text)?;
    to.flush()
}

/// Writes a content in parts and flushes.
///
/// # Errors
/// The stream is closed.
pub fn send_content(to: &mut dyn Write, content: &[u8]) -> io::Result<()> {
    content.chunks(LONGEST_PART).try_for_each(|part| packet(to, b'c', part))?;
    to.flush()
}

fn packet(to: &mut dyn Write, kind: u8, bytes: &[u8]) -> io::Result<()> {
    let length = u32::try_from(bytes.len()).map_err(io::Error::other)?;
    to.write_all(&[kind])?;
    to.write_all(&length.to_le_bytes())?;
    to.write_all(bytes)
}

/// Reads a packet.
///
/// # Errors
/// The stream ends, or the packet is too long, of an unknown kind, or not a message.
pub fn receive<M: DeserializeOwned>(from: &mut dyn Read) -> Result<Packet<M>, WireError> {
    let mut head = [0; 5];
    from.read_exact(&mut head).map_err(ended)?;
    let [kind, length @ ..] = head;
    let length = usize::try_from(u32::from_le_bytes(length)).unwrap_or(usize::MAX);
    let most = match kind {
        b'm' => LONGEST_MESSAGE,
        b'c' => LONGEST_PART,
        _ => return Err(WireError::Kind),
    };
    if length > most {
        return Err(WireError::Long(length));
    }
    let mut bytes = vec![0; length];
    from.read_exact(&mut bytes).map_err(ended)?;
    match kind {
        b'm' => serde_json::from_slice(&bytes).map(Packet::Message).map_err(WireError::Message),
        _ => Ok(Packet::Part(bytes)),
    }
}

fn ended(why: io::Error) -> WireError {
    match why.kind() {
        io::ErrorKind::UnexpectedEof | io::ErrorKind::BrokenPipe => WireError::Ended,
        _ => WireError::Io(why),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packets_are_read_back_and_bounded() {
        let mut bytes = Vec::new();
        send(&mut bytes, &Request::Log { name: "a".to_owned(), from: 3 }).unwrap();
        send_content(&mut bytes, &[7; LONGEST_PART + 1]).unwrap();
        let mut from = &*bytes;
        let log = Request::Log { name: "a".to_owned(), from: 3 };
        assert_eq!(receive(&mut from).unwrap(), Packet::Message(log));
        for length in [LONGEST_PART, 1] {
            assert_eq!(receive::<Request>(&mut from).unwrap(), Packet::Part(vec![7; length]));
        }
        assert!(matches!(receive::<Request>(&mut from), Err(WireError::Ended)));
        let huge = [b'm', 255, 255, 255, 255];
        assert!(matches!(receive::<Request>(&mut &huge[..]), Err(WireError::Long(_))));
        assert!(matches!(receive::<Request>(&mut &b"Last login"[..]), Err(WireError::Kind)));
        let unknown = [&b"m\x06\0\0\0"[..], b"\"warp\""].concat();
        assert!(matches!(receive::<Request>(&mut &*unknown), Err(WireError::Message(_))));
    }
}
