//! A conversation that goes on with another program.

use std::io::Write;
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc::Receiver;
use std::thread;
use std::time::{Duration, Instant};

use afp_debug::wire::{Frames, frame};
use serde_json::Value;

use super::super::super::dap::read;
use super::output;

/// What a program may take to end by itself once its client is gone: it stops the robot first.
const GRACE_PERIOD: Duration = Duration::from_secs(2);

/// What a client has said up to now.
#[derive(Default)]
pub(super) struct Conversation {
    /// Its greeting, which was answered.
    greeting: Option<String>,
    rest: Vec<String>,
}

impl Conversation {
    /// Keeps what has been answered, as far as whoever goes on must know it.
    pub(super) fn note(&mut self, request: &Value, message: &str) {
        if request["command"] == "initialize" {
            self.greeting = Some(message.to_owned());
        }
    }

    /// Adds what nobody has answered.
    pub(super) fn then(&mut self, message: String) {
        self.rest.push(message);
    }
}

/// Lets a client talk with the debug adapter of another program until one of them is gone; then that program has ended.
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
    thread::scope(|scope| {
        scope.spawn(|| forward_answers(from, greeted, tell));
        forward_requests(to, before, said);
        end(&mut child);
    });
}

/// Hands on what the program says; its answer to the greeting is the second one.
fn forward_answers(from: ChildStdout, greeted: bool, tell: &(impl Fn(String) -> bool + Sync)) {
    let mut frames = Frames::default();
    let mut answered = !greeted;
    read(from, |bytes| {
        frames.push(&bytes);
        while let Ok(Some(message)) = frames.next_message() {
            if !answered && is_greeting(&message) {
                answered = true;
            } else if !tell(message) {
                return false;
            }
        }
        true
    });
}

fn is_greeting(message: &str) -> bool {
    let value: Value = serde_json::from_str(message).unwrap_or_default();
    value["type"] == "response" && value["command"] == "initialize"
}

/// Hands on what the client says until it is gone, or the program is.
fn forward_requests(mut to: ChildStdin, before: Conversation, said: &Receiver<String>) {
    let mut send =
        |message: String| to.write_all(&frame(&message)).and_then(|()| to.flush()).is_ok();
    let before = before.greeting.into_iter().chain(before.rest);
    let _ = before.chain(said.iter()).all(&mut send);
}

/// Waits for a program whose input has ended; one that goes on is killed.
fn end(child: &mut Child) {
    let begin = Instant::now();
    while begin.elapsed() < GRACE_PERIOD {
        if let Ok(Some(_)) = child.try_wait() {
            return;
        }
        thread::sleep(Duration::from_millis(10));
    }
    let _ = child.kill();
    let _ = child.wait();
}

#[cfg(all(test, unix))]
mod tests;
