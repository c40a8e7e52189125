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
const FAREWELL: Duration = Duration::from_secs(2);

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
        scope.spawn(|| hear(from, greeted, tell));
        pass(to, before, said);
        end(&mut child);
    });
}

/// Hands on what the program says; its answer to the greeting is the second one.
fn hear(from: ChildStdout, greeted: bool, tell: &(impl Fn(String) -> bool + Sync)) {
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
fn pass(mut to: ChildStdin, before: Conversation, said: &Receiver<String>) {
    let mut send =
        |message: String| to.write_all(&frame(&message)).and_then(|()| to.flush()).is_ok();
    let before = before.greeting.into_iter().chain(before.rest);
    let _ = before.chain(said.iter()).all(&mut send);
}

/// Waits for a program whose input has ended; one that goes on is killed.
fn end(child: &mut Child) {
    let begin = Instant::now();
    while begin.elapsed() < FAREWELL {
        if let Ok(Some(_)) = child.try_wait() {
            return;
        }
        thread::sleep(Duration::from_millis(10));
    }
    let _ = child.kill();
    let _ = child.wait();
}

#[cfg(all(test, unix))]
mod tests {
    use std::fs;
    use std::os::unix::fs::PermissionsExt;
    use std::path::PathBuf;
    use std::sync::Mutex;
    use std::sync::mpsc::channel;

    use super::*;

    /// A program that is written while another one is started could be busy.
    static ALONE: Mutex<()> = Mutex::new(());

    const GREETING: &str = r#"{"type":"request","command":"initialize"}"#;

    /// A program that does what `script` says.
    fn stand_in(folder: &Path, script: &str) -> PathBuf {
        let path = folder.join("program");
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
        path
    }

    fn met(script: &str) -> Vec<String> {
        let _alone = ALONE.lock();
        let place = tempfile::tempdir().unwrap();
        let program = stand_in(place.path(), script);
        let (client, said) = channel();
        let told = Mutex::new(Vec::new());
        let mut before = Conversation::default();
        before.note(&serde_json::from_str(GREETING).unwrap(), GREETING);
        before.then(r#"{"command":"launch"}"#.to_owned());
        client.send(r#"{"command":"threads"}"#.to_owned()).unwrap();
        drop(client);
        let tell = |message: String| {
            told.lock().unwrap().push(message);
            true
        };
        relay(&program, place.path(), before, &said, &tell);
        told.into_inner().unwrap()
    }

    #[test]
    fn another_program_hears_everything_and_greets_nobody_twice() {
        let greets = r#"{"type":"response","command":"initialize"}"#;
        let script =
            format!("printf 'Content-Length: {}\\r\\n\\r\\n%s' '{greets}'; exec cat", greets.len());
        let echoed = [GREETING, r#"{"command":"launch"}"#, r#"{"command":"threads"}"#];
        assert_eq!(met(&script), echoed);
    }

    #[test]
    fn a_program_that_goes_on_without_its_client_is_ended() {
        let begin = Instant::now();
        assert!(met("exec sleep 600").is_empty());
        assert!(begin.elapsed() >= FAREWELL);
    }

    #[test]
    fn a_program_that_cannot_be_started_is_named() {
        let told = Mutex::new(String::new());
        let tell = |message: String| {
            *told.lock().unwrap() = message;
            true
        };
        let (_, said) = channel();
        let nothing = Path::new("/nowhere/runner");
        relay(nothing, Path::new("/"), Conversation::default(), &said, &tell);
        assert!(told.into_inner().unwrap().contains("cannot start '/nowhere/runner'"));
    }
}
