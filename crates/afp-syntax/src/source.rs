//! Sources and spans in them.

mod lines;

use std::sync::Arc;

pub use afp_excerpt::LineTable;
pub use lines::{Encoding, LineColumn, Lines};

/// A range of bytes in one file of a compilation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The file, an index into the compilation's sources.
    pub file: u16,
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
}

impl Span {
    /// The range from the start of `self` to the end of `last`, in the file of `self`.
    pub fn to(self, last: Span) -> Span {
        Span { end: last.end.max(self.start), ..self }
    }

    /// The empty range at the end of `self`.
    pub fn after(self) -> Span {
        Span { start: self.end, ..self }
    }

    /// The empty range at the start of `self`.
    pub fn before(self) -> Span {
        Span { end: self.start, ..self }
    }

    /// Whether `other` is inside `self`, including the borders.
    pub fn contains(self, other: Span) -> bool {
        self.file == other.file && self.start <= other.start && other.end <= self.end
    }
}

/// A source and its name for diagnostics.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// The file's path as written by the user.
    pub name: String,
    pub text: String,
}

impl Source {
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Source {
        Source { name: name.into(), text: text.into() }
    }

    /// Line and column of a byte, both counted from 1; columns count characters.
    ///
    /// An offset after the end or inside a character means the nearest one before it.
    pub fn line_column(&self, offset: u32) -> (usize, usize) {
        afp_excerpt::line_column(&self.text, offset as usize)
    }
}

/// The files of a compilation; [`Span::file`] is an index into them.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<Arc<Source>>,
}

impl Sources {
    /// Adds a file and returns its index; `None` after 65,536 files.
    pub fn add(&mut self, source: Arc<Source>) -> Option<u16> {
        let index = u16::try_from(self.files.len()).ok()?;
        self.files.push(source);
        Some(index)
    }

    pub fn len(&self) -> usize {
        self.files.len()
    }

    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    pub fn get(&self, file: u16) -> Option<&Source> {
        self.files.get(usize::from(file)).map(|source| &**source)
    }

    /// The text of a span; empty if the span fits no file.
    pub fn text(&self, span: Span) -> &str {
        self.get(span.file)
            .and_then(|source| source.text.get(span.start as usize..span.end as usize))
            .unwrap_or("")
    }

    pub fn iter(&self) -> impl Iterator<Item = &Source> {
        self.files.iter().map(|source| &**source)
    }
}

#[cfg(test)]
mod tests {
    use super::Source;

    #[test]
    fn lines_and_columns_count_characters_from_one() {
        let source = Source::new("x", "ab\nä°c\n");
        assert_eq!(source.line_column(0), (1, 1));
        assert_eq!(source.line_column(3), (2, 1));
        assert_eq!(source.line_column(7), (2, 3));
        assert_eq!(source.line_column(4), (2, 1));
        assert_eq!(source.line_column(99), (3, 1));
    }
}
