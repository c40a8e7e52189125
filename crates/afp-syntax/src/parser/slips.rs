//! Misspelt keywords, and keywords of other languages: reported once, and read as the intended
//! keyword.

use super::Parser;
use super::elsewhere::is_large;
use crate::diagnostics::{Code, Diagnostic, Message, words};
use crate::keywords;
use crate::kind::Kind;
use crate::message;

impl Parser<'_, '_> {
    /// The intended keyword of a list at the beginning of an item, if the rest of the line fits.
    pub(super) fn meant<'a>(&self, list: &[&'a str]) -> Option<&'a str> {
        use Kind::{Float, Int, Name, OpenBrace, Text};
        let goes_on = matches!(self.nth(1), Name | Text | Int | Float | OpenBrace);
        let is_read = self.slip.is_some_and(|(at, _)| at == self.at);
        let is_word = self.at(Kind::Name) && goes_on && !self.begins_line(1) && !is_read;
        (is_word && self.explains()).then(|| keywords::meant(self.word(0), list))?
    }

    /// Whether a substitute for a keyword precedes a name and a template: `callback hit:
    /// CheckTouchSensor {`.
    pub(super) fn at_head_elsewhere(&self, list: &[&str]) -> bool {
        use Kind::{Arrow, Colon, Name, OpenBrace, OpenParen};
        let is_head = (self.nth(1), self.nth(2)) == (Name, Colon)
            && is_large(self.word(3))
            && matches!(self.nth(4), OpenParen | OpenBrace | Arrow);
        is_head && self.meant(list).is_some()
    }

    /// Reports the next word and reads it as the intended keyword of a list. Returns whether it
    /// did.
    pub(super) fn item_meant(&mut self, what: &'static str, list: &[&'static str]) -> bool {
        let meant = self.meant(list);
        if let Some(meant) = meant {
            self.read_as(meant, what);
        }
        meant.is_some()
    }

    /// Reports a word and reads it as another word.
    pub(super) fn read_as(&mut self, meant: &'static str, what: impl Into<Message>) {
        if !self.word(0).is_ascii() {
            self.supersede(self.next_span());
        }
        self.report_skipped(what, message!("write '{}'", meant), Some(meant));
        self.slip = Some((self.at, meant));
    }

    /// Whether the next word, on the same line as the word before it, is a misspelt keyword. Short
    /// words are too similar to other words.
    pub(super) fn at_slip(&self, word: &str) -> bool {
        let written = self.word(0);
        self.on_same_line()
            && written.len() > 2
            && !self.names_something(0)
            && self.explains()
            && words::nearest(written, [word]).is_some()
    }

    /// Takes a keyword, or its misspelling before a token for which `follows` holds.
    pub(super) fn eat_meant(&mut self, word: &'static str, follows: impl Fn(Kind) -> bool) -> bool {
        let is_slip = !self.at_word(word) && self.at_slip(word) && follows(self.nth(1));
        if is_slip {
            self.read_as(word, message!("'{}'", word));
        }
        self.eat_word(word)
    }

    /// Reports and skips a repeated word: `actor actor go`.
    pub(super) fn word_twice(&mut self) {
        if self.word(0) == self.word_before() && self.nth(1) == Kind::Name && self.on_same_line() {
            let message = message!("'{}' is repeated here", self.word(0));
            self.instead(1, message, "remove it", "");
        }
    }

    /// Reports and skips a word before a keyword of a list: `pub plan Main {`, `async actor go:
    /// Wait`. Returns whether it did.
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

    /// Reports and skips `live` after `out`: only inputs are live.
    pub(super) fn live_elsewhere(&mut self) {
        if self.at_word("live") && self.nth(1) == Kind::Name {
            let error = Diagnostic::new(Code::E0102, self.here(), "only an 'in' is live");
            self.error(error.help("remove 'live'").replace(""));
            self.pass(1);
        }
    }

    /// Reports the order of the words in `live in x`, and skips the first. Returns whether it did.
    pub(super) fn live_before_in(&mut self) -> bool {
        let stands = self.word(0) == "live" && self.word(1) == "in" && self.nth(2) == Kind::Name;
        if stands {
            let error = Diagnostic::new(Code::E0102, self.ahead(2), "'live' comes after 'in'");
            self.error(error.help("write 'in live'").replace("in live"));
            self.pass(1);
        }
        stands
    }
}
