//! What is wrong with a world file, and where.

use std::fmt;
use std::ops::Range;
use toml_edit::Document;

/// An error in a world file, or in that of a map.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorldError {
    /// The bytes of the text, where the place is known.
    pub span: Option<Range<usize>>,
    /// What is wrong, without the place.
    pub message: String,
}

impl WorldError {
    /// An error at the value of a key; a number in `path` counts the tables of an array.
    pub(super) fn at_key(text: &str, path: &[&str], message: String) -> Self {
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
        WorldError { span, message }
    }
}

impl fmt::Display for WorldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for WorldError {}
