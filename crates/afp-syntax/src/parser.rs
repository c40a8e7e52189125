//! Builds the tree from tokens, by recursive descent.
//!
//! This file has the machinery; each submodule has the grammar of one part of a file. A rule
//! reports unexpected text once, skips to the beginning of the next item of some level, and
//! continues.

mod bind;
mod braces;
mod device;
mod edge;
mod elsewhere;
mod file;
mod formula;
mod habits;
mod known;
mod marks;
mod plan;
mod reactions;
mod recovery;
mod scenario;
mod slips;
mod table;
mod toolbox;

use std::cell::{Cell, OnceCell};
use std::collections::{BTreeMap, BTreeSet};

use rowan::{Checkpoint, GreenNode, GreenNodeBuilder, Language};

use crate::diagnostics::{Code, Diagnostic, Diagnostics, Message};
use crate::kind::{Afp, Kind};
use crate::lexer::Token;
use crate::source::Span;
use known::{Names, uses};
use marks::Marks;

/// Maximum depth of brackets and signs in formulas and skipped text.
const MAX_DEPTH: usize = 64;

pub(super) fn parse(mut tokens: Vec<Token<'_>>, file: u16, diags: &mut Diagnostics) -> GreenNode {
    let of_lexer = |code| matches!(code, Code::E0101 | Code::E0113);
    let foreign = diags.iter().filter(|it| it.span.file == file && of_lexer(it.code));
    let foreign = foreign.map(|it| it.span.start).collect();
    let mended = braces::mend(&mut tokens, file, diags);
    let mut parser = Parser::new(&tokens, file, diags);
    parser.foreign = foreign;
    parser.note_reported(&mended.reported);
    (parser.balanced, parser.balanced_as_written) = (mended.balanced, mended.as_written);
    parser.file();
    parser.withdraw_fixes();
    parser.drop_superseded();
    parser.builder.finish()
}

struct Parser<'t, 'd> {
    tokens: &'t [Token<'t>],
    /// The indices of the tokens that are read.
    solid: Vec<u32>,
    /// The index of the next token in `solid`.
    at: usize,
    /// The index of the next token in `tokens` that is not yet in the tree.
    built: usize,
    file: u16,
    /// The depth of brackets and signs here.
    depth: usize,
    /// Whether the preceding item is outside of a plan and reported.
    misplaced: bool,
    /// Whether all braces match, so that none is missing.
    balanced: bool,
    /// Whether all braces match without repairs.
    balanced_as_written: bool,
    /// Whether the file is a toolbox, as far as it has been read.
    is_toolbox: bool,
    /// Whether a scenario is being read.
    in_scenario: bool,
    /// Whether a comma here separates two formulas, so that it is not a decimal comma.
    commas_separate: bool,
    /// Whether the bounds of a range are being read.
    in_range: bool,
    /// The place of the current plan in `solid`.
    plan: usize,
    /// The names of all plans, found for the first message that needs them.
    known: OnceCell<BTreeMap<usize, Names<'t>>>,
    no_names: Names<'t>,
    /// The names with '-' in them.
    hyphens: BTreeSet<String>,
    /// The last element, template and state or event, for help texts.
    element: &'t str,
    template: &'t str,
    event: &'t str,
    /// The last entry of the type `int`.
    int: &'t str,
    /// Whether the file uses `std`, and whether it uses `carbot`.
    has_std: bool,
    has_carbot: bool,
    /// The places of signs of other languages, and of those among them that belong to a habit.
    foreign: BTreeSet<u32>,
    superseded: Vec<(u32, u32)>,
    /// Whether an item of the file is a part of a program in another language, and reported.
    is_foreign: bool,
    marks: Marks,
    /// The index in `solid` of a token that is read as another word.
    slip: Option<(usize, &'static str)>,
    /// The first and the last of the comma-separated names that were last searched.
    names: Cell<(usize, usize)>,
    /// The ends of lines with an error that precedes the grammar, each with its place.
    reported: BTreeMap<u32, u32>,
    /// The ends of lines with an error that is not reported.
    hidden: BTreeSet<u32>,
    /// The beginning of the line after the last error: errors before it are its consequences.
    quiet: u32,
    /// Like the last field, for a wrong arrow, which hides only other messages.
    behind_arrow: u32,
    builder: GreenNodeBuilder<'static>,
    diags: &'d mut Diagnostics,
}

impl<'t, 'd> Parser<'t, 'd> {
    fn new(tokens: &'t [Token<'t>], file: u16, diags: &'d mut Diagnostics) -> Parser<'t, 'd> {
        let mut solid = Vec::with_capacity(tokens.len());
        let indexed = (0..).zip(tokens).filter(|(_, token)| !token.kind.is_passed_over());
        solid.extend(indexed.map(|(index, _)| index));
        let (marks, builder) = (Marks::new(tokens, &solid), GreenNodeBuilder::new());
        Parser {
            tokens,
            plan: usize::MAX,
            known: OnceCell::new(),
            no_names: Names::default(),
            solid,
            at: 0,
            built: 0,
            file,
            depth: 0,
            misplaced: false,
            balanced: false,
            balanced_as_written: false,
            is_toolbox: false,
            in_scenario: false,
            commas_separate: false,
            in_range: false,
            hyphens: BTreeSet::new(),
            element: "terminate",
            template: "",
            event: "",
            int: "n",
            has_std: uses(tokens, "std"),
            has_carbot: uses(tokens, "carbot"),
            foreign: BTreeSet::new(),
            is_foreign: false,
            superseded: Vec::new(),
            marks,
            slip: None,
            names: Cell::new((1, 0)),
            reported: BTreeMap::new(),
            hidden: BTreeSet::new(),
            quiet: 0,
            behind_arrow: 0,
            builder,
            diags,
        }
    }

    // Look-ahead.

    /// The index of a token ahead; at the end, the last token.
    fn token_index(&self, ahead: usize) -> usize {
        self.solid.get(self.at + ahead).map_or(self.tokens.len(), |index| *index as usize)
    }

    fn token(&self, ahead: usize) -> Option<Token<'t>> {
        self.tokens.get(self.token_index(ahead)).copied()
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
        match (self.token(ahead), self.slip) {
            (_, Some((at, meant))) if at == self.at + ahead => meant,
            (Some(token), _) if token.kind == Kind::Name => token.text,
            _ => "",
        }
    }

    fn before(&self) -> Option<Token<'t>> {
        let before = self.solid.get(self.at.checked_sub(1)?)?;
        self.tokens.get(*before as usize).copied()
    }

    /// The word before the next token.
    fn word_before(&self) -> &'t str {
        self.before().map_or("", |token| token.text)
    }

    /// The names of the current plan.
    fn known(&self) -> &Names<'t> {
        let all = self.known.get_or_init(|| known::names(self.tokens, &self.solid));
        all.get(&self.plan).unwrap_or(&self.no_names)
    }

    /// Whether the next token is this word as a keyword. Before `:`, `=`, `=>` and `->` every word
    /// is a name.
    fn at_word(&self, word: &str) -> bool {
        self.word(0) == word && !self.names_something(0)
    }

    fn names_something(&self, ahead: usize) -> bool {
        matches!(self.nth(ahead + 1), Kind::Colon | Kind::Equal | Kind::FatArrow | Kind::Arrow)
    }

    /// Whether the next token is on the same line as the token before it.
    fn on_same_line(&self) -> bool {
        self.at == 0 || !self.begins_line(0)
    }

    /// Whether a token ahead is on another line than the token before it.
    fn begins_line(&self, ahead: usize) -> bool {
        let before = (self.at + ahead).checked_sub(1).and_then(|before| self.solid.get(before));
        let from = before.map_or(0, |before| *before as usize + 1);
        self.tokens[from..self.token_index(ahead)].iter().any(Token::ends_line)
    }

    /// The number of tokens before a brace of a kind on this line.
    fn ahead_on_line(&self, kind: Kind) -> Option<usize> {
        self.on_line_from(0, kind)
    }

    /// The number of tokens before a brace of a kind, if no line begins from the given token on.
    fn on_line_from(&self, ahead: usize, kind: Kind) -> Option<usize> {
        let from = self.at + ahead;
        let found = self.marks.brace(kind, from)?;
        let before = from.checked_sub(1).and_then(|before| self.solid.get(before));
        let end = before.map_or(0, |before| self.span_of(self.tokens[*before as usize]).end);
        let start = self.token(found - self.at)?.start;
        self.marks.newline(end).is_none_or(|newline| newline >= start).then_some(found - self.at)
    }

    /// Whether the next token has no white space before it.
    fn is_adjacent(&self) -> bool {
        self.at < self.solid.len() && self.token_index(0) == self.built
    }

    // Spans.

    fn span_of(&self, token: Token<'_>) -> Span {
        token.span(self.file)
    }

    /// The span of the next token; at the end of a line or file the empty span after the last
    /// token.
    fn here(&self) -> Span {
        match self.token(0) {
            Some(token) if self.on_same_line() => self.span_of(token),
            _ => self.behind(),
        }
    }

    /// The span of the next token, on any line.
    fn next_span(&self) -> Span {
        self.token(0).map_or_else(|| self.behind(), |token| self.span_of(token))
    }

    /// The empty span after the last token.
    fn behind(&self) -> Span {
        self.before()
            .map_or(Span { file: self.file, start: 0, end: 0 }, |token| self.span_of(token).after())
    }

    /// The span from one token to the token before another.
    fn place_between(&self, first: usize, end: usize) -> Span {
        let span = |at: usize| self.solid.get(at).map(|at| self.span_of(self.tokens[*at as usize]));
        let first = span(first).unwrap_or_else(|| self.behind());
        end.checked_sub(1).and_then(span).map_or(first, |last| first.to(last))
    }

    /// The text of these tokens, with the text between them.
    fn text_between(&self, first: usize, end: usize) -> String {
        let last =
            end.checked_sub(1).filter(|last| *last >= first).and_then(|at| self.solid.get(at));
        let (Some(first), Some(last)) = (self.solid.get(first), last) else { return String::new() };
        let tokens = &self.tokens[*first as usize..=*last as usize];
        tokens.iter().map(|token| token.text).collect()
    }

    /// The text from one token ahead to the token before another.
    fn text_of(&self, first: usize, end: usize) -> String {
        self.text_between(self.at + first, self.at + end)
    }

    fn found(&self) -> Message {
        self.found_at(0)
    }

    fn found_at(&self, ahead: usize) -> Message {
        found(self.token(ahead))
    }

    // Building the tree.

    fn emit(&mut self, kind: Kind, text: &str) {
        // A missing brace has no text.
        if text.is_empty() {
            return;
        }
        self.builder.token(Afp::kind_to_raw(kind), text);
    }

    /// Adds everything before the next token to the tree.
    fn trivia(&mut self) {
        let to = self.token_index(0);
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

    /// Reads adjacent tokens as one.
    fn bump_together(&mut self, tokens: usize, kind: Kind) {
        self.trivia();
        let taken = self.tokens.get(self.built..self.built + tokens).unwrap_or_default();
        let text: String = taken.iter().map(|token| token.text).collect();
        self.emit(kind, &text);
        self.built += taken.len();
        self.at += taken.len();
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

    /// Runs a rule that repeats. If it reads nothing, skips a token, so that every repetition ends.
    fn repeat(&mut self, rule: impl FnOnce(&mut Self)) {
        let before = self.at;
        rule(self);
        if self.at == before {
            self.open(Kind::Error);
            self.bump();
            self.close();
        }
    }

    /// Opens an item. Help text and comments directly above it belong to it.
    fn open_item(&mut self, kind: Kind) {
        let to = self.token_index(0);
        let own = own_trivia(&self.tokens[self.built..to]);
        self.trivia_to(self.built + own, false);
        self.builder.start_node(Afp::kind_to_raw(kind));
        self.trivia_to(to, true);
    }

    /// Closes an item. A comma and a comment on its last line belong to it.
    fn close_item(&mut self) {
        self.eat(Kind::Comma);
        let to = self.token_index(0);
        let mut own = self.built;
        for index in self.built..to {
            match self.tokens[index].kind {
                Kind::Comment => own = index + 1,
                Kind::Whitespace if !self.tokens[index].ends_line() => continue,
                _ => {}
            }
            break;
        }
        self.trivia_to(own, false);
        self.close();
    }
}

/// The number of trivia before an item that do not belong to it: everything up to the last blank
/// line, unless help text precedes that.
fn own_trivia(trivia: &[Token<'_>]) -> usize {
    let is_blank_line = |token: &Token<'_>| token.kind == Kind::Whitespace && token.breaks > 1;
    let after_blank = trivia.iter().rposition(is_blank_line).map_or(0, |index| index + 1);
    let help = trivia.iter().position(|token| token.kind == Kind::Doc).unwrap_or(trivia.len());
    let before_help = trivia[..help].iter().rposition(is_blank_line).map_or(0, |index| index + 1);
    if help < after_blank { before_help } else { after_blank }
}

/// The message about an unexpected token.
fn found(token: Option<Token<'_>>) -> Message {
    token.map_or_else(|| "the end of the file".into(), |token| token.shown())
}
