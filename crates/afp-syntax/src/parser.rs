//! Builds the tree from tokens, by recursive descent.
//!
//! The machinery is here, the grammar in the submodules, one for each part of a file. A rule that
//! meets what it does not expect reports it once, skips to where an item of some level can begin
//! again, and goes on.

mod device;
mod file;
mod formula;
mod plan;
mod scenario;
mod toolbox;

use rowan::{Checkpoint, GreenNode, GreenNodeBuilder, Language};

use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::kind::{Afp, Kind};
use crate::lexer::Token;
use crate::source::Span;

/// Greatest depth of brackets and signs in formulas and skipped text.
const MAX_DEPTH: usize = 64;

/// Parses a whole file.
pub(super) fn parse(tokens: &[Token<'_>], file: u16, diags: &mut Diagnostics) -> GreenNode {
    let mut parser = Parser::new(tokens, file, diags);
    parser.file();
    parser.builder.finish()
}

struct Parser<'t, 'd> {
    tokens: &'t [Token<'t>],
    /// Places of the tokens that are no trivia.
    solid: Vec<u32>,
    /// The next of `solid`.
    at: usize,
    /// The next of `tokens` that is not yet in the tree.
    built: usize,
    file: u16,
    /// Depth of brackets and signs around the current place.
    depth: usize,
    /// Whether the item before this one stands outside of a plan and is reported.
    misplaced: bool,
    /// Where the last error is; no second one is reported there.
    last_error: Option<Span>,
    builder: GreenNodeBuilder<'static>,
    diags: &'d mut Diagnostics,
}

impl<'t, 'd> Parser<'t, 'd> {
    fn new(tokens: &'t [Token<'t>], file: u16, diags: &'d mut Diagnostics) -> Parser<'t, 'd> {
        let mut solid = Vec::with_capacity(tokens.len());
        let places = (0..).zip(tokens).filter(|(_, token)| !token.kind.is_trivia());
        solid.extend(places.map(|(place, _)| place));
        let builder = GreenNodeBuilder::new();
        Parser {
            tokens,
            solid,
            at: 0,
            built: 0,
            file,
            depth: 0,
            misplaced: false,
            last_error: None,
            builder,
            diags,
        }
    }

    // Looking.

    /// The place of the token so many ahead; behind the last one the end of all.
    fn place(&self, ahead: usize) -> usize {
        self.solid.get(self.at + ahead).map_or(self.tokens.len(), |place| *place as usize)
    }

    fn token(&self, ahead: usize) -> Option<Token<'t>> {
        self.tokens.get(self.place(ahead)).copied()
    }

    fn nth(&self, ahead: usize) -> Kind {
        self.token(ahead).map_or(Kind::End, |token| token.kind)
    }

    fn at(&self, kind: Kind) -> bool {
        self.nth(0) == kind
    }

    fn at_end(&self) -> bool {
        self.at(Kind::End)
    }

    fn word(&self, ahead: usize) -> &'t str {
        match self.token(ahead) {
            Some(token) if token.kind == Kind::Name => token.text,
            _ => "",
        }
    }

    /// Whether the next token is this word and a word of the grammar: before `:`, `=`, `=>` and
    /// `->` every word is a name.
    fn at_word(&self, word: &str) -> bool {
        self.word(0) == word && !self.names_something(0)
    }

    fn names_something(&self, ahead: usize) -> bool {
        matches!(self.nth(ahead + 1), Kind::Colon | Kind::Equal | Kind::FatArrow | Kind::Arrow)
    }

    /// Whether the next token stands on the line of the one before it.
    fn on_same_line(&self) -> bool {
        let Some(before) = self.at.checked_sub(1) else { return true };
        let from = self.solid[before] as usize + 1;
        !self.tokens[from..self.place(0)].iter().any(|token| token.text.contains('\n'))
    }

    /// Whether no white space stands before the next token.
    fn is_adjacent(&self) -> bool {
        self.at < self.solid.len() && self.place(0) == self.built
    }

    // Places.

    fn span_of(&self, token: Token<'_>) -> Span {
        let end = token.start + u32::try_from(token.text.len()).unwrap_or(0);
        Span { file: self.file, start: token.start, end }
    }

    /// The next token; at the end of a line or of the file the place behind the last one.
    fn here(&self) -> Span {
        match self.token(0) {
            Some(token) if self.on_same_line() => self.span_of(token),
            _ => self.behind(),
        }
    }

    /// The next token, wherever it stands.
    fn next_span(&self) -> Span {
        self.token(0).map_or_else(|| self.behind(), |token| self.span_of(token))
    }

    /// The empty place behind the last token.
    fn behind(&self) -> Span {
        let before = self.at.checked_sub(1).map(|before| self.tokens[self.solid[before] as usize]);
        before
            .map_or(Span { file: self.file, start: 0, end: 0 }, |token| self.span_of(token).after())
    }

    fn found(&self) -> String {
        match self.token(0) {
            None => "the end of the file".to_owned(),
            Some(token) => format!("'{}'", token.text.chars().take(30).collect::<String>()),
        }
    }

    // Building.

    fn emit(&mut self, kind: Kind, text: &str) {
        self.builder.token(Afp::kind_to_raw(kind), text);
    }

    /// Puts everything up to the next token into the tree.
    fn trivia(&mut self) {
        let to = self.place(0);
        self.trivia_to(to, false);
    }

    fn trivia_to(&mut self, to: usize, help_fits: bool) {
        while self.built < to {
            let token = self.tokens[self.built];
            if token.kind == Kind::Doc && !help_fits {
                let span = self.span_of(token);
                self.diags.push(
                    Diagnostic::new(Code::E0110, span, "this help text describes nothing")
                        .help("put it above what it describes, or start it with '//'"),
                );
            }
            self.emit(token.kind, token.text);
            self.built += 1;
        }
    }

    fn bump_as(&mut self, kind: Kind) {
        let Some(token) = self.token(0) else { return };
        self.trivia();
        self.emit(kind, token.text);
        self.built += 1;
        self.at += 1;
    }

    fn bump(&mut self) {
        self.bump_as(self.nth(0));
    }

    fn keyword(&mut self) {
        self.bump_as(Kind::Keyword);
    }

    fn eat(&mut self, kind: Kind) -> bool {
        let fits = self.at(kind);
        if fits {
            self.bump();
        }
        fits
    }

    fn eat_word(&mut self, word: &str) -> bool {
        let fits = self.at_word(word);
        if fits {
            self.keyword();
        }
        fits
    }

    fn open(&mut self, kind: Kind) {
        self.trivia();
        self.builder.start_node(Afp::kind_to_raw(kind));
    }

    fn close(&mut self) {
        self.builder.finish_node();
    }

    fn checkpoint(&mut self) -> Checkpoint {
        self.trivia();
        self.builder.checkpoint()
    }

    fn wrap(&mut self, from: Checkpoint, kind: Kind) {
        self.builder.start_node_at(from, Afp::kind_to_raw(kind));
        self.builder.finish_node();
    }

    /// Runs a rule that is repeated; when it takes nothing, takes a token, so that every
    /// repetition ends.
    fn repeat(&mut self, rule: impl FnOnce(&mut Self)) {
        let before = self.at;
        rule(self);
        if self.at == before {
            self.open(Kind::Error);
            self.bump();
            self.close();
        }
    }

    /// Opens an item: help text and the comments directly above it belong to it.
    fn open_item(&mut self, kind: Kind) {
        let to = self.place(0);
        let own = own_trivia(&self.tokens[self.built..to]);
        self.trivia_to(self.built + own, false);
        self.builder.start_node(Afp::kind_to_raw(kind));
        self.trivia_to(to, true);
    }

    /// Closes an item: a comma and a comment on its last line belong to it.
    fn close_item(&mut self) {
        self.eat(Kind::Comma);
        let to = self.place(0);
        let mut own = self.built;
        for place in self.built..to {
            match self.tokens[place].kind {
                Kind::Comment => own = place + 1,
                Kind::Whitespace if !self.tokens[place].text.contains('\n') => continue,
                _ => {}
            }
            break;
        }
        self.trivia_to(own, false);
        self.close();
    }

    // Errors.

    fn error(&mut self, diagnostic: Diagnostic) {
        if self.last_error != Some(diagnostic.span) {
            self.last_error = Some(diagnostic.span);
            self.diags.push(diagnostic);
        }
    }

    /// Reports that something is missing here.
    fn expected(&mut self, what: &str, help: &str) {
        let here = self.here();
        self.expected_at(here, what, help);
    }

    fn expected_at(&mut self, here: Span, what: &str, help: &str) {
        match self.nth(0) {
            // The lexer has reported it.
            Kind::Unknown => return self.last_error = Some(here),
            Kind::OpenBracket | Kind::CloseBracket | Kind::At => return self.reserved(),
            _ => {}
        }
        let message = format!("expected {what}, found {}", self.found());
        self.error(Diagnostic::new(Code::E0102, here, message).help(help));
    }

    fn expect(&mut self, kind: Kind, help: &str) -> bool {
        let fits = self.eat(kind);
        if !fits {
            self.expected(kind.describe(), help);
        }
        fits
    }

    /// Takes a name, or reports that one is missing.
    fn name(&mut self, help: &str) -> bool {
        if !self.on_same_line() && self.begins_item() {
            self.expected("a name", help);
            return false;
        }
        if self.at(Kind::Name) {
            self.take_name();
            return true;
        }
        self.expect(Kind::Name, help)
    }

    /// Takes the next token, which is a name.
    fn take_name(&mut self) {
        if matches!(self.word(0), "resume" | "repeat") {
            self.reserved();
        }
        self.bump();
    }

    /// Whether an item of some level surely begins here, so that no name can be meant.
    fn begins_item(&self) -> bool {
        let first = matches!(self.word(0), "start" | "supervise") && self.nth(1) == Kind::Name;
        (first && !self.names_something(0)) || self.leaves_body() || self.at_tool()
    }

    fn reserved(&mut self) {
        let message = format!("{} is reserved for a later version", self.found());
        let help = if self.at(Kind::Name) { "choose another name" } else { "remove it" };
        let here = self.next_span();
        self.error(Diagnostic::new(Code::E0112, here, message).help(help));
    }

    /// Closes a bracket, or reports where it was opened.
    fn close_bracket(&mut self, kind: Kind, opened: Span) {
        if self.eat(kind) {
            return;
        }
        let sign = kind.describe();
        let here = self.behind();
        self.error(
            Diagnostic::new(Code::E0103, here, format!("missing {sign}, found {}", self.found()))
                .note(opened, "opened here")
                .help(format!("add {sign}"))
                .fix(here, sign.trim_matches('\'')),
        );
    }

    /// Reports the next token as unexpected and skips to where `stop` holds, brackets and braces
    /// as a whole.
    fn skip(&mut self, what: &str, help: &str, stop: impl Fn(&Self) -> bool) {
        match self.nth(0) {
            Kind::Name if matches!(self.word(0), "resume" | "repeat") => self.reserved(),
            _ => {
                let here = self.next_span();
                self.expected_at(here, what, help);
            }
        }
        self.open(Kind::Error);
        let mut depth = 0_usize;
        loop {
            match self.nth(0) {
                Kind::End => break,
                Kind::OpenBrace | Kind::OpenParen => depth += 1,
                Kind::CloseBrace | Kind::CloseParen => {
                    if depth == 0 && stop(self) {
                        break;
                    }
                    depth = depth.saturating_sub(1);
                }
                _ if depth == 0 && stop(self) => break,
                _ => {}
            }
            self.bump();
        }
        self.close();
    }
}

/// How many of the trivia before an item stand apart from it: everything up to the last blank line,
/// unless help text stands above that.
fn own_trivia(trivia: &[Token<'_>]) -> usize {
    let is_blank_line =
        |token: &Token<'_>| token.kind == Kind::Whitespace && token.text.matches('\n').count() > 1;
    let after_blank = trivia.iter().rposition(is_blank_line).map_or(0, |place| place + 1);
    let help = trivia.iter().position(|token| token.kind == Kind::Doc).unwrap_or(trivia.len());
    let before_help = trivia[..help].iter().rposition(is_blank_line).map_or(0, |place| place + 1);
    if help < after_blank { before_help } else { after_blank }
}
