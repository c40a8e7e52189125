//! Lines of scenarios with words in another order, or with other signs.

use crate::diagnostics::{Code, Diagnostic, Words};
use crate::kind::Kind;
use crate::message;
use crate::parser::Parser;
use crate::parser::scenario::is_line;

const MOST_TOKENS: usize = 64;
/// Actions of scenarios other than 'set'.
const ACTIONS: &[&str] = &["press", "release", "fail", "fire", "finish", "idle"];

impl Parser<'_, '_> {
    /// Reports the sign in `expect a = 0`. Returns whether it did.
    pub(in crate::parser) fn comparison_meant(&mut self) -> bool {
        let stands = self.at(Kind::Equal) && self.on_same_line();
        if stands {
            let here = self.next_span();
            let error = Diagnostic::new(Code::E0102, here, "two values are compared with '=='");
            self.error(error.help("write '=='").replace("=="));
        }
        stands
    }

    /// Reports and skips the sign in `seed = 7`, `until: 20 s`.
    pub(in crate::parser) fn no_sign_behind_word(&mut self) {
        if matches!(self.nth(0), Kind::Equal | Kind::Colon) && self.on_same_line() {
            let message = message!("unexpected {} after '{}'", self.found(), self.word_before());
            self.instead(1, message, "remove it", "");
        }
    }

    /// Reports and skips the signs in `expect a <> 0`. Returns whether it did.
    pub(in crate::parser) fn unequal_meant(&mut self) -> bool {
        let adjacent = self.token_index(1) == self.token_index(0) + 1;
        let stands = self.at(Kind::Less) && self.nth(1) == Kind::Greater && self.on_same_line();
        if stands && adjacent {
            let message = "unexpected '<>' between two values";
            let error = Diagnostic::new(Code::E0102, self.ahead(2), message);
            self.error(error.help("write '!='").replace("!="));
            self.bump_together(2, Kind::NotEqual);
        }
        stands && adjacent
    }

    /// Reports the place of the time, and skips the line: `press touch at 3 s`, `idle all`. Returns
    /// whether the line is an action.
    pub(in crate::parser) fn action_without_its_time(&mut self) -> bool {
        let tokens = self.tokens_on_line();
        let at = (1..tokens).find(|at| self.at_time(*at));
        let is_action = self.at_action() && tokens > 1;
        let is_set = self.word(0) == "set" && at.is_some();
        if !(is_action || is_set) {
            return false;
        }
        let place = self.ahead(tokens);
        let error = match at {
            Some(at) => {
                let end = self.token_of_time(at);
                let (time, what) = (self.text_of(at + 1, end), self.text_of(0, at));
                let better = format!("at {time}: {what} {}", self.text_of(end, tokens));
                let better = better.trim_end();
                let message = "a line begins with the time of its action";
                let error = Diagnostic::new(Code::E0102, place, message);
                error.write(better)
            }
            None => {
                let message = message!("missing time at which to {}", Words(self.word(0)));
                let help =
                    message!("write it in front, such as 'at 1 s: {}'", self.text_of(0, tokens));
                Diagnostic::new(Code::E0102, place, message).help(help)
            }
        };
        self.error(error);
        self.pass(tokens);
        true
    }

    /// Whether an action is next.
    pub(in crate::parser) fn at_action(&self) -> bool {
        ACTIONS.contains(&self.word(0)) && self.nth(1) == Kind::Name
    }

    /// Reports and skips the word after the claim of a line that begins at `first`: `expect end
    /// never`.
    pub(in crate::parser) fn never_behind(&mut self, first: usize) {
        let ends = self.begins_line(1)
            || matches!(self.nth(1), Kind::CloseBrace | Kind::End)
            || matches!(self.word(1), "within" | "before" | "after");
        if !self.at_word("never") || !self.on_same_line() || !ends {
            return;
        }
        let place = self.place_between(first, self.at + 1);
        let better = format!("never {}", self.text_between(first + 1, self.at));
        let error = Diagnostic::new(Code::E0102, place, "'never' replaces 'expect'");
        self.error(error.write(better));
        self.pass(1);
        while matches!(self.word(0), "within" | "before" | "after") && self.on_same_line() {
            self.open(Kind::Bound);
            self.keyword();
            self.quantity("write a time such as '3 s'");
            self.close();
        }
    }

    /// The number of tokens on the line of a scenario that begins here.
    fn tokens_on_line(&self) -> usize {
        let ends = |at: usize| {
            let is_path = at == 1 || self.nth(at - 1) == Kind::Dot;
            let is_line = is_line(self.word(at)) || ACTIONS.contains(&self.word(at));
            let is_line = is_line && !is_path && !self.at_time(at);
            let kind = self.nth(at);
            is_line || self.begins_line(at) || matches!(kind, Kind::CloseBrace | Kind::End)
        };
        (1..MOST_TOKENS).find(|at| ends(*at)).unwrap_or(1)
    }

    /// Whether a token ahead is a time, with 'at' or 'after' before it and without a ':' after it.
    fn at_time(&self, ahead: usize) -> bool {
        matches!(self.word(ahead), "at" | "after")
            && matches!(self.nth(ahead + 1), Kind::Int | Kind::Float)
            && self.nth(self.token_of_time(ahead)) != Kind::Colon
    }

    /// The token after a word and the time after the word.
    fn token_of_time(&self, word: usize) -> usize {
        word + 2 + usize::from(self.nth(word + 2) == Kind::Unit)
    }
}
