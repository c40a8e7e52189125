//! The command-line arguments of a job.

use std::path::PathBuf;

use afp_lsp::path_of;
use serde_json::Value;

use super::super::Room;

/// The file of the folder named by a request.
pub(super) fn file_of(room: &Room, params: &Value) -> Option<Result<PathBuf, String>> {
    params["file"].as_str().map(|uri| room.folder.inside(&path_of(uri)))
}

/// The arguments of a job. Files must be in the folder, and all other values have fixed formats.
pub(super) fn arguments(room: &Room, kind: &str, params: &Value) -> Result<Vec<String>, String> {
    let file = || -> Result<String, String> {
        let path = file_of(room, params).ok_or("'file' is missing")??;
        Ok(path.to_string_lossy().into_owned())
    };
    let word = |name: &str, fits: &dyn Fn(char) -> bool| checked(&params[name], name, fits);
    let plan = |file: String| -> Result<String, String> {
        let name = word("plan", &|letter| letter.is_alphanumeric() || letter == '_')?;
        Ok(name.map_or_else(|| file.clone(), |name| format!("{file}:{name}")))
    };
    let texts = |texts: &[&str]| texts.iter().map(|it| (*it).to_owned()).collect::<Vec<_>>();
    Ok(match kind {
        "test" => {
            let all = match params["file"].is_null() {
                true => Vec::new(),
                false => vec![file()?],
            };
            [texts(&["test", "--json", "--coverage"]), all].concat()
        }
        "generate" => [texts(&["test", "--generate"]), vec![file()?]].concat(),
        "sweep" => {
            let seeds = word("seeds", &|letter| letter.is_ascii_digit() || ".,".contains(letter))?;
            let until = until(&params["until"])?;
            let mut all = [texts(&["sweep", "--json"]), vec![plan(file()?)?]].concat();
            let mut add = |option: &str, value: String| all.extend([option.to_owned(), value]);
            seeds.into_iter().for_each(|value| add("--seeds", value));
            until.into_iter().for_each(|value| add("--until", value));
            for value in params["vary"].as_array().into_iter().flatten() {
                let fits = |letter: char| letter.is_alphanumeric() || "_.=:,- %/°".contains(letter);
                if let Some(value) = checked(value, "vary", &fits)? {
                    add("--vary", value);
                }
            }
            if let Some(world) = params["world"].as_str() {
                add("--world", world_of(room, world)?);
            }
            all
        }
        "build" => [texts(&["build", "--json"]), vec![plan(file()?)?]].concat(),
        "new" => {
            let fits = |letter: char| letter.is_ascii_alphanumeric() || "_-".contains(letter);
            let name = word("name", &fits)?.ok_or("'name' is missing")?;
            let with = match params["with"].as_str() {
                None => None,
                Some("toolbox") => Some("--toolbox"),
                Some("robot") => Some("--robot"),
                Some(other) => return Err(format!("there are no projects with '{other}'")),
            };
            [texts(&["new", &name]), texts(&Vec::from_iter(with))].concat()
        }
        other => return Err(format!("unknown job '{other}'")),
    })
}

/// Checks the format of a value, which must not look like an option; `None` if it is missing.
fn checked(
    value: &Value,
    name: &str,
    fits: &dyn Fn(char) -> bool,
) -> Result<Option<String>, String> {
    let Some(word) = value.as_str().filter(|word| !word.is_empty()) else { return Ok(None) };
    match word.chars().all(fits) && !word.starts_with('-') {
        true => Ok(Some(word.to_owned())),
        false => Err(format!("'{word}' cannot be {name}{}", remedy(name))),
    }
}

/// The time limit of a sweep's runs; plans write it with a space, '60 s'.
fn until(value: &Value) -> Result<Option<String>, String> {
    let written = value.as_str().unwrap_or_default();
    let word: String = written.split_whitespace().collect();
    let fits = |letter: char| letter.is_ascii_alphanumeric() || letter == '.';
    let word = checked(&Value::from(word), "until", &fits)?;
    let is_nothing = |word: &String| {
        let number = word.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
        number.parse::<f64>().is_ok_and(|number| number == 0.0)
    };
    match word.as_ref().is_some_and(is_nothing) {
        true => Err(format!("'{}' is not a time: write for example '30 s'", written.trim())),
        false => Ok(word),
    }
}

/// The help for a malformed value.
fn remedy(name: &str) -> &'static str {
    match name {
        "seeds" => ": write a range such as '0..20' (the last seed is 19)",
        "until" => ": write a time, '30 s'",
        "vary" => {
            ": write an input with its values, 'walldist=20cm..60cm:10cm' or 'walldist=20cm,30cm'"
        }
        "name" => ": use letters, digits, '-' and '_'",
        _ => "",
    }
}

/// A world of the folder, or a random one from a seed.
fn world_of(room: &Room, world: &str) -> Result<String, String> {
    let seed = world.strip_prefix("random:");
    if seed.is_some_and(|seed| seed.chars().all(|letter| letter.is_ascii_digit())) {
        return Ok(world.to_owned());
    }
    Ok(room.folder.inside(world)?.to_string_lossy().into_owned())
}
