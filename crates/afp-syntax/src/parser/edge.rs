//! Edges: `State -> target`.

use super::Parser;
use super::elsewhere::is_large;
use crate::diagnostics::{Code, Diagnostic};
use crate::kind::Kind;
use crate::message;

impl Parser<'_, '_> {
    /// `"->" target` for the only state of the element. Returns whether nothing else follows.
    pub(super) fn edge_without_braces(&mut self) -> bool {
        let is_reversed = (self.nth(0), self.nth(1)) == (Kind::Name, Kind::Arrow);
        if is_reversed && self.on_same_line() && self.begins_line(2) {
            let message = "the arrow comes before its target";
            let target = format!("-> {}", self.word(0));
            self.instead(2, message, message!("write '{}'", target), &target);
            return true;
        }
        let is_arrow = match self.arrow_at(0) {
            Some(1) => matches!(self.nth(0), Kind::Arrow | Kind::FatArrow),
            arrow => arrow.is_some(),
        };
        if !is_arrow || !(self.at(Kind::Arrow) || self.on_same_line()) {
            return false;
        }
        if self.nth(2) == Kind::OpenBrace {
            let error =
                Diagnostic::new(Code::E0102, self.ahead(2), "this edge belongs in the braces");
            self.error(error.help(message!("write 'State -> {}' in the braces", self.word(1))));
        }
        self.open_item(Kind::Edge);
        self.end_of_edge();
        while self.on_same_line() && self.at_edge() {
            let error = Diagnostic::new(Code::E0102, self.next_span(), "several edges need braces");
            self.error(error.help("write '{', the edges with their states, and '}'"));
            self.edge();
        }
        !self.at(Kind::OpenBrace)
    }

    /// The number of tokens to the last of the comma-separated names, from the given token on.
    fn last_name(&self, ahead: usize) -> usize {
        let from = self.at + ahead;
        let (first, end) = self.names.get();
        // The result for one of the names holds for the names after it.
        if (first..=end).contains(&from) && (from - first).is_multiple_of(2) {
            return end - self.at;
        }
        let mut last = ahead;
        while self.nth(last) == Kind::Name
            && self.nth(last + 1) == Kind::Comma
            && self.nth(last + 2) == Kind::Name
        {
            last += 2;
        }
        self.names.set((from, self.at + last));
        last
    }

    /// Whether comma-separated names precede an arrow.
    pub(super) fn at_edge(&self) -> bool {
        self.edge_at(0)
    }

    /// The same, from a token ahead.
    pub(super) fn edge_at(&self, ahead: usize) -> bool {
        let last = self.last_name(ahead);
        self.nth(last) == Kind::Name && self.arrow_at(last + 1).is_some()
    }

    /// Whether comma-separated names end a body.
    pub(super) fn at_bare_names(&self) -> bool {
        self.nth(self.last_name(0) + 1) == Kind::CloseBrace
    }

    /// `NAME {"," NAME} "->" target`
    pub(super) fn edge(&mut self) {
        self.open_item(Kind::Edge);
        let whole = self.at_edge() || self.at_bare_names();
        self.event = self.word(0);
        self.take_name();
        while whole && self.eat(Kind::Comma) {
            self.take_name();
        }
        self.end_of_edge();
    }

    /// Names after a wrong sign for a comma, and the end of their edge.
    pub(super) fn rest_of_edge(&mut self) {
        self.take_name();
        self.end_of_edge();
    }

    /// `"->" target`
    fn end_of_edge(&mut self) {
        if !self.arrow() {
            return self.close_item();
        }
        let is_foreign = self.next_written().is_some_and(|at| at < self.token_index(0));
        let is_path = matches!(self.nth(1), Kind::Dot | Kind::Colon)
            && (self.nth(3) == Kind::OpenParen || is_large(self.word(0)));
        let is_called =
            is_foreign || is_path || matches!(self.nth(1), Kind::Name | Kind::OpenParen);
        if self.at(Kind::Name) && is_called && self.habit_of_target() {
            return self.close_item();
        }
        if self.at(Kind::Name) && (self.on_same_line() || self.target_of_another_line()) {
            self.no_word_before_target();
            let brackets = self.no_brackets();
            self.target(brackets);
            self.habit_behind_target();
            self.no_more_targets();
        } else if !self.habit_of_target() && !self.target_in_signs() {
            let here = self.behind();
            self.error(
                Diagnostic::new(Code::E0109, here, "no target on the line of its '->'")
                    .help("name an element of the plan, or write 'terminate'"),
            );
        }
        self.close_item();
    }

    /// Reads the arrow of an edge, or its substitute. Returns whether a target may follow.
    fn arrow(&mut self) -> bool {
        match self.arrow_at(0) {
            Some(1) if self.at(Kind::Arrow) => self.bump(),
            Some(tokens) => {
                let message = "'->' leads from a state or event to its target";
                self.wrong_arrow(tokens, message, "->");
            }
            None if self.at_arrow_word() => {
                let message = "'->' leads from a state or event to its target";
                self.wrong_arrow(1, message, "->");
            }
            // Only the arrow is missing.
            None if self.at(Kind::Name) && self.on_same_line() && !self.names_something(0) => {
                let here = self.here().before();
                self.error(
                    Diagnostic::new(Code::E0109, here, "missing '->' before the target")
                        .help("write '->'")
                        .fix(here, "-> "),
                );
            }
            None => {
                let here = self.behind();
                self.error(
                    Diagnostic::new(Code::E0109, here, "the edge has no target")
                        .help("write '->' and the name of an element, or 'terminate'"),
                );
                return false;
            }
        }
        true
    }

    /// Whether `suspend` and the element that takes over are next.
    fn at_suspend(&self) -> bool {
        let is_pair = self.word(0) == "suspend" && self.nth(1) == Kind::Name;
        is_pair && !self.begins_line(1) && self.arrow_at(2).is_none()
    }

    /// `suspend` without an element: reports it, and takes the word.
    fn suspend_alone(&mut self) -> bool {
        if self.word(0) != "suspend" || self.at_suspend() {
            return false;
        }
        let error = Diagnostic::new(Code::E0109, self.next_span(), "'suspend' names no element");
        self.error(error.help("write 'suspend' and the element that runs meanwhile"));
        self.open(Kind::Target);
        self.keyword();
        self.close();
        true
    }

    /// `NAME`, `"suspend" NAME`, or `"fail" [STRING]`
    fn target(&mut self, brackets: usize) {
        if self.suspend_alone() {
            return self.pass_tokens(brackets);
        }
        self.open(Kind::Target);
        if self.at_suspend() {
            self.keyword();
        }
        let fails = self.word(0) == "fail";
        self.take_name();
        self.pass_tokens(brackets);
        if fails {
            self.reason_without_quotes();
        }
        if fails && self.at(Kind::Text) {
            self.reason_of_another_line();
            self.bump();
        }
        self.close();
        if !fails {
            self.no_text_behind_target();
        }
    }
}
