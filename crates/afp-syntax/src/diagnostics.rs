//! What the compiler has to say about a text, and how it is shown.
//!
//! Every diagnostic has a code, one primary span (the smallest text to change) and a help that,
//! followed, mends it. Stages append to one list and never stop at the first error.

mod codes;
mod json;
mod render;
mod tables;

use std::collections::BTreeSet;

use crate::source::Span;

pub use afp_excerpt::{Severity, words};
pub use codes::Code;

/// Another place that explains the diagnostic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// What is there.
    pub text: String,
}

/// A replacement of text that mends the error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The text to replace; an empty range inserts.
    pub span: Span,
    /// The new text.
    pub text: String,
}

/// One thing the compiler has to say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Which rule it is about.
    pub code: Code,
    /// How bad it is.
    pub severity: Severity,
    /// What is wrong: lower case, no final period, the user's names in single quotes.
    pub message: String,
    /// The smallest text to change.
    pub span: Span,
    /// Other places that matter.
    pub notes: Vec<Label>,
    /// What to do.
    pub help: String,
    /// The edit that does it, where there is one.
    pub fix: Option<Edit>,
}

impl Diagnostic {
    /// A diagnostic whose severity is the one its code has by nature.
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            code,
            severity: code.severity(),
            message: message.into(),
            span,
            notes: Vec::new(),
            help: String::new(),
            fix: None,
        }
    }

    /// Says what to do.
    pub fn help(mut self, text: impl Into<String>) -> Diagnostic {
        self.help = text.into();
        self
    }

    /// Points at another place.
    pub fn note(mut self, span: Span, text: impl Into<String>) -> Diagnostic {
        self.notes.push(Label { span, text: text.into() });
        self
    }

    /// Gives the edit that follows the help.
    pub fn fix(mut self, span: Span, text: impl Into<String>) -> Diagnostic {
        self.fix = Some(Edit { span, text: text.into() });
        self
    }

    /// Gives the edit that puts `text` in place of the primary span.
    pub fn replace(self, text: impl Into<String>) -> Diagnostic {
        let span = self.span;
        self.fix(span, text)
    }
}

/// The diagnostics of a compilation.
#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    /// Where the errors are, since each item asks for its own.
    errors: BTreeSet<Span>,
    /// Where the text could not be read.
    unread: BTreeSet<Span>,
}

impl Diagnostics {
    /// Appends one.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.note(&diagnostic);
        self.list.push(diagnostic);
    }

    /// Appends all of `other`.
    pub fn extend(&mut self, other: Diagnostics) {
        self.list.extend(other.list);
        self.errors.extend(other.errors);
        self.unread.extend(other.unread);
    }

    /// Drops those for which `keep` does not hold.
    pub fn retain(&mut self, keep: impl FnMut(&Diagnostic) -> bool) {
        self.list.retain(keep);
        self.note_all();
    }

    /// Changes each of them.
    pub fn change(&mut self, change: impl FnMut(&mut Diagnostic)) {
        self.list.iter_mut().for_each(change);
        self.note_all();
    }

    fn note(&mut self, diagnostic: &Diagnostic) {
        if diagnostic.severity == Severity::Error {
            self.errors.insert(diagnostic.span);
            if diagnostic.code < Code::E0201 {
                self.unread.insert(diagnostic.span);
            }
        }
    }

    fn note_all(&mut self) {
        self.errors.clear();
        self.unread.clear();
        let list = std::mem::take(&mut self.list);
        list.iter().for_each(|diagnostic| self.note(diagnostic));
        self.list = list;
    }

    /// Whether one of them is an error.
    pub fn has_errors(&self) -> bool {
        !self.errors.is_empty()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// One of them, by its place.
    pub fn get(&self, index: u32) -> Option<&Diagnostic> {
        self.list.get(index as usize)
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// Whether one of them may lie in `span`, or begins in it; they must be sorted.
    pub fn any_begins_within(&self, span: Span) -> bool {
        let first = self.list.partition_point(|each| each.span < span.before());
        self.list
            .get(first)
            .is_some_and(|each| each.span.file == span.file && each.span.start <= span.end)
    }

    /// Sorts by place (file, first byte, code) and drops exact repetitions.
    pub fn sort(&mut self) {
        self.list.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
        self.list.dedup();
    }

    /// The places in `span` at which the text could not be read.
    pub fn syntax_errors_within(&self, span: Span) -> impl Iterator<Item = Span> {
        within(&self.unread, span)
    }

    /// Whether an error lies in `span`.
    pub fn error_within(&self, span: Span) -> bool {
        within(&self.errors, span).next().is_some()
    }
}

/// The places that lie in `span`.
fn within(places: &BTreeSet<Span>, span: Span) -> impl Iterator<Item = Span> {
    let first = Span { end: 0, ..span };
    let last = Span { start: span.end.max(span.start), end: u32::MAX, ..span };
    places.range(first..=last).copied().filter(move |place| span.contains(*place))
}

#[cfg(test)]
mod tests;
