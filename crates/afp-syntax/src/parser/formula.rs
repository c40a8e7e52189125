//! Formulas, types, references and quantities.
//!
//! Sums and products are flat nodes, so that a long chain of terms makes no deep tree.

use super::habits::is_operator;
use super::{MAX_DEPTH, Parser};
use crate::diagnostics::{Code, Diagnostic, Message, Words, words};
use crate::dimension::Dimension;
use crate::habits;
use crate::keywords::{self, BEHIND_NUMBER};
use crate::kind::Kind;
use crate::message;
use crate::source::Span;
use crate::units::Unit;

impl Parser<'_, '_> {
    /// `term {("+" | "-") term}`
    pub(super) fn formula(&mut self) {
        self.chain(Kind::Sum, &[Kind::Plus, Kind::Minus], |parser| {
            parser.chain(Kind::Product, &[Kind::Star, Kind::Slash, Kind::Percent], Self::unary);
        });
    }

    fn chain(&mut self, kind: Kind, signs: &[Kind], operand: impl Fn(&mut Self)) {
        let start = self.checkpoint();
        operand(self);
        if !signs.contains(&self.nth(0)) {
            return;
        }
        while signs.contains(&self.nth(0)) {
            self.bump();
            operand(self);
        }
        self.wrap(start, kind);
    }

    fn unary(&mut self) {
        if self.depth >= MAX_DEPTH {
            return self.too_deep();
        }
        self.depth += 1;
        if self.habit_of_operand() {
            self.depth -= 1;
            return;
        }
        if let Some(operand) = self.no_prefix() {
            if operand {
                self.unary();
            }
            self.depth -= 1;
            return;
        }
        match self.nth(0) {
            _ if !self.on_same_line() && (self.begins_item() || self.begins_scenario_line()) => {
                self.no_formula()
            }
            Kind::Minus => {
                self.open(Kind::Negation);
                self.bump();
                self.unary();
                self.close();
            }
            Kind::OpenParen => self.brackets(),
            Kind::Int | Kind::Float => self.number(),
            Kind::Text => self.literal(),
            Kind::Name if matches!(self.word(0), "true" | "false") && !self.names_something(0) => {
                self.literal();
            }
            Kind::Name if self.text_with_a_letter() => {}
            Kind::Name if self.at_function_of_a_library() => {
                let function = self.word(2);
                let message = "functions have no library prefix";
                self.instead(2, message, message!("write '{}'", function), "");
                self.call();
            }
            Kind::Name if self.nth(1) == Kind::OpenParen => self.call(),
            // A bound name begins the next item; the operand is missing.
            Kind::Name if !self.names_something(0) || self.nth(1) == Kind::Colon => {
                self.reference()
            }
            Kind::Dot if self.nth(1) == Kind::Int => self.bare_fraction(),
            Kind::Plus => {
                let here = self.here();
                self.error(
                    Diagnostic::new(Code::E0102, here, "a formula does not begin with '+'")
                        .help("remove the '+'")
                        .replace(""),
                );
                self.open(Kind::Error);
                self.bump();
                self.close();
                self.unary();
            }
            _ => self.no_formula(),
        }
        self.depth -= 1;
    }

    fn no_formula(&mut self) {
        self.expected("a formula", "write a number, a quantity, a string or an entry");
    }

    fn literal(&mut self) {
        self.open(Kind::Literal);
        self.bump();
        self.close();
    }

    fn brackets(&mut self) {
        self.open(Kind::Brackets);
        let opened = self.here();
        self.bump();
        self.with_commas(false, |parser| {
            parser.formula();
            parser.no_operators();
        });
        self.close_bracket(Kind::CloseParen, opened);
        self.close();
    }

    /// Reads with or without commas that separate formulas.
    pub(super) fn with_commas(&mut self, separate: bool, rule: impl FnOnce(&mut Self)) {
        let around = std::mem::replace(&mut self.commas_separate, separate);
        rule(self);
        self.commas_separate = around;
    }

    /// `FUNCTION "(" formula {"," formula} ")"`
    fn call(&mut self) {
        self.open(Kind::Call);
        self.bump();
        let opened = self.here();
        self.bump();
        if !self.at(Kind::CloseParen) {
            self.with_commas(true, |parser| {
                parser.formula();
                parser.no_operators();
                while parser.eat(Kind::Comma) {
                    parser.formula();
                    parser.no_operators();
                }
            });
        }
        self.close_bracket(Kind::CloseParen, opened);
        self.close();
    }

    /// A number with its unit, if it has one.
    pub(super) fn number(&mut self) {
        self.open(Kind::Literal);
        if !self.decimal_comma() {
            self.bump();
        }
        self.number_that_ends_with_a_point();
        let is_unit = self.eat(Kind::Unit) || self.unit_of_a_bound();
        if is_unit {
            self.unit_in_words();
        }
        if !is_unit && !self.number_with_letters() && !self.percent() {
            self.unknown_unit();
        }
        self.close();
    }

    /// `1 m 20 cm`: reports the second quantity, and skips it.
    pub(super) fn no_second_quantity(&mut self, first: usize) {
        let is_quantity = |p: &Self, from: usize| {
            matches!(p.nth(from), Kind::Int | Kind::Float) && p.nth(from + 1) == Kind::Unit
        };
        let ends_with_unit = self.before().is_some_and(|token| token.kind == Kind::Unit);
        if self.on_same_line() && ends_with_unit && is_quantity(self, 0) {
            let place = self.place_between(first, self.at + 2);
            let [one, two] = [(first, self.at), (self.at, self.at + 2)];
            let [one, two] = [one, two].map(|(from, end)| self.text_between(from, end));
            let message = "a quantity has one number and one unit";
            self.error(
                Diagnostic::new(Code::E0102, place, message).write(format!("{one} + {two}")),
            );
            self.pass(2);
        }
    }

    /// `30`, and its unit on the next line: reports the line break, and reads the unit.
    fn unit_of_another_line(&mut self) -> bool {
        let word = self.word(0);
        let ends = matches!(self.nth(1), Kind::CloseParen | Kind::Comma | Kind::CloseBrace);
        let is_unit = ends && !self.on_same_line() && Unit::parse(word).is_some();
        if let Some(number) = self.before().filter(|_| is_unit) {
            let place = self.span_of(number).to(self.next_span());
            let error =
                Diagnostic::new(Code::E0236, place, "a unit follows its number on the same line");
            self.error(error.write(format!("{} {word}", number.text)));
            self.bump_as(Kind::Unit);
        }
        is_unit
    }

    /// `12 in`: reports an unknown unit, and skips it.
    fn foreign_unit(&mut self) -> bool {
        let word = self.word(0);
        let name = if self.word(1) == "live" && self.nth(2) == Kind::Name { 2 } else { 1 };
        let begins_item =
            self.nth(name) == Kind::Name && matches!(self.nth(name + 1), Kind::Colon | Kind::Equal);
        let number = self.before().filter(|_| self.on_same_line() && !begins_item);
        let better = number.and_then(|number| habits::converted(number.text, word));
        let (Some(number), Some(better)) = (number, better.filter(|_| !self.names_something(0)))
        else {
            return false;
        };
        let place = self.span_of(number).to(self.next_span());
        let error = Diagnostic::new(Code::E0236, place, message!("'{}' is not a unit", word));
        self.error(error.write(better));
        self.pass(1);
        true
    }

    fn unknown_unit(&mut self) {
        if self.foreign_unit() || self.unit_of_another_line() {
            return;
        }
        let word = self.word(0);
        let strange = !word.is_empty()
            && self.on_same_line()
            && !self.names_something(0)
            && (self.is_adjacent() || !self.at_word_behind_number());
        if !strange {
            return;
        }
        // If it is one, the text after it is wrong.
        if Unit::meant(word).is_some_and(|unit| unit == word) {
            return self.bump_as(Kind::Unit);
        }
        let error = Diagnostic::new(Code::E0236, self.here(), message!("'{}' is not a unit", word));
        if let Some((prefixed, better)) = self.strange_prefix() {
            self.error(error.help(message!("there is no {}: write '{}'", Words(prefixed), better)));
            return self.pass(1);
        }
        let meant = Unit::meant(word).map(str::to_owned);
        self.error(match meant.or_else(|| Unit::power_meant(word)) {
            Some(unit) => error.write(unit),
            None => error.help(
                "use one of the units m cm mm km, deg rad, s ms min h, kg, N, V, K, Hz or a product such as 'cm/s'",
            ),
        });
        self.open(Kind::Error);
        self.bump();
        self.close();
    }

    /// Whether a word of the grammar follows a number, perhaps misspelt, with the text that such a
    /// word needs.
    fn at_word_behind_number(&self) -> bool {
        let word = self.word(0);
        let goes_on = self.nth(1).begins_formula() && !self.begins_line(1);
        let is_slip = goes_on && word.len() > 3 && Unit::meant(word).is_none();
        keywords::has(word, BEHIND_NUMBER)
            || is_operator(word)
            || is_slip && words::nearest(word, keywords::with(BEHIND_NUMBER)).is_some()
    }

    /// Whether a word of the grammar is next, with the text that it needs on its line.
    pub(super) fn at_word_of_grammar(&self) -> bool {
        let goes_on = self.nth(1).begins_formula() && !self.begins_line(1);
        goes_on && keywords::has(self.word(0), BEHIND_NUMBER)
    }

    /// `.5`
    fn bare_fraction(&mut self) {
        let here = self.here();
        let error = Diagnostic::new(Code::E0115, here, "a number begins with a digit");
        self.error(match self.token_index(1) == self.token_index(0) + 1 {
            true => error.help("write '0' before the point").fix(here.before(), "0"),
            false => error.help("write '0' before the point, and its digits directly after it"),
        });
        self.open(Kind::Error);
        self.bump();
        self.number();
        self.close();
    }

    /// Reports the nesting once and reads the remaining brackets flat.
    pub(super) fn too_deep(&mut self) {
        let here = self.here();
        self.error(
            Diagnostic::new(
                Code::E0111,
                here,
                message!("more than {} brackets or signs around this", Words(MAX_DEPTH)),
            )
            .help("compute a part of it in a separate entry"),
        );
        self.open(Kind::Error);
        let mut depth = 0_usize;
        loop {
            match self.nth(0) {
                Kind::OpenParen => depth += 1,
                Kind::CloseParen if depth > 0 => depth -= 1,
                Kind::Minus | Kind::Plus | Kind::Star | Kind::Slash | Kind::Percent => {}
                Kind::Int | Kind::Float | Kind::Unit | Kind::Text | Kind::Dot => {}
                Kind::Name if !self.names_something(0) && (depth > 0 || self.on_same_line()) => {}
                _ => break,
            }
            self.bump();
        }
        self.close();
    }

    /// `NAME ["." NAME]`
    pub(super) fn reference(&mut self) {
        self.open(Kind::Ref);
        // In a formula '-' subtracts.
        let is_word = self.at(Kind::Name) && !self.has_hyphens_in_use();
        match is_word && (self.on_same_line() || !self.begins_item()) {
            true => self.take_word(),
            false => _ = self.name("write a name"),
        }
        let is_sign = matches!(self.nth(1), Kind::Caret | Kind::Star | Kind::Slash);
        if !is_sign && self.eat(Kind::Dot) || self.double_colon() {
            // An item on the next line does not belong to an incomplete reference.
            if self.at(Kind::Name) && (self.on_same_line() || !self.leaves_body()) {
                self.bump();
            } else {
                self.expected_name("write a name after the '.'");
            }
        }
        self.close();
    }

    /// Whether the next name is followed by a claim about a path, so that it does not begin a line
    /// of a scenario.
    fn at_path(&self) -> bool {
        let claims = matches!(self.nth(1), Kind::Dot | Kind::Arrow) || self.nth(1).is_comparison();
        claims || self.word(1) == "active" && !self.begins_line(1)
    }

    /// `NAME {"." NAME}`
    pub(super) fn path(&mut self) {
        self.open(Kind::Path);
        if !self.on_same_line() && self.at_line() && !self.at_path() {
            self.expected_name("write the name of an element or entry");
            return self.close();
        }
        self.name("write the name of an element or entry");
        while self.eat(Kind::Dot) {
            if !self.on_same_line() && self.at_line() {
                self.expected_name("write a name after the '.'");
                break;
            }
            self.name("write a name after the '.'");
        }
        self.close();
    }

    /// `dim {("*" | "/") dim}`
    pub(super) fn ty(&mut self) {
        self.open(Kind::Type);
        self.factor();
        while self.at(Kind::Star) || self.at(Kind::Slash) {
            self.bump();
            self.factor();
        }
        self.close();
    }

    fn factor(&mut self) {
        self.open(Kind::Factor);
        match self.nth(0) {
            Kind::Int => {
                self.whole_number("write a whole number");
            }
            Kind::Name if self.on_same_line() || !self.begins_item() => {
                let first = self.next_span();
                self.reference();
                self.dimension_in_two_words(first);
            }
            _ => self.expected(
                "a type",
                "write a type such as 'length', 'float' or 'length/duration^2'",
            ),
        }
        if self.eat(Kind::Caret) {
            self.eat(Kind::Minus);
            self.whole_number("write a whole number after the '^'");
        }
        self.close();
    }

    /// `angular speed` for `angular_speed`.
    fn dimension_in_two_words(&mut self, first: Span) {
        if !self.at(Kind::Name) || !self.on_same_line() {
            return;
        }
        let name = format!("{}_{}", self.word_before(), self.word(0));
        if Dimension::named(&name).is_none() {
            return;
        }
        let both = Span { end: self.next_span().end, ..first };
        let error = Diagnostic::new(Code::E0102, both, "the name of a dimension is one word");
        self.error(error.write(name));
        self.open(Kind::Error);
        self.bump();
        self.close();
    }

    /// A number with a unit, in the place of a time.
    pub(super) fn quantity(&mut self, help: impl Into<Message>) {
        match self.nth(0) {
            Kind::Int | Kind::Float => self.number(),
            Kind::Minus => {
                self.open(Kind::Negation);
                self.bump();
                match self.nth(0) {
                    Kind::Int | Kind::Float => self.number(),
                    _ => self.expected("a duration", help),
                }
                self.close();
            }
            _ => self.expected("a duration", help),
        }
    }
}
