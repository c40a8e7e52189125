//! What a client asks of the room.

use std::path::Path;
use std::time::Duration;

use afp_lsp::{path_of, uri_of};
use serde_json::{Value, json};

use crate::examples::{self, Example};

use crate::files;

use super::document::Keep;
use super::{ClientId, Out, Room};

/// Requests that the room answers, and not the language server.
const OURS: [&str; 10] = [
    "afp/hello",
    "afp/read",
    "afp/create",
    "afp/rename",
    "afp/remove",
    "afp/choose",
    "afp/pen",
    "afp/trust",
    "afp/job",
    "afp/endJob",
];

pub(super) fn is_ours(method: &str) -> bool {
    OURS.contains(&method)
}

/// The answer, or a sentence that says why there is none; and what others are told.
pub(super) fn answer(
    room: &mut Room,
    client: ClientId,
    method: &str,
    params: &Value,
    now: Duration,
) -> (Result<Value, String>, Out) {
    let mut out = Out::new();
    let answer = match method {
        "afp/hello" => {
            out = room.look_at_files();
            let before = params["client"].as_u64().and_then(|id| ClientId::try_from(id).ok());
            room.greeted(client, before);
            let hello = hello(room, client);
            out.extend(room.tell_done(client));
            Ok(hello)
        }
        "afp/pen" => {
            if params["take"] == json!(true) {
                out = room.hand_pen(Some(client));
            }
            Ok(json!({ "holder": room.pen, "yours": room.pen == Some(client) }))
        }
        "afp/read" => path(params, "uri").and_then(|path| read(room, &path)),
        // Who watches runs plans, too, and may know why not.
        "afp/trust" if params["give"] != json!(true) => trust(room, params),
        _ if room.pen != Some(client) => {
            Err("somebody else has the pen: take it first, then change things".to_owned())
        }
        "afp/trust" => trust(room, params),
        "afp/job" => room.begin_job(client, params),
        "afp/endJob" => room.end_job(params),
        "afp/create" => create(room, params, &mut out),
        "afp/rename" => rename(room, params, now, &mut out),
        "afp/remove" => remove(room, params, now, &mut out),
        "afp/choose" => choose(room, params, now).map(|path| {
            out = room.settled(&path);
            Value::Null
        }),
        _ => Err(format!("there is no '{method}'")),
    };
    if matches!(method, "afp/create" | "afp/rename" | "afp/remove") && answer.is_ok() {
        out.extend(room.look_at_files());
    }
    (answer, out)
}

fn hello(room: &Room, client: ClientId) -> Value {
    let examples = room.examples.iter().map(Example::listed);
    json!({
        "client": client,
        "root": room.root(),
        "open": room.open.clone().or_else(|| first_plan(room)),
        "pen": room.pen == Some(client),
        "trusted": room.trust.is_given(),
        "files": room.files(),
        "more": room.listed.is_cut,
        "examples": examples.collect::<Vec<_>>(),
        "jobs": room.jobs_of(client),
        "longest": files::LONGEST,
    })
}

/// The first file of the folder with a plan: one that is opened for nothing in particular shows something.
fn first_plan(room: &Room) -> Option<String> {
    let plans = room.listed.files.keys().filter(|path| path.ends_with(".afp"));
    let mut read = plans.filter_map(|path| Some((path, files::read(path.as_ref()).ok()?.text)));
    read.find(|(_, text)| afp_lsp::holds_plan(text)).map(|(path, _)| uri_of(path))
}

/// Whether the folder is trusted, and what of it, or for a file of it, would run then; gives it that trust where it is
/// asked to.
fn trust(room: &mut Room, params: &Value) -> Result<Value, String> {
    if params["give"] == json!(true) {
        room.trust.give()?;
    }
    let folder = room.folder.root().to_string_lossy();
    // What lies elsewhere is not run at all.
    let code = room.code(params).unwrap_or_default();
    Ok(json!({ "trusted": room.trust.is_given(), "folder": folder, "code": code }))
}

fn path(params: &Value, name: &str) -> Result<String, String> {
    let uri = params[name].as_str().ok_or_else(|| format!("'{name}' is missing"))?;
    Ok(path_of(uri))
}

fn read(room: &mut Room, path: &str) -> Result<Value, String> {
    let document = room.document(path)?;
    Ok(json!({ "uri": uri_of(path), "text": document.text, "version": 0, "etag": document.etag() }))
}

/// A new file with a text, or an example with what belongs to it; never over one that is there. Who still has a text of this
/// address open, since another program has removed its file, is told the new one.
fn create(room: &mut Room, params: &Value, out: &mut Out) -> Result<Value, String> {
    let path = path(params, "uri")?;
    if Path::new(&path).exists() {
        return Err(format!("there is a file '{}' already", room.folder.name(&path)));
    }
    unless_unsaved(room, &path)?;
    match params["example"].as_str() {
        Some(name) => examples::copy(&room.examples, name, &room.folder, Path::new(&path))?,
        None => {
            let file = room.folder.inside(&path)?;
            let text = params["text"].as_str().unwrap_or_default();
            files::check_length(text.len())?;
            afp_output::write_whole(&file, text.as_bytes())
                .map_err(|why| format!("cannot write '{}': {why}", file.display()))?;
        }
    }
    told_anew(room, &path, out)
}

/// Refuses where a text that was changed is about to be written under an address.
fn unless_unsaved(room: &Room, path: &str) -> Result<(), String> {
    match room.documents.get(path).is_some_and(|document| !document.is_saved()) {
        true => Err(format!("'{}' is about to be written anew", room.folder.name(path))),
        false => Ok(()),
    }
}

/// Reads what has come to lie under an address, and tells it to who has something else open there.
fn told_anew(room: &mut Room, path: &str, out: &mut Out) -> Result<Value, String> {
    room.documents.remove(path);
    let text = room.document(path)?.text.clone();
    out.extend(room.tell_all(&uri_of(path), &text));
    out.extend(room.tell_saved(path, Ok(())));
    read(room, path)
}

fn rename(room: &mut Room, params: &Value, now: Duration, out: &mut Out) -> Result<Value, String> {
    let (from, to) = (path(params, "uri")?, path(params, "to")?);
    let (old, new) = (room.folder.inside(&from)?, room.folder.inside(&to)?);
    if new.exists() {
        return Err(format!("there is a file '{}' already", room.folder.name(&to)));
    }
    settled(room, &from, now, out)?;
    if !room.document(&from)?.is_saved() {
        return Err("it is not saved yet: wait a moment".to_owned());
    }
    unless_unsaved(room, &to)?;
    std::fs::rename(&old, &new)
        .map_err(|why| format!("cannot rename '{}': {why}", old.display()))?;
    room.documents.remove(&from);
    told_anew(room, &to, out)
}

/// Removes a file and gives its text, with what others have just written, so that it can be made again.
fn remove(room: &mut Room, params: &Value, now: Duration, out: &mut Out) -> Result<Value, String> {
    let path = path(params, "uri")?;
    let file = room.folder.inside(&path)?;
    settled(room, &path, now, out)?;
    let text = room.document(&path)?.text.clone();
    std::fs::remove_file(&file)
        .map_err(|why| format!("cannot remove '{}': {why}", file.display()))?;
    room.documents.remove(&path);
    Ok(json!({ "text": text }))
}

/// Looks at a file that is to be moved or removed: what another program has written there is known, and not in dispute.
fn settled(room: &mut Room, path: &str, now: Duration, out: &mut Out) -> Result<(), String> {
    room.document(path)?;
    out.extend(room.look_at(path, now));
    let document = room.document(path)?;
    if document.is_disputed() {
        return Err("another program has changed it: choose between the two texts first".to_owned());
    }
    if document.is_unreadable() {
        return Err(
            "another program has written what is no text there: look at it first".to_owned()
        );
    }
    Ok(())
}

fn choose(room: &mut Room, params: &Value, now: Duration) -> Result<String, String> {
    let path = path(params, "uri")?;
    let keep = match params["keep"].as_str() {
        Some("mine") => Keep::Mine,
        Some("theirs") => Keep::Theirs,
        Some("both") => Keep::Both,
        _ => return Err("'keep' is 'mine', 'theirs' or 'both'".to_owned()),
    };
    room.document(&path)?.choose(keep, now);
    Ok(path)
}
