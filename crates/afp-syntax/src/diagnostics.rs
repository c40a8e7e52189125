//! Errors and warnings of the compiler, and their presentation.
//!
//! Each diagnostic has a code, a primary span (the smallest text to change) and a help that, if
//! followed, corrects the error. All stages append to one list and continue after errors.

mod codes;
mod join;
mod json;
mod message;
mod render;
mod shown;
mod tables;

use std::collections::BTreeSet;

use crate::message;
use crate::source::Span;

pub use afp_excerpt::{Severity, words};
pub use codes::Code;
pub use join::places;
pub use message::{Arg, Message, ToArg, Words, holes, list};
#[doc(hidden)]
pub use shown::show_only_codes;

/// Another place that explains the diagnostic.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Label {
    span: Span,
    text: Message,
}

/// A replacement of text that corrects the error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The text to replace; an empty range inserts.
    pub span: Span,
    pub text: String,
}

/// The subject of a diagnostic, for code that depends on it. No code may depend on the wording of a
/// message.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    /// A subject on which no code depends.
    #[default]
    Other,
    MissingName,
    /// A name that does not exist.
    Unknown {
        what: Sought,
        name: String,
        /// The plan in which the name was sought, if the text names one.
        plan: Option<String>,
    },
    /// A path of a scenario.
    Path(String),
    /// A word before an edge, whose name may be an event.
    Event,
    /// A value without the port that it is for.
    Value,
}

/// The kind of change in the help.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Aim {
    /// Another text at the place.
    #[default]
    Write,
    /// Removal of the text at the place.
    Remove,
    /// A change elsewhere.
    Elsewhere,
}

/// The kinds of items that a name can refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sought {
    /// A template, a plan, or the toolbox before it.
    Template,
    Entry,
    Element,
    Supervisor,
    Toolbox,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    pub code: Code,
    pub severity: Severity,
    /// The smallest text to change.
    pub span: Span,
    pub subject: Subject,
    /// The mistake: lower case, no final period, the user's names in single quotes.
    message: Message,
    /// The text that was found instead, which ends the message.
    found: Option<Box<Message>>,
    /// Related places.
    notes: Vec<Label>,
    help: Message,
    /// The kind of change that `help` asks for.
    pub aim: Aim,
    /// The edit that follows the help, if possible.
    pub fix: Option<Edit>,
}

impl Diagnostic {
    /// A diagnostic with the default severity of its code.
    pub fn new(code: Code, span: Span, message: impl Into<Message>) -> Diagnostic {
        Diagnostic {
            code,
            severity: code.severity(),
            span,
            subject: Subject::Other,
            message: message.into(),
            found: None,
            notes: Vec::new(),
            help: Message::default(),
            aim: Aim::Write,
            fix: None,
        }
    }

    pub fn about(mut self, subject: Subject) -> Diagnostic {
        self.subject = subject;
        self
    }

    /// Sets the subject: a name that does not exist.
    pub fn unknown(self, what: Sought, name: &str) -> Diagnostic {
        self.about(Subject::Unknown { what, name: name.to_owned(), plan: None })
    }

    /// Sets the subject: a name that does not exist in `plan`, which is written elsewhere.
    pub fn unknown_in(self, plan: &str, what: Sought, name: &str) -> Diagnostic {
        let plan = Some(plan.to_owned());
        self.about(Subject::Unknown { what, name: name.to_owned(), plan })
    }

    /// Moves it to another place.
    pub fn at(mut self, span: Span) -> Diagnostic {
        self.span = span;
        self
    }

    /// Sets the text that was found instead.
    pub fn found(mut self, found: Message) -> Diagnostic {
        self.found = Some(Box::new(found));
        self
    }

    pub fn help(mut self, text: impl Into<Message>) -> Diagnostic {
        self.help = text.into();
        self
    }

    /// Sets a help for a change elsewhere.
    pub fn elsewhere(mut self, text: impl Into<Message>) -> Diagnostic {
        self.aim = Aim::Elsewhere;
        self.help(text)
    }

    /// Sets a help and the edit for a new text at another place.
    pub fn write_at(self, span: Span, text: impl Into<String>) -> Diagnostic {
        let text = text.into();
        self.help(message!("write '{}'", text)).fix(span, text)
    }

    /// Sets a help and the edit for a new text at the primary span.
    pub fn write(self, text: impl Into<String>) -> Diagnostic {
        let span = self.span;
        self.write_at(span, text)
    }

    /// Adds a related place.
    pub fn note(mut self, span: Span, text: impl Into<Message>) -> Diagnostic {
        self.notes.push(Label { span, text: text.into() });
        self
    }

    /// Sets the edit that follows the help.
    pub fn fix(mut self, span: Span, text: impl Into<String>) -> Diagnostic {
        let text = text.into();
        if text.is_empty() {
            self.aim = Aim::Remove;
        }
        self.fix = Some(Edit { span, text });
        self
    }

    /// Sets the edit that replaces the primary span by `text`.
    pub fn replace(self, text: impl Into<String>) -> Diagnostic {
        let span = self.span;
        self.fix(span, text)
    }

    /// The diagnostic without notes, help and edit, for callers with better ones.
    pub fn bare(&self) -> Diagnostic {
        let Diagnostic { subject, message, found, .. } = self.clone();
        Diagnostic { subject, found, ..Diagnostic::new(self.code, self.span, message) }
    }

    pub fn set_help(&mut self, text: impl Into<Message>) {
        self.help = text.into();
    }

    pub fn change_message(&mut self, change: impl FnOnce(&Message) -> Message) {
        self.message = change(&self.message);
    }

    /// The message, for comparisons with others.
    pub fn message(&self) -> &Message {
        &self.message
    }

    /// The names in the message.
    pub fn names(&self) -> Vec<&str> {
        let mut names = Vec::new();
        self.message.names(&mut names);
        names
    }
}

#[derive(Clone, Debug, Default)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    /// The spans of errors; each item searches its own span.
    errors: BTreeSet<Span>,
    /// The places of syntax errors.
    unread: BTreeSet<Span>,
    /// Errors that are counted and not kept.
    counted: Vec<(Span, Code)>,
}

/// With this number of errors a file counts as invalid; the rest is not checked.
const MOST_EXPLAINED: usize = 500;

/// The maximum number of diagnostics. Further errors only have a number and spans.
const MOST_KEPT: usize = 10_000;

impl Diagnostics {
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.note(&diagnostic);
        match diagnostic.severity {
            Severity::Error if self.list.len() >= MOST_KEPT => {
                self.counted.push((diagnostic.span, diagnostic.code));
            }
            _ => self.list.push(diagnostic),
        }
    }

    pub fn extend(&mut self, other: Diagnostics) {
        self.list.extend(other.list);
        self.errors.extend(other.errors);
        self.unread.extend(other.unread);
        self.counted.extend(other.counted);
    }

    /// Removes those for which `keep` is false.
    pub fn retain(&mut self, keep: impl FnMut(&Diagnostic) -> bool) {
        let before = self.list.len();
        self.list.retain(keep);
        if self.list.len() < before {
            self.note_all();
        }
    }

    pub fn change(&mut self, change: impl FnMut(&mut Diagnostic)) {
        self.list.iter_mut().for_each(change);
        self.note_all();
    }

    fn note(&mut self, diagnostic: &Diagnostic) {
        if diagnostic.severity == Severity::Error {
            self.errors.insert(diagnostic.span);
            if is_of_text(diagnostic.code) {
                self.unread.insert(diagnostic.span);
            }
        }
    }

    fn note_all(&mut self) {
        let errors = self.list.iter().filter(|each| each.severity == Severity::Error);
        let errors = errors.map(|each| (each.span, each.code));
        let errors: Vec<_> = errors.chain(self.counted.iter().copied()).collect();
        let unread = errors.iter().filter(|(_, code)| is_of_text(*code));
        self.unread = unread.map(|(span, _)| *span).collect();
        self.errors = errors.into_iter().map(|(span, _)| span).collect();
    }

    pub fn has_errors(&self) -> bool {
        !self.errors.is_empty()
    }

    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The number of diagnostics, with errors that are only counted.
    pub fn len(&self) -> usize {
        self.list.len() + self.counted.len()
    }

    /// Whether there are so few errors that the next one is worth a search for its meaning.
    pub fn explains(&self) -> bool {
        self.len() < MOST_EXPLAINED
    }

    pub fn get(&self, index: u32) -> Option<&Diagnostic> {
        self.list.get(index as usize)
    }

    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// Whether one of them begins in `span` or may overlap it; they must be sorted.
    pub fn any_begins_within(&self, span: Span) -> bool {
        let first = self.list.partition_point(|each| each.span < span.before());
        self.list
            .get(first)
            .is_some_and(|each| each.span.file == span.file && each.span.start <= span.end)
    }

    /// The diagnostics within `span`; the list must be sorted.
    pub fn within(&self, span: Span) -> impl Iterator<Item = &Diagnostic> {
        let first = self.list.partition_point(|each| each.span < span.before());
        let inside = self.list.iter().skip(first).take_while(move |each| each.span <= span.after());
        inside.filter(move |each| span.contains(each.span))
    }

    /// Sorts by place (file, first byte, code) and drops exact repetitions.
    pub fn sort(&mut self) {
        self.list.sort_by_key(|diagnostic| (diagnostic.span, diagnostic.code));
        self.list.dedup();
    }

    /// The places of syntax errors in `span`.
    pub fn syntax_errors_within(&self, span: Span) -> impl Iterator<Item = Span> {
        within(&self.unread, span)
    }

    /// Whether an error is inside `span`.
    pub fn error_within(&self, span: Span) -> bool {
        within(&self.errors, span).next().is_some()
    }
}

/// Whether diagnostics of a code are about unreadable text.
fn is_of_text(code: Code) -> bool {
    code < Code::E0201
}

/// The spans inside `span`.
fn within(places: &BTreeSet<Span>, span: Span) -> impl Iterator<Item = Span> {
    let first = Span { end: 0, ..span };
    let last = Span { start: span.end.max(span.start), end: u32::MAX, ..span };
    places.range(first..=last).copied().filter(move |place| span.contains(*place))
}

#[cfg(test)]
mod tests;
