//! Text in the braces of an element or a supervisor as in other languages.

use crate::diagnostics::{Code, Diagnostic};
use crate::kind::Kind;
use crate::message;
use crate::parser::Parser;
use crate::parser::elsewhere::is_large;
use crate::parser::plan::BODY;

impl Parser<'_, '_> {
    /// Whether an edge has an invalid word before it: `when Done -> home`.
    pub(in crate::parser) fn at_word_before_edge(&self) -> bool {
        let is_word = matches!(
            self.word(0),
            "when"
                | "if"
                | "case"
                | "upon"
                | "once"
                | "on"
                | "event"
                | "on_event"
                | "state"
                | "edge"
        );
        let is_small = self.word(0).starts_with(|first: char| first.is_ascii_lowercase());
        let is_word = is_word || is_small && is_large(self.word(1)) && !self.names_something(0);
        is_word
            && self.nth(1) == Kind::Name
            && !self.begins_line(1)
            && self.arrow_at(2).is_some()
            && !self.is_read(self.word(1))
    }

    /// Reports and skips ports in the braces: `{ distance = 30 cm`. Returns whether there is one.
    pub(in crate::parser) fn port_in_braces(&mut self) -> bool {
        if !self.at_port() {
            return false;
        }
        let (here, name) = (self.next_span(), self.word(0));
        let sign = if self.nth(1) == Kind::FatArrow { "=>" } else { "=" };
        let message = message!("'{}' does not belong in these braces", name);
        let help = message!("move it before the '{{', in brackets: '({} {} ...)'", name, sign);
        self.error(Diagnostic::new(Code::E0114, here, message).help(help));
        self.open(Kind::Error);
        while self.at_port() {
            self.bind();
        }
        self.close();
        true
    }

    /// Whether a port or an entry with a value is next. States begin with a capital letter.
    fn at_port(&self) -> bool {
        use Kind::{Colon, Equal, FatArrow, Float, Int, Minus, Name, OpenParen, Text};
        let is_small = self.word(0).starts_with(|first: char| first.is_ascii_lowercase());
        let is_value = matches!(self.nth(2), Int | Float | Text | Minus | OpenParen)
            || matches!(self.word(2), "true" | "false");
        match self.nth(1) {
            _ if !self.at(Name) || self.begins_line(1) || self.begins_line(2) => false,
            Equal | Colon if is_value => true,
            Equal | FatArrow => is_small && self.nth(2) == Name,
            _ => self.changes() && is_small,
        }
    }

    /// Whether an edge begins here, perhaps with an invalid word before it.
    pub(in crate::parser) fn begins_edge(&self) -> bool {
        self.at_edge() || self.at_word_before_edge()
    }

    /// Reads an item with an invalid word before its name, or a keyword of other languages:
    /// `supervisor hit: ...`, `if (far) { ... }`. Returns whether there is one.
    pub(in crate::parser) fn strange_item(&mut self, what: &'static str) -> bool {
        let is_item = self.nth(1) == Kind::Name && self.nth(2) == Kind::Colon;
        if is_item && what == BODY && self.item_meant(what, &["supervise"]) {
            self.guard();
            return true;
        }
        let help = match self.meant(&["actor", "computation", "subplan", "supervise"]) {
            Some("supervise") => "move it after the '}' of this supervisor".into(),
            Some(word) => message!("write '{}' after the '}}' of this element", word),
            None => "write 'supervise' before the name of a supervisor".into(),
        };
        if !is_item || self.names_something(0) {
            return false;
        }
        self.skip(what, help, |p| {
            p.at(Kind::CloseBrace) || p.at_word("supervise") || p.leaves_body() || p.begins_edge()
        });
        true
    }
}
