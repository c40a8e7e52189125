//! A server killed at any message: a new server with the same open documents gives the same
//! answers.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::cases::{say, steps};
use crate::client::{Client, Files};

/// The address of a document that a message opens or closes, and whether it opens.
fn moved(said: &str) -> Option<(String, bool)> {
    let (what, rest) = said.split_once(' ')?;
    if what == "open" {
        return Some((format!("file://{rest}"), true));
    }
    let (method, params) = rest.split_once(' ')?;
    let open = match method {
        "textDocument/didOpen" => true,
        "textDocument/didClose" => false,
        _ => return None,
    };
    let params: Value = serde_json::from_str(&params.replace('@', "file:///w/")).ok()?;
    Some((params["textDocument"]["uri"].as_str()?.to_owned(), open))
}

/// The server's responses from one message on, without their numbers.
fn answers(client: &mut Client, files: &Files, all: &[String]) -> Vec<Vec<Value>> {
    let one = |said: &String| {
        let said = say(client, files, said);
        let responses = said.into_iter().filter(|message| message.get("method").is_none());
        responses
            .map(|mut message| {
                message["id"] = Value::Null;
                message
            })
            .collect()
    };
    all.iter().map(one).collect()
}

/// A replacement of a killed server, with the open documents.
fn started(killed: &Client, files: &Files, hello: &str, open: &BTreeSet<String>) -> Client {
    let mut client = Client::new(files.clone());
    say(&mut client, files, hello);
    for uri in open {
        let (version, text) = killed.server.text(uri).expect("it is open");
        let document = json!({ "uri": uri, "languageId": "afp", "version": version, "text": text });
        client.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }
    client
}

#[test]
fn a_new_server_after_a_kill_gives_the_same_answers() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let mut killed_at = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let (files, all) = steps(&fs::read_to_string(&path).unwrap());
        let end = all.iter().position(|said| said.contains("shutdown")).unwrap_or(all.len());
        let all = &all[..end];
        if !all.first().is_some_and(|said| said.starts_with("ask initialize")) {
            continue;
        }
        let mut whole = Client::new(files.clone());
        let wanted = answers(&mut whole, &files, all);
        let (mut client, mut open) = (Client::new(files.clone()), BTreeSet::new());
        for (at, said) in all.iter().enumerate() {
            if at > 0 {
                let mut fresh = started(&client, &files, &all[0], &open);
                let got = answers(&mut fresh, &files, &all[at..]);
                assert_eq!(got, wanted[at..], "{}, killed before '{said}'", path.display());
                killed_at += 1;
            }
            say(&mut client, &files, said);
            match moved(said) {
                Some((uri, true)) => drop(open.insert(uri)),
                Some((uri, false)) => drop(open.remove(&uri)),
                None => {}
            }
        }
    }
    assert!(killed_at > 30, "killed {killed_at} times");
}
