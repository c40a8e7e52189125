//! Converts places of the compiler to those of the protocol and back.

use afp_dsl::Compiled;
use afp_ide::edit::TextEdit;
use afp_syntax::source::{Encoding, LineColumn, Lines, Span};
use gen_lsp_types::{Location, Position, Range, Uri};

use crate::uri::uri;
use crate::workspace::Workspace;

/// The lines of a text, in the client's column units.
pub(crate) struct Places<'t> {
    lines: Lines<'t>,
    encoding: Encoding,
}

impl<'t> Places<'t> {
    pub fn new(text: &'t str, encoding: Encoding) -> Places<'t> {
        Places { lines: Lines::new(text), encoding }
    }

    pub fn position(&self, offset: u32) -> Position {
        let LineColumn { line, column } = self.lines.position(offset, self.encoding);
        Position { line, character: column }
    }

    pub fn range(&self, span: Span) -> Range {
        Range { start: self.position(span.start), end: self.position(span.end) }
    }

    pub fn offset(&self, position: Position) -> u32 {
        let at = LineColumn { line: position.line, column: position.character };
        self.lines.offset(at, self.encoding)
    }
}

impl Workspace {
    pub fn location(&self, compiled: &Compiled, span: Span) -> Option<Location> {
        let source = compiled.sources.get(span.file)?;
        let range = Places::new(&source.text, self.encoding).range(span);
        Some(Location { uri: self.uri(&source.name), range })
    }

    /// Returns the address of a path, in the client's spelling if the document is open.
    pub fn uri(&self, path: &str) -> Uri {
        self.documents.get(path).map_or_else(|| uri(path), |document| document.uri.clone())
    }
}

pub(crate) fn text_edit(places: &Places<'_>, edit: &TextEdit) -> gen_lsp_types::TextEdit {
    gen_lsp_types::TextEdit { range: places.range(edit.span), new_text: edit.text.clone() }
}
