//! Items that no plan and no file has, and items that stand in braces where they have no place.

use super::CHOICE;
use crate::diagnostics::{Code, Diagnostic};
use crate::dimension::Dimension;
use crate::kind::Kind;
use crate::parser::recovery::Body;
use crate::parser::{MAX_DEPTH, Parser};

/// What functions and tasks are here.
const SUB_PLAN: &str = "write a plan of its own, and use it as a 'subplan'";

/// Whether a word is a type that every file knows.
fn is_type(word: &str) -> bool {
    matches!(word, "int" | "bool" | "float" | "string") || Dimension::named(word).is_some()
}

impl Parser<'_, '_> {
    /// What to write for an item that no plan has, and that is no slip.
    pub(in crate::parser) fn item_help(&self) -> Option<String> {
        let (word, next) = (self.word(0), self.word(1));
        let begins_element = || self.on_line_from(1, Kind::OpenBrace).is_some();
        Some(match (word, self.nth(1)) {
            (_, Kind::Colon) if begins_element() => {
                "begin an element with 'actor', 'computation' or 'subplan', a supervisor with 'supervise'"
                    .to_owned()
            }
            (_, Kind::Colon | Kind::Equal) => {
                format!("begin an entry with 'var', 'const', 'in' or 'out': 'var {word}'")
            }
            (_, Kind::Arrow) => "put the edge into the braces of an element or a supervisor".to_owned(),
            (_, Kind::Name) if is_type(word) => format!("write 'var {next}: {word}'"),
            ("double" | "real", Kind::Name) => format!("write 'var {next}: float'"),
            ("def" | "task", Kind::Name) if self.nth(2) == Kind::OpenParen => SUB_PLAN.to_owned(),
            ("let" | "mut" | "auto" | "local" | "global" | "val" | "def", Kind::Name) => {
                format!("write 'var {next}'")
            }
            ("task", Kind::Name) if self.nth(2) == Kind::Colon => return None,
            ("if" | "else" | "elif" | "switch" | "case" | "when" | "match", _) => CHOICE.to_owned(),
            ("while" | "for" | "loop" | "do", _) => "lead an edge back to an element".to_owned(),
            ("import" | "include" | "from", _) => "write 'use' at the top of the file".to_owned(),
            ("fn" | "func" | "function" | "void" | "class" | "task", _) => {
                SUB_PLAN.to_owned()
            }
            ("every" | "deadline", _) => {
                "write it behind the supervisor's template, before its '{'".to_owned()
            }
            _ => return None,
        })
    }

    /// What to write for an item that files of other languages have.
    pub(in crate::parser) fn top_help(&self) -> Option<String> {
        let is_import = matches!(self.word(0), "import" | "include" | "from" | "using" | "require");
        is_import.then(|| "write 'use' and the name of a toolbox".to_owned())
    }

    /// Whether an actor, entry or supervisor begins here inside the body of another one, though no brace is missing.
    pub(in crate::parser) fn is_nested(&self) -> bool {
        let begins = self.at_watch() || self.leaves_body() && !self.at_top_item();
        begins && self.balanced && self.depth < MAX_DEPTH
    }

    /// Whether an item of a file begins here inside of a plan, though no brace is missing.
    pub(in crate::parser) fn is_top_inside(&self, body: &Body) -> bool {
        self.balanced && body.is_opened() && self.depth < MAX_DEPTH
    }

    /// Reads an item of a file that stands inside of a plan.
    pub(in crate::parser) fn top_inside(&mut self) {
        let (here, word) = (self.next_span(), self.word(0));
        let message = format!("'{word}' stands in the braces of a plan");
        let help = match word {
            "use" => "move it to the top of the file",
            _ => "move it behind the '}' of the plan",
        };
        self.error(Diagnostic::new(Code::E0114, here, message).help(help));
        self.depth += 1;
        self.open(Kind::Error);
        self.top_item();
        self.close();
        self.depth -= 1;
    }

    /// Reads an item that stands inside of another one.
    pub(in crate::parser) fn nested(&mut self) {
        let (here, word) = (self.next_span(), self.word(0));
        if self.depth == 0 {
            let message = format!("'{word}' stands in braces where it has no place");
            let help = match word {
                "supervise" => "move it behind the '}' of the other supervisor",
                "on" => "move it behind the '}' of the supervisor",
                _ => "move it behind the '}' of the element around it",
            };
            self.error(Diagnostic::new(Code::E0114, here, message).help(help));
        }
        self.depth += 1;
        self.open(Kind::Error);
        self.plan_item();
        self.close();
        self.depth -= 1;
    }
}
