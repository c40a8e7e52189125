//! Indented blocks of other languages below a line that has been reported.

use crate::diagnostics::Diagnostic;
use crate::habits::{BODY, FILE, PLAN, Places};
use crate::kind::Kind;
use crate::lexer::Token;
use crate::parser::Parser;

/// Words at the beginning of a line that continue a block.
const CONTINUES: &[&str] = &[
    "else",
    "elif",
    "elseif",
    "end",
    "end;",
    "except",
    "finally",
    "catch",
    "case",
    "otherwise",
    "default",
    "until",
    "sonst",
    "sinon",
    "endif",
    "endwhile",
    "fi",
    "done",
];

impl Parser<'_, '_> {
    /// Reports and skips a line, brackets and braces as a whole, with the block below it.
    pub(in crate::parser) fn foreign_block(&mut self, mut error: Diagnostic) {
        let Some(head) = self.token(0) else { return };
        self.pass_line();
        self.block_below(head);
        error.span = error.span.to(self.behind());
        if let Some(fix) = &mut error.fix {
            fix.span = error.span;
        }
        self.error(error);
    }

    /// Skips a habit up to a place, with the indented block below it, which belongs to its error.
    pub(super) fn with_block(
        &mut self,
        mut error: Diagnostic,
        head: Token<'_>,
        place: Places,
        next: u32,
    ) -> Diagnostic {
        self.pass_to(|p| p.token(0).is_none_or(|token| token.start >= next));
        let end = self.at;
        if place & (PLAN | FILE | BODY) != 0 {
            self.block_below(head);
        }
        if self.at > end {
            error.span = error.span.to(self.behind());
            if let Some(fix) = &mut error.fix {
                fix.span = fix.span.to(self.behind());
            }
        }
        error
    }

    /// Skips the lines of the block whose first line began with a token: lines that are indented
    /// further, and lines that continue or end the block. Items of plans are read.
    fn block_below(&mut self, head: Token<'_>) {
        let Some(base) = self.indent_of(head.start) else { return };
        while !self.at_end() && !self.on_same_line() && !self.belongs_to_a_plan() {
            let Some(next) = self.token(0) else { break };
            let Some(indent) = self.indent_of(next.start) else { break };
            let continues = CONTINUES.contains(&next.text) || next.text == "<" && head.text == "<";
            if indent <= base && !(indent == base && continues) {
                break;
            }
            self.pass_line();
        }
    }

    /// Skips the rest of a line, brackets and braces as a whole.
    pub(in crate::parser) fn pass_line(&mut self) {
        let (first, here) = (self.at, self.next_span());
        self.pass_to(|p| p.at > first && !p.on_same_line());
        self.supersede(here.to(self.behind()));
    }

    /// Whether text of plans begins here, which other languages do not have.
    fn belongs_to_a_plan(&self) -> bool {
        let is_item = self.at_plan_item()
            && (self.nth(2) == Kind::Colon || self.word(0) == "start" || self.word(0) == "on");
        is_item || self.at(Kind::CloseBrace) || self.at_top_item() || self.nth(1) == Kind::Arrow
    }

    /// The column of the first token of a line, if it begins at this place.
    fn indent_of(&self, place: u32) -> Option<usize> {
        let at = self.tokens.partition_point(|token| token.start < place);
        let before = at.checked_sub(1).and_then(|at| self.tokens.get(at));
        match before {
            None => Some(0),
            Some(blank) if blank.ends_line() => {
                let (_, line) = blank.text.rsplit_once('\n')?;
                Some(line.len())
            }
            Some(_) => None,
        }
    }
}
