//! Text after a template as in other languages: ports, times.

use crate::diagnostics::{Code, Diagnostic, Message, Words};
use crate::habits::HEAD;
use crate::kind::Kind;
use crate::message;
use crate::parser::Parser;
use crate::parser::elsewhere::is_large;

/// The maximum number of tokens of a path.
const MOST_TOKENS: usize = 64;

impl Parser<'_, '_> {
    /// Reports and skips a path without quotes: `use lib/a.afp`. Returns whether there is one.
    pub(in crate::parser) fn path_without_quotes(&mut self) -> bool {
        use Kind::{Dot, Float, Int, Minus, Name, Slash};
        let is_part = |at: usize| matches!(self.nth(at), Name | Dot | Slash | Minus | Int | Float);
        let adjacent = |at: usize| self.token_index(at) == self.token_index(0) + at;
        let tokens = (0..MOST_TOKENS).take_while(|at| is_part(*at) && adjacent(*at)).count();
        let path = self.text_of(0, tokens);
        if !self.on_same_line() || !(path.contains('/') || path.ends_with(".afp")) {
            return false;
        }
        let toolbox = self.word(0);
        if matches!(toolbox, "std" | "carbot") && !path.ends_with(".afp") {
            let error =
                Diagnostic::new(Code::E0102, self.ahead(tokens), "a toolbox is used as a whole");
            self.error(error.write(toolbox));
            self.pass(tokens);
            return true;
        }
        let error =
            Diagnostic::new(Code::E0102, self.ahead(tokens), "the path of a file is a string");
        let error = error.help("put the path in double quotes");
        self.error(error.replace(format!("\"{path}\"")));
        self.pass(tokens);
        self.short_name_of_a_file();
        true
    }

    /// Reports and skips a short name after the path of a file: `use "a.afp" as a`.
    pub(in crate::parser) fn short_name_of_a_file(&mut self) {
        let named = self.nth(1) == Kind::Name && !self.begins_line(1);
        if self.at_word("as") && self.on_same_line() && named {
            let message = "a file has no short name";
            let help = "remove it; use the names that the file declares";
            self.instead(2, message, help, "");
        }
    }

    /// `use carbot, std`, `use carbot::*`, `use carbot.Forward`: reports and skips the text after
    /// the name of a toolbox or the path of a file; the line begins at token `first`.
    pub(in crate::parser) fn use_of_parts(&mut self, first: usize) {
        let same_line = |p: &Self| p.on_same_line() && !p.begins_line(1);
        while self.at(Kind::Comma)
            && matches!(self.nth(1), Kind::Name | Kind::Text)
            && same_line(self)
        {
            let name = self.text_of(1, 2);
            let what = if self.nth(1) == Kind::Text { "file" } else { "toolbox" };
            let message = message!("each {} needs its own 'use'", Words(what));
            let help = message!("write 'use {}' on the next line", name);
            let place = self.ahead(2);
            let error = Diagnostic::new(Code::E0102, place, message);
            self.error(error.help(help).replace(format!("\nuse {name}")));
            self.pass(2);
        }
        let colons = usize::from(self.at(Kind::Colon) && self.nth(1) == Kind::Colon);
        if !(self.at(Kind::Dot) || colons > 0) || !same_line(self) {
            return;
        }
        let (line, toolbox) = (self.text_between(first, self.at), self.word_before());
        let tokens = 1 + colons + usize::from(!self.begins_line(1 + colons));
        let help =
            message!("write '{}'; then use its names directly, or after '{}.'", line, toolbox);
        self.instead(tokens, "a toolbox is used as a whole", help, "");
    }

    /// `Turn[angle = 90 deg]`, `Turn angle = 90 deg`: reports the missing parentheses, and reads
    /// the ports.
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
        let help = "put the inputs of a template in parentheses: '(' and ')'";
        self.error(self.instead_of(here, "'('").help(help));
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

    /// Reports and reads a name of two words: `actor hold still: Hold`. Returns whether there is
    /// one.
    pub(in crate::parser) fn name_in_two_words(&mut self) -> bool {
        let behind = if self.word_before() == "plan" { Kind::OpenBrace } else { Kind::Colon };
        let stands = (self.nth(0), self.nth(1), self.nth(2)) == (Kind::Name, Kind::Name, behind)
            && !matches!(self.word(1), "forever" | "loop" | "always" | "cyclic" | "endless")
            && crate::diagnostics::words::nearest(self.word(1), ["forever"]).is_none()
            && self.on_same_line()
            && !self.begins_line(1);
        if stands {
            let error = Diagnostic::new(Code::E0102, self.ahead(2), "a name is one word");
            let (first, second) = (self.word(0), self.word(1));
            self.error(error.write(match first == second {
                true => first.to_owned(),
                false => format!("{first}_{second}"),
            }));
            self.bump();
            self.pass(1);
        }
        stands
    }

    /// Reports and skips a word before a template: `new Turn(`, `not CheckTouchSensor {`.
    pub(in crate::parser) fn word_before_template(&mut self) {
        let is_small = self.word(0).starts_with(|first: char| first.is_ascii_lowercase());
        let is_template = is_large(self.word(1))
            && matches!(self.nth(2), Kind::OpenParen | Kind::OpenBrace | Kind::Arrow);
        if is_small && is_template && self.on_same_line() && !self.begins_line(1) {
            let message = message!("unexpected {} before a template", self.found());
            self.instead(1, message, "remove it", "");
        }
    }

    /// Returns the help for brackets after the name of a plan.
    pub(in crate::parser) fn help_for_parameters(&self) -> Message {
        let close = (1..MOST_TOKENS).find(|at| self.nth(*at) == Kind::CloseParen);
        let is_typed = (self.nth(1), self.nth(2)) == (Kind::Name, Kind::Colon);
        match close.filter(|_| is_typed) {
            Some(close) => {
                let entries = self.text_of(1, close).replace(',', " in");
                message!("remove the brackets, and write 'in {}' in the braces", entries)
            }
            None => "remove the brackets: a plan declares its inputs with 'in'".into(),
        }
    }

    /// Reports and skips the text before the opening brace on this line: `plan Main extends Other
    /// {`. Returns whether there is such text.
    pub(in crate::parser) fn nothing_before_brace(&mut self) -> bool {
        let opens = self.ahead_on_line(Kind::OpenBrace);
        let closes = self.ahead_on_line(Kind::CloseBrace);
        let Some(tokens) = opens.filter(|open| closes.is_none_or(|close| close > *open)) else {
            return false;
        };
        let is_port = (0..tokens).any(|at| matches!(self.nth(at), Kind::Equal | Kind::FatArrow));
        if self.at(Kind::OpenParen) || !self.on_same_line() {
            return false;
        }
        let is_habit = self.habit(HEAD);
        if is_port && !is_habit {
            return false;
        }
        if !is_habit {
            let message = message!("unexpected '{}' before '{{'", self.text_of(0, tokens));
            self.instead(tokens, message, "remove it", "");
        }
        true
    }

    /// `supervise t: every 5 ms CheckTouchSensor`: reports times before a template, and reads them.
    pub(in crate::parser) fn times_before_template(&mut self, watches: bool) {
        let mut tokens = 0;
        while matches!(self.word(tokens), "every" | "deadline")
            && matches!(self.nth(tokens + 1), Kind::Int | Kind::Float)
        {
            tokens += 2 + usize::from(self.nth(tokens + 2) == Kind::Unit);
        }
        if tokens == 0 || !self.on_same_line() {
            return;
        }
        let (times, word) = (self.text_of(0, tokens), self.word(0));
        let template =
            Some(self.word(tokens)).filter(|name| !name.is_empty() && !self.begins_line(tokens));
        let named = template.filter(|_| self.nth(tokens + 1) == Kind::OpenBrace);
        let error = match (watches, named) {
            (false, _) => {
                let message = message!("only supervisors have '{}'", word);
                Diagnostic::new(Code::E0102, self.ahead(tokens), message)
                    .help("remove it")
                    .replace("")
            }
            (true, Some(template)) => {
                let better = format!("{template} {times}");
                let place = self.ahead(tokens + 1);
                let error = Diagnostic::new(
                    Code::E0102,
                    place,
                    message!("'{}' belongs after the template", word),
                );
                error.write(better)
            }
            (true, None) => {
                let message = message!("'{}' belongs after the template", word);
                let help =
                    message!("write the template, its ports in brackets, and then '{}'", times);
                Diagnostic::new(Code::E0102, self.ahead(tokens), message).help(help)
            }
        };
        self.error(error);
        while self.at_timing() {
            self.timing();
        }
    }

    /// Reports and skips a frequency after a substitute for 'every': `rate 100 Hz`. Returns whether
    /// there is one.
    fn frequency_for_a_period(&mut self) -> bool {
        let factor = match self.token(2).map_or("", |unit| unit.text) {
            "Hz" => 1.0,
            "kHz" => 1000.0,
            _ => return false,
        };
        let number = self.token(1).and_then(|number| number.text.parse::<f64>().ok());
        let Some(hertz) = number.filter(|hertz| *hertz > 0.0) else { return false };
        let message = "a supervisor has a period, not a frequency";
        let error = Diagnostic::new(Code::E0102, self.ahead(3), message);
        let ms = 1000.0 / (hertz * factor);
        let period = if ms < 1.0 { format!("{} us", ms * 1000.0) } else { format!("{ms} ms") };
        self.error(error.write(format!("every {period}")));
        self.pass(3);
        true
    }

    /// `every 5 ms * 2`: reports and skips a formula after a time.
    pub(in crate::parser) fn no_formula_of_a_time(&mut self) {
        use Kind::{CloseBrace, Minus, OpenBrace, OpenParen, Percent, Plus, Slash, Star};
        if !matches!(self.nth(0), Plus | Minus | Star | Slash | Percent) || !self.on_same_line() {
            return;
        }
        let (here, first) = (self.next_span(), self.at);
        let error = Diagnostic::new(Code::E0102, here, "a time here cannot be a formula");
        self.error(error.help("write one time such as '10 ms', or name a constant that has it"));
        self.pass_to(|p| {
            let ends = matches!(p.nth(0), OpenBrace | CloseBrace | OpenParen) || p.at_end();
            ends || p.at > first && (!p.on_same_line() || p.at_timing())
        });
        while self.at_timing() {
            self.timing();
        }
    }

    /// `CheckTimeout every 5 ms (duration = 3 s)`: reports and reads ports after the times of a
    /// supervisor.
    pub(in crate::parser) fn ports_behind_times(&mut self) {
        if !self.at(Kind::OpenParen) || !self.on_same_line() {
            return;
        }
        let here = self.next_span();
        let error = Diagnostic::new(Code::E0102, here, "ports come before the times");
        self.error(
            error.help("write them in brackets after the template, before 'every' and 'deadline'"),
        );
        self.args(true);
        while self.at_timing() {
            self.timing();
        }
    }

    /// Reports a word, and reads it as the intended word: `within 50 ms`, `evry 50 ms`. Returns
    /// whether it did.
    pub(in crate::parser) fn time_by_another_word(&mut self) -> bool {
        let before_time = matches!(self.nth(1), Kind::Int | Kind::Float) && self.on_same_line();
        if before_time && self.frequency_for_a_period() {
            return false;
        }
        before_time && self.item_meant("'every' or 'deadline'", &["every", "deadline"])
    }
}
