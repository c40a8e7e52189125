//! What the compiler has to say about a text, and how it is shown.
//!
//! Every diagnostic has a code, one primary span (the smallest text to change) and a help that,
//! followed, mends it. Stages append to one list and never stop at the first error.

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

/// A replacement of text that mends the error.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The text to replace; an empty range inserts.
    pub span: Span,
    pub text: String,
}

/// What a diagnostic is about, for everything that decides by it. The wording of its message decides nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    /// Nothing that a decision depends on.
    #[default]
    Other,
    /// A name that is missing in the text.
    MissingName,
    /// A name that nothing has.
    Unknown {
        /// What it would be the name of.
        what: Sought,
        name: String,
        /// The plan in which it was sought, if the text names that.
        plan: Option<String>,
    },
    /// A path of a scenario.
    Path(String),
    /// A word before an edge, whose name may be an event.
    Event,
    /// A value without the port that it is for.
    Value,
}

/// What the help of a diagnostic asks for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Aim {
    /// Another text at the place.
    #[default]
    Write,
    /// No text at the place.
    Remove,
    /// A change elsewhere.
    Elsewhere,
}

/// What a name can be sought for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sought {
    /// A template, a plan, or the toolbox in front of it.
    Template,
    /// An entry of a plan.
    Entry,
    /// An element of a plan.
    Element,
    /// A supervisor of a plan.
    Supervisor,
    Toolbox,
}

/// One thing the compiler has to say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Which rule it is about.
    pub code: Code,
    /// How bad it is.
    pub severity: Severity,
    /// The smallest text to change.
    pub span: Span,
    /// What it is about.
    pub subject: Subject,
    /// What is wrong: lower case, no final period, the user's names in single quotes.
    message: Message,
    /// What was found instead, which ends the message.
    found: Option<Box<Message>>,
    /// Other places that matter.
    notes: Vec<Label>,
    help: Message,
    /// What that asks for.
    pub aim: Aim,
    /// The edit that does it, where there is one.
    pub fix: Option<Edit>,
}

impl Diagnostic {
    /// A diagnostic whose severity is the one its code has by nature.
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

    /// Says what it is about.
    pub fn about(mut self, subject: Subject) -> Diagnostic {
        self.subject = subject;
        self
    }

    /// Is about a name that nothing has.
    pub fn unknown(self, what: Sought, name: &str) -> Diagnostic {
        self.about(Subject::Unknown { what, name: name.to_owned(), plan: None })
    }

    /// Is about a name that nothing in a plan has, which is written elsewhere.
    pub fn unknown_in(self, plan: &str, what: Sought, name: &str) -> Diagnostic {
        let plan = Some(plan.to_owned());
        self.about(Subject::Unknown { what, name: name.to_owned(), plan })
    }

    /// Moves it to another place.
    pub fn at(mut self, span: Span) -> Diagnostic {
        self.span = span;
        self
    }

    /// Says what was found instead.
    pub fn found(mut self, found: Message) -> Diagnostic {
        self.found = Some(Box::new(found));
        self
    }

    pub fn help(mut self, text: impl Into<Message>) -> Diagnostic {
        self.help = text.into();
        self
    }

    /// Says what to do elsewhere.
    pub fn elsewhere(mut self, text: impl Into<Message>) -> Diagnostic {
        self.aim = Aim::Elsewhere;
        self.help(text)
    }

    /// Says what to write at another place, with the edit that does it.
    pub fn write_at(self, span: Span, text: impl Into<String>) -> Diagnostic {
        let text = text.into();
        self.help(message!("write '{}'", text)).fix(span, text)
    }

    /// Says what to write at the primary span, with the edit that does it.
    pub fn write(self, text: impl Into<String>) -> Diagnostic {
        let span = self.span;
        self.write_at(span, text)
    }

    /// Points at another place.
    pub fn note(mut self, span: Span, text: impl Into<Message>) -> Diagnostic {
        self.notes.push(Label { span, text: text.into() });
        self
    }

    /// Gives the edit that follows the help.
    pub fn fix(mut self, span: Span, text: impl Into<String>) -> Diagnostic {
        let text = text.into();
        if text.is_empty() {
            self.aim = Aim::Remove;
        }
        self.fix = Some(Edit { span, text });
        self
    }

    /// Gives the edit that puts `text` in place of the primary span.
    pub fn replace(self, text: impl Into<String>) -> Diagnostic {
        let span = self.span;
        self.fix(span, text)
    }

    /// The diagnostic without notes, help and edit, for those that know better ones.
    pub fn bare(&self) -> Diagnostic {
        let Diagnostic { subject, message, found, .. } = self.clone();
        Diagnostic { subject, found, ..Diagnostic::new(self.code, self.span, message) }
    }

    /// Replaces what it says to do.
    pub fn set_help(&mut self, text: impl Into<Message>) {
        self.help = text.into();
    }

    /// Replaces what is wrong.
    pub fn change_message(&mut self, change: impl FnOnce(&Message) -> Message) {
        self.message = change(&self.message);
    }

    /// What is wrong, to be compared with others.
    pub fn message(&self) -> &Message {
        &self.message
    }

    /// The names that the message mentions.
    pub fn names(&self) -> Vec<&str> {
        let mut names = Vec::new();
        self.message.names(&mut names);
        names
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
    /// Errors that are counted and not kept.
    counted: Vec<(Span, Code)>,
}

/// A text with so many errors is wrong throughout: the meaning of the rest is not searched.
const MOST_EXPLAINED: usize = 500;

/// So many diagnostics are kept; of errors beyond them only the number and the places.
const MOST_KEPT: usize = 10_000;

impl Diagnostics {
    /// Appends one.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.note(&diagnostic);
        match diagnostic.severity {
            Severity::Error if self.list.len() >= MOST_KEPT => {
                self.counted.push((diagnostic.span, diagnostic.code));
            }
            _ => self.list.push(diagnostic),
        }
    }

    /// Appends all of `other`.
    pub fn extend(&mut self, other: Diagnostics) {
        self.list.extend(other.list);
        self.errors.extend(other.errors);
        self.unread.extend(other.unread);
        self.counted.extend(other.counted);
    }

    /// Drops those for which `keep` does not hold.
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

    /// Whether one of them is an error.
    pub fn has_errors(&self) -> bool {
        !self.errors.is_empty()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// How many there are, with errors that are only counted.
    pub fn len(&self) -> usize {
        self.list.len() + self.counted.len()
    }

    /// Whether there are so few that the next one is worth a search for its meaning.
    pub fn explains(&self) -> bool {
        self.len() < MOST_EXPLAINED
    }

    /// One of them, by its place.
    pub fn get(&self, index: u32) -> Option<&Diagnostic> {
        self.list.get(index as usize)
    }

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

    /// The places in `span` at which the text could not be read.
    pub fn syntax_errors_within(&self, span: Span) -> impl Iterator<Item = Span> {
        within(&self.unread, span)
    }

    /// Whether an error lies in `span`.
    pub fn error_within(&self, span: Span) -> bool {
        within(&self.errors, span).next().is_some()
    }
}

/// Whether diagnostics of a code are about text that could not be read.
fn is_of_text(code: Code) -> bool {
    code < Code::E0201
}

/// The places that lie in `span`.
fn within(places: &BTreeSet<Span>, span: Span) -> impl Iterator<Item = Span> {
    let first = Span { end: 0, ..span };
    let last = Span { start: span.end.max(span.start), end: u32::MAX, ..span };
    places.range(first..=last).copied().filter(move |place| span.contains(*place))
}

#[cfg(test)]
mod tests;
