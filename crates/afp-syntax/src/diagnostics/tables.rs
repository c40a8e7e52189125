//! The lines of the files of diagnostics, computed once each.

use std::cell::OnceCell;

use afp_excerpt::LineTable;

use crate::source::{Sources, Span};

/// The lines of each file, computed on first use.
pub(super) struct Tables<'s> {
    pub(super) sources: &'s Sources,
    known: Vec<OnceCell<LineTable<'s>>>,
}

impl<'s> Tables<'s> {
    pub(super) fn new(sources: &'s Sources) -> Tables<'s> {
        Tables { sources, known: vec![OnceCell::new(); sources.len()] }
    }

    pub(super) fn lines(&self, file: u16) -> Option<&LineTable<'s>> {
        let source = self.sources.get(file)?;
        let known = self.known.get(usize::from(file))?;
        Some(known.get_or_init(|| LineTable::new(&source.text)))
    }

    /// Line and column of the begin of a place, both counted from 1.
    pub(super) fn line_column(&self, span: Span) -> (usize, usize) {
        self.lines(span.file).map_or((1, 1), |lines| lines.line_column(span.start as usize))
    }
}
