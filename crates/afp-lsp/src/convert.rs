//! From places of the compiler to those of the protocol, and back.

use afp_dsl::Compiled;
use afp_ide::edit::TextEdit;
use afp_syntax::source::{Encoding, LineColumn, Lines, Span};
use gen_lsp_types::{
    DocumentChange, Edit, Location, OptionalVersionedTextDocumentIdentifier, Position, Range,
    TextDocumentEdit, TextDocumentIdentifier, Uri, WorkspaceEdit,
};

use crate::uri::uri;
use crate::workspace::Workspace;

/// The lines of a text, counted as the client counts.
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

pub(crate) struct FileEdits {
    pub path: String,
    /// The text that they are made on.
    pub text: String,
    pub edits: Vec<TextEdit>,
}

impl Workspace {
    /// The place of a span of a compilation.
    pub fn location(&self, compiled: &Compiled, span: Span) -> Option<Location> {
        let source = compiled.sources.get(span.file)?;
        let range = Places::new(&source.text, self.encoding).range(span);
        Some(Location { uri: self.uri(&source.name), range })
    }

    /// The address of a path, as the client writes it where it has it open.
    pub fn uri(&self, path: &str) -> Uri {
        self.documents.get(path).map_or_else(|| uri(path), |document| document.uri.clone())
    }

    /// Edits of a compilation's files, each with the text that it is made on.
    pub fn by_file(&self, compiled: &Compiled, edits: Vec<TextEdit>) -> Vec<FileEdits> {
        let mut files: Vec<(u16, FileEdits)> = Vec::new();
        for edit in edits {
            let file = edit.span.file;
            if let Some((_, known)) = files.iter_mut().find(|(known, _)| *known == file) {
                known.edits.push(edit);
            } else if let Some(source) = compiled.sources.get(file) {
                let (path, text) = (source.name.clone(), source.text.clone());
                files.push((file, FileEdits { path, text, edits: vec![edit] }));
            }
        }
        files.into_iter().map(|(_, file)| file).collect()
    }

    /// Edits as the protocol has them, with the versions that they are made on.
    pub fn edit(&self, files: &[FileEdits]) -> WorkspaceEdit {
        let change = |file: &FileEdits| {
            let places = Places::new(&file.text, self.encoding);
            let edits = file.edits.iter().map(|edit| text_edit(&places, edit));
            let id = TextDocumentIdentifier { uri: self.uri(&file.path) };
            let version = self.documents.get(&file.path).map(|document| document.version);
            let text_document =
                OptionalVersionedTextDocumentIdentifier { version, text_document_identifier: id };
            DocumentChange::TextDocumentEdit(TextDocumentEdit {
                text_document,
                edits: edits.map(Edit::TextEdit).collect(),
            })
        };
        let changes = files.iter().map(change).collect();
        WorkspaceEdit { document_changes: Some(changes), ..WorkspaceEdit::default() }
    }
}

/// An edit of a text as the protocol has it.
pub(crate) fn text_edit(places: &Places<'_>, edit: &TextEdit) -> gen_lsp_types::TextEdit {
    gen_lsp_types::TextEdit { range: places.range(edit.span), new_text: edit.text.clone() }
}
