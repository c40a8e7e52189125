//! Words of the grammar with a slip in them, and words that other languages have in their place: said once, and read as
//! what they were meant for.

use super::Parser;
use super::elsewhere::is_large;
use crate::diagnostics::{Code, Diagnostic, Message, words};
use crate::keywords;
use crate::kind::Kind;
use crate::message;

impl Parser<'_, '_> {
    /// The word of a list that was meant where an item begins: on the line of the next word stands what such items have.
    pub(super) fn meant<'a>(&self, list: &[&'a str]) -> Option<&'a str> {
        use Kind::{Float, Int, Name, OpenBrace, Text};
        let goes_on = matches!(self.nth(1), Name | Text | Int | Float | OpenBrace);
        let is_read = self.slip.is_some_and(|(at, _)| at == self.at);
        let is_word = self.at(Kind::Name) && goes_on && !self.begins_line(1) && !is_read;
        (is_word && self.explains()).then(|| keywords::meant(self.word(0), list))?
    }

    /// `callback hit: CheckTouchSensor {`: whether a word that stands for one of a list is written before a name and a
    /// template.
    pub(super) fn at_head_elsewhere(&self, list: &[&str]) -> bool {
        use Kind::{Arrow, Colon, Name, OpenBrace, OpenParen};
        let is_head = (self.nth(1), self.nth(2)) == (Name, Colon)
            && is_large(self.word(3))
            && matches!(self.nth(4), OpenParen | OpenBrace | Arrow);
        is_head && self.meant(list).is_some()
    }

    /// Reads the next word as that of a list which it was meant for, after having said so. Returns whether it was.
    pub(super) fn item_meant(&mut self, what: &'static str, list: &[&'static str]) -> bool {
        let meant = self.meant(list);
        if let Some(meant) = meant {
            self.read_as(meant, what);
        }
        meant.is_some()
    }

    /// Says that another word stands in the place of one, and reads it as that one.
    pub(super) fn read_as(&mut self, meant: &'static str, what: impl Into<Message>) {
        self.report_skipped(what, message!("write '{}'", meant), Some(meant));
        self.slip = Some((self.at, meant));
    }

    /// Whether the next word, on the line of the one before it, is a slip of a word of the grammar. Short ones are too
    /// near to others.
    pub(super) fn at_slip(&self, word: &str) -> bool {
        let written = self.word(0);
        self.on_same_line()
            && written.len() > 2
            && !self.names_something(0)
            && self.explains()
            && words::nearest(written, [word]).is_some()
    }

    /// Takes a word of the grammar, or a slip of it before a token of which `follows` holds.
    pub(super) fn eat_meant(&mut self, word: &'static str, follows: impl Fn(Kind) -> bool) -> bool {
        let is_slip = !self.at_word(word) && self.at_slip(word) && follows(self.nth(1));
        if is_slip {
            self.read_as(word, message!("'{}'", word));
        }
        self.eat_word(word)
    }

    /// `actor actor go`: says that a word stands there twice, and reads past the second.
    pub(super) fn word_twice(&mut self) {
        if self.word(0) == self.word_before() && self.nth(1) == Kind::Name && self.on_same_line() {
            let message = message!("'{}' stands here twice", self.word(0));
            self.instead(1, message, "remove it", "");
        }
    }

    /// `pub plan Main {`, `async actor go: Wait`: says that a word stands before one of a list, and reads past it. Returns
    /// whether it does.
    pub(super) fn word_before_item(&mut self, list: &[&str]) -> bool {
        let stands = self.at(Kind::Name)
            && list.contains(&self.word(1))
            && self.nth(2) == Kind::Name
            && !self.begins_line(1);
        if stands {
            let message = message!("unexpected {} before '{}'", self.found(), self.word(1));
            self.instead(1, message, "remove it", "");
        }
        stands
    }

    /// `out live x`: says that nothing else than an input is live, and reads past the word.
    pub(super) fn live_elsewhere(&mut self) {
        if self.at_word("live") && self.nth(1) == Kind::Name {
            let error = Diagnostic::new(Code::E0102, self.here(), "only an 'in' is live");
            self.error(error.help("remove 'live'").replace(""));
            self.pass(1);
        }
    }

    /// `live in x`: says in which order the words stand, and reads past the first. Returns whether they stand so.
    pub(super) fn live_before_in(&mut self) -> bool {
        let stands = self.word(0) == "live" && self.word(1) == "in" && self.nth(2) == Kind::Name;
        if stands {
            let error = Diagnostic::new(Code::E0102, self.ahead(2), "'live' stands behind 'in'");
            self.error(error.help("write 'in live'").replace("in live"));
            self.pass(1);
        }
        stands
    }
}
