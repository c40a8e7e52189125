//! Text in the braces of an element or a supervisor as in other languages.

use crate::diagnostics::{Code, Diagnostic};
use crate::habits::{STATES, ours};
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
            Equal | FatArrow => {
                let is_entry = self.known().entries.contains_key(self.word(2));
                let is_state = ours(STATES, self.word(0)).is_some() && !is_entry;
                is_small && self.nth(2) == Name && !is_state
            }
            _ => self.changes() && is_small,
        }
    }

    /// Reports and takes an edge whose state is written in two words: `Forward Successful -> turn`.
    /// Returns whether there is one.
    pub(in crate::parser) fn state_in_two_words(&mut self) -> bool {
        let [first, second] = [self.word(0), self.word(1)];
        let stands = is_large(first)
            && is_large(second)
            && first != second
            && !self.begins_line(1)
            && self.nth(2) == Kind::Arrow;
        if stands {
            let error = Diagnostic::new(Code::E0102, self.ahead(2), "a name is one word");
            let (one, two) = (format!("{first}{second}"), format!("{first}, {second}"));
            self.error(error.help(message!("write '{}', or '{}' for two names", one, two)));
            self.pass(1);
            self.edge();
        }
        stands
    }

    /// Reports and skips a line of a plan that has no meaning, with the block below it.
    pub(in crate::parser) fn foreign_line(&mut self) {
        let (word, element) = (self.word(0), self.element);
        let message = message!("a plan has no '{}'", word);
        let help = message!(
            "remove it, or write an element, such as 'actor wait: Wait {{ Elapsed -> {} }}'",
            element
        );
        let error = Diagnostic::new(Code::E0102, self.next_span(), message).help(help);
        self.foreign_block(error);
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
