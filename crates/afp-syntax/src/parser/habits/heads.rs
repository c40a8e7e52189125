//! What stands behind a template as other languages have it: ports, times.

use crate::diagnostics::{Code, Diagnostic};
use crate::kind::Kind;
use crate::parser::Parser;

/// Words that a time of a supervisor has elsewhere, and ours.
const TIMES: &[(&str, &[&str])] =
    &[("every", &["each", "period", "interval", "rate"]), ("deadline", &["within", "timeout"])];

impl Parser<'_, '_> {
    /// `Turn[angle = 90 deg]`, `Turn angle = 90 deg`: reports the parentheses that are missing, and reads the ports.
    pub(in crate::parser) fn ports_without_parentheses(&mut self) {
        if !self.on_same_line() || self.at_timing() {
            return;
        }
        let in_brackets = self.at(Kind::OpenBracket);
        let first = usize::from(in_brackets);
        if self.nth(first) != Kind::Name || self.nth(first + 1) != Kind::Equal {
            return;
        }
        let here = self.next_span();
        let message = format!("expected '(', found {}", self.found());
        let help = "put what goes into a template in parentheses: '(' and ')'";
        self.error(Diagnostic::new(Code::E0102, here, message).help(help));
        if in_brackets {
            self.pass(1);
        }
        self.open(Kind::Args);
        while self.at(Kind::Name) && self.nth(1) == Kind::Equal && self.on_same_line() {
            self.bind();
            self.eat(Kind::Comma);
        }
        self.close();
        if self.at(Kind::CloseBracket) && self.on_same_line() {
            self.pass(1);
        }
    }

    /// `within 50 ms`, `each 50 ms`: reports the word, and reads what follows as the time that is meant.
    pub(in crate::parser) fn time_by_another_word(&mut self) {
        let word = self.word(0);
        let ours = TIMES.iter().find(|(_, others)| others.contains(&word));
        let before_time = matches!(self.nth(1), Kind::Int | Kind::Float) && !self.begins_line(1);
        let Some((ours, _)) = ours.filter(|_| before_time && self.on_same_line()) else { return };
        let here = self.next_span();
        let message = format!("a time of a supervisor has no word '{word}'");
        let help = format!("write '{ours}'");
        self.error(Diagnostic::new(Code::E0102, here, message).help(help).replace(*ours));
        self.timing();
    }
}
