//! Plans: entries, elements, supervisors, edges and bindings.

use super::Parser;
use crate::diagnostics::{Code, Diagnostic, words};
use crate::kind::Kind;

/// Tokens that are looked at in search of the arrow behind the names of states.
const MAX_NAMES: usize = 128;
/// The words that items of a plan begin with.
const WORDS: &[&str] =
    &["in", "out", "var", "const", "start", "supervise", "actor", "computation", "subplan"];
const ITEMS: &str = "an item of the plan";
const ITEM_HELP: &str =
    "write 'in', 'out', 'var', 'const', 'start', 'supervise', 'actor', 'computation' or 'subplan'";

impl Parser<'_, '_> {
    pub(super) fn plan(&mut self) {
        self.open_item(Kind::Plan);
        self.keyword();
        self.name("give the plan a name");
        self.eat_word("forever");
        let opened = self.here();
        if self.open_body("put the plan's items in braces", Self::at_plan_item) {
            while !self.at_end() && !self.at(Kind::CloseBrace) && !self.at_top_item() {
                self.repeat(|parser| {
                    if parser.at_plan_item() {
                        parser.plan_item();
                    } else {
                        parser.no_plan_item();
                    }
                });
            }
            self.close_bracket(Kind::CloseBrace, opened);
        }
        self.close_item();
    }

    fn at_plan_item(&self) -> bool {
        WORDS.contains(&self.word(0)) && (!self.names_something(0) || self.nth(1) == Kind::Colon)
    }

    /// Passes over what is no item of a plan.
    fn no_plan_item(&mut self) {
        let meant = words::nearest(self.word(0), WORDS.iter().copied());
        let help = match meant.filter(|_| self.nth(1) == Kind::Name) {
            Some(meant) => format!("write '{meant}'"),
            None => ITEM_HELP.to_owned(),
        };
        let is_body = self.begins_body();
        self.skip(ITEMS, &help, |p| p.at_plan_item() || p.at(Kind::CloseBrace) || p.at_top_item());
        // Edges whose element cannot be read have its brace behind them.
        if is_body && self.at(Kind::CloseBrace) && self.nth(1) != Kind::End {
            self.open(Kind::Error);
            self.bump();
            self.close();
        }
    }

    /// Whether an edge begins here, which stands in a body alone: its brace is missing.
    fn begins_body(&self) -> bool {
        self.at(Kind::Name) && self.nth(1) == Kind::Arrow
    }

    pub(super) fn plan_item(&mut self) {
        match self.word(0) {
            "start" => {
                self.open_item(Kind::Start);
                self.keyword();
                if self.on_same_line() {
                    self.name("name the first element");
                } else {
                    self.expected("a name", "name the first element");
                }
                self.close_item();
            }
            "supervise" => self.guard(),
            "actor" | "computation" | "subplan" => self.element(),
            _ => self.entry(),
        }
    }

    fn entry(&mut self) {
        self.open_item(Kind::Entry);
        self.keyword();
        self.name("give the entry a name");
        if self.eat(Kind::Colon) {
            self.ty();
        }
        self.value_and_range();
        self.close_item();
    }

    fn element(&mut self) {
        self.open_item(Kind::Element);
        self.keyword();
        self.head("an actor's template, a computation's or a plan");
        let opened = self.here();
        if self.open_body("put supervisors and edges in braces", Self::begins_body) {
            while !self.at_end() && !self.at(Kind::CloseBrace) && !self.leaves_body() {
                self.repeat(|parser| {
                    if parser.at_word("supervise") {
                        parser.guard();
                    } else {
                        parser.edge_or_skip("a supervisor or an edge");
                    }
                });
            }
            self.close_bracket(Kind::CloseBrace, opened);
        }
        self.close_item();
    }

    fn guard(&mut self) {
        self.open_item(Kind::Guard);
        self.keyword();
        self.head("a supervisor's template");
        while self.at_word("every") || self.at_word("deadline") {
            self.timing();
        }
        let opened = self.here();
        if self.open_body("put the edges of the events in braces", Self::begins_body) {
            while !self.at_end() && !self.at(Kind::CloseBrace) && !self.leaves_body() {
                if self.at_word("supervise") {
                    break;
                }
                self.repeat(|parser| parser.edge_or_skip("an edge"));
            }
            self.close_bracket(Kind::CloseBrace, opened);
        }
        self.close_item();
    }

    /// `NAME ":" ref [args]`
    fn head(&mut self, what: &str) {
        self.name("give it a name");
        if self.expect(Kind::Colon, "write ':' and the template") {
            if self.at(Kind::Name) && self.on_same_line() {
                self.reference();
            } else {
                self.expected(what, "name the template behind the ':'");
            }
        }
        if self.at(Kind::OpenParen) {
            self.args();
        }
    }

    pub(super) fn timing(&mut self) {
        self.open(Kind::Timing);
        self.keyword();
        // A time that is missing has the other word behind it.
        let other = matches!(self.word(0), "every" | "deadline")
            && matches!(self.nth(1), Kind::Int | Kind::Float | Kind::Name);
        if self.at(Kind::Name) && self.on_same_line() && !self.names_something(0) && !other {
            self.reference();
        } else {
            self.quantity("write a time such as '10 ms', or name a constant");
        }
        self.close();
    }

    /// Whether an item begins that no body of an element holds: a `}` is missing.
    pub(super) fn leaves_body(&self) -> bool {
        let element = matches!(self.word(0), "actor" | "computation" | "subplan")
            && self.nth(1) == Kind::Name
            && self.nth(2) == Kind::Colon;
        let entry = matches!(self.word(0), "in" | "out" | "var" | "const")
            && self.nth(1) == Kind::Name
            && matches!(self.nth(2), Kind::Colon | Kind::Equal);
        element || entry || self.at_top_item()
    }

    fn edge_or_skip(&mut self, what: &str) {
        if self.at_edge() {
            return self.edge();
        }
        // The name of a state without an arrow: the edge is still being typed.
        let followed_by_edge = self.nth(1) == Kind::Name && !self.leaves_body();
        if self.at(Kind::Name) && (self.nth(1) == Kind::CloseBrace || followed_by_edge) {
            return self.edge();
        }
        self.skip(what, "write an edge such as 'State -> target'", |p| {
            p.at(Kind::CloseBrace) || p.at_word("supervise") || p.leaves_body() || p.at_edge()
        });
    }

    /// Whether names with commas between them stand before an arrow.
    fn at_edge(&self) -> bool {
        let mut last = 0;
        while last < MAX_NAMES
            && self.nth(last) == Kind::Name
            && self.nth(last + 1) == Kind::Comma
            && self.nth(last + 2) == Kind::Name
        {
            last += 2;
        }
        let named = self.nth(last) == Kind::Name && self.names_something(last);
        named && self.nth(last + 1) != Kind::Colon
    }

    /// `NAME {"," NAME} "->" target`
    fn edge(&mut self) {
        self.open_item(Kind::Edge);
        let whole = self.at_edge();
        self.take_name();
        while whole && self.eat(Kind::Comma) {
            self.take_name();
        }
        match self.nth(0) {
            Kind::Arrow => self.bump(),
            Kind::FatArrow | Kind::Equal => {
                self.wrong_arrow("'->' leads from a state or event to what comes next", "->");
            }
            // The arrow alone is missing.
            Kind::Name if self.on_same_line() && !self.names_something(0) => {
                let here = self.here().before();
                self.error(
                    Diagnostic::new(Code::E0109, here, "no '->' before the target")
                        .help("write '->'")
                        .fix(here, "-> "),
                );
            }
            _ => {
                let here = self.behind();
                self.error(
                    Diagnostic::new(Code::E0109, here, "the edge leads nowhere")
                        .help("write '->' and the name of an element, or 'terminate'"),
                );
                self.close_item();
                return;
            }
        }
        if self.at(Kind::Name) && self.on_same_line() {
            self.target();
        } else {
            let here = self.behind();
            self.error(
                Diagnostic::new(Code::E0109, here, "no target on the line of its '->'")
                    .help("name an element of the plan, or write 'terminate'"),
            );
        }
        self.close_item();
    }

    /// `NAME`, or `"fail" [STRING]`
    fn target(&mut self) {
        self.open(Kind::Target);
        let fails = self.word(0) == "fail";
        self.take_name();
        if fails && self.at(Kind::Text) && self.on_same_line() {
            self.bump();
        }
        self.close();
    }

    fn wrong_arrow(&mut self, message: &str, right: &str) {
        let here = self.here();
        self.error(
            Diagnostic::new(Code::E0108, here, message)
                .help(format!("write '{right}'"))
                .replace(right),
        );
        self.bump();
    }

    /// `"(" {bind [","]} ")"`
    pub(super) fn args(&mut self) {
        self.open(Kind::Args);
        let opened = self.here();
        self.bump();
        while !self.ends_args() {
            self.repeat(|parser| {
                let named = parser.at(Kind::Name) && parser.names_something(0);
                if named && parser.nth(1) != Kind::Colon {
                    parser.bind();
                } else {
                    parser.unnamed_bind();
                }
            });
        }
        self.close_bracket(Kind::CloseParen, opened);
        self.close();
    }

    fn ends_args(&self) -> bool {
        matches!(self.nth(0), Kind::End | Kind::CloseParen | Kind::OpenBrace | Kind::CloseBrace)
            || self.leaves_body()
            // An edge on a line of its own, whose arrow is no mistake for '=>'.
            || (!self.on_same_line() && self.at(Kind::Name) && self.nth(1) == Kind::Arrow)
            || (self.word(0) == "supervise"
                && self.nth(1) == Kind::Name
                && self.nth(2) == Kind::Colon)
    }

    fn bind(&mut self) {
        let kind = if self.nth(1) == Kind::Equal { Kind::BindIn } else { Kind::BindOut };
        self.open_item(kind);
        self.take_name();
        if kind == Kind::BindIn {
            self.bump();
            self.formula();
            self.close_item();
            return;
        }
        if !self.eat(Kind::FatArrow) {
            self.wrong_arrow("'=>' carries data out to an entry; '->' is the flow of action", "=>");
        }
        // A formula here is an error of its own, reported where outputs are checked.
        self.open(Kind::Target);
        if self.at(Kind::Name)
            && !matches!(
                self.nth(1),
                Kind::Plus | Kind::Minus | Kind::Star | Kind::Slash | Kind::Percent | Kind::Dot
            )
        {
            self.name("name the entry that takes the value");
        } else {
            self.formula();
        }
        self.close();
        self.close_item();
    }

    /// A value without a port, or text that is no binding at all.
    fn unnamed_bind(&mut self) {
        self.skip("a port", "name the port, such as 'distance = 30 cm'", |p| {
            p.ends_args()
                || p.at(Kind::Comma)
                || (p.at(Kind::Name)
                    && matches!(p.nth(1), Kind::Equal | Kind::FatArrow | Kind::Arrow))
        });
        self.eat(Kind::Comma);
    }
}
