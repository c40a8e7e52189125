//! Tables of constants: columns with types, rows in brackets.

use super::Parser;
use crate::diagnostics::{Code, Diagnostic};
use crate::kind::Kind;
use crate::message;

const COLUMNS_HELP: &str = "name the columns in brackets, such as '(x: length, y: length)'";
const ROW_HELP: &str = "write a row such as '(1 m, 2 m)'";

impl Parser<'_, '_> {
    /// `"table" NAME "(" columns ")" "{" {row [","]} "}"`
    pub(super) fn table(&mut self) {
        self.open_item(Kind::Table);
        self.keyword();
        self.name("give the table a name");
        if self.at(Kind::OpenParen) {
            self.columns();
        } else {
            self.expected("'('", COLUMNS_HELP);
        }
        let body = self.open_body("put the rows in braces", Self::at_row);
        if let Some(body) = body {
            while !self.ends_rows() {
                self.repeat(|parser| match parser.at_row() {
                    true => parser.row(),
                    false => parser.skip("a row", ROW_HELP, |p| p.at_row() || p.ends_rows()),
                });
            }
            self.close_body(body);
        }
        self.close_item();
    }

    /// `"(" {NAME ":" type [","]} ")"`
    fn columns(&mut self) {
        self.open(Kind::Columns);
        let opened = self.here();
        self.bump();
        while !self.ends_cells() {
            self.repeat(|parser| {
                if parser.at(Kind::Name) {
                    parser.open_item(Kind::Column);
                    parser.port(COLUMNS_HELP);
                    parser.no_range_of_a_column();
                    parser.close_item();
                } else {
                    parser.skip("a column", COLUMNS_HELP, |p| {
                        p.ends_cells() || p.at(Kind::Name) && p.nth(1) == Kind::Colon
                    });
                }
            });
        }
        self.close_bracket(Kind::CloseParen, opened);
        self.close();
    }

    /// `way: length from 0 m to 1 m`: reports and skips the range.
    fn no_range_of_a_column(&mut self) {
        if self.word(0) != "from" || !self.nth(1).begins_formula() {
            return;
        }
        let here = self.next_span();
        let error = Diagnostic::new(Code::E0102, here, "a column has no range");
        self.error(error.help("remove the text from 'from' to the next column"));
        self.open(Kind::Error);
        self.range();
        self.close();
    }

    /// Whether a row begins here; brackets of other languages count too.
    fn at_row(&self) -> bool {
        matches!(self.nth(0), Kind::OpenParen | Kind::OpenBracket)
    }

    fn ends_rows(&self) -> bool {
        self.at_end() || self.at(Kind::CloseBrace) || self.leaves_body()
    }

    /// `"(" formula {"," formula} ")"`
    fn row(&mut self) {
        self.open_item(Kind::Row);
        let opened = self.next_span();
        let is_list = self.at(Kind::OpenBracket);
        if is_list {
            let here = self.next_span();
            self.error(
                Diagnostic::new(Code::E0102, here, "expected '(', found '['")
                    .help("write '(' and ')' around the values of a row"),
            );
        }
        self.bump();
        let mut separated = true;
        while !self.ends_cells() && (separated || !self.at_row()) {
            if !separated {
                self.no_comma();
            }
            self.open_item(Kind::Cell);
            self.repeat(|parser| {
                parser.with_commas(true, |parser| {
                    parser.formula();
                    parser.no_operators();
                });
            });
            separated = self.at(Kind::Comma);
            self.close_item();
        }
        if !(is_list && self.eat(Kind::CloseBracket)) {
            self.close_bracket(Kind::CloseParen, opened);
        }
        self.close_item();
    }

    fn no_comma(&mut self) {
        if self.at(Kind::Name) && self.word(0) == self.word_before() {
            let message = message!("{} is repeated", self.found());
            return self.instead(1, message, "remove one of them", "");
        }
        let behind = self.behind();
        let error = self.instead_of(behind, "','");
        self.error(error.help("write ',' between the values of a row").fix(behind, ","));
    }

    fn ends_cells(&self) -> bool {
        use Kind::{CloseBrace, CloseBracket, CloseParen, End, OpenBrace};
        matches!(self.nth(0), End | CloseParen | CloseBracket | OpenBrace | CloseBrace)
            || self.leaves_body()
    }
}
