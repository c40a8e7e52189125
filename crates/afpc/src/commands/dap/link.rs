//! A connection to the debug adapter of a run elsewhere. It answers the lease for clients that do
//! not know it.

use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use afp_output::frames::{Frames, WireError, frame};
use afp_run::RunError;
use serde_json::{Value, json};

use super::incoming::Arrived;
use super::sockets;
use crate::commands::robot::connect::{command, no_ssh, shown, unreachable};
use crate::commands::stream::read;

/// The interval of checks whether the run has closed the connection.
const LOOK: Duration = Duration::from_millis(50);
/// The time that the connection has for its last messages.
const PATIENCE: Duration = Duration::from_secs(2);

/// Sends a message to the client; returns whether the client still listens.
pub type Tell = Arc<dyn Fn(&str) -> bool + Send + Sync>;

/// A connection to a run.
pub struct Link {
    from: Box<dyn Read + Send>,
    to: Box<dyn Write + Send>,
    ssh: Option<Ssh>,
}

/// The program that connects to another machine, with the errors that it prints.
struct Ssh {
    host: String,
    child: Child,
    errors: Option<JoinHandle<String>>,
}

/// The messages of a client that comes from elsewhere.
#[derive(Default)]
pub struct Begun {
    /// Its first messages, to be sent again.
    pub first: Vec<String>,
    /// The number of a request that is answered already.
    pub answered: Option<i64>,
    /// Whether the client answers the lease itself.
    pub leases: bool,
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
            return Ok(Link { from: Box::new(copy), to: Box::new(stream), ssh: None });
        }
        let mut command: Command = command(place, "afpc attach")?;
        let name = command.get_program().to_string_lossy().into_owned();
        let piped = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = piped.spawn().map_err(|why| no_ssh(&name, &why))?;
        let errors = child.stderr.take().map(shown);
        let (Some(to), Some(from)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(RunError::usage(format!("'{name}' has no pipes"), ""));
        };
        let ssh = Ssh { host: place.to_owned(), child, errors };
        Ok(Link { from: Box::new(from), to: Box::new(to), ssh: Some(ssh) })
    }

    /// Passes messages on in both directions until one side ends. Returns the reason if the other
    /// machine has not answered.
    ///
    /// # Errors
    /// The client's input is not a sequence of messages.
    pub fn relay(
        self,
        begun: Begun,
        mut next: impl FnMut(Option<Duration>) -> Result<Arrived, WireError>,
        tell: &Tell,
    ) -> Result<Option<RunError>, WireError> {
        let Link { from, to, ssh } = self;
        let to: Arc<Way> = Arc::new(Mutex::new(Some(to)));
        let over = Arc::new(AtomicBool::new(false));
        let (tell, answered) = (tell.clone(), begun.answered);
        let back = Back { to: to.clone(), tell, answered, leases: begun.leases, heard: false };
        let ended = over.clone();
        let receiving = thread::spawn(move || {
            let heard = back.pass_on(from);
            ended.store(true, Ordering::Release);
            heard
        });
        begun.first.iter().for_each(|message| send(&to, message));
        let left = loop {
            match next(Some(LOOK))? {
                Arrived::Messages(all) => all.iter().for_each(|message| send(&to, message)),
                Arrived::Nothing if over.load(Ordering::Acquire) => break false,
                Arrived::Nothing => {}
                Arrived::End => break true,
            }
        };
        // The other side ends with its input, after it has read all messages.
        *to.lock().unwrap_or_else(PoisonError::into_inner) = None;
        let Some(ssh) = ssh else { return Ok(None) };
        let (host, said) = ssh.end();
        let heard = receiving.join().unwrap_or_default();
        Ok((!heard && !left).then(|| unreachable(&host, &said)))
    }
}

impl Ssh {
    /// Waits for the end of the program; returns the host and the program's errors.
    fn end(mut self) -> (String, String) {
        let since = Instant::now();
        while matches!(self.child.try_wait(), Ok(None)) && since.elapsed() < PATIENCE {
            thread::sleep(LOOK);
        }
        let _ = self.child.kill();
        let _ = self.child.wait();
        // A process that ssh has started can keep its errors open.
        let is_read = |errors: &JoinHandle<String>| errors.is_finished();
        while self.errors.as_ref().is_some_and(|it| !is_read(it)) && since.elapsed() < 2 * PATIENCE
        {
            thread::sleep(LOOK);
        }
        let said = self.errors.filter(is_read).and_then(|errors| errors.join().ok());
        (self.host, said.unwrap_or_default())
    }
}

/// The way to the run; `None` after the last message.
type Way = Mutex<Option<Box<dyn Write + Send>>>;

/// The way back to the client.
struct Back {
    to: Arc<Way>,
    tell: Tell,
    answered: Option<i64>,
    leases: bool,
    /// Whether the run has sent a message.
    heard: bool,
}

impl Back {
    /// Passes messages on; returns whether there was one.
    fn pass_on(mut self, from: impl Read) -> bool {
        let mut frames = Frames::default();
        read(from, |bytes| {
            frames.push(&bytes);
            while let Ok(Some(message)) = frames.next_message() {
                self.heard = true;
                if !self.message(&message) {
                    return false;
                }
            }
            true
        });
        self.heard
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
        (self.tell)(message)
    }
}

/// Sends a message in one piece. If the other side is gone, its reader ends the connection.
fn send(to: &Way, message: &str) {
    if let Some(to) = &mut *to.lock().unwrap_or_else(PoisonError::into_inner) {
        let _ = to.write_all(&frame(message)).and_then(|()| to.flush());
    }
}
