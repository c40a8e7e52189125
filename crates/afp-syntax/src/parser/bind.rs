//! Bindings: the inputs and outputs of a component.

use super::Parser;
use crate::diagnostics::{Code, Diagnostic, Message, Subject};
use crate::kind::Kind;
use crate::message;
use crate::units::Unit;

impl Parser<'_, '_> {
    /// `"(" {bind [","]} ")"`. Scenarios have no short bindings, because their values are written
    /// out.
    pub(super) fn args(&mut self, alone: bool) {
        self.open(Kind::Args);
        let opened = self.here();
        self.bump();
        while !self.ends_args() {
            self.repeat(|parser| {
                if parser.at(Kind::Name) && parser.at_sign_of_bind() {
                    parser.bind();
                } else if parser.value_without_sign() || parser.points_at_the_end() {
                } else if alone && parser.stands_alone() {
                    parser.bind_alone();
                } else {
                    parser.unnamed_bind();
                }
            });
        }
        self.close_bracket(Kind::CloseParen, opened);
        self.close();
    }

    /// Whether `=` or `=>`, or a substitute for one, follows the next token.
    pub(super) fn at_sign_of_bind(&self) -> bool {
        let is_output =
            matches!(self.nth(1), Kind::GreaterEqual | Kind::Greater) && self.nth(2) == Kind::Name;
        let is_output = is_output && matches!(self.nth(3), Kind::Comma | Kind::CloseParen);
        self.names_something(0) || self.nth(1) == Kind::EqualEqual || is_output || self.changes()
    }

    /// `value += 1`
    pub(super) fn changes(&self) -> bool {
        let is_sign = matches!(self.nth(1), Kind::Plus | Kind::Minus | Kind::Star | Kind::Slash);
        is_sign && self.nth(2) == Kind::Equal
    }

    fn ends_args(&self) -> bool {
        matches!(self.nth(0), Kind::End | Kind::CloseParen | Kind::OpenBrace | Kind::CloseBrace)
            || self.leaves_body()
            // An edge on its own line; its arrow is not a wrong '=>'.
            || (!self.on_same_line() && self.at(Kind::Name) && self.nth(1) == Kind::Arrow)
            || (!self.on_same_line() && self.at_line() && !self.names_something(0))
            || (self.word(0) == "supervise"
                && self.nth(1) == Kind::Name
                && self.nth(2) == Kind::Colon)
    }

    /// Whether commas surround the next name. Otherwise a value next to it on its line
    /// may lack its `=` or its sign.
    fn stands_alone(&self) -> bool {
        self.at(Kind::Name)
            && !self.follows_value()
            && match self.nth(1) {
                Kind::Comma | Kind::CloseParen | Kind::OpenBrace | Kind::CloseBrace | Kind::End => {
                    true
                }
                Kind::Name => self.begins_line(1) || self.names_something(1),
                _ => false,
            }
    }

    /// `goal` for `goal = goal`, or for `goal => goal`.
    fn bind_alone(&mut self) {
        self.open_item(Kind::BindSame);
        self.reference();
        self.close_item();
    }

    pub(super) fn bind(&mut self) {
        let is_value = self.nth(1) == Kind::Arrow && self.nth(2) != Kind::Name;
        let is_output = matches!(
            self.nth(1),
            Kind::FatArrow | Kind::Arrow | Kind::GreaterEqual | Kind::Greater
        ) && !is_value;
        let changes = self.changes();
        self.open_item(if is_output { Kind::BindOut } else { Kind::BindIn });
        self.take_name();
        if !is_output {
            self.no_type_before_value();
            if self.at(Kind::Equal) {
                self.bump();
            } else if changes {
                let sign = self.token(0).map_or("", |token| token.text);
                let message = message!("unexpected '{}=' between a port and its value", sign);
                let help = message!("write '=' and a formula, such as 'x {} 1'", sign);
                self.error(Diagnostic::new(Code::E0108, self.ahead(2), message).help(help));
                self.pass(2);
            } else {
                let assigns = self.at(Kind::Colon) && self.nth(1) == Kind::Equal;
                let message = "'=' passes a value to an input";
                match assigns && self.may_take_value(2) {
                    true => {
                        let error = Diagnostic::new(Code::E0108, self.ahead(2), message);
                        self.error(error.help("write '=>' for an output, '=' for an input"));
                        self.pass(2);
                    }
                    false => self.wrong_arrow(1 + usize::from(assigns), message, "="),
                }
            }
            let value = self.at;
            self.formula();
            self.no_second_quantity(value);
            self.no_operators();
            self.close_item();
            return;
        }
        if !self.eat(Kind::FatArrow) {
            let message = "'=>' writes an output to an entry; '->' leads to the next element";
            self.wrong_arrow(1, message, "=>");
        }
        // A formula here is reported where outputs are checked.
        self.open(Kind::Target);
        let computes = matches!(
            self.nth(1),
            Kind::Plus | Kind::Minus | Kind::Star | Kind::Slash | Kind::Percent | Kind::Dot
        );
        if self.at(Kind::Name) && (!computes || self.has_hyphens_in_use()) {
            self.name("name the entry that takes the value");
        } else {
            self.formula();
        }
        self.close();
        self.close_item();
    }

    /// Whether a name ahead is a writable entry and ends a binding.
    fn may_take_value(&self, ahead: usize) -> bool {
        let ends = matches!(self.nth(ahead + 1), Kind::Comma | Kind::CloseParen);
        ends && matches!(self.known().entries.get(self.word(ahead)), Some(&("var" | "out")))
    }

    /// `distance: length = 3 m`: the toolbox has the type of a port.
    fn no_type_before_value(&mut self) {
        let is_type = self.at(Kind::Colon) && self.nth(1) == Kind::Name;
        if is_type && self.nth(2) == Kind::Equal && self.on_same_line() && !self.begins_line(1) {
            let message = "the port already has a type";
            self.instead(2, message, "remove the ':' and the type", "");
        }
    }

    /// Whether the next token is on the same line, without a bracket or comma before it.
    fn follows_value(&self) -> bool {
        let before = self.before();
        before.is_some_and(|token| {
            !matches!(token.kind, Kind::OpenParen | Kind::Comma) && self.on_same_line()
        })
    }

    /// The missing part of a binding.
    fn bind_help(&self) -> (&'static str, Message) {
        let is_value =
            matches!(self.nth(1), Kind::Int | Kind::Float | Kind::Text | Kind::OpenParen)
                || self.nth(1).is_comparison();
        let is_arrow = matches!(self.nth(0), Kind::FatArrow | Kind::Arrow);
        match self.word(0) {
            _ if self.follows_value() && is_arrow && self.nth(1) != Kind::Name => {
                ("',' or ')' after a value", "remove it".into())
            }
            _ if self.follows_value() && self.at(Kind::Dot) => {
                ("',' or ')' after a value", "remove it".into())
            }
            unit if self.follows_value() && Unit::parse(unit).is_some() => {
                ("',' or ')' after a value", "remove it: a unit only follows a number".into())
            }
            _ if self.follows_value() => {
                let help = "write ',' and a port before it, or a sign such as '*'";
                ("',' or ')' after a value", help.into())
            }
            port if !port.is_empty() && is_value => {
                ("a port and '='", message!("write '{} = ' and the value", port))
            }
            _ => ("a port", "write the port's name and '=' before the value".into()),
        }
    }

    /// A value without a port, or text that is not a binding.
    fn unnamed_bind(&mut self) {
        let (what, help) = self.bind_help();
        let is_value = what == "a port"
            && !self.at(Kind::Name)
            && (self.nth(0).begins_formula() || self.at(Kind::Text));
        match is_value {
            true => self.missing(self.next_span(), what, help, Subject::Value),
            false => self.report_skipped(what, help, None),
        }
        self.pass_to(|p| {
            p.ends_args()
                || p.at(Kind::Comma)
                || (p.at(Kind::Name)
                    && matches!(p.nth(1), Kind::Equal | Kind::FatArrow | Kind::Arrow))
        });
        self.eat(Kind::Comma);
    }
}
