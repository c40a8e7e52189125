//! Programs that replace a program with the robot of a project: an echo, a hanging program, a
//! missing program.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::mpsc::channel;

use super::*;

/// A program file that is written during another process start could be busy.
static ALONE: Mutex<()> = Mutex::new(());

const GREETING: &str = r#"{"type":"request","command":"initialize"}"#;

/// A program that runs `script`.
fn stand_in(folder: &Path, script: &str) -> PathBuf {
    let path = folder.join("program");
    fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    path
}

/// The messages to a client that sends a request and leaves.
fn met(script: &str) -> Vec<String> {
    talked(script, false)
}

/// The messages to a client that sends a request, and leaves or stays.
fn talked(script: &str, stays: bool) -> Vec<String> {
    let _alone = ALONE.lock();
    let place = tempfile::tempdir().unwrap();
    let program = stand_in(place.path(), script);
    let (client, said) = channel();
    let told = Mutex::new(Vec::new());
    let mut before = Conversation::default();
    before.note(&serde_json::from_str(GREETING).unwrap(), GREETING);
    before.then(r#"{"command":"launch"}"#.to_owned());
    client.send(r#"{"command":"threads"}"#.to_owned()).unwrap();
    let client = stays.then_some(client);
    let tell = |message: String| {
        told.lock().unwrap().push(message);
        true
    };
    relay(&program, place.path(), before, &said, &tell);
    drop(client);
    told.into_inner().unwrap()
}

#[test]
fn a_connected_client_is_notified_when_a_program_ends_unexpectedly() {
    let told = talked("exit 3", true);
    assert!(told[0].contains("ended unexpectedly (exit status: 3)"), "{told:?}");
    assert!(told[1].contains("\"terminated\""), "{told:?}");
    assert_eq!(told.len(), 2);
    let goodbye = r#"{"type":"event","event":"terminated"}"#;
    let script = format!("printf 'Content-Length: {}\\r\\n\\r\\n%s' '{goodbye}'", goodbye.len());
    assert_eq!(talked(&script, true), [goodbye]);
}

#[test]
fn another_program_gets_all_requests_and_its_greeting_is_hidden() {
    let greets = r#"{"type":"response","command":"initialize"}"#;
    let script =
        format!("printf 'Content-Length: {}\\r\\n\\r\\n%s' '{greets}'; exec cat", greets.len());
    let echoed = [GREETING, r#"{"command":"launch"}"#, r#"{"command":"threads"}"#];
    assert_eq!(met(&script), echoed);
}

#[test]
fn a_program_that_continues_without_its_client_is_ended() {
    let begin = Instant::now();
    assert!(met("exec sleep 600").is_empty());
    assert!(begin.elapsed() >= GRACE_PERIOD);
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
