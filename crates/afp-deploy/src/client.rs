//! The side of the machine that deploys.

use std::io::{self, Read, Write};

use crate::manifest::{Kind, Manifest};
use crate::wire::{
    Answer, GREETING, Hello, Packet, Request, Status, Step, WireError, receive, send, send_content,
};

/// The most bytes that are shown of a side that is not an agent.
const SHOWN: usize = 400;

/// A connection to an agent.
pub struct Connection<R, W> {
    from: R,
    to: W,
    /// The robot.
    pub hello: Hello,
}

/// Why a request failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ClientError {
    /// The other side is not an agent; these are its first bytes as text.
    #[error("the robot did not answer as 'afpc agent' does")]
    NotAgent(String),
    /// The connection ended, or the agent does not follow the protocol.
    #[error("the connection to the robot failed: {0}")]
    Wire(#[from] WireError),
    #[error("the agent answered a different request")]
    Unexpected,
    #[error("{message}")]
    Refused { message: String, help: String },
}

impl From<io::Error> for ClientError {
    fn from(why: io::Error) -> Self {
        ClientError::Wire(WireError::Io(why))
    }
}

/// An event of a deploy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// The number of changed files, and of their bytes.
    Differs { files: usize, bytes: u64 },
    /// A step on the robot begins.
    Step(Step),
}

/// The release that runs after a deploy or a rollback.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ran {
    pub release: String,
    pub plan: String,
    /// Why it is not the requested release.
    pub instead: Option<String>,
}

impl<R: Read, W: Write> Connection<R, W> {
    /// Reads the greeting of an agent.
    ///
    /// # Errors
    /// The other side is not an agent of this protocol.
    pub fn new(mut from: R, to: W) -> Result<Self, ClientError> {
        let mut said = Vec::new();
        for expected in GREETING {
            let mut byte = [0];
            let read = from.read(&mut byte).unwrap_or(0);
            said.extend(byte.iter().take(read));
            if read == 0 || byte != [*expected] {
                from.take(SHOWN as u64).read_to_end(&mut said).ok();
                return Err(ClientError::NotAgent(
                    String::from_utf8_lossy(&said).trim().to_owned(),
                ));
            }
        }
        let mut connection = Connection { from, to, hello: Hello::default() };
        let Answer::Hello(hello) = connection.receive()? else {
            return Err(ClientError::Unexpected);
        };
        connection.hello = hello;
        Ok(connection)
    }

    /// Puts a release on the robot and starts it. `contents` returns the content with a hash.
    ///
    /// # Errors
    /// The robot refuses the release, or the connection fails. In either case the robot has a
    /// complete release, which [`Connection::status`] names.
    pub fn deploy<'c>(
        &mut self,
        manifest: &Manifest,
        contents: &dyn Fn(&str) -> Option<&'c [u8]>,
        stop_first: bool,
        progress: &mut dyn FnMut(Progress),
    ) -> Result<Ran, ClientError> {
        let request = Request::Deploy { manifest: manifest.clone(), stop_first };
        let Answer::Missing(missing) = self.ask(&request)? else {
            return Err(ClientError::Unexpected);
        };
        let content = |sha256: &str| contents(sha256).ok_or(ClientError::Unexpected);
        let missing = missing.iter().map(|sha256| Ok((sha256, content(sha256)?)));
        let missing = missing.collect::<Result<Vec<_>, ClientError>>()?;
        let bytes = missing.iter().map(|(_, content)| content.len() as u64).sum();
        progress(Progress::Differs { files: missing.len(), bytes });
        for (sha256, content) in missing {
            if let Err(why) = self.send_file(sha256, content) {
                // The agent said why before it ended.
                return Err(self.receive().err().unwrap_or(why.into()));
            }
        }
        self.start(&Request::Commit, progress)
    }

    fn send_file(&mut self, sha256: &str, content: &[u8]) -> io::Result<()> {
        send(&mut self.to, &Request::Content { sha256: sha256.to_owned() })?;
        send_content(&mut self.to, content)
    }

    /// Goes back to the release that ran before.
    ///
    /// # Errors
    /// There is none, the robot may be moving, or the connection fails.
    pub fn rollback(
        &mut self,
        stop_first: bool,
        progress: &mut dyn FnMut(Progress),
    ) -> Result<Ran, ClientError> {
        self.start(&Request::Rollback { stop_first }, progress)
    }

    fn start(
        &mut self,
        request: &Request,
        progress: &mut dyn FnMut(Progress),
    ) -> Result<Ran, ClientError> {
        let mut answer = self.ask(request)?;
        loop {
            match answer {
                Answer::Step(step) => progress(Progress::Step(step)),
                Answer::Runs { release, plan, instead } => {
                    return Ok(Ran { release, plan, instead });
                }
                _ => return Err(ClientError::Unexpected),
            }
            answer = self.receive()?;
        }
    }

    /// Lets the plan drive, or stops it.
    ///
    /// # Errors
    /// No plan waits on the robot, or the connection fails.
    pub fn arm(&mut self, arm: bool) -> Result<(), ClientError> {
        match self.ask(&Request::Arm(arm))? {
            Answer::Done => Ok(()),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// The state of the robot and its releases.
    ///
    /// # Errors
    /// The connection fails.
    pub fn status(&mut self) -> Result<Status, ClientError> {
        match self.ask(&Request::Status)? {
            Answer::Status(status) => Ok(status),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// The names and lengths of the robot's logs.
    ///
    /// # Errors
    /// The connection fails.
    pub fn logs(&mut self) -> Result<Vec<(String, u64)>, ClientError> {
        match self.ask(&Request::Logs)? {
            Answer::Logs(logs) => Ok(logs),
            _ => Err(ClientError::Unexpected),
        }
    }

    /// Appends the content of a log to an output, from a byte on. Returns the number of bytes.
    ///
    /// # Errors
    /// There is no such log, the connection or the output fails. The output then has the first
    /// bytes, and the next call can continue after them.
    pub fn log(&mut self, name: &str, from: u64, to: &mut dyn Write) -> Result<u64, ClientError> {
        let Answer::Content { size } = self.ask(&Request::Log { name: name.to_owned(), from })?
        else {
            return Err(ClientError::Unexpected);
        };
        let mut left = size;
        while left > 0 {
            let Packet::Part(part) = receive::<Answer>(&mut self.from)? else {
                return Err(ClientError::Unexpected);
            };
            left = left.checked_sub(part.len() as u64).ok_or(ClientError::Unexpected)?;
            to.write_all(&part)?;
        }
        Ok(size)
    }

    fn ask(&mut self, request: &Request) -> Result<Answer, ClientError> {
        send(&mut self.to, request)?;
        self.receive()
    }

    fn receive(&mut self) -> Result<Answer, ClientError> {
        match receive(&mut self.from)? {
            Packet::Message(Answer::Refused { message, help }) => {
                Err(ClientError::Refused { message, help })
            }
            Packet::Message(answer) => Ok(answer),
            Packet::Part(_) => Err(ClientError::Unexpected),
        }
    }
}

/// Whether a release can run on a robot with another version of `afpc`.
///
/// # Errors
/// The interpreter of the robot has another version.
pub fn check_version(hello: &Hello, manifest: &Manifest, ours: &str) -> Result<(), ClientError> {
    match manifest.kind {
        Kind::Interpreted if hello.version != ours => Err(ClientError::Refused {
            message: format!("the robot has afpc {}, and this is {ours}", hello.version),
            help: "install the same version on both, or deploy a program with '--built'".to_owned(),
        }),
        _ => Ok(()),
    }
}
