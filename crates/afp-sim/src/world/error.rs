//! What is wrong with a world file, and where.

use std::fmt;
use std::ops::Range;
use toml_edit::Document;

/// An error in a world file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WorldError {
    /// Line from 1 and column from 1 (in characters), where the place is known.
    pub place: Option<(usize, usize)>,
    /// What is wrong, without the place.
    pub message: String,
}

impl WorldError {
    /// An error at a span of bytes of `text`.
    pub(super) fn at_span(text: &str, span: Option<Range<usize>>, message: String) -> Self {
        let place = span.and_then(|span| {
            let before = text.get(..span.start)?;
            let line = before.matches('\n').count() + 1;
            let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
            Some((line, column))
        });
        WorldError { place, message }
    }

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
        WorldError::at_span(text, span, message)
    }
}

impl fmt::Display for WorldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((line, column)) = self.place {
            write!(f, "line {line}, column {column}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for WorldError {}
