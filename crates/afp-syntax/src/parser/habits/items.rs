//! Items that no plan and no file has, and items that stand in braces where they have no place.

use super::{LOOP, is_type};
use crate::diagnostics::{Code, Diagnostic, Message};
use crate::kind::Kind;
use crate::lexer::CHOICE;
use crate::message;
use crate::parser::recovery::Body;
use crate::parser::{MAX_DEPTH, Parser};
use crate::source::Span;

/// So many tokens of a value are looked at.
const MOST_TOKENS: usize = 64;
/// What functions and tasks are here.
const SUB_PLAN: &str = "write a plan of its own, and use it as a 'subplan'";

impl Parser<'_, '_> {
    /// What to write for an item that no plan has, and that is no slip.
    pub(in crate::parser) fn item_help(&self) -> Option<Message> {
        let (word, next) = (self.word(0), self.word(1));
        let begins_element = || self.on_line_from(1, Kind::OpenBrace).is_some();
        // What stands on the next line is none of this.
        let sign = if self.begins_line(1) { Kind::End } else { self.nth(1) };
        Some(match (word, sign) {
            (_, Kind::Equal | Kind::Plus | Kind::Minus | Kind::Star | Kind::Slash)
                if let Some(help) = self.assignment_help(false) =>
            {
                help
            }
            (_, Kind::Colon) if begins_element() => {
                "begin an element with 'actor', 'computation' or 'subplan', a supervisor with 'supervise'"
                    .into()
            }
            (_, Kind::Colon | Kind::Equal) => {
                message!("begin an entry with 'var', 'const', 'in' or 'out': 'var {}'", word)
            }
            (_, Kind::Arrow) => "put the edge into the braces of an element or a supervisor".into(),
            (_, Kind::Name) if is_type(word) => message!("write 'var {}: {}'", next, word),
            ("double" | "real", Kind::Name) => message!("write 'var {}: float'", next),
            ("def" | "task", Kind::Name) if self.nth(2) == Kind::OpenParen => SUB_PLAN.into(),
            ("let" | "mut" | "auto" | "local" | "global" | "val" | "def", Kind::Name) => {
                message!("write 'var {}'", next)
            }
            ("task", Kind::Name) if self.nth(2) == Kind::Colon => return None,
            ("if" | "else" | "elif" | "switch" | "case" | "when" | "match", _) => CHOICE.into(),
            ("while" | "for" | "loop" | "do" | "until", _) => LOOP.into(),
            ("import" | "include" | "from", _) => "write 'use' at the top of the file".into(),
            ("fn" | "func" | "function" | "void" | "class" | "task", _) => {
                SUB_PLAN.into()
            }
            ("every" | "deadline", _) => {
                "write it behind the supervisor's template, before its '{'".into()
            }
            _ => return None,
        })
    }

    /// `n = n + 1`, `n += 1`, `n++`: how a value is written, where an entry is that changes and not one that is declared, or,
    /// in the body of an element, a port.
    pub(in crate::parser) fn assignment_help(&self, in_body: bool) -> Option<Message> {
        let (name, sign) = (self.word(0), self.token(1)?.text);
        let end = |from: usize| self.end_of_value(from);
        let value = match (self.nth(1), self.nth(2)) {
            (Kind::Equal, _) => self.text_of(2, end(2)?),
            (_, Kind::Equal) => format!("{name} {sign} {}", self.text_of(3, end(3)?)),
            (first @ (Kind::Plus | Kind::Minus), second) if first == second => {
                format!("{name} {sign} 1")
            }
            _ => return None,
        };
        let declared = self.entries.get(name).copied();
        let reads_itself = end(2)? > 3 && (2..end(2)?).any(|at| self.word(at) == name);
        let is_entry = declared.is_some() && !in_body || reads_itself;
        if self.nth(1) == Kind::Equal && !is_entry {
            return None;
        }
        let help =
            message!("let a computation write it: 'Assign(value = {}, result => {})'", value, name);
        Some(match declared {
            Some(word @ ("in" | "const")) => {
                message!("declare '{}' with 'var' in place of '{}', and {}", name, word, help)
            }
            _ => help,
        })
    }

    /// The token behind the value that begins so many tokens ahead, on its line.
    fn end_of_value(&self, from: usize) -> Option<usize> {
        let mut depth = 0_usize;
        (from..from + MOST_TOKENS).find(|at| {
            match self.nth(*at) {
                Kind::OpenParen => depth += 1,
                Kind::CloseParen => depth = depth.saturating_sub(1),
                _ => {}
            }
            let ends = matches!(self.nth(*at), Kind::CloseBrace | Kind::End)
                || depth == 0 && self.nth(*at) == Kind::Comma;
            ends || self.begins_line(*at) || self.nth(*at + 1) == Kind::Arrow
        })
    }

    /// `in d = 30 cm length`: reports a type behind the value of an entry whose name ends before token `end`.
    pub(in crate::parser) fn type_behind_value(&mut self, end: usize) {
        let is_type = is_type(self.word(0)) && !self.names_something(0);
        if !is_type || !self.on_same_line() {
            return;
        }
        let ty = self.word(0);
        let value = self.text_between(end, self.at);
        let place = Span { start: self.place_between(0, end).end, ..self.next_span() };
        let error =
            Diagnostic::new(Code::E0102, self.next_span(), "the type stands before the '='");
        let better = format!(": {ty} {value}");
        let help = message!("write '{}{}'", self.text_between(end - 1, end), better);
        self.error(error.help(help).fix(place, better));
        self.pass(1);
    }

    /// `from 1 to 2 = 3`: reports a value behind the range that begins at token `range`, and reads it.
    pub(in crate::parser) fn value_behind_range(&mut self, range: usize) {
        let (sign, equal) = (self.next_span(), self.at);
        self.bump();
        self.formula();
        let [bounds, value] =
            [(range, equal), (equal, self.at)].map(|(first, end)| self.text_between(first, end));
        let error = Diagnostic::new(Code::E0102, sign, "the value stands before its range");
        let better = format!("{value} {bounds}");
        let place = self.place_between(range, self.at);
        self.error(error.write_at(place, better));
    }

    /// What to write for an item that files of other languages have.
    pub(in crate::parser) fn top_help(&self) -> Option<Message> {
        if self.word(0) == "afp" && self.nth(1) == Kind::Int {
            return Some("move it to the first line of the file".into());
        }
        let is_import = matches!(self.word(0), "import" | "include" | "from" | "using" | "require");
        is_import.then(|| "write 'use' and the name of a toolbox".into())
    }

    /// Whether an actor, entry or supervisor begins here inside the body of another one, though no brace is missing.
    pub(in crate::parser) fn is_nested(&self) -> bool {
        let begins = self.at_watch() || self.leaves_body() && !self.at_top_item();
        begins && self.balanced && self.depth < MAX_DEPTH
    }

    /// Whether an item of a file begins here inside of a plan, though no brace is missing.
    pub(in crate::parser) fn is_top_inside(&self, body: &Body) -> bool {
        self.balanced && body.is_opened() && self.depth < MAX_DEPTH
    }

    /// Reads an item of a file that stands inside of a plan.
    pub(in crate::parser) fn top_inside(&mut self) {
        let (here, word) = (self.next_span(), self.word(0));
        let message = message!("'{}' stands in the braces of a plan", word);
        let help = match word {
            "use" => "move it to the top of the file",
            _ => "move it behind the '}' of the plan",
        };
        self.error(Diagnostic::new(Code::E0114, here, message).help(help));
        self.depth += 1;
        self.open(Kind::Error);
        self.top_item();
        self.close();
        self.depth -= 1;
    }

    /// Reads an item that stands inside of another one.
    pub(in crate::parser) fn nested(&mut self) {
        let (here, word) = (self.next_span(), self.word(0));
        if self.depth == 0 {
            let message = message!("'{}' stands in braces where it has no place", word);
            let help = match word {
                "supervise" => "move it behind the '}' of the other supervisor",
                "on" => "move it behind the '}' of the supervisor",
                _ => "move it behind the '}' of the element around it",
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
