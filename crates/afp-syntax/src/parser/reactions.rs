//! `on`: the reactions of an element to the plan's supervisors.

use super::Parser;
use crate::diagnostics::{Code, Diagnostic, Message};
use crate::habits::EVENTS;
use crate::kind::Kind;
use crate::message;

impl Parser<'_, '_> {
    /// Whether `on` begins here; a state may have the same name.
    pub(super) fn at_reactions(&self) -> bool {
        let named =
            self.nth(1) == Kind::Name && (!self.begins_line(1) || self.nth(2) == Kind::OpenBrace);
        // An edge with a word before it has an error of its own.
        let is_edge = self.arrow_at(2).is_some();
        self.at_word("on") && !is_edge && (named || self.nth(1) == Kind::OpenBrace)
    }

    /// Whether a supervisor or `on` begins here.
    pub(super) fn at_watch(&self) -> bool {
        self.at_word("supervise") || self.at_reactions()
    }

    /// `"on" NAME "{" {edge} "}"`
    pub(super) fn reactions(&mut self) {
        self.open_item(Kind::Reactions);
        self.keyword();
        self.path_of_supervisor();
        let name = Some(self.word(0)).filter(|name| !name.is_empty()).unwrap_or("NAME");
        let help = message!("write 'on {} {{ Event -> target }}'", name);
        self.name("name a supervisor of the plan");
        self.events(help);
        self.close_item();
    }

    /// `on Main.escape { ... }`: reports the text before the supervisor's name, and skips it.
    fn path_of_supervisor(&mut self) {
        let is_path = self.nth(1) == Kind::Dot && self.nth(3) == Kind::OpenBrace;
        let name = self.word(2);
        if is_path && self.at(Kind::Name) && !name.is_empty() {
            let message = "write only the name of a supervisor of the plan";
            self.instead(2, message, message!("write 'on {}'", name), "");
        }
    }

    /// `on esc -> ignore`, `on esc.Pressed -> ignore`: reports that the edge belongs into braces,
    /// and skips it.
    pub(super) fn reaction_without_braces(&mut self) -> bool {
        let event = if self.nth(2) == Kind::Dot { self.word(3) } else { "Event" };
        let arrow = if self.nth(2) == Kind::Dot { 4 } else { 2 };
        // States begin with a capital letter.
        let is_supervisor = self.word(1).starts_with(|first: char| first.is_ascii_lowercase());
        let target = self.word(arrow + 1);
        let stands = self.word(0) == "on" && self.nth(arrow) == Kind::Arrow && !target.is_empty();
        if !stands || !(is_supervisor || arrow == 4) || self.begins_line(1) {
            return false;
        }
        let better = format!("on {} {{ {event} -> {target} }}", self.word(1));
        let error = Diagnostic::new(
            Code::E0102,
            self.ahead(arrow + 2),
            "the edges of 'on' belong in braces",
        );
        let error = error.help(message!("write '{}'", better));
        self.error(if arrow == 4 { error.replace(better) } else { error });
        self.pass(arrow + 2);
        true
    }

    /// `esc.Pressed -> ignore` of a supervisor of the plan: reports that the edge belongs into an
    /// 'on', and skips it.
    pub(super) fn reaction_as_edge(&mut self) -> bool {
        let (supervisor, event, target) = (self.word(0), self.word(2), self.word(4));
        let is_edge = self.nth(1) == Kind::Dot && self.nth(3) == Kind::Arrow;
        let ends = self.nth(5) == Kind::CloseBrace || self.begins_line(5);
        let is_whole = ends && !event.is_empty() && !target.is_empty();
        if !is_edge || !is_whole || !self.known().is_global(supervisor) {
            return false;
        }
        let better = format!("on {supervisor} {{ {event} -> {target} }}");
        let message = "reactions to the plan's supervisors are written in 'on'";
        let error = Diagnostic::new(Code::E0102, self.ahead(5), message);
        let error = error.help(message!("write '{}'", better));
        // Edges of the same supervisor belong into one 'on'.
        let is_other = |first: Option<usize>| {
            let text = |at: usize| self.solid.get(at).map(|at| self.tokens[*at as usize].text);
            first.is_some_and(|at| text(at) == Some(supervisor) && text(at + 1) == Some("."))
        };
        let is_alone = !is_other(Some(self.at + 5)) && !is_other(self.at.checked_sub(5));
        self.error(if is_alone { error.replace(better) } else { error });
        self.pass(5);
        true
    }

    /// The edges of events, in braces; `help` names the missing braces.
    pub(super) fn events(&mut self, help: impl Into<Message>) {
        if self.at(Kind::Arrow) && self.nth(1) == Kind::Name && !self.begins_line(1) {
            let error = Diagnostic::new(
                Code::E0102,
                self.ahead(2),
                message!("an edge of '{}' names its event, in braces", self.template),
            );
            self.error(error.help(message!("write '{{ Event -> {} }}' with that", self.word(1))));
            return self.pass(2);
        }
        let body = self.open_body(help, Self::begins_body);
        if let Some(body) = body {
            while !self.ends_body(&body) && (!self.at_watch() || self.is_nested()) {
                self.repeat(|parser| match parser.is_nested() {
                    true => parser.nested(),
                    false if parser.habit_of_body(EVENTS) => {}
                    false => parser.edge_or_skip("an edge"),
                });
            }
            self.close_body(body);
        }
    }
}
