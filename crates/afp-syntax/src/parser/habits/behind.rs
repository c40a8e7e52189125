//! Invalid text after a claim, an action or another line of a scenario.

use crate::diagnostics::{Code, Diagnostic, Message, Words};
use crate::keywords::ENDS;
use crate::kind::Kind;
use crate::message;
use crate::parser::Parser;
use crate::source::Span;

/// The help for text after a claim.
const BOUNDS: &str = "write 'within', 'before' or 'after' and a time, 'always', 'once' or '3 times'; \
     write another claim on its own line";

/// Words for a count, and their correct forms.
const OFTEN: &[(&str, &str)] = &[("twice", "2 times"), ("thrice", "3 times")];

/// Whether a plan can end in this way.
fn is_end(word: &str) -> bool {
    ENDS.into_iter().any(|end| end.eq_ignore_ascii_case(word))
}

/// The help for text after a line, and an edit if it fixes the line.
struct Said(Message, Option<(Span, String)>);

impl Parser<'_, '_> {
    /// Reports and skips text after a line of a scenario that begins with `first`.
    pub(in crate::parser) fn nothing_behind(&mut self, first: &str) {
        let ends = |p: &Self| {
            !p.on_same_line()
                || p.at_end()
                || matches!(p.nth(0), Kind::CloseBrace | Kind::CloseParen | Kind::Comma)
                || p.at_action()
                || p.at_line()
                || p.at_top_item()
        };
        if ends(self) {
            return;
        }
        let Said(help, fix) = match first {
            "expect" | "never" => self.behind_claim(),
            "at" => self.behind_action(),
            "robot" if self.word_before() == ")" && self.quantity_ends_line() => {
                let here = self.next_span().before();
                Said("write 'heading' before it".into(), Some((here, "heading ".to_owned())))
            }
            _ => Said("remove it, or begin a line with it".into(), None),
        };
        let what = match first {
            "expect" | "never" => "a claim",
            "at" => "an action",
            _ => "a line",
        };
        let message = message!("{} does not belong after {}", self.found(), Words(what));
        let error = Diagnostic::new(Code::E0102, self.next_span(), message).help(help);
        self.error(match fix {
            Some((place, text)) => error.fix(place, text),
            None => error,
        });
        self.pass_to(ends);
    }

    fn behind_claim(&self) -> Said {
        let (word, before, here) = (self.word(0), self.word_before(), self.next_span());
        let write = |text: &str, fits: bool| {
            Said(message!("write '{}'", text), fits.then(|| (here, text.to_owned())))
        };
        let path = self.path_ends(0);
        let add = |text: &str| {
            let whole = format!("{before} {text} {}", self.text_of(0, path));
            let place = (here.before(), format!("{text} "));
            Said(message!("write '{}'", whole), self.claim_ends(path).then_some(place))
        };
        let has_time = self.time_behind(1);
        match (word, before) {
            ("in", _) if has_time.is_some_and(|it| self.claim_ends(it)) => write("within", true),
            ("for" | "during", _) if let Some(end) = has_time => {
                let time = self.text_of(1, end);
                Said(message!("write 'always within {}', or 'within {}' for once", time, time), None)
            }
            ("is" | "equals" | "eq", _) if self.word(1) == "active" => {
                let place = here.to(self.ahead(2));
                Said("write 'active'".into(), Some((place, "active".to_owned())))
            }
            ("is" | "equals" | "eq", _) => write("==", self.nth(1).begins_formula()),
            _ if self.at(Kind::FatArrow) && matches!(self.nth(1), Kind::Int | Kind::Float) => {
                write(">=", true)
            }
            _ if matches!(self.nth(0), Kind::FatArrow | Kind::Minus) => {
                Said("write '->' before the next element".into(), None)
            }
            ("by", _) => Said(
                "'by' follows 'end', 'commit', or an element with its '->'".into(),
                None,
            ),
            ("between", _) => Said("write 'after' and 'before', each with a time".into(), None),
            ("then" | "to" | "goto" | "becomes" | "reaches", _) => {
                let end = self.path_ends(1);
                write("->", end > 1 && (self.claim_ends(end) || self.word(end) == "by"))
            }
            ("and" | "or" | "but", _) => {
                Said(message!("a line has one claim, without '{}': write two lines", word), None)
            }
            _ if self.at(Kind::Int) => self.times(),
            _ if let Some((_, ours)) = OFTEN.iter().find(|(theirs, _)| *theirs == word) => {
                write(ours, self.claim_ends(1))
            }
            (_, "end") if self.claim_ends(path) && (path > 1 || is_end(word)) => add("by"),
            (_, "end") if path > 0 => {
                Said("write the state or event after 'end by', and a time after 'within', 'before' or 'after'".into(), None)
            }
            (_, "commit" | "interrupt") if path > 0 => add("of"),
            _ => Said(BOUNDS.into(), None),
        }
    }

    /// The index of the token after the path that begins `ahead` tokens ahead, on its line.
    fn path_ends(&self, ahead: usize) -> usize {
        let is_name = |at: usize| self.nth(at) == Kind::Name && (at == 0 || !self.begins_line(at));
        if !is_name(ahead) {
            return ahead;
        }
        let mut end = ahead + 1;
        while self.nth(end) == Kind::Dot && is_name(end + 1) {
            end += 2;
        }
        end
    }

    /// The index of the token after the time that begins `ahead` tokens ahead, on its line.
    fn time_behind(&self, ahead: usize) -> Option<usize> {
        let is_number = matches!(self.nth(ahead), Kind::Int | Kind::Float);
        let end = ahead + 1 + usize::from(self.nth(ahead + 1) == Kind::Unit);
        (is_number && !self.begins_line(ahead)).then_some(end)
    }

    /// Whether the rest of the line is a number with an optional unit.
    fn quantity_ends_line(&self) -> bool {
        let sign = usize::from(self.at(Kind::Minus));
        let end = self.time_behind(sign);
        end.is_some_and(|end| self.begins_line(end) || self.nth(end) == Kind::CloseBrace)
    }

    /// Whether a claim may end `ahead` tokens ahead.
    fn claim_ends(&self, ahead: usize) -> bool {
        let bound = match self.word(ahead) {
            "within" | "before" | "after" => self.time_behind(ahead + 1).is_some(),
            word => matches!(word, "always" | "once"),
        };
        let ends = matches!(self.nth(ahead), Kind::CloseBrace | Kind::Comma | Kind::End);
        bound || ends || self.begins_line(ahead)
    }

    /// `3x`, `3 time`, `3`
    fn times(&self) -> Said {
        let number = self.token(0).map_or("", |token| token.text);
        let tokens = match (self.nth(1), self.word(1)) {
            (Kind::Unit, _) => {
                let time = self.text_of(0, 2);
                let help = message!("write 'within', 'before' or 'after' before '{}'", time);
                return Said(help, None);
            }
            (_, "x" | "time" | "tims") if !self.begins_line(1) => 2,
            _ => {
                let help =
                    message!("write '{} times' for how often, '== {}' for a value", number, number);
                return Said(help, None);
            }
        };
        let times = format!("{number} times");
        let place = (self.ahead(tokens), times.clone());
        Said(message!("write '{}'", times), self.claim_ends(tokens).then_some(place))
    }

    fn behind_action(&self) -> Said {
        let time = self.time_behind(1);
        match self.word(0) {
            "during" | "in" | "within" if let Some(end) = time => {
                let place = (self.next_span(), "for".to_owned());
                let ends = self.begins_line(end) || self.nth(end) == Kind::CloseBrace;
                Said("write 'for'".into(), ends.then_some(place))
            }
            _ => Said(
                "only 'for' and a time may follow; write the next action on its own line".into(),
                None,
            ),
        }
    }

    /// `after 3 s press touch`, `wait 3 s`: reports and skips a line with a wrong word before its
    /// time. Returns whether it did.
    pub(in crate::parser) fn time_first(&mut self) -> bool {
        let word = self.word(0);
        let known = matches!(word, "after" | "in" | "when" | "on" | "wait" | "sleep" | "delay");
        if !known || !matches!(self.nth(1), Kind::Int | Kind::Float) || self.begins_line(1) {
            return false;
        }
        let tokens = 2 + usize::from(self.nth(2) == Kind::Unit);
        let time = self.text_of(1, tokens);
        let colon = usize::from(self.nth(tokens) == Kind::Colon);
        let place = self.ahead(tokens + colon);
        let goes_on = self.nth(tokens + colon) == Kind::Name && !self.begins_line(tokens + colon);
        let message = message!("no line of a scenario begins with '{}'", word);
        let error = Diagnostic::new(Code::E0102, place, message);
        let ours = format!("at {time}:");
        self.error(match goes_on {
            true => error.help(message!("write '{}', counted from the start", ours)).replace(ours),
            false => error.help(message!(
                "remove it; an action begins with its time, such as '{} press touch'",
                ours
            )),
        });
        self.pass(tokens + colon);
        self.pass_to(|p| !p.on_same_line() || p.at(Kind::CloseBrace));
        true
    }

    /// `robot at (1 m, 2 m, 90 deg)`: reports and reads a heading within the brackets.
    pub(in crate::parser) fn heading_in_brackets(&mut self) {
        if !self.at(Kind::Comma) || !self.nth(1).begins_formula() {
            return;
        }
        let (comma, first) = (self.next_span(), self.at + 1);
        self.open(Kind::Error);
        self.bump();
        self.formula();
        self.close();
        let heading = self.text_between(first, self.at);
        let message = "the heading follows the brackets";
        let alone = self.at(Kind::CloseParen) && self.word(1) != "heading";
        let error = Diagnostic::new(Code::E0102, comma, message);
        let better = format!(") heading {heading}");
        let place = comma.to(self.next_span());
        self.error(match alone {
            true => error.write_at(place, better),
            false => error.help("remove one of the two"),
        });
    }
}
