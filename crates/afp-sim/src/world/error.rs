//! Errors in a world file, with their places.

use afp_session::WorldError;
use toml_edit::Document;

/// An error at the value of a key; a number in `path` counts the tables of an array.
pub(super) fn at_key(text: &str, path: &[&str], message: impl Into<String>) -> WorldError {
    let span = Document::parse(text).ok().and_then(|document| {
        let mut item = document.as_item();
        for part in path {
            item = match part.parse::<usize>() {
                Ok(index) => item.get(index)?,
                Err(_) => item.get(part)?,
            };
        }
        item.span()
    });
    WorldError::new(span, message)
}
