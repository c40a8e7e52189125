//! Errors in text that does not match the grammar, and recovery from them.
//!
//! A line has one error; further errors on it are usually consequences.

use super::Parser;
use crate::diagnostics::{Code, Diagnostic, Message, Subject, Words};
use crate::kind::Kind;
use crate::message;
use crate::source::Span;

/// Braces with tokens in them.
pub(super) struct Body {
    /// The index of the first brace, if there is one.
    opened: Option<Span>,
}

impl Body {
    /// Whether its first brace is at this index.
    pub(super) fn is_opened(&self) -> bool {
        self.opened.is_some()
    }
}

impl Parser<'_, '_> {
    /// Reports an arrow of another language, and skips it.
    pub(super) fn wrong_arrow(&mut self, tokens: usize, message: &'static str, right: &str) {
        let here = self.ahead(tokens);
        self.error(Diagnostic::new(Code::E0108, here, message).write(right));
        // A word is not a name of the edge.
        match self.at(Kind::Name) {
            true => self.pass(tokens),
            false => (0..tokens).for_each(|_| self.bump()),
        }
    }

    /// Like [`Diagnostics::explains`](crate::diagnostics::Diagnostics::explains).
    pub(super) fn explains(&self) -> bool {
        self.diags.explains()
    }

    /// Reports an error, unless an earlier error is on the same line.
    pub(super) fn error(&mut self, diagnostic: Diagnostic) {
        let mut diagnostic = diagnostic;
        let place = diagnostic.span.start;
        self.with_semicolon(&mut diagnostic);
        if let Some(cause) = self.reported_before(place) {
            self.hidden.insert(self.next_line(cause));
            return;
        }
        let is_arrow = diagnostic.code == Code::E0108;
        if place < self.quiet || !is_arrow && place < self.behind_arrow {
            self.hidden.insert(self.next_line(place));
            return;
        }
        // Text that was read as if it were right has no consequences, but it may not have been an
        // arrow.
        match is_arrow {
            true => self.behind_arrow = self.next_line(place),
            false => self.be_quiet(place),
        }
        self.diags.push(diagnostic);
    }

    /// Withdraws the error about a ';' at the end of a line with another error; an edit also
    /// removes it.
    fn with_semicolon(&mut self, diagnostic: &mut Diagnostic) {
        let place = diagnostic.span.start;
        let Some(cause) = self.reported_before(place).filter(|cause| *cause > place) else {
            return;
        };
        let at = self.tokens.partition_point(|token| token.start < cause);
        let is_sign = self.tokens.get(at).is_some_and(|token| token.text == ";");
        let behind = self.tokens.get(at + 1);
        let ends = behind.is_none_or(|token| token.ends_line())
            || self.tokens[at + 1..]
                .iter()
                .find(|it| !it.kind.is_trivia())
                .is_some_and(|it| it.kind == Kind::CloseBrace);
        if !is_sign || !ends {
            return;
        }
        self.supersede(diagnostic.span);
        if let Some(fix) = diagnostic.fix.as_mut().filter(|fix| fix.span.end == cause) {
            fix.span.end += 1;
        }
    }

    /// Withdraws edits that do not fix all errors on their lines.
    pub(super) fn withdraw_fixes(&mut self) {
        let (hidden, file) = (std::mem::take(&mut self.hidden), self.file);
        if hidden.is_empty() {
            return;
        }
        let mut diags = std::mem::take(self.diags);
        diags.change(|each| {
            let is_in_part =
                each.span.file == file && hidden.contains(&self.next_line(each.span.start));
            // The lexer has its own edits.
            let is_of_grammar = matches!(
                each.code,
                Code::E0101 | Code::E0102 | Code::E0103 | Code::E0108 | Code::E0109
            );
            if is_in_part && is_of_grammar {
                each.fix = None;
            }
        });
        *self.diags = diags;
    }

    /// Suppresses further errors on the line of a place.
    pub(super) fn be_quiet(&mut self, index: u32) {
        self.quiet = self.quiet.max(self.next_line(index));
    }

    /// Notes lines with a reported error, each with the place of that error.
    pub(super) fn note_reported(&mut self, reported: &[(u32, u32)]) {
        for (index, cause) in reported {
            self.reported.entry(self.next_line(*index)).or_insert(*cause);
        }
    }

    /// The place of the reported error on the line of a place.
    pub(super) fn reported_before(&self, index: u32) -> Option<u32> {
        self.reported.get(&self.next_line(index)).copied()
    }

    /// The start of the line after a place.
    pub(super) fn next_line(&self, index: u32) -> u32 {
        self.marks.newline(index).map_or(u32::MAX, |end| end + 1)
    }

    /// Reports that something is missing here.
    pub(super) fn expected(&mut self, what: impl Into<Message>, help: impl Into<Message>) {
        self.missing(self.here(), what, help, Subject::Other);
    }

    /// Reports that a name is missing here.
    pub(super) fn expected_name(&mut self, help: impl Into<Message>) {
        self.missing(self.here(), "a name", help, Subject::MissingName);
    }

    pub(super) fn missing(
        &mut self,
        here: Span,
        what: impl Into<Message>,
        help: impl Into<Message>,
        subject: Subject,
    ) {
        if matches!(self.nth(0), Kind::OpenBracket | Kind::CloseBracket | Kind::At) {
            return self.reserved("remove it");
        }
        self.error(self.instead_of(here, what).help(help).about(subject));
    }

    /// The message about the next token, which is unexpected.
    pub(super) fn instead_of(&self, here: Span, what: impl Into<Message>) -> Diagnostic {
        let message = message!("expected {}", what.into());
        Diagnostic::new(Code::E0102, here, message).found(self.found())
    }

    /// Opens a body, or reports that its brace is missing. Other tokens before the brace on this
    /// line belong to the same error. Without a brace there may still be a body.
    pub(super) fn open_body(
        &mut self,
        help: impl Into<Message>,
        begins: impl Fn(&Self) -> bool,
    ) -> Option<Body> {
        let opened = Body { opened: Some(self.here()) };
        if self.eat(Kind::OpenBrace) {
            return Some(opened);
        }
        match self.nth(0) {
            Kind::OpenBracket => self.error(
                Diagnostic::new(Code::E0102, self.next_span(), "expected '{', found '['")
                    .help("write '{' and '}'"),
            ),
            Kind::Colon if self.on_same_line() && self.begins_line(1) => {
                self.expected("'{'", "write '{' instead of ':', and '}' at the end");
            }
            _ if self.nothing_before_brace() => {}
            _ => self.expected("'{'", help),
        }
        // Indented languages write it so.
        if self.at(Kind::Colon) && self.on_same_line() && self.begins_line(1) {
            self.pass(1);
        }
        let Some(ahead) = self.ahead_on_line(Kind::OpenBrace) else {
            let begins = !self.on_same_line() && begins(self);
            return begins.then_some(Body { opened: None });
        };
        if self.ahead_on_line(Kind::CloseBrace).is_some_and(|close| close < ahead) {
            return None;
        }
        self.open(Kind::Error);
        (0..ahead).for_each(|_| self.bump());
        self.close();
        let opened = Body { opened: Some(self.here()) };
        self.eat(Kind::OpenBrace).then_some(opened)
    }

    /// Closes a body. A body without an opening brace needs no closing brace, and if all braces
    /// match, none is missing.
    pub(super) fn close_body(&mut self, body: Body) {
        match body.opened {
            Some(opened) => self.close_bracket(Kind::CloseBrace, opened),
            None if !self.balanced_as_written && self.closes_more() => {
                self.eat(Kind::CloseBrace);
            }
            None => {}
        }
    }

    /// Whether a brace is next that does not end the plan, because more of its items follow.
    fn closes_more(&self) -> bool {
        let ends =
            matches!(self.word(1), "plan" | "scenario" | "enum" | "table" | "toolbox" | "use");
        self.at(Kind::CloseBrace) && self.nth(1) != Kind::End && !ends
    }

    pub(super) fn expect(&mut self, kind: Kind, help: impl Into<Message>) -> bool {
        let fits = self.eat(kind);
        match kind {
            _ if fits => {}
            Kind::Name => self.expected_name(help),
            _ => self.expected(kind.describe(), help),
        }
        fits
    }

    /// Reads a name, or reports that it is missing.
    pub(super) fn name(&mut self, help: impl Into<Message>) -> bool {
        if !self.on_same_line() && self.begins_item() {
            self.expected_name(help);
            return false;
        }
        if self.at(Kind::Name) {
            self.take_name();
            return true;
        }
        self.expect(Kind::Name, help)
    }

    /// Reads the next token, which is a name.
    pub(super) fn take_name(&mut self) {
        if !self.name_with_hyphens() {
            self.take_word();
        }
    }

    /// Reads the next token, which is a name; a '-' after it does not belong to it.
    pub(super) fn take_word(&mut self) {
        if self.word(0) == "repeat" {
            self.reserved("choose another name");
        }
        self.bump();
    }

    /// Whether an item of some level certainly begins here, so that it cannot be a name.
    pub(super) fn begins_item(&self) -> bool {
        let first = matches!(self.word(0), "start" | "supervise") && self.nth(1) == Kind::Name;
        (first && !self.names_something(0)) || self.leaves_body() || self.at_tool()
    }

    fn reserved(&mut self, help: impl Into<Message>) {
        let message = message!("{} is reserved for a later version", self.found());
        let here = self.next_span();
        self.error(Diagnostic::new(Code::E0112, here, message).help(help));
    }

    /// Closes a bracket, or reports the place of its opening.
    pub(super) fn close_bracket(&mut self, kind: Kind, opened: Span) {
        if self.eat(kind) {
            return;
        }
        let sign = kind.describe();
        let here = self.behind();
        if let Some(slashes) = self.divided_by_a_comment() {
            let message = message!("missing {}: '//' begins a comment", Words(sign));
            return self.error(
                Diagnostic::new(Code::E0103, here, message)
                    .note(opened, "opened here")
                    .help("write '/' to divide")
                    .fix(slashes, "/"),
            );
        }
        self.error(
            Diagnostic::new(Code::E0103, here, message!("missing {}", Words(sign)))
                .found(self.found())
                .note(opened, "opened here")
                .help(message!("add {}", Words(sign)))
                .fix(here, sign.trim_matches('\'')),
        );
    }

    /// The number of commas in the bracket that begins here, up to its end or the end of the file.
    pub(super) fn commas_in_brackets(&self) -> usize {
        if !self.at(Kind::OpenParen) || !self.is_closed() {
            return 0;
        }
        let (mut depth, mut commas) = (0_usize, 0);
        for kind in (0..).map(|ahead| self.nth(ahead)) {
            match kind {
                Kind::OpenParen => depth += 1,
                Kind::CloseParen => depth -= 1,
                Kind::Comma if depth == 1 => commas += 1,
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        commas
    }

    /// Whether the bracket that begins here is closed before the next brace.
    pub(super) fn is_closed(&self) -> bool {
        self.marks.is_closed(self.at)
    }

    /// Reports the next token as unexpected and skips to where `stop` holds, brackets and braces
    /// as a whole.
    pub(super) fn skip(
        &mut self,
        what: &'static str,
        help: impl Into<Message>,
        stop: impl Fn(&Self) -> bool,
    ) {
        self.report_skipped(what, help, None);
        self.pass_to(stop);
    }

    /// Reports the next token as unexpected, with the word that may have been meant.
    pub(super) fn report_skipped(
        &mut self,
        what: impl Into<Message>,
        help: impl Into<Message>,
        meant: Option<&str>,
    ) {
        let here = self.next_span();
        match (self.nth(0), meant) {
            (Kind::CloseParen, _) => {
                let error = Diagnostic::new(Code::E0102, here, "unmatched ')'");
                self.error(error.help("remove it").replace(""));
            }
            (_, Some(meant)) => {
                self.error(self.instead_of(here, what).help(help).replace(meant));
            }
            _ => self.missing(here, what, help, Subject::Other),
        }
    }

    /// Skips to where `stop` holds, brackets and braces as a whole.
    pub(super) fn pass_to(&mut self, stop: impl Fn(&Self) -> bool) {
        self.open(Kind::Error);
        let mut depth = 0_usize;
        while !(self.at_end() || depth == 0 && stop(self)) {
            match self.nth(0) {
                Kind::OpenBrace => depth += 1,
                Kind::OpenParen if depth > 0 || self.is_closed() => depth += 1,
                Kind::CloseBrace | Kind::CloseParen => depth = depth.saturating_sub(1),
                _ => {}
            }
            self.bump();
        }
        self.close();
    }
}
