//! Toolboxes: templates and their parts, object types.

use super::Parser;
use crate::diagnostics::Message;
use crate::keywords::{self, PART};
use crate::kind::Kind;
use crate::message;
use crate::units::Unit;

const PART_HELP: &str = "write 'icon', 'uses', 'needs', 'in', 'out', 'every', 'deadline', 'budget', 'stop', 'state', 'states of', 'event' or 'exclusive'";

impl Parser<'_, '_> {
    pub(super) fn toolbox(&mut self) {
        self.open_item(Kind::Toolbox);
        self.keyword();
        self.is_toolbox = true;
        self.name("give the toolbox a name");
        if self.eat_meant("version", |next| next == Kind::Text) {
            self.expect(Kind::Text, "write the version in double quotes, such as '\"1.0\"'");
        }
        self.close_item();
    }

    pub(super) fn object(&mut self) {
        self.open_item(Kind::Object);
        self.keyword();
        self.name("give the object type a name");
        self.close_item();
    }

    pub(super) fn template(&mut self) {
        self.open_item(Kind::Template);
        self.keyword();
        self.name("give the template a name");
        self.eat_meant("resumable", |next| next == Kind::OpenBrace);
        let help = match self.on_same_line() && !self.at_end() {
            true => "a template declares what it takes with 'in', between its braces",
            false => "put the template's parts in braces",
        };
        let body = self.open_body(help, Self::at_part);
        if let Some(body) = body {
            let ends = |p: &Self| {
                let is_tool = p.at_tool() || p.at_template();
                p.at(Kind::CloseBrace) || is_tool && !p.at_use_for_uses()
            };
            while !self.at_end() && !ends(self) {
                self.repeat(|parser| {
                    let next = parser.word(1);
                    let possible = || match next {
                        "of" => vec!["states"],
                        _ => keywords::with(PART),
                    };
                    let is_read = parser.at_part()
                        || parser.live_before_in()
                        || parser.item_meant("a part of the template", &possible());
                    match is_read {
                        true => parser.part(),
                        false => parser
                            .skip("a part of the template", PART_HELP, |p| p.at_part() || ends(p)),
                    }
                });
            }
            self.close_body(body);
        }
        self.close_item();
    }

    /// Whether a template begins: with a brace, or in a toolbox with any text.
    pub(super) fn at_template(&self) -> bool {
        self.at_named_template() && (self.opens_behind_name() || self.is_toolbox)
    }

    /// Whether a brace opens after the name of a template, or after its `resumable`.
    fn opens_behind_name(&self) -> bool {
        let behind = if self.word(2) == "resumable" { 3 } else { 2 };
        self.nth(behind) == Kind::OpenBrace
    }

    fn at_named_template(&self) -> bool {
        matches!(self.word(0), "actor" | "supervisor" | "computation") && self.nth(1) == Kind::Name
    }

    /// Whether an item of a toolbox begins.
    pub(super) fn at_tool(&self) -> bool {
        let template = self.at_named_template() && self.opens_behind_name();
        let object = self.word(0) == "object" && self.nth(1) == Kind::Name;
        template || object || self.at_device() || self.at_top_item()
    }

    fn at_part(&self) -> bool {
        keywords::has(self.word(0), PART)
    }

    /// `use eye` in a template, which is not a `use` of a file.
    fn at_use_for_uses(&self) -> bool {
        self.word(0) == "use" && self.nth(1) == Kind::Name
    }

    fn part(&mut self) {
        match self.word(0) {
            "in" => self.in_port(),
            "out" => self.out_port(),
            "icon" => {
                self.open_item(Kind::Icon);
                self.keyword();
                self.expect(Kind::Text, "write the icon's name in double quotes");
                self.close_item();
            }
            word @ ("uses" | "needs") => self.device_of_template(word),
            "states" => {
                self.open_item(Kind::StatesOf);
                self.keyword();
                if !self.eat_word("of") {
                    self.expected("'of'", "write 'states of' and the port whose values they are");
                }
                self.name("name the port whose values are the states");
                self.close_item();
            }
            "state" | "event" => {
                let is_event = self.at_word("event");
                self.open_item(Kind::Outcome);
                self.keyword();
                if self.name("give it a name") && is_event {
                    self.eat_meant("once", |_| true);
                    self.after();
                }
                self.case(is_event);
                self.close_item();
            }
            "exclusive" => {
                self.open_item(Kind::Exclusive);
                self.keyword();
                let help = "name two events that cannot both hold";
                if self.name(help) && self.second_name(help) && self.at_condition() {
                    self.condition();
                }
                self.close_item();
            }
            _ => {
                self.open_item(Kind::Timing);
                self.keyword();
                self.quantity("write a time such as '10 ms'");
                self.close_item();
            }
        }
    }

    /// `["after" formula]` of an event.
    fn after(&mut self) {
        if self.at_word("after") && self.on_same_line() {
            self.open(Kind::After);
            self.keyword();
            self.formula();
            self.close();
        }
    }

    fn second_name(&mut self, help: &'static str) -> bool {
        if self.on_same_line() || !self.at_part() {
            return self.name(help);
        }
        self.expected_name(help);
        false
    }

    /// `["when" condition] ["{" {bind} "}"]` of a state of a declared computation. An event has no
    /// body.
    fn case(&mut self, is_event: bool) {
        let behind_name = self.at;
        if self.at_condition() {
            self.condition();
        }
        if (is_event || self.at == behind_name) && !self.at(Kind::OpenBrace) {
            return;
        }
        let help = "put what the state assigns in braces, or write '{}' for nothing";
        let Some(body) = self.open_body(help, |_| false) else { return };
        while !self.at_end() && !self.at(Kind::CloseBrace) && !self.at_part_behind_case() {
            self.repeat(|parser| match parser.at(Kind::Name) && parser.at_sign_of_bind() {
                true => parser.bind(),
                false => parser.skip("an assignment", "write an output, '=' and a formula", |p| {
                    p.at(Kind::CloseBrace) || p.at_part_behind_case()
                }),
            });
        }
        self.close_body(body);
    }

    /// Whether an unbound part of the template begins.
    fn at_part_behind_case(&self) -> bool {
        self.at_part() && !self.at_sign_of_bind() || self.at_template()
    }

    /// `"when" comparison {"and" comparison}`
    fn condition(&mut self) {
        self.open(Kind::When);
        self.keyword();
        self.comparison();
        while self.eat_word("and") {
            self.comparison();
        }
        self.close();
    }

    fn comparison(&mut self) {
        self.open(Kind::Comparison);
        self.formula();
        if self.unequal_meant() {
            self.formula();
        } else if self.nth(0).is_comparison() || self.comparison_meant() {
            // A '=' is read as '=='.
            self.bump_as(if self.at(Kind::Equal) { Kind::EqualEqual } else { self.nth(0) });
            self.formula();
        } else {
            self.expected("a comparison", "write a sign such as '<' and another value");
        }
        self.close();
    }

    /// `uses NAME` or `needs NAME`
    fn device_of_template(&mut self, word: &str) {
        let (help, message) = match word {
            "uses" => {
                ("name what it commands, such as 'uses navigator'", "'uses' names one device")
            }
            _ => ("name what it needs, such as 'needs odometry'", "'needs' names one device"),
        };
        self.open_item(Kind::Uses);
        self.keyword();
        self.name(help);
        // The next part may follow a comma.
        while self.at(Kind::Comma)
            && self.nth(1) == Kind::Name
            && !keywords::has(self.word(1), PART)
        {
            let ours = format!(" {word} {}", self.word(1));
            self.instead(2, message, message!("write '{}'", ours.trim_start()), &ours);
        }
        self.close_item();
    }

    fn in_port(&mut self) {
        self.open_item(Kind::InPort);
        self.keyword();
        self.eat_meant("live", |next| next == Kind::Name);
        self.port("give the port a name");
        self.value_and_range();
        self.close_item();
    }

    /// A value and its bounds; each may be missing.
    pub(super) fn value_and_range(&mut self) {
        if self.at(Kind::Colon) && self.nth(1) == Kind::Equal && self.on_same_line() {
            self.instead(1, "unexpected ':' before '='", "write '='", "");
        }
        let has_value = self.eat(Kind::Equal);
        if has_value {
            self.formula();
            self.no_operators();
        }
        let range = self.at;
        if self.at_word("from") || self.at_slip("from") && self.nth(1).begins_formula() {
            let around = std::mem::replace(&mut self.in_range, true);
            let is_whole = self.range();
            self.in_range = around;
            if !has_value && self.at(Kind::Equal) && self.on_same_line() {
                match is_whole {
                    true => self.value_behind_range(range),
                    // An error of the range has been reported.
                    false => self.pass_value(),
                }
            }
        }
    }

    /// `"from" formula "to" formula`. Returns whether both ends exist.
    pub(super) fn range(&mut self) -> bool {
        self.open(Kind::Range);
        self.eat_meant("from", Kind::begins_formula);
        self.formula();
        if self.word(0) == "to" && self.nth(1) == Kind::Colon && self.nth(2).begins_formula() {
            self.keyword();
            let message = "unexpected ':' after 'to'";
            self.instead(1, message, "remove it", "");
            self.formula();
            self.close();
            return true;
        }
        let points = (0..2).all(|at| self.nth(at) == Kind::Dot) && self.on_same_line();
        if points {
            self.instead(2, "'to' separates the bounds of a range", "write ' to '", " to ");
        }
        let is_whole = points || self.eat_word("to");
        if is_whole {
            self.formula();
        } else {
            self.expected("'to'", "write both ends, such as 'from 0 cm to 30 cm'");
        }
        self.close();
        is_whole
    }

    fn pass_value(&mut self) {
        self.open(Kind::Error);
        self.bump();
        self.formula();
        self.close();
    }

    /// `from 0 s to 5 s = 3 s`: a unit after a bound, which in other places would be the name of a
    /// bound value.
    pub(super) fn unit_of_a_bound(&mut self) -> bool {
        let is_unit = self.in_range
            && self.nth(1) == Kind::Equal
            && self.on_same_line()
            && Unit::parse(self.word(0)).is_some();
        if is_unit {
            self.bump_as(Kind::Unit);
        }
        is_unit
    }

    fn out_port(&mut self) {
        self.open_item(Kind::OutPort);
        self.keyword();
        self.live_elsewhere();
        self.port("give the port a name");
        if self.at_word("on") {
            self.open(Kind::On);
            self.keyword();
            self.name("name the state or event that carries the output");
            while self.eat(Kind::Pipe) || self.other_sign_between_outcomes() {
                self.name("name another state or event");
            }
            self.close();
        }
        self.close_item();
    }

    /// `on A, B`, `on A or B`: reports the text between the names, and skips it.
    fn other_sign_between_outcomes(&mut self) -> bool {
        let is_sign = self.at(Kind::Comma) || matches!(self.word(0), "or" | "and");
        let is_name = self.nth(1) == Kind::Name && !self.begins_line(1);
        let stands =
            is_sign && self.on_same_line() && is_name && !keywords::has(self.word(1), PART);
        if stands {
            let message = message!("expected '|', found {}", self.found());
            let sign = if self.at(Kind::Comma) { " |" } else { "|" };
            self.instead(1, message, "write '|'", sign);
        }
        stands
    }

    /// A name and its type.
    pub(super) fn port(&mut self, help: impl Into<Message>) {
        self.name(help);
        if self.expect(Kind::Colon, "write ':' and a type") {
            self.ty();
        }
    }
}
