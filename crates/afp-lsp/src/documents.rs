//! The documents that the client has open, and their changes.

use std::collections::BTreeMap;

use afp_syntax::source::{Encoding, LineColumn, Lines};
use gen_lsp_types::{Position, TextDocumentContentChangeEvent, TextDocumentItem, Uri};

/// A document that is open.
#[derive(Clone, Debug)]
pub(crate) struct Document {
    /// Its address as the client writes it.
    pub uri: Uri,
    /// What the client says that it is written in.
    pub language: String,
    /// The client's number of this state of it.
    pub version: i32,
    pub text: String,
    /// Tells this state from all others of all documents.
    pub stamp: u64,
}

/// All open documents by path.
#[derive(Debug, Default)]
pub(crate) struct Documents {
    open: BTreeMap<String, Document>,
    stamps: u64,
    /// The stamp of everything that is not open.
    disk: u64,
}

impl Documents {
    /// Opens a document, or opens it anew.
    pub fn open(&mut self, path: String, item: TextDocumentItem) {
        let stamp = self.next();
        let TextDocumentItem { uri, language_id, version, text } = item;
        let language = language_id.into();
        self.open.insert(path, Document { uri, language, version, text, stamp });
    }

    /// Forgets a document; its file counts from now on.
    pub fn close(&mut self, path: &str) -> Option<Document> {
        self.disk_changed();
        self.open.remove(path)
    }

    /// Makes changes of a document, one after the other; changes of one that is not open are lost.
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

    /// Files have changed that are not open.
    pub fn disk_changed(&mut self) {
        self.disk = self.next();
    }

    /// An open document.
    pub fn get(&self, path: &str) -> Option<&Document> {
        self.open.get(path)
    }

    /// All open documents with their paths.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Document)> {
        self.open.iter().map(|(path, document)| (path.as_str(), document))
    }

    /// What changes whenever the text of a path may have changed.
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
