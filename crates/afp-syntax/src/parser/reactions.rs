//! `on`: what an element does instead where a supervisor of its plan reports something.

use super::Parser;
use crate::kind::Kind;

impl Parser<'_, '_> {
    /// Whether `on` begins here; a state may be called so, too.
    pub(super) fn at_reactions(&self) -> bool {
        let named =
            self.nth(1) == Kind::Name && (!self.begins_line(1) || self.nth(2) == Kind::OpenBrace);
        // An edge with a word before it is told that by itself.
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
        let name = Some(self.word(0)).filter(|name| !name.is_empty()).unwrap_or("NAME");
        let help = format!("write 'on {name} {{ Event -> target }}'");
        self.name("name a supervisor of the plan");
        self.events(&help);
        self.close_item();
    }

    /// The edges of events, in braces; `help` tells who has left them out.
    pub(super) fn events(&mut self, help: &str) {
        let body = self.open_body(help, Self::begins_body);
        if let Some(body) = body {
            while !self.ends_body(&body) && (!self.at_watch() || self.is_nested()) {
                self.repeat(|parser| match parser.is_nested() {
                    true => parser.nested(),
                    false => parser.edge_or_skip("an edge"),
                });
            }
            self.close_body(body);
        }
    }
}
