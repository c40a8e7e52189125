//! Conversations as data: client messages after `-->`, server messages after `<--`.
//!
//! `file PATH` begins a file for the server, up to a line `end`; `open PATH` opens it. `ask METHOD
//! PARAMS` is a request and `tell METHOD PARAMS` a notification. Both may continue over indented
//! lines. In parameters `@` means `file:///w/`. `AFP_BLESS=1` rewrites the server's messages; read
//! the diff like code.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::client::{Client, Files};

#[test]
fn every_conversation_matches_its_file() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let mut paths: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() >= 5);
    let mut wrong = Vec::new();
    for path in paths {
        let written = fs::read_to_string(&path).unwrap();
        let actual = conversation(&written);
        if written == actual {
            continue;
        }
        match std::env::var_os("AFP_BLESS") {
            Some(_) => fs::write(&path, actual).unwrap(),
            None => wrong.push(format!("--- {} is now\n{actual}", path.display())),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Returns the conversation with the server's current messages.
fn conversation(written: &str) -> String {
    let mut files = Files::default();
    let mut lines = written.lines().filter(|line| !line.starts_with("<-- ")).peekable();
    let mut text = String::new();
    let mut client = None;
    while let Some(line) = lines.next() {
        let _ = writeln!(text, "{line}");
        if let Some(path) = line.strip_prefix("file ") {
            let body: Vec<_> = lines.by_ref().take_while(|line| *line != "end").collect();
            let body = body.iter().map(|line| format!("{line}\n")).collect::<String>();
            text += &format!("{body}end\n");
            files.0.insert(path.to_owned(), body);
        } else if let Some(said) = line.strip_prefix("--> ") {
            let mut said = said.to_owned();
            while let Some(more) = lines.next_if(|line| line.starts_with("    ")) {
                let _ = writeln!(text, "{more}");
                said += more;
            }
            let client = client.get_or_insert_with(|| Client::new(files.clone()));
            for answer in say(client, &files, &said) {
                let _ = writeln!(text, "<-- {}", shown(answer));
            }
        }
    }
    text
}

pub fn steps(written: &str) -> (Files, Vec<String>) {
    let (mut files, mut said) = (Files::default(), Vec::<String>::new());
    let mut lines = written.lines();
    while let Some(line) = lines.next() {
        if let Some(path) = line.strip_prefix("file ") {
            let body = lines.by_ref().take_while(|line| *line != "end");
            files.0.insert(path.to_owned(), body.map(|line| format!("{line}\n")).collect());
        } else if let Some(first) = line.strip_prefix("--> ") {
            said.push(first.to_owned());
        } else if line.starts_with("    ")
            && let Some(last) = said.last_mut()
        {
            *last += line;
        }
    }
    (files, said)
}

/// Performs a step and returns the server's messages.
pub fn say(client: &mut Client, files: &Files, said: &str) -> Vec<Value> {
    let mut words = said.splitn(3, ' ');
    let (what, name) = (words.next().unwrap(), words.next().unwrap());
    let params = words.next().unwrap_or("null").replace('@', "file:///w/");
    let params = || -> Value {
        serde_json::from_str(&params).unwrap_or_else(|error| panic!("{error} in {params}"))
    };
    match what {
        "open" => client.open(&format!("file://{name}"), &files.0[name]),
        "ask" => client.request(name, params()),
        "tell" => client.notify(name, params()),
        _ => panic!("nobody can '{what}'"),
    }
}

/// A message in one line, without pictures.
fn shown(mut message: Value) -> String {
    message.as_object_mut().unwrap().remove("jsonrpc");
    leave_out_pictures(&mut message);
    message.to_string().replace("file:///w/", "@")
}

fn leave_out_pictures(value: &mut Value) {
    match value {
        Value::Object(object) => {
            for (key, value) in object {
                match value {
                    Value::String(text) if key == "svg" || key == "icon" => {
                        assert!(text.contains('<'), "{text}");
                        *text = "...".to_owned();
                    }
                    _ => leave_out_pictures(value),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(leave_out_pictures),
        _ => {}
    }
}
