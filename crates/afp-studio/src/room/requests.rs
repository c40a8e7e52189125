//! Requests of clients to the room.

use std::path::Path;
use std::time::Duration;

use afp_lsp::{path_of, uri_of};
use serde_json::{Value, json};

use crate::examples::{self, Example};

use crate::{files, world};

use super::document::Keep;
use super::{ClientId, Out, Room};

/// The requests that the room answers, instead of the language server.
const OURS: [&str; 12] = [
    "afp/hello",
    "afp/read",
    "afp/create",
    "afp/rename",
    "afp/remove",
    "afp/choose",
    "afp/newWorld",
    "afp/furnish",
    "afp/pen",
    "afp/trust",
    "afp/job",
    "afp/endJob",
];

pub(super) fn is_ours(method: &str) -> bool {
    OURS.contains(&method)
}

/// Returns the response or an error sentence, and messages to others.
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
        // Read-only clients also run plans, and may ask for the trust.
        "afp/trust" if params["give"] != json!(true) => trust(room, params),
        _ if room.pen != Some(client) => {
            Err("another window has the edit lock: take it first".to_owned())
        }
        "afp/trust" => trust(room, params),
        "afp/job" => room.begin_job(client, params),
        "afp/endJob" => room.end_job(params),
        "afp/create" => create(room, params, &mut out),
        "afp/newWorld" => new_world(room, params, &mut out),
        "afp/furnish" => furnish(room, params),
        "afp/rename" => rename(room, params, now, &mut out),
        "afp/remove" => remove(room, params, now, &mut out),
        "afp/choose" => choose(room, params, now).map(|path| {
            out = room.settled(&path);
            Value::Null
        }),
        _ => Err(format!("unknown request '{method}'")),
    };
    if matches!(method, "afp/create" | "afp/newWorld" | "afp/rename" | "afp/remove")
        && answer.is_ok()
    {
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

/// The first file of the folder with a plan, shown if no file was requested.
fn first_plan(room: &Room) -> Option<String> {
    let plans = room.listed.files.keys().filter(|path| path.ends_with(".afp"));
    let mut read = plans.filter_map(|path| Some((path, files::read(path.as_ref()).ok()?.text)));
    read.find(|(_, text)| afp_lsp::holds_plan(text)).map(|(path, _)| uri_of(path))
}

/// Returns whether the folder is trusted, and the code that it, or a file of it, would run. Grants
/// the trust on request.
fn trust(room: &mut Room, params: &Value) -> Result<Value, String> {
    if params["give"] == json!(true) {
        room.trust.give()?;
    }
    let folder = room.folder.root().to_string_lossy();
    // Code outside the folder is never run.
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

/// Creates a file with a text or an example, but never overwrites one. Clients that still have a
/// removed file of that address open receive the new text.
fn create(room: &mut Room, params: &Value, out: &mut Out) -> Result<Value, String> {
    let path = path(params, "uri")?;
    if Path::new(&path).exists() {
        return Err(format!("the file '{}' already exists", room.folder.name(&path)));
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

/// Creates an empty room in the folder `worlds` of a plan, where runs of the plan look for worlds.
fn new_world(room: &mut Room, params: &Value, out: &mut Out) -> Result<Value, String> {
    let plan = room.folder.inside(&path(params, "plan")?)?;
    let name = params["name"].as_str().unwrap_or_default();
    if name.is_empty() || name.contains(['/', '\\', '.']) {
        return Err("the name of a room has no '/' and no '.'".to_owned());
    }
    let folder = plan.parent().unwrap_or(Path::new(""));
    let is_plans = folder.file_name().is_some_and(|name| name == "plans");
    let folder = if is_plans { folder.parent().unwrap_or(folder) } else { folder }.join("worlds");
    if !folder.starts_with(room.folder.root()) {
        return Err(format!("'{}' is outside of the studio's folder", folder.display()));
    }
    std::fs::create_dir_all(&folder)
        .map_err(|why| format!("cannot make '{}': {why}", folder.display()))?;
    let file = folder.join(name).with_extension("toml");
    let file = file.to_string_lossy();
    create(room, &json!({ "uri": uri_of(&file), "text": world::empty(name) }), out)
}

/// Returns the text of a world after a change; the client applies it.
fn furnish(room: &mut Room, params: &Value) -> Result<Value, String> {
    let path = path(params, "uri")?;
    let change: world::Change = serde_json::from_value(params["change"].clone())
        .map_err(|why| format!("not a change of a world: {why}"))?;
    let text = world::changed(&room.document(&path)?.text, &change)?;
    Ok(json!({ "text": text }))
}

/// Rejects a request if an unsaved text of that address would be lost.
fn unless_unsaved(room: &Room, path: &str) -> Result<(), String> {
    match room.documents.get(path).is_some_and(|document| !document.is_saved()) {
        true => Err(format!("'{}' is about to be saved", room.folder.name(path))),
        false => Ok(()),
    }
}

/// Reads the new file of an address, and sends it to clients with an older text.
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
        return Err(format!("the file '{}' already exists", room.folder.name(&to)));
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

/// Removes a file and returns its text, including recent changes by others, so that it can be
/// restored.
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

/// Checks a file before it is moved or removed: its current content is known and without a
/// conflict.
fn settled(room: &mut Room, path: &str, now: Duration, out: &mut Out) -> Result<(), String> {
    room.document(path)?;
    out.extend(room.look_at(path, now));
    let document = room.document(path)?;
    if document.is_disputed() {
        return Err(
            "another program has changed it: choose one of the two versions first".to_owned()
        );
    }
    if document.is_unreadable() {
        return Err(
            "another program has written a file that is not text: check it first".to_owned()
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
