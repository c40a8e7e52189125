//! A connection to the debug adapter of a run elsewhere. It answers the lease for clients that do
//! not know it.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use afp_output::frames::{Frames, WireError, frame};
use afp_run::RunError;
use serde_json::{Value, json};

use super::sockets;
use crate::commands::robot::connect::command;
use crate::commands::stream::read;

/// The interval of checks whether the run has closed the connection.
const LOOK: Duration = Duration::from_millis(50);
/// The time that the connection has for its last messages.
const PATIENCE: Duration = Duration::from_secs(2);

/// A connection to a run.
pub struct Link {
    from: Box<dyn Read + Send>,
    to: Box<dyn Write + Send>,
    child: Option<Child>,
}

/// The messages of a client that comes from elsewhere.
pub struct Begun {
    /// Its first messages, to be sent again.
    pub first: Vec<String>,
    /// The number of a request that is answered already.
    pub answered: Option<i64>,
    /// Whether the client answers the lease itself.
    pub leases: bool,
    pub frames: Frames,
}

impl Begun {
    /// A client that has sent nothing.
    pub fn nothing() -> Begun {
        Begun { first: Vec::new(), answered: None, leases: false, frames: Frames::default() }
    }
}

impl Link {
    /// Connects to a run by ssh, or to a socket on this machine.
    ///
    /// # Errors
    /// It cannot be reached.
    pub fn to(place: &str) -> Result<Link, RunError> {
        if place.contains('/') && !place.starts_with("exec:") {
            let stream = sockets::connect(Path::new(place))?;
            let copy =
                stream.try_clone().map_err(RunError::file("cannot attach to", place.as_ref()))?;
            return Ok(Link { from: Box::new(copy), to: Box::new(stream), child: None });
        }
        let mut command: Command = command(place, "afpc attach")?;
        let name = command.get_program().to_string_lossy().into_owned();
        let spawned = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = spawned.map_err(RunError::file("cannot start", name.as_ref()))?;
        let (Some(to), Some(from)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(RunError::usage(format!("'{name}' has no pipes"), ""));
        };
        Ok(Link { from: Box::new(from), to: Box::new(to), child: Some(child) })
    }

    /// Passes messages on in both directions until one side ends.
    ///
    /// # Errors
    /// The client's input is not a sequence of messages.
    pub fn relay(
        self,
        mut begun: Begun,
        arrived: &Receiver<Vec<u8>>,
        out: impl Write + Send + 'static,
    ) -> Result<(), WireError> {
        let Link { from, to, child } = self;
        let to: Arc<Way> = Arc::new(Mutex::new(Some(to)));
        let over = Arc::new(AtomicBool::new(false));
        let back = Back { to: to.clone(), out, answered: begun.answered, leases: begun.leases };
        let ended = over.clone();
        let receiving = thread::spawn(move || {
            back.pass_on(from);
            ended.store(true, Ordering::Release);
        });
        begun.first.iter().for_each(|message| send(&to, message));
        loop {
            while let Some(message) = begun.frames.next_message()? {
                send(&to, &message);
            }
            match arrived.recv_timeout(LOOK) {
                Ok(bytes) => begun.frames.push(&bytes),
                Err(RecvTimeoutError::Timeout) if over.load(Ordering::Acquire) => break,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        // The other side ends with its input, after it has read all messages.
        *to.lock().unwrap_or_else(PoisonError::into_inner) = None;
        if let Some(mut child) = child {
            let since = Instant::now();
            while matches!(child.try_wait(), Ok(None)) && since.elapsed() < PATIENCE {
                thread::sleep(LOOK);
            }
            let _ = child.kill();
            let _ = child.wait();
            let _ = receiving.join();
        }
        Ok(())
    }
}

/// The way to the run; `None` after the last message.
type Way = Mutex<Option<Box<dyn Write + Send>>>;

/// The way back to the client.
struct Back<W> {
    to: Arc<Way>,
    out: W,
    answered: Option<i64>,
    leases: bool,
}

impl<W: Write> Back<W> {
    fn pass_on(mut self, from: impl Read) {
        let mut frames = Frames::default();
        read(from, |bytes| {
            frames.push(&bytes);
            while let Ok(Some(message)) = frames.next_message() {
                if !self.message(&message) {
                    return false;
                }
            }
            true
        });
    }

    /// Handles a message of the run; returns whether the client still listens.
    fn message(&mut self, message: &str) -> bool {
        let parsed: Value = serde_json::from_str(message).unwrap_or_default();
        if parsed["command"] == "afp/lease" && parsed["type"] == "request" && !self.leases {
            let answer = json!({
                "type": "response", "request_seq": parsed["seq"], "command": "afp/lease",
                "success": true, "seq": 0,
            });
            send(&self.to, &answer.to_string());
            return true;
        }
        if parsed["type"] == "response"
            && self.answered.is_some()
            && parsed["request_seq"].as_i64() == self.answered
        {
            self.answered = None;
            return true;
        }
        self.out.write_all(&frame(message)).and_then(|()| self.out.flush()).is_ok()
    }
}

/// Sends a message in one piece. If the other side is gone, its reader ends the connection.
fn send(to: &Way, message: &str) {
    if let Some(to) = &mut *to.lock().unwrap_or_else(PoisonError::into_inner) {
        let _ = to.write_all(&frame(message)).and_then(|()| to.flush());
    }
}
