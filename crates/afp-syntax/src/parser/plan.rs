//! Plans: entries, elements, supervisors and edges.

use super::Parser;
use super::recovery::Body;
use crate::diagnostics::{Code, Diagnostic, Subject};
use crate::habits;
use crate::keywords::{self, ELEMENT, ENTRY, NAMED, PLAN, SUPERVISE, with};
use crate::kind::Kind;
use crate::message;

/// The help for a time after the braces of a supervisor.
const TIME_BEHIND_BODY: &str = "write it after the supervisor's template, before its '{'";
/// The content of an element's body.
pub(super) const BODY: &str = "a supervisor, 'on' or an edge";
const ITEMS: &str = "an item of the plan";
const ITEM_HELP: &str =
    "write 'in', 'out', 'var', 'const', 'start', 'supervise', 'actor', 'computation' or 'subplan'";

impl Parser<'_, '_> {
    pub(super) fn plan(&mut self) {
        self.open_item(Kind::Plan);
        self.plan = self.at;
        self.element = "terminate";
        self.keyword();
        self.word_twice();
        if !self.name_in_two_words() {
            self.name("give the plan a name, such as 'Main'");
        }
        self.eat_meant("forever", |next| next == Kind::OpenBrace);
        let help = match self.nth(0) {
            Kind::OpenParen => self.help_for_parameters(),
            _ => "put the plan's items in braces".into(),
        };
        let body = self.open_body(help, Self::at_plan_item);
        if let Some(body) = body {
            let ends = |parser: &Self| parser.at_end() || parser.at(Kind::CloseBrace);
            while !ends(self) && (!self.at_top_item() || self.is_top_inside(&body)) {
                self.repeat(|parser| {
                    if parser.at_plan_item() {
                        parser.plan_item();
                    } else if parser.at_top_item() {
                        parser.top_inside();
                    } else {
                        parser.no_plan_item();
                    }
                });
            }
            self.close_body(body);
        }
        self.close_item();
    }

    pub(super) fn at_plan_item(&self) -> bool {
        let named = self.names_something(0) && self.nth(1) != Kind::Colon;
        keywords::has(self.word(0), PLAN) && (!named || self.word(0) == "start")
    }

    /// Skips text that is not an item of a plan.
    fn no_plan_item(&mut self) {
        if self.live_before_in() {
            return self.plan_item();
        }
        let heads = with(ELEMENT | SUPERVISE);
        if self.at_head_elsewhere(&heads) && self.item_meant(ITEMS, &heads) {
            return self.plan_item();
        }
        if self.word_before_item(&heads) {
            return self.plan_item();
        }
        if self.habit(habits::PLAN) {
            return;
        }
        let help = match self.item_help() {
            _ if self.at_reactions() => {
                "put it into the braces of the element that reacts so".into()
            }
            Some(help) => help,
            None if self.item_meant(ITEMS, &self.possible_items_of_plan()) => {
                return self.plan_item();
            }
            None if !self.begins_body() && self.word(0).starts_with(|it: char| it.is_ascii()) => {
                return self.foreign_line();
            }
            None => ITEM_HELP.into(),
        };
        let is_body = self.begins_body();
        self.report_skipped(ITEMS, help, None);
        let first = self.at;
        self.pass_to(|p| {
            let next = p.at > first && !p.on_same_line() && p.at_strange_item();
            next || p.at_plan_item() || p.at(Kind::CloseBrace) || p.at_top_item()
        });
        // After edges of an unreadable element comes its brace.
        if is_body && self.at(Kind::CloseBrace) && self.nth(1) != Kind::End {
            self.open(Kind::Error);
            self.bump();
            self.close();
        }
    }

    /// The words that begin items of a plan and are followed by the text here.
    fn possible_items_of_plan(&self) -> Vec<&'static str> {
        keywords::with(match self.nth(2) {
            Kind::Colon => NAMED,
            Kind::Equal => ENTRY,
            _ => PLAN,
        })
    }

    /// Whether a line begins like an item that plans do not have.
    fn at_strange_item(&self) -> bool {
        self.at(Kind::Name) && matches!(self.nth(1), Kind::Name | Kind::Colon | Kind::Equal)
    }

    /// Whether an edge begins outside of a body, because a brace is missing.
    pub(super) fn begins_body(&self) -> bool {
        self.at(Kind::Name) && self.nth(1) == Kind::Arrow
    }

    pub(super) fn plan_item(&mut self) {
        match self.word(0) {
            "start" => {
                self.open_item(Kind::Start);
                self.keyword();
                self.no_sign_behind_start();
                if self.at(Kind::Name) {
                    self.element = self.word(0);
                }
                // The name of an edge or entry belongs to the next item.
                if self.at(Kind::Text) && self.target_in_signs() {
                } else if self.on_same_line() || !self.names_something(0) {
                    self.name("name the first element");
                } else {
                    self.expected_name("name the first element");
                }
                self.one_start();
                self.close_item();
            }
            "supervise" => self.guard(),
            "on" => self.reactions(),
            "actor" | "computation" | "subplan" => self.element(),
            _ => self.entry(),
        }
    }

    fn entry(&mut self) {
        self.open_item(Kind::Entry);
        let input = self.at_word("in");
        self.keyword();
        if input {
            self.eat_meant("live", |next| next == Kind::Name);
        } else {
            self.live_elsewhere();
        }
        let name = self.word(0);
        self.name("give the entry a name");
        let end = self.at;
        self.ty_of_entry();
        let is_typed = self.at != end;
        self.no_sign_before_value();
        if is_typed && self.word_before() == "int" {
            self.int = name;
        }
        self.value_and_range();
        self.comma_for_a_point();
        if !is_typed && self.at != end {
            self.type_behind_value(end);
        }
        self.close_item();
    }

    fn element(&mut self) {
        self.open_item(Kind::Element);
        self.keyword();
        if !self.head("an actor's template, a computation's or a plan", false) {
            return self.close_item();
        }
        self.no_timing();
        if self.edge_without_braces() {
            return self.close_item();
        }
        let body = self.open_body("put supervisors and edges in braces", Self::begins_body);
        let template = self.template;
        if let Some(body) = body {
            while !self.ends_body(&body) {
                self.template = template;
                self.repeat(|parser| {
                    if parser.habit_of_body(habits::BODY)
                        || parser.reaction_without_braces()
                        || parser.reaction_as_edge()
                    {
                        return;
                    }
                    if parser.at_word("supervise") {
                        parser.guard();
                    } else if parser.at_reactions() {
                        parser.reactions();
                    } else if parser.is_nested() {
                        parser.nested();
                    } else {
                        parser.edge_or_skip(BODY);
                    }
                });
            }
            self.close_body(body);
        }
        self.close_item();
    }

    pub(super) fn guard(&mut self) {
        self.open_item(Kind::Guard);
        self.keyword();
        self.head("a supervisor's template", true);
        while self.at_timing() || self.time_by_another_word() {
            self.timing();
            self.no_formula_of_a_time();
        }
        self.ports_behind_times();
        self.events("put the edges of the events in braces");
        self.close_item();
    }

    /// `NAME ":" ref [args]`. Returns whether a body may follow.
    fn head(&mut self, what: &'static str, watches: bool) -> bool {
        self.word_twice();
        self.times_before_template(watches);
        if !watches && self.at(Kind::Name) {
            self.element = self.word(0);
        }
        let is_nameless = self.template_without_name();
        if !is_nameless && !self.name_in_two_words() {
            self.name("give it a name");
        }
        self.times_before_template(watches);
        if is_nameless || self.colon_of_head() {
            self.times_before_template(watches);
            self.word_before_template();
            // The name of an edge or of the next item is not a template.
            let template = !self.names_something(0) && !self.begins_item();
            if !watches && template && self.habit_of_template() {
                return false;
            }
            if self.at(Kind::Name) && (self.on_same_line() || template) {
                self.template_name();
            } else {
                self.expected(what, "name the template after the ':'");
            }
        }
        if self.at(Kind::OpenParen) {
            self.args(true);
        } else {
            self.ports_without_parentheses();
        }
        true
    }

    fn template_name(&mut self) {
        self.template = self.word(0);
        if self.tokens_of_name(0) == 1 {
            return self.reference();
        }
        self.open(Kind::Ref);
        self.take_name();
        self.close();
    }

    pub(super) fn at_timing(&self) -> bool {
        matches!(self.word(0), "every" | "deadline") && self.nth(1) != Kind::Arrow
    }

    /// Whether the body of an element or a supervisor has ended.
    pub(super) fn ends_body(&self, body: &Body) -> bool {
        let leaves = self.leaves_body() && !(body.is_opened() && self.is_nested());
        self.at_end() || self.at(Kind::CloseBrace) || leaves
    }

    pub(super) fn timing(&mut self) {
        self.open(Kind::Timing);
        self.keyword();
        if matches!(self.nth(0), Kind::Colon | Kind::Equal) {
            let message = message!("unexpected {} before a time", self.found());
            self.instead(1, message, "remove it", "");
        }
        // The word of the other time follows a missing time.
        let other = matches!(self.word(0), "every" | "deadline")
            && matches!(self.nth(1), Kind::Int | Kind::Float | Kind::Name);
        let is_name = self.at(Kind::Name) && !self.names_something(0) && !other;
        if is_name && (self.on_same_line() || self.at_time_of_another_line()) {
            self.reference();
        } else {
            self.quantity("write a time such as '10 ms', or name a constant");
        }
        self.close();
    }

    /// Whether a constant on the next line is the time: the text after it fits a time.
    fn at_time_of_another_line(&self) -> bool {
        let goes_on =
            self.nth(1) == Kind::OpenBrace || matches!(self.word(1), "every" | "deadline");
        goes_on && !self.begins_item()
    }

    /// Whether an item begins that a body cannot have: a `}` is missing.
    pub(super) fn leaves_body(&self) -> bool {
        let element = matches!(self.word(0), "actor" | "computation" | "subplan")
            && self.nth(1) == Kind::Name
            && self.nth(2) == Kind::Colon;
        let named = |ahead: usize| {
            let sign = self.nth(ahead + 1);
            self.nth(ahead) == Kind::Name && matches!(sign, Kind::Colon | Kind::Equal)
        };
        let is_live = self.word(0) == "in" && self.word(1) == "live";
        let entry = matches!(self.word(0), "in" | "out" | "var" | "const")
            && (named(1) || is_live && named(2));
        element || entry || self.at_top_item()
    }

    pub(super) fn edge_or_skip(&mut self, what: &'static str) {
        if self.at_word_before_edge() {
            let message = message!("unexpected {} before an edge", self.found());
            let error = Diagnostic::new(Code::E0102, self.ahead(1), message).help("remove it");
            let subject = if what == BODY { Subject::Event } else { Subject::Other };
            self.error(error.replace("").about(subject));
            return self.pass(1);
        }
        if self.port_in_braces() || self.state_in_two_words() {
            return;
        }
        if self.at_edge_with_hyphens() || self.at_edge() {
            return self.edge();
        }
        if self.sign_between_states() || self.strange_item(what) {
            return;
        }
        // Names of states without an arrow: the edge is still being typed.
        let followed_by_edge = self.nth(1) == Kind::Name && !self.leaves_body();
        if self.at(Kind::Name) && (self.at_bare_names() || followed_by_edge) {
            return self.edge();
        }
        if self.nth(1) == Kind::Dot && self.nth(2) == Kind::Name && self.arrow_at(3).is_some() {
            let message = "an edge begins with only the name of its state or event";
            return self.instead(2, message, message!("write '{}'", self.word(2)), "");
        }
        if what == BODY && self.at(Kind::Name) && self.nth(1) == Kind::Colon && self.explains() {
            let message = message!("an element has no '{}'", self.word(0));
            let error = Diagnostic::new(Code::E0102, self.next_span(), message).help("remove it");
            return self.foreign_block(error.replace(""));
        }
        let help = match self.word(0) {
            "every" | "deadline" if self.at_timing() => TIME_BEHIND_BODY,
            _ => "write an edge such as 'State -> target'",
        };
        self.skip(what, help, |p| {
            p.at(Kind::CloseBrace) || p.at_watch() || p.leaves_body() || p.begins_edge()
        });
    }
}
