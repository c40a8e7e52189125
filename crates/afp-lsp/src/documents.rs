//! Open documents and their changes.

use std::collections::BTreeMap;

use afp_syntax::source::{Encoding, LineColumn, Lines};
use gen_lsp_types::{Position, TextDocumentContentChangeEvent, TextDocumentItem, Uri};

#[derive(Clone, Debug)]
pub(crate) struct Document {
    /// Its address in the client's spelling.
    pub uri: Uri,
    /// The language that the client reports.
    pub language: String,
    /// The client's version number.
    pub version: i32,
    pub text: String,
    /// A stamp that is unique among all states of all documents.
    pub stamp: u64,
}

/// All open documents by path.
#[derive(Debug, Default)]
pub(crate) struct Documents {
    open: BTreeMap<String, Document>,
    stamps: u64,
    /// The stamp of all files that are not open.
    disk: u64,
}

impl Documents {
    pub fn open(&mut self, path: String, item: TextDocumentItem) {
        let stamp = self.next();
        let TextDocumentItem { uri, language_id, version, text } = item;
        let language = language_id.into();
        self.open.insert(path, Document { uri, language, version, text, stamp });
    }

    /// Closes a document, so that its file applies again.
    pub fn close(&mut self, path: &str) -> Option<Document> {
        self.disk_changed();
        self.open.remove(path)
    }

    /// Applies changes in order; changes of a document that is not open are ignored.
    pub fn change(
        &mut self,
        path: &str,
        version: i32,
        changes: Vec<TextDocumentContentChangeEvent>,
        encoding: Encoding,
    ) {
        let stamp = self.next();
        let Some(document) = self.open.get_mut(path) else { return };
        for change in changes {
            make(&mut document.text, change, encoding);
        }
        (document.version, document.stamp) = (version, stamp);
    }

    /// Notes that files have changed on disk.
    pub fn disk_changed(&mut self) {
        self.disk = self.next();
    }

    pub fn get(&self, path: &str) -> Option<&Document> {
        self.open.get(path)
    }

    /// All open documents with their paths.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Document)> {
        self.open.iter().map(|(path, document)| (path.as_str(), document))
    }

    /// Returns a stamp that changes with every possible change of a path's text.
    pub fn stamp(&self, path: &str) -> u64 {
        self.open.get(path).map_or(self.disk, |document| document.stamp)
    }

    fn next(&mut self) -> u64 {
        self.stamps += 1;
        self.stamps
    }
}

fn make(text: &mut String, change: TextDocumentContentChangeEvent, encoding: Encoding) {
    use TextDocumentContentChangeEvent as Change;

    match change {
        Change::TextDocumentContentChangeWholeDocument(whole) => *text = whole.text,
        Change::TextDocumentContentChangePartial(part) => {
            let lines = Lines::new(text);
            let offset = |at: Position| {
                let at = LineColumn { line: at.line, column: at.character };
                lines.offset(at, encoding) as usize
            };
            let (start, end) = (offset(part.range.start), offset(part.range.end));
            text.replace_range(start.min(end)..end.max(start), &part.text);
        }
    }
}
