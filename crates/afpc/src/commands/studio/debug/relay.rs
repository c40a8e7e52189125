//! A conversation that continues with another program.

use std::io::Write;
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use afp_output::frames::{Frames, frame};
use serde_json::{Value, json};

use super::output;
use crate::commands::stream::read;

/// The time in which a program must end after its client has gone: it stops the robot first.
const GRACE_PERIOD: Duration = Duration::from_secs(2);

/// The interval of the checks that the program still runs, while the client is silent.
const LOOK: Duration = Duration::from_millis(100);

/// The client's messages so far.
#[derive(Default)]
pub(super) struct Conversation {
    /// The initialize request, already answered.
    greeting: Option<String>,
    rest: Vec<String>,
}

impl Conversation {
    /// Keeps an answered request if the next program must know it.
    pub(super) fn note(&mut self, request: &Value, message: &str) {
        if request["command"] == "initialize" {
            self.greeting = Some(message.to_owned());
        }
    }

    /// Adds an unanswered request.
    pub(super) fn then(&mut self, message: String) {
        self.rest.push(message);
    }
}

/// Connects a client with the debug adapter of another program until one of them is gone. Then the
/// program has ended. A remaining client is notified, unless the program did it.
pub(super) fn relay(
    program: &Path,
    folder: &Path,
    before: Conversation,
    said: &Receiver<String>,
    tell: &(impl Fn(String) -> bool + Sync),
) {
    let mut command = Command::new(program);
    command.args(["dap", "--inside"]).arg(folder).current_dir(folder);
    let started = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
    let mut child = match started {
        Ok(child) => child,
        Err(why) => {
            tell(output("stderr", &format!("cannot start '{}': {why}", program.display())));
            return;
        }
    };
    let (Some(to), Some(from)) = (child.stdin.take(), child.stdout.take()) else { return };
    let greeted = before.greeting.is_some();
    let silent = AtomicBool::new(false);
    thread::scope(|scope| {
        let answers = scope.spawn(|| {
            let said_goodbye = forward_answers(from, greeted, tell);
            silent.store(true, Ordering::Relaxed);
            said_goodbye
        });
        let is_gone = forward_requests(to, before, said, &silent);
        let status = end(&mut child);
        let said_goodbye = answers.join().unwrap_or_default();
        if !is_gone && !said_goodbye {
            tell(output("stderr", &died(status)));
            tell(json!({ "seq": 0, "type": "event", "event": "terminated" }).to_string());
        }
    });
}

/// The message for a client after its program has ended unexpectedly.
fn died(status: Option<ExitStatus>) -> String {
    let how = status.map_or_else(String::new, |status| format!(" ({status})"));
    format!(
        "the program with the robot of the project has ended unexpectedly{how}: see the terminal of the studio"
    )
}

/// Forwards the program's messages except its second answer to `initialize`. Returns whether the
/// program has reported the end of the run.
fn forward_answers(
    from: ChildStdout,
    greeted: bool,
    tell: &(impl Fn(String) -> bool + Sync),
) -> bool {
    let mut frames = Frames::default();
    let (mut answered, mut said_goodbye) = (!greeted, false);
    read(from, |bytes| {
        frames.push(&bytes);
        while let Ok(Some(message)) = frames.next_message() {
            said_goodbye |= is_goodbye(&message);
            if !answered && is_greeting(&message) {
                answered = true;
            } else if !tell(message) {
                return false;
            }
        }
        true
    });
    said_goodbye
}

/// Whether a message reports the end of the run or disconnects the client.
fn is_goodbye(message: &str) -> bool {
    if !message.contains("terminated") && !message.contains("disconnect") {
        return false;
    }
    let value: Value = serde_json::from_str(message).unwrap_or_default();
    value["event"] == "terminated"
        || (value["type"] == "response" && value["command"] == "disconnect")
}

fn is_greeting(message: &str) -> bool {
    let value: Value = serde_json::from_str(message).unwrap_or_default();
    value["type"] == "response" && value["command"] == "initialize"
}

/// Forwards the client's messages until the client is gone or the program stops reading or writing.
/// Returns whether the client is gone.
fn forward_requests(
    mut to: ChildStdin,
    before: Conversation,
    said: &Receiver<String>,
    silent: &AtomicBool,
) -> bool {
    let mut send =
        |message: String| to.write_all(&frame(&message)).and_then(|()| to.flush()).is_ok();
    if !before.greeting.into_iter().chain(before.rest).all(&mut send) {
        return false;
    }
    while !silent.load(Ordering::Relaxed) {
        match said.recv_timeout(LOOK) {
            Ok(message) => {
                if !send(message) {
                    return false;
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return true,
        }
    }
    false
}

/// Waits for a program whose input has ended and returns its exit status; kills the program after
/// the grace period.
fn end(child: &mut Child) -> Option<ExitStatus> {
    let begin = Instant::now();
    while begin.elapsed() < GRACE_PERIOD {
        if let Ok(Some(status)) = child.try_wait() {
            return Some(status);
        }
        thread::sleep(Duration::from_millis(10));
    }
    let _ = child.kill();
    child.wait().ok()
}

#[cfg(all(test, unix))]
mod tests;
