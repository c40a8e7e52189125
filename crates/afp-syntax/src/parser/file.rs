//! The items of a file, whichever kind of file it is.

use rowan::Language;

use super::Parser;
use crate::diagnostics::{Code, Diagnostic, list};
use crate::habits::FILE;
use crate::keywords::{self, PLAN, TOOL, TOP};
use crate::kind::{Afp, Kind};
use crate::message;

impl Parser<'_, '_> {
    pub(super) fn file(&mut self) {
        self.builder.start_node(Afp::kind_to_raw(Kind::File));
        if self.word(0) == "afp" && self.nth(1) == Kind::Int {
            self.open_item(Kind::Version);
            self.keyword();
            self.bump();
            self.close_item();
        }
        while !self.at_end() {
            self.repeat(Self::top_item);
        }
        self.trivia();
        self.builder.finish_node();
    }

    pub(super) fn top_item(&mut self) {
        self.misplaced &= !self.at_top_item();
        match self.word(0) {
            "use" => self.use_item(),
            "plan" => self.plan(),
            "scenario" => self.scenario(),
            "toolbox" => self.toolbox(),
            "enum" => self.enumeration(),
            "table" => self.table(),
            "object" => self.object(),
            "device" | "sensor" => self.device(),
            "robot" if self.at_device() => self.device(),
            _ if self.at_template() => self.template(),
            "supervise" if self.nth(1) == Kind::Name && self.nth(2) == Kind::OpenBrace => {
                self.read_as("supervisor", "an item of a toolbox");
                self.template();
            }
            // Entries may be part of a program in another language.
            "const" | "let" | "var" if self.nth(3) == Kind::Name && self.habit(FILE) => {}
            _ if self.is_foreign => self.pass_line(),
            word if keywords::has(word, PLAN) => self.misplaced(),
            _ if self.at_plan_elsewhere() => {
                self.read_as("plan", "a plan");
                self.plan();
            }
            _ if self.word_before_item(&["plan", "enum", "table"]) => self.top_item(),
            _ if !self.is_toolbox && self.habit(FILE) => {}
            _ => {
                let what = match self.is_toolbox {
                    true => "an item of a toolbox",
                    false => "'use', 'plan', 'scenario', 'enum', 'table' or 'toolbox'",
                };
                let help = match self.top_help() {
                    Some(help) => help,
                    None if self.item_meant(what, &self.possible_items()) => {
                        return self.top_item();
                    }
                    None if self.is_toolbox => {
                        let known = keywords::with(TOOL).into_iter().chain(["enum"]);
                        message!("write {}", list(known, "or"))
                    }
                    None => "remove it, or put it into a plan".into(),
                };
                let first = self.at;
                self.skip(what, help, |p| {
                    let is_next = p.at > first && !p.on_same_line();
                    p.leaves_body()
                        || p.at_tool()
                        || is_next && p.meant(&p.possible_items()).is_some()
                });
            }
        }
    }

    /// The keywords of file items that fit the next tokens.
    fn possible_items(&self) -> Vec<&'static str> {
        let with_braces =
            ["plan", "enum", "device", "sensor", "robot", "actor", "supervisor", "computation"];
        match (self.nth(1), self.nth(2)) {
            (Kind::Text, _) => vec!["use", "scenario"],
            (Kind::OpenBrace, _) => vec!["plan", "enum", "robot"],
            (_, Kind::OpenBrace) => with_braces.to_vec(),
            (_, Kind::Colon) => Vec::new(),
            (_, Kind::OpenParen) => vec!["table", "enum"],
            _ => keywords::with(TOP).into_iter().chain(["object", "device", "sensor"]).collect(),
        }
    }

    /// Whether a word instead of 'plan' precedes a name and items of a plan: `node Main { start
    /// go`.
    fn at_plan_elsewhere(&self) -> bool {
        let is_head = (self.nth(1), self.nth(2)) == (Kind::Name, Kind::OpenBrace);
        is_head && keywords::has(self.word(3), PLAN) && self.meant(&["plan"]).is_some()
    }

    /// Parses an item of a plan outside of all plans.
    fn misplaced(&mut self) {
        let word = self.word(0);
        let here = self.next_span();
        // After a surplus brace everything is outside; report only one error.
        if !std::mem::replace(&mut self.misplaced, true) {
            self.error(
                Diagnostic::new(Code::E0114, here, message!("'{}' is outside of a plan", word))
                    .help("move it between the braces of a plan; perhaps a '}' above is unmatched"),
            );
        }
        self.open(Kind::Error);
        self.plan_item();
        self.close();
    }

    /// Whether an item of a file can begin here; two tokens decide, since names may be words.
    pub(super) fn at_top_item(&self) -> bool {
        match self.word(0) {
            "use" => matches!(self.nth(1), Kind::Name | Kind::Text),
            "scenario" => self.nth(1) == Kind::Text,
            "plan" | "enum" => {
                let named = 1 + usize::from(self.nth(1) == Kind::Name);
                let braces = named + usize::from(self.word(named) == "forever");
                let is_indented = self.nth(braces) == Kind::Colon && self.begins_line(braces + 1);
                self.nth(braces) == Kind::OpenBrace || is_indented
            }
            "table" => {
                self.nth(1) == Kind::Name
                    && matches!(self.nth(2), Kind::OpenParen | Kind::OpenBrace)
            }
            "toolbox" => self.nth(1) == Kind::Name && !self.word(2).is_empty(),
            _ => false,
        }
    }

    fn use_item(&mut self) {
        self.open_item(Kind::Use);
        let first = self.at;
        self.keyword();
        if self.path_without_quotes() {
            return self.close_item();
        }
        let is_file = self.eat(Kind::Text);
        let named = !is_file && self.name("name a toolbox, such as 'use carbot'");
        if named && self.at_word("as") {
            self.open(Kind::Alias);
            self.keyword();
            self.name("give the short name, such as 'use carbot as c'");
            self.close();
        }
        if is_file {
            self.short_name_of_a_file();
        }
        self.use_of_parts(first);
        self.close_item();
    }

    fn enumeration(&mut self) {
        self.open_item(Kind::Enum);
        self.keyword();
        let is_named = self.nth(1) == Kind::Name && !self.begins_line(1);
        if matches!(self.word(0), "class" | "struct") && is_named {
            let message = message!("unexpected {} after 'enum'", self.found());
            self.instead(1, message, "remove it", "");
        }
        self.name("give the enum a name");
        let opened = self.here();
        // The brackets of other languages.
        let closing = match self.nth(0) {
            Kind::OpenParen => Kind::CloseParen,
            Kind::OpenBracket => Kind::CloseBracket,
            _ => Kind::CloseBrace,
        };
        if closing != Kind::CloseBrace {
            let error = self.instead_of(self.next_span(), "'{'");
            self.error(error.help("write '{' and '}' around the values"));
            self.pass(1);
            self.variants(closing);
            if self.at(closing) {
                self.pass(1);
            }
        } else if self.expect(Kind::OpenBrace, "list the values in braces") {
            self.variants(closing);
            self.close_bracket(closing, opened);
        }
        self.close_item();
    }

    /// The values of an enum, up to the bracket that ends them.
    fn variants(&mut self, closing: Kind) {
        while self.at(Kind::Name) && !self.at_top_item() {
            self.open_item(Kind::Variant);
            self.take_name();
            self.numbers_of_values();
            self.close_item();
        }
        let ends = |p: &Self| p.at(closing) || p.at(Kind::CloseBrace) || p.at_top_item();
        if !ends(self) && !self.at_end() {
            self.skip("a value or '}'", "write only names between the braces", ends);
        }
    }
}
