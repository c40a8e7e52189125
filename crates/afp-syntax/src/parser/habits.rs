//! Text as in other languages: its replacement, and the place where parsing continues.

mod behind;
mod bodies;
mod edges;
mod heads;
mod items;
mod lines;
mod names;
mod numbers;
mod values;

use super::Parser;
use crate::diagnostics::{Code, Diagnostic, Message, Subject, Words};
use crate::dimension::Dimension;
use crate::habits::{ENDS, ours};
use crate::kind::Kind;
use crate::lexer::Token;
use crate::message;
use crate::source::Span;
use numbers::hundredth;

/// Words that are written where a `->` belongs.
const ARROW_WORDS: &[&str] = &["goto", "to", "then", "next"];

/// `forward` for `Forward`.
fn with_small_first(name: &str) -> String {
    let (first, rest) = name.split_at_checked(1).unwrap_or((name, ""));
    first.to_ascii_lowercase() + rest
}

/// Whether other languages use the word between operands.
pub(super) fn is_operator(word: &str) -> bool {
    matches!(word, "and" | "or" | "xor" | "is" | "if" | "mod" | "div" | "in")
}

fn is_type(word: &str) -> bool {
    matches!(word, "int" | "bool" | "float" | "string") || Dimension::named(word).is_some()
}

impl Parser<'_, '_> {
    /// `start -> go`, `start: go`
    pub(super) fn no_sign_behind_start(&mut self) {
        if matches!(self.nth(0), Kind::Arrow | Kind::FatArrow | Kind::Equal | Kind::Colon) {
            let message = message!("unexpected {} after 'start'", self.found());
            let element = Some(self.word(1)).filter(|word| !word.is_empty()).unwrap_or("NAME");
            self.instead(1, message, message!("write 'start {}'", element), "");
        }
    }

    /// `start go, turn`
    pub(super) fn one_start(&mut self) {
        let more = (0..).step_by(2).take_while(|at| {
            matches!(self.nth(*at), Kind::Comma | Kind::Arrow)
                && self.nth(at + 1) == Kind::Name
                && !self.begins_line(at + 1)
                && (matches!(self.nth(at + 2), Kind::Comma | Kind::Arrow | Kind::CloseBrace)
                    || self.begins_line(at + 2))
        });
        let more = 2 * more.count();
        if more > 0 && self.on_same_line() {
            self.instead(more, "a plan starts with a single element", "remove what follows", "");
        }
    }

    /// `Done -> goto turn`
    pub(super) fn no_word_before_target(&mut self) {
        let ends = self.begins_line(2) || matches!(self.nth(2), Kind::CloseBrace | Kind::End);
        let between = self.token_index(0) + 1..self.token_index(1);
        let is_foreign =
            self.tokens.get(between).unwrap_or_default().iter().any(|it| it.kind == Kind::Unknown);
        let is_pair = self.nth(1) == Kind::Name && !self.begins_line(1) && ends && !is_foreign;
        if is_pair && let Some(ending) = ours(ENDS, self.word(0)) {
            let error = Diagnostic::new(Code::E0102, self.ahead(2), "an edge leads to one element");
            self.error(error.write(ending));
            self.pass(1);
        } else if self.at_arrow_word() && !self.edge_at(1) || is_pair && self.is_small_pair() {
            let message = message!("unexpected {} before a target", self.found());
            self.instead(1, message, "remove it", "");
        }
    }

    /// Whether two lower-case words follow that are not keywords.
    fn is_small_pair(&self) -> bool {
        let is_small = |word: &str| word.starts_with(|first: char| first.is_ascii_lowercase());
        let is_free = |word: &str| {
            is_small(word)
                && !matches!(
                    word,
                    "and" | "or" | "terminate" | "fail" | "ignore" | "resume" | "suspend"
                )
        };
        is_free(self.word(0)) && is_small(self.word(1)) && !self.begins_item()
    }

    /// The ':' before a template, or a substitute for it.
    pub(super) fn colon_of_head(&mut self) -> bool {
        let swapped =
            self.at(Kind::Name) && matches!(self.nth(1), Kind::OpenBrace | Kind::OpenParen);
        let (template, name) = (self.word_before(), self.word(0));
        let looks = |word: &str, upper: bool| {
            word.starts_with(|first: char| {
                first.is_ascii_alphabetic() && first.is_uppercase() == upper
            })
        };
        if self.at(Kind::Equal) && self.nth(1) == Kind::Name {
            self.instead(1, "unexpected '=' before a template", "write ':'", ":");
            return true;
        }
        if swapped && looks(template, true) && looks(name, false) {
            let help = message!("write the name first: '{}: {}'", name, template);
            self.expected("':'", help);
            return false;
        }
        let is_template = matches!(self.nth(1), Kind::OpenBrace | Kind::OpenParen | Kind::Arrow);
        if is_template && looks(name, true) && self.on_same_line() {
            let here = self.behind();
            let error = Diagnostic::new(Code::E0102, here, "missing ':' before a template");
            self.error(error.help("write ':'").fix(here, ":"));
            return true;
        }
        self.expect(Kind::Colon, "write ':' and the template")
    }

    /// Reports a missing name before a template, as in `actor Forward(...)`. Returns whether it
    /// did.
    pub(super) fn template_without_name(&mut self) -> bool {
        let template = self.word(0);
        let is_large = template.starts_with(|first: char| first.is_ascii_uppercase());
        let is_nameless = is_large
            && matches!(self.nth(1), Kind::OpenParen | Kind::OpenBrace)
            && self.on_same_line();
        if is_nameless {
            let (here, word) = (self.next_span().before(), self.word_before());
            let name = with_small_first(template);
            let error =
                Diagnostic::new(Code::E0102, here, message!("missing name after '{}'", word));
            let error = error.help(message!("write '{} {}: {}'", word, name, template));
            self.error(error.about(Subject::MissingName).fix(here, format!("{name}: ")));
        }
        is_nameless
    }

    /// The type of an entry.
    pub(super) fn ty_of_entry(&mut self) {
        let next = self.at_plan_item() || self.at_word("from");
        let begins = next || self.names_something(0) && self.nth(1) != Kind::Equal;
        if self.eat(Kind::Colon) {
            if !self.type_of_a_type() {
                self.ty();
            }
        } else if self.at(Kind::Name) && self.on_same_line() && !begins {
            let (before, word) = (self.word_before(), self.word(0));
            let is_swapped = is_type(before) && !is_type(word);
            let message = "missing ':' before the type";
            let here = self.here().before();
            let error = Diagnostic::new(Code::E0102, here, message);
            match is_swapped {
                true => self.error(error.help(message!("write '{}: {}'", word, before))),
                false => self.error(error.help("write ':'").fix(here, ": ")),
            }
            self.ty();
        }
    }

    /// Reports times of a component that has none.
    pub(super) fn no_timing(&mut self) {
        while self.at_timing() {
            let (here, word) = (self.next_span(), self.word(0));
            let message = message!("only supervisors have '{}'", word);
            let help = "remove it, or write it after the template of a supervisor";
            self.error(Diagnostic::new(Code::E0102, here, message).help(help));
            self.open(Kind::Error);
            self.timing();
            self.close();
        }
    }

    /// Whether the next line can only begin with the target; reports it.
    pub(super) fn target_of_another_line(&mut self) -> bool {
        let ends = matches!(self.nth(1), Kind::CloseBrace) || self.begins_line(1);
        let is_target = ends && !self.names_something(0) && !self.begins_item();
        if is_target && !self.at_word("supervise") {
            let (here, target) = (self.behind(), self.word(0));
            let message = "no target on the line of its '->'";
            let help = message!("write '{}' after the '->'", target);
            self.error(Diagnostic::new(Code::E0109, here, message).help(help));
            // The rest of that line belongs to the target.
            return true;
        }
        false
    }

    /// The number of tokens of an arrow of an edge, or of its substitute.
    pub(super) fn arrow_at(&self, ahead: usize) -> Option<usize> {
        let same_line = |many: usize| (1..=many).all(|more| !self.begins_line(ahead + more));
        match (self.nth(ahead), self.nth(ahead + 1), self.nth(ahead + 2)) {
            (Kind::Minus, Kind::Minus, Kind::Arrow) => Some(3),
            (Kind::Greater, Kind::Greater, Kind::Name) if same_line(2) => Some(2),
            (Kind::Minus | Kind::Equal, Kind::Greater | Kind::Arrow | Kind::FatArrow, _) => Some(2),
            (Kind::Arrow | Kind::FatArrow | Kind::Equal, ..) => Some(1),
            (Kind::Minus | Kind::Greater, Kind::Name, _) if same_line(1) => Some(1),
            (Kind::Colon, Kind::Name, Kind::CloseBrace | Kind::Comma | Kind::End)
                if same_line(1) =>
            {
                Some(1)
            }
            (Kind::Colon, Kind::Name, Kind::Name) if same_line(1) && !same_line(2) => Some(1),
            _ => None,
        }
    }

    /// `math.sqrt(x)`
    pub(super) fn at_function_of_a_library(&self) -> bool {
        let kinds = (self.nth(1), self.nth(2), self.nth(3));
        let called = kinds == (Kind::Dot, Kind::Name, Kind::OpenParen);
        called && !(1..=3).any(|ahead| self.begins_line(ahead))
    }

    /// Reports and skips the sign between two names, as in `Side::left`.
    pub(super) fn double_colon(&mut self) -> bool {
        let stands = self.at(Kind::Colon) && self.nth(1) == Kind::Colon && self.is_adjacent();
        let named = self.nth(2) == Kind::Name && !self.begins_line(2);
        if stands && named {
            self.instead(2, "unexpected '::' between two names", "write '.'", ".");
        }
        stands && named
    }

    /// Whether the next word is a substitute for an arrow.
    pub(super) fn at_arrow_word(&self) -> bool {
        ARROW_WORDS.contains(&self.word(0)) && self.nth(1) == Kind::Name && !self.begins_line(1)
    }

    /// Reports and skips signs of other languages after an operand.
    pub(super) fn no_operators(&mut self) {
        while !self.habit_of_operator()
            && let Some(help) = self.operator_help()
        {
            let (here, message) = (self.next_span(), message!("formulas have no {}", self.found()));
            self.error(Diagnostic::new(Code::E0102, here, message).help(help));
            self.open(Kind::Error);
            self.bump();
            self.formula();
            self.close();
        }
    }

    /// The replacement of an operator that formulas do not have.
    fn operator_help(&self) -> Option<&'static str> {
        match self.word(0) {
            _ if self.at(Kind::Caret) => Some("write a product, such as 'x * x'"),
            "mod" if self.on_same_line() => Some("write '%'"),
            "div" if self.on_same_line() => Some("write '/'"),
            _ => None,
        }
    }

    /// `not x`, `x ** 2`, `i++`: reports and skips the text before or instead of an operand.
    /// Returns whether the operand follows.
    pub(super) fn no_prefix(&mut self) -> Option<bool> {
        let before = self.before();
        let doubled = self.is_adjacent() && before.is_some_and(|token| token.kind == self.nth(0));
        match self.nth(0) {
            Kind::Star if doubled => {
                let here = self.next_span();
                let error = Diagnostic::new(Code::E0102, here, "formulas have no '**'");
                self.error(self.with_product(error));
                self.pass(1);
                Some(true)
            }
            Kind::Plus
                if doubled
                    && matches!(
                        self.nth(1),
                        Kind::Comma | Kind::CloseParen | Kind::CloseBrace | Kind::End
                    ) =>
            {
                self.instead(1, "formulas have no '++'", "write '+ 1'", " 1");
                Some(false)
            }
            _ => None,
        }
    }

    /// `(value = n // 2)`: the place of the slashes, if the closing bracket is in their comment.
    pub(super) fn divided_by_a_comment(&self) -> Option<Span> {
        let before = self.at.checked_sub(1).and_then(|at| self.solid.get(at)).copied()? as usize;
        let between = self.tokens.get(before + 1..self.token_index(0))?;
        let comment = between.iter().find(|token| token.kind != Kind::Whitespace)?;
        let divisor = comment.text.strip_prefix("//")?.trim_start();
        let is_number = divisor.starts_with(|first: char| first.is_ascii_digit());
        let behind_value = matches!(
            self.tokens.get(before)?.kind,
            Kind::Name | Kind::Int | Kind::Float | Kind::Unit | Kind::CloseParen
        );
        let same_line = between.first().is_none_or(|first| !first.ends_line());
        let divides = is_number && behind_value && same_line && divisor.contains(')');
        divides.then(|| Span { end: comment.start + 2, ..self.span_of(*comment) })
    }

    /// `50 %`: reports and skips a '%' after a number without a divisor.
    pub(super) fn percent(&mut self) -> bool {
        let before = self.before();
        let number = before.filter(|token| matches!(token.kind, Kind::Int | Kind::Float));
        let (Some(number), true) = (number, self.at(Kind::Percent) && self.on_same_line()) else {
            return false;
        };
        // The next token is not an operand.
        self.at += 1;
        let is_item = !self.on_same_line() && (self.begins_item() || self.begins_scenario_line());
        let ends = is_item || self.names_something(0) || self.at_word_of_grammar();
        let ends = ends || !self.nth(0).begins_formula() && !self.at(Kind::Text);
        self.at -= 1;
        if !ends {
            return false;
        }
        let better = hundredth(number.text);
        let place = self.span_of(number).to(self.next_span());
        let error = Diagnostic::new(Code::E0102, place, "formulas have no '%'");
        self.error(error.write(better));
        self.pass(1);
        true
    }

    /// The number of tokens of the next number: three with a decimal comma.
    pub(super) fn tokens_of_number(&self) -> usize {
        let adjacent = self.token_index(2) == self.token_index(0) + 2;
        let is_fraction = |token: Token<'_>| token.text.bytes().all(|byte| byte != b'.');
        let kinds = (self.nth(0), self.nth(1), self.nth(2));
        match (kinds, self.token(2)) {
            ((Kind::Int, Kind::Comma, Kind::Int | Kind::Float), Some(fraction))
                if adjacent && is_fraction(fraction) =>
            {
                3
            }
            _ => 1,
        }
    }

    /// `2,5`: reports the comma and takes the whole number, unless commas separate numbers here.
    pub(super) fn decimal_comma(&mut self) -> bool {
        let (Some(whole), Some(comma), Some(fraction)) =
            (self.token(0), self.token(1), self.token(2))
        else {
            return false;
        };
        if self.commas_separate || self.tokens_of_number() == 1 {
            return false;
        }
        let message = "a number has a decimal point, not a comma";
        let help = message!("write '{}.{}'", whole.text, fraction.text);
        let error = Diagnostic::new(Code::E0106, self.span_of(comma), message);
        self.error(error.help(help).replace("."));
        self.bump_together(3, Kind::Float);
        true
    }

    /// Takes a whole number, or reports that one is missing.
    pub(super) fn whole_number(&mut self, help: impl Into<Message>) -> bool {
        let tokens = self.tokens_of_number();
        if tokens == 1 {
            return self.expect(Kind::Int, help);
        }
        let place = self.ahead(tokens);
        let found: String = (0..tokens).filter_map(|at| self.token(at)).map(|it| it.text).collect();
        let message = message!("expected {}", Words(Kind::Int.describe()));
        let error = Diagnostic::new(Code::E0102, place, message);
        self.error(error.found(message!("'{}'", found)).help(help));
        self.bump_together(tokens, Kind::Int);
        true
    }

    /// `1_000`, `0x10`: a number with letters in it, which has been read up to its first letter.
    pub(super) fn number_with_letters(&mut self) -> bool {
        let Some(before) = self.before() else {
            return false;
        };
        let word = self.word(0);
        let is_suffix = matches!(word, "f" | "F" | "L" | "u" | "U" | "f32" | "f64" | "i32" | "u8");
        let better = match word.strip_prefix(['x', 'X']).filter(|_| before.text == "0") {
            _ if is_suffix => Some(before.text.to_owned()),
            Some(digits) => i64::from_str_radix(digits, 16).ok().map(|value| value.to_string()),
            None => {
                let digits = word.replace('_', "");
                let is_number =
                    word.starts_with('_') && digits.bytes().all(|it| it.is_ascii_digit());
                is_number.then(|| format!("{}{digits}", before.text))
            }
        };
        let Some(better) = better.filter(|_| self.is_adjacent()) else { return false };
        let place = self.span_of(before).to(self.next_span());
        self.error(
            Diagnostic::new(Code::E0115, place, message!("unexpected '{}' in a number", word))
                .write(better),
        );
        self.pass(1);
        true
    }

    /// `5.`; in `(value = 5. equals = 3)` the point replaces a comma.
    pub(super) fn number_that_ends_with_a_point(&mut self) {
        if self.at(Kind::Dot) && self.is_adjacent() && !matches!(self.nth(1), Kind::Dot | Kind::Int)
        {
            if self.nth(1) == Kind::Name && self.names_something(1) {
                return self.instead(1, "missing ',' between two values", "write ','", ",");
            }
            let here = self.next_span();
            self.error(
                Diagnostic::new(Code::E0115, here, "expected a digit after '.'")
                    .help(message!("write '{}.0'", self.word_before()))
                    .fix(here.after(), "0"),
            );
            self.pass(1);
        }
    }

    /// Reports and skips tokens that something else should replace.
    pub(super) fn instead(
        &mut self,
        tokens: usize,
        message: impl Into<Message>,
        help: impl Into<Message>,
        ours: &str,
    ) {
        let here = self.ahead(tokens);
        self.error(Diagnostic::new(Code::E0102, here, message).help(help).replace(ours));
        self.pass(tokens);
    }

    /// The place of this number of tokens.
    pub(super) fn ahead(&self, tokens: usize) -> Span {
        let last = self.token(tokens.saturating_sub(1)).map(|last| self.span_of(last));
        let first = self.next_span();
        last.map_or(first, |last| first.to(last))
    }

    /// Skips tokens with a reported error.
    pub(super) fn pass(&mut self, tokens: usize) {
        self.open(Kind::Error);
        (0..tokens).for_each(|_| self.bump());
        self.close();
    }
}
