//! Unknown items of plans and files, and items in the wrong braces.

use super::is_type;
use crate::diagnostics::{Code, Diagnostic, Message};
use crate::kind::Kind;
use crate::message;
use crate::parser::recovery::Body;
use crate::parser::{MAX_DEPTH, Parser};
use crate::source::Span;

impl Parser<'_, '_> {
    /// A help for an unknown item that is not a misspelt keyword.
    pub(in crate::parser) fn item_help(&self) -> Option<Message> {
        let (word, next) = (self.word(0), self.word(1));
        let begins_element = || self.on_line_from(1, Kind::OpenBrace).is_some();
        // Only the same line counts.
        let sign = if self.begins_line(1) { Kind::End } else { self.nth(1) };
        Some(match (word, sign) {
            (_, Kind::Colon) if begins_element() => {
                "begin an element with 'actor', 'computation' or 'subplan', a supervisor with 'supervise'"
                    .into()
            }
            (_, Kind::Colon | Kind::Equal) => {
                message!("begin an entry with 'var', 'const', 'in' or 'out': 'var {}'", word)
            }
            (_, Kind::Name) if is_type(word) => message!("write 'var {}: {}'", next, word),
            ("double" | "real", Kind::Name) => message!("write 'var {}: float'", next),
            ("let" | "mut" | "auto" | "local" | "global" | "val" | "def", Kind::Name) => {
                message!("write 'var {}'", next)
            }
            ("task", Kind::Name) if self.nth(2) == Kind::Colon => return None,
            ("every" | "deadline", _) => {
                "write it after the supervisor's template, before its '{'".into()
            }
            _ => return None,
        })
    }

    /// `in d = 30 cm length`: reports a type after the value of an entry whose name ends before
    /// token `end`.
    pub(in crate::parser) fn type_behind_value(&mut self, end: usize) {
        let is_type = is_type(self.word(0)) && !self.names_something(0);
        if !is_type || !self.on_same_line() {
            return;
        }
        let ty = self.word(0);
        let value = self.text_between(end, self.at);
        let place = Span { start: self.place_between(0, end).end, ..self.next_span() };
        let error = Diagnostic::new(Code::E0102, self.next_span(), "the type comes before the '='");
        let better = format!(": {ty} {value}");
        let help = message!("write '{}{}'", self.text_between(end - 1, end), better);
        self.error(error.help(help).fix(place, better));
        self.pass(1);
    }

    /// `from 1 to 2 = 3`: reports and reads a value after the range that begins at token `range`.
    pub(in crate::parser) fn value_behind_range(&mut self, range: usize) {
        let (sign, equal) = (self.next_span(), self.at);
        self.bump();
        self.formula();
        let [bounds, value] =
            [(range, equal), (equal, self.at)].map(|(first, end)| self.text_between(first, end));
        let error = Diagnostic::new(Code::E0102, sign, "the value comes before its range");
        let better = format!("{value} {bounds}");
        let place = self.place_between(range, self.at);
        self.error(error.write_at(place, better));
    }

    /// A help for a version that is not on the first line.
    pub(in crate::parser) fn top_help(&self) -> Option<Message> {
        let is_version = self.word(0) == "afp" && self.nth(1) == Kind::Int;
        is_version.then(|| "move it to the first line of the file".into())
    }

    /// Whether an actor, entry or supervisor begins here inside the body of another one, although
    /// no brace is missing.
    pub(in crate::parser) fn is_nested(&self) -> bool {
        let begins = self.at_watch() || self.leaves_body() && !self.at_top_item();
        begins && self.balanced && self.depth < MAX_DEPTH
    }

    /// Whether an item of a file begins here inside a plan, although no brace is missing.
    pub(in crate::parser) fn is_top_inside(&self, body: &Body) -> bool {
        self.balanced && body.is_opened() && self.depth < MAX_DEPTH
    }

    /// Reads an item of a file inside a plan.
    pub(in crate::parser) fn top_inside(&mut self) {
        let (here, word) = (self.next_span(), self.word(0));
        let message = message!("'{}' does not belong in the braces of a plan", word);
        let help = match word {
            "use" => "move it to the top of the file",
            _ => "move it after the '}' of the plan",
        };
        self.error(Diagnostic::new(Code::E0114, here, message).help(help));
        self.depth += 1;
        self.open(Kind::Error);
        self.top_item();
        self.close();
        self.depth -= 1;
    }

    /// Reads an item inside another one.
    pub(in crate::parser) fn nested(&mut self) {
        let (here, word) = (self.next_span(), self.word(0));
        if self.depth == 0 {
            let message = message!("'{}' does not belong in these braces", word);
            let help = match word {
                "supervise" => "move it after the '}' of the other supervisor",
                "on" => "move it after the '}' of the supervisor",
                _ => "move it after the '}' of the element around it",
            };
            self.error(Diagnostic::new(Code::E0114, here, message).help(help));
        }
        self.depth += 1;
        self.open(Kind::Error);
        self.plan_item();
        self.close();
        self.depth -= 1;
    }
}
