//! Text before and after the arrow of an edge in the style of other languages.

use crate::diagnostics::{Code, Diagnostic};
use crate::keywords::{self, PLAN};
use crate::kind::Kind;
use crate::message;
use crate::parser::Parser;
use crate::parser::elsewhere::QUOTES;

impl Parser<'_, '_> {
    /// `fail("why")`, `terminate()`, `home()`: reports the brackets after a target and returns
    /// their number of tokens.
    pub(in crate::parser) fn no_brackets(&mut self) -> usize {
        let is_word = matches!(self.word(0), "terminate" | "fail" | "ignore" | "resume" | "return");
        let tokens = match (self.nth(1), self.nth(2), self.nth(3)) {
            (Kind::OpenParen, Kind::CloseParen, _) => 2,
            (Kind::Colon | Kind::Comma, Kind::Text, _) if is_word => 2,
            (Kind::OpenParen, Kind::Text, Kind::CloseParen) if is_word => 3,
            _ => return 0,
        };
        if (1..=tokens).any(|ahead| self.begins_line(ahead)) {
            return 0;
        }
        let word = self.word(0);
        let text = (2..=tokens).filter_map(|ahead| self.token(ahead));
        let better = match { text }.find(|token| token.kind == Kind::Text) {
            Some(text) => format!("{word} {}", text.text),
            None => word.to_owned(),
        };
        let sign =
            if self.nth(1) == Kind::OpenParen { "brackets".into() } else { self.found_at(1) };
        let message = message!("unexpected {} after '{}'", sign, word);
        self.error(Diagnostic::new(Code::E0102, self.ahead(tokens + 1), message).write(better));
        tokens
    }

    /// Takes tokens after a target that were already reported; a string among them belongs to the
    /// target.
    pub(in crate::parser) fn pass_tokens(&mut self, tokens: usize) {
        (0..tokens).for_each(|_| self.bump());
    }

    /// `-> "home"`, `-> (home)`, `-> [home]`: reports the signs around a target. Returns whether it
    /// did.
    pub(in crate::parser) fn target_in_signs(&mut self) -> bool {
        if !self.on_same_line() {
            return false;
        }
        if self.at(Kind::Text) {
            let text = self.token(0).map_or("", |token| token.text);
            let name = text.trim_matches(QUOTES);
            let is_name = name.chars().all(|sign| sign.is_alphanumeric() || sign == '_');
            let (message, better) = match is_name && !name.is_empty() {
                true => ("a target has no quotes", name.to_owned()),
                false => ("only 'fail' takes a string", format!("fail {text}")),
            };
            if is_name {
                self.supersede(self.next_span());
            }
            self.instead(1, message, message!("write '{}'", better), &better);
            return true;
        }
        if self.at(Kind::Int) && self.token_index(1) == self.token_index(0) + 1 {
            let name = self.word(1);
            if !name.is_empty() {
                let help = message!("write '{}'", name);
                self.instead(2, "a name begins with a letter", help, name);
                return true;
            }
        }
        let in_brackets = matches!(
            (self.nth(0), self.nth(2)),
            (Kind::OpenParen, Kind::CloseParen) | (Kind::OpenBracket, Kind::CloseBracket)
        );
        let name = self.word(1);
        if in_brackets && !name.is_empty() {
            let help = message!("write '{}'", name);
            self.instead(3, "a target has no brackets", help, name);
        }
        in_brackets && !name.is_empty()
    }

    /// `-> go.Done`, `-> go -> home`, `-> go, home`: reports text after a target on its line.
    pub(in crate::parser) fn no_more_targets(&mut self) {
        let more = self.on_same_line() && self.nth(1) == Kind::Name && !self.begins_line(1);
        if self.at(Kind::Dot) && self.is_adjacent() && !more {
            return self.instead(1, "an edge ends with its target", "remove it", "");
        }
        if !more {
            return;
        }
        let one = "an edge leads to one element";
        let (message, help) = match self.nth(0) {
            Kind::Dot => {
                ("an edge leads to an element as a whole", "remove everything from the '.' on")
            }
            Kind::Arrow => (one, "write the next edge in the braces of that element"),
            Kind::Comma if self.is_second_target() => (one, "remove everything from the ',' on"),
            Kind::Name if matches!(self.word(0), "and" | "or") && self.is_second_target() => {
                (one, "remove what follows")
            }
            _ => return,
        };
        let here = self.ahead(2);
        let error = Diagnostic::new(Code::E0102, here, message).help(help);
        let goes_on = self.at(Kind::Arrow);
        self.error(if goes_on { error } else { error.replace("") });
        self.pass(2);
    }

    /// `fail`, with its reason on the next line.
    pub(in crate::parser) fn reason_of_another_line(&mut self) {
        if !self.on_same_line() {
            let message = "the reason of 'fail' belongs on the same line";
            let error = Diagnostic::new(Code::E0102, self.next_span(), message);
            self.error(error.help("write it after 'fail'"));
        }
    }

    /// Reports and skips a string after a target other than `fail`: `terminate "why"`.
    pub(in crate::parser) fn no_text_behind_target(&mut self) {
        if self.at(Kind::Text) && self.on_same_line() {
            let message = "only 'fail' takes a reason";
            self.instead(1, message, "remove it, or write 'fail' before it", "");
        }
    }

    /// Whether the next name belongs to an element. Names of states, whose edges may be incomplete,
    /// begin with a capital letter.
    fn is_second_target(&self) -> bool {
        let ends = self.nth(2) == Kind::CloseBrace || self.begins_line(2);
        let is_name = self.word(1).starts_with(|first: char| first.is_ascii_lowercase());
        ends && is_name && !self.edge_at(1)
    }

    /// `Done | Lost -> home`, `Done or Lost -> home`: reports the sign between the names. Returns
    /// whether it did.
    pub(in crate::parser) fn sign_between_states(&mut self) -> bool {
        let is_sign = matches!(self.nth(1), Kind::Pipe | Kind::Slash | Kind::Plus)
            || matches!(self.word(1), "or" | "and");
        let is_edge = self.nth(2) == Kind::Name && self.arrow_at(3).is_some();
        if !(self.at(Kind::Name) && is_sign && is_edge) || self.begins_line(2) {
            return false;
        }
        let here = self.token(1).map_or_else(|| self.behind(), |token| self.span_of(token));
        let error = Diagnostic::new(Code::E0102, here, "the names of states are separated by ','");
        // Without the space before it.
        self.error(error.help("write ','").replace(","));
        self.open_item(Kind::Edge);
        self.take_name();
        self.pass(1);
        self.rest_of_edge();
        true
    }

    /// `fail it is stuck`: reports the missing quotes and skips the words.
    pub(in crate::parser) fn reason_without_quotes(&mut self) {
        let is_word = |parser: &Self, ahead: usize| {
            parser.nth(ahead) == Kind::Name && !parser.begins_line(ahead)
        };
        let words = (0..).take_while(|ahead| is_word(self, *ahead)).count();
        let ends = self.nth(words) == Kind::CloseBrace || self.begins_line(words);
        let begins_item = words == 2 && keywords::has(self.word(0), PLAN);
        if words == 0 || !ends || begins_item {
            return;
        }
        let text: Vec<_> = (0..words).map(|ahead| self.word(ahead)).collect();
        let better = format!("\"{}\"", text.join(" "));
        let message = "the reason of 'fail' needs double quotes";
        self.instead(words, message, message!("write '{}'", better), &better);
    }
}
