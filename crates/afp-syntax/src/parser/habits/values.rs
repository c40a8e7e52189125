//! Values with signs and words of other languages: `20 cm per s`, `f"lap {lap}"`, `Side,left`, `x ** 2`.

use crate::diagnostics::{Code, Diagnostic};
use crate::kind::Kind;
use crate::message;
use crate::parser::Parser;
use crate::parser::elsewhere::is_large;
use crate::units::Unit;

impl Parser<'_, '_> {
    /// Reports and skips the word after a unit, and the unit after the word: `20 cm per s`.
    pub(in crate::parser) fn unit_in_words(&mut self) {
        let is_word = matches!(self.word(0), "per" | "pro" | "je" | "par") && self.on_same_line();
        if !is_word || self.begins_line(1) {
            return;
        }
        let behind = Unit::meant(self.word(1));
        let (Some(unit), Some(behind)) = (self.before(), behind) else { return };
        let better = format!("{}/{behind}", unit.text);
        let place = self.span_of(unit).to(self.ahead(2));
        let message = message!("unexpected '{}' in a unit", self.word(0));
        self.error(Diagnostic::new(Code::E0236, place, message).write(better));
        self.pass(2);
    }

    /// `f"lap {lap}"`: reports the letter before a string, and skips both. Returns whether it did.
    pub(in crate::parser) fn text_with_a_letter(&mut self) -> bool {
        let text = self.token(1).filter(|text| text.kind == Kind::Text);
        let is_letter = matches!(self.word(0), "f" | "F" | "r" | "b" | "u" | "L" | "s");
        let adjacent = self.token_index(1) == self.token_index(0) + 1;
        let Some(text) = text.filter(|_| is_letter && adjacent) else { return false };
        let better = match self.word(0) {
            "f" | "F" | "s" => joined(text.text),
            _ => text.text.to_owned(),
        };
        let message = message!("a string has no prefix '{}'", self.word(0));
        let error = Diagnostic::new(Code::E0102, self.ahead(2), message);
        self.error(error.write(better));
        self.pass(2);
        true
    }

    /// Reports the comma after the name of an enum, and skips the value: `= Side,left`.
    pub(in crate::parser) fn comma_for_a_point(&mut self) {
        let ends = self.begins_line(2) || matches!(self.nth(2), Kind::CloseBrace | Kind::End);
        let stands = self.at(Kind::Comma) && self.nth(1) == Kind::Name && !self.begins_line(1);
        if stands && ends && is_large(self.word_before()) {
            let here = self.next_span();
            let error = Diagnostic::new(Code::E0102, here, "a value of an enum follows a '.'");
            self.error(error.help("write '.'").replace("."));
            self.pass(2);
        }
    }

    /// `x ** 2`, after the first sign: the error with the product.
    pub(in crate::parser) fn with_product(&self, error: Diagnostic) -> Diagnostic {
        let base = self.at.checked_sub(2).map(|at| self.text_between(at, at + 1));
        match (self.token(1), base) {
            (Some(power), Some(base)) if power.text == "2" && !base.is_empty() && base != ")" => {
                let better = format!("{base} * {base}");
                let place = self.place_between(self.at - 2, self.at).to(self.span_of(power));
                error.help(message!("write '{}'", better)).fix(place, better)
            }
            _ => error.help("write a product, such as 'x * x'"),
        }
    }

    /// `var x: length 3 m`: reports the missing '=' before a value, which is read next.
    pub(in crate::parser) fn no_sign_before_value(&mut self) {
        let is_value = matches!(self.nth(0), Kind::Int | Kind::Float | Kind::Text)
            || matches!(self.word(0), "true" | "false");
        if is_value && self.on_same_line() {
            let here = self.here().before();
            let error = Diagnostic::new(Code::E0102, here, "missing '=' before the value");
            self.error(error.help("write '='").fix(here, "= "));
            self.formula();
        }
    }

    /// Reports a missing '=' before a value, and reads the value: `Forward(distance 30 cm)`.
    /// Returns whether it is missing.
    pub(in crate::parser) fn value_without_sign(&mut self) -> bool {
        let is_number = |at: usize| matches!(self.nth(at), Kind::Int | Kind::Float);
        let is_value = is_number(1)
            || self.nth(1) == Kind::Text
            || self.nth(1) == Kind::Minus && is_number(2)
            || matches!(self.word(1), "true" | "false");
        // In a difference, the sign has spaces on both sides or on neither.
        let is_sign = self.nth(1) != Kind::Minus
            || self.token_index(1) > self.token_index(0) + 1
                && self.token_index(2) == self.token_index(1) + 1;
        let first = matches!(self.before().map(|it| it.kind), Some(Kind::OpenParen | Kind::Comma));
        let stands = first && self.at(Kind::Name) && is_value && is_sign && !self.begins_line(1);
        if stands {
            self.open_item(Kind::BindIn);
            self.take_name();
            let here = self.behind();
            let error = Diagnostic::new(Code::E0102, here, "missing '=' before a value");
            self.error(error.help("write '='").fix(here, " ="));
            self.formula();
            self.no_operators();
            self.close_item();
        }
        stands
    }

    /// Reports the text around a type, and reads the type: `Option<angle>`. Returns whether it did.
    pub(in crate::parser) fn type_of_a_type(&mut self) -> bool {
        let kinds = (self.nth(0), self.nth(1), self.nth(2), self.nth(3));
        let stands = kinds == (Kind::Name, Kind::Less, Kind::Name, Kind::Greater);
        if stands {
            let message = "a type cannot contain another type";
            let error = Diagnostic::new(Code::E0102, self.ahead(4), message);
            self.error(error.write(self.word(2)));
            self.pass(2);
            self.ty();
            self.pass(1);
        }
        stands
    }

    /// Reports and skips the points of a continued line: `(range = 2 m, ...`. Returns whether it
    /// did.
    pub(in crate::parser) fn points_at_the_end(&mut self) -> bool {
        let stands = (0..3).all(|at| self.nth(at) == Kind::Dot) && self.begins_line(3);
        if stands {
            self.instead(3, "a list continues on the next line without '...'", "remove it", "");
        }
        stands
    }

    /// Reports and skips the numbers of values, after the first name: `left = 0, right = 1 }`.
    pub(in crate::parser) fn numbers_of_values(&mut self) {
        if !self.at(Kind::Equal) {
            return;
        }
        let all = (0..64).find(|at| self.nth(*at) == Kind::CloseBrace);
        let Some(all) = all.filter(|_| self.balanced) else { return };
        let is_name = |at: &usize| self.nth(*at) == Kind::Name && self.nth(at - 1) != Kind::Equal;
        let names = (1..all).filter(is_name).map(|at| self.word(at));
        let better = names.fold(self.word_before().to_owned(), |all, name| all + " " + name);
        let Some(first) = self.before() else { return };
        let place = self.span_of(first).to(self.ahead(all));
        let error = Diagnostic::new(Code::E0102, place, "values of an enum have no numbers");
        self.error(error.write(better));
        self.pass(all);
    }
}

/// `"lap " + lap` for the string `"lap {lap}"`.
fn joined(text: &str) -> String {
    let inner = text.trim_matches('"');
    let parts = inner.split(['{', '}']).enumerate().filter(|(_, part)| !part.is_empty());
    let parts = parts.map(|(at, part)| match at % 2 {
        0 => format!("\"{part}\""),
        _ => part.trim().to_owned(),
    });
    let parts: Vec<_> = parts.collect();
    if parts.is_empty() { text.to_owned() } else { parts.join(" + ") }
}
