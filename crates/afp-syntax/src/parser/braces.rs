//! Finds missing and surplus braces by indentation, and brackets that are closed twice.
//!
//! The grammar does not depend on white space. But if the braces of a file do not match, the wrong
//! one is usually where the indentation deviates; errors elsewhere are consequences. The tokens are
//! repaired, and the parser reads them as if they were right. Without indentation the parser
//! reports the missing brace.

use super::found;
use crate::diagnostics::{Code, Diagnostic, Diagnostics, Severity};
use crate::keywords::{self, BODY, HEAD, TOOL, TOP};
use crate::kind::Kind;
use crate::lexer::Token;
use crate::message;
use crate::source::Span;

/// The maximum number of braces of a file that are repaired.
const MOST: usize = 16;

/// An error of a brace.
enum Wrong {
    /// A token is a surplus brace.
    Stray(usize),
    /// A closing brace is missing after a token; the other token is its opening brace.
    Missing(usize, usize),
    /// The opening brace of a body is missing after a token.
    Unopened(usize),
    /// A token closes instead of opening.
    Swapped(usize),
}

/// The part of a line that has been read.
#[derive(Clone, Copy)]
struct Line {
    number: usize,
    /// The column of its first token.
    indent: usize,
    /// Whether it begins the head of a body.
    is_head: bool,
    opens: bool,
    /// Its first and last token.
    first: usize,
    last: usize,
}

#[derive(Clone, Copy)]
struct Opened {
    /// Its token.
    at: usize,
    line: Line,
    /// Whether the lines inside are not indented further than its own line; `None` before the first
    /// of them.
    is_flat: Option<bool>,
}

/// Facts about a file before it is parsed.
pub(super) struct Mended {
    /// Places on lines with a reported error, each with the place of that error.
    pub reported: Vec<(u32, u32)>,
    /// Whether all braces match now.
    pub balanced: bool,
    /// Whether all braces match in the source.
    pub as_written: bool,
}

/// Reports missing and surplus braces. A missing brace is added without text; a surplus brace is
/// skipped.
pub(super) fn mend(tokens: &mut Vec<Token<'_>>, file: u16, diags: &mut Diagnostics) -> Mended {
    let is_reported =
        |each: &&Diagnostic| each.span.file == file && each.severity == Severity::Error;
    let starts = diags.iter().filter(is_reported).map(|each| each.span.start);
    let mut reported: Vec<_> = starts.map(|start| (start, start)).collect();
    let (mut strays, before) = (Vec::new(), reported.len());
    for at in doubled(tokens) {
        strays.push((tokens[at].span(file), tokens[at].text));
        reported.push((tokens[at].start, tokens[at].start));
        tokens[at].kind = Kind::Unknown;
    }
    for _ in 0..MOST {
        let Some(wrong) = find(tokens) else { break };
        if let Some((at, brace, sign)) = in_place(&wrong, tokens) {
            let message = message!("expected '{}', found '{}'", sign, tokens[at].text);
            let error = Diagnostic::new(Code::E0102, tokens[at].span(file), message);
            diags.push(error.help(message!("write '{}'", sign)).replace(sign));
            reported.push((tokens[at].start, tokens[at].start));
            tokens[at].kind = brace;
            continue;
        }
        let (behind, error, brace) = match wrong {
            Wrong::Stray(at) | Wrong::Swapped(at) => {
                strays.push((tokens[at].span(file), tokens[at].text));
                reported.push((tokens[at].start, tokens[at].start));
                tokens[at].kind = Kind::Unknown;
                continue;
            }
            Wrong::Missing(behind, opener) => {
                let here = tokens[behind].span(file).after();
                let error = Diagnostic::new(Code::E0103, here, "missing '}'");
                let error = match next(tokens, behind) {
                    // This brace belongs to an enclosing block.
                    Some(brace) if brace.text == "}" => error,
                    other => error.found(found(other)),
                };
                let error = error.help("add '}'").fix(here, "}");
                (behind, error.note(tokens[opener].span(file), "opened here"), Kind::CloseBrace)
            }
            Wrong::Unopened(behind) => {
                let here = tokens[behind].span(file).after();
                let error = Diagnostic::new(Code::E0102, here, "expected '{'");
                let error = error.found(found(next(tokens, behind)));
                (behind, error.help("add '{'").fix(here, " {"), Kind::OpenBrace)
            }
        };
        let start = error.span.start;
        diags.push(error);
        // The following line shows it.
        let finder = tokens[behind + 1..].iter().find(|token| !token.kind.is_trivia());
        let lines = finder.map(|token| token.start).into_iter().chain([start]);
        reported.extend(lines.map(|line| (line, start)));
        tokens.insert(behind + 1, Token { kind: brace, text: "", start, breaks: 0 });
    }
    let is_mended = !strays.is_empty() || reported.len() > before;
    report_strays(strays, diags);
    let (opened, closed) = count(tokens);
    let balanced = opened == closed;
    Mended { reported, balanced, as_written: balanced && !is_mended }
}

/// Reports surplus braces; adjacent ones are one error.
fn report_strays(mut strays: Vec<(Span, &str)>, diags: &mut Diagnostics) {
    strays.sort_by_key(|(span, _)| span.start);
    let side_by_side =
        |one: &(Span, &str), next: &(Span, &str)| one.0.end == next.0.start && one.1 == next.1;
    for group in strays.chunk_by(side_by_side) {
        let [(first, brace), ..] = *group else { continue };
        let place = group.last().map_or(first, |(last, _)| first.to(*last));
        let (message, help) = match group.len() {
            1 => (message!("unmatched '{}'", brace), "remove it"),
            many => (message!("{} unmatched '{}'", many, brace), "remove them"),
        };
        diags.push(Diagnostic::new(Code::E0102, place, message).help(help).replace(""));
    }
}

/// The surplus `)` that follow another one.
fn doubled(tokens: &[Token<'_>]) -> Vec<usize> {
    let (mut open, mut before, mut found) = (0_usize, Kind::End, Vec::new());
    for (at, token) in tokens.iter().enumerate().filter(|(_, it)| !it.kind.is_passed_over()) {
        match token.kind {
            Kind::OpenParen => open += 1,
            Kind::CloseParen if open == 0 && before == Kind::CloseParen => found.push(at),
            Kind::CloseParen => open = open.saturating_sub(1),
            Kind::OpenBrace | Kind::CloseBrace => open = 0,
            _ => {}
        }
        before = token.kind;
    }
    found
}

/// The token of the grammar after another one.
fn next<'t>(tokens: &[Token<'t>], behind: usize) -> Option<Token<'t>> {
    tokens[behind + 1..].iter().copied().find(|token| !token.kind.is_trivia())
}

/// A token in the place of a brace: the kind and the sign of that brace.
fn in_place(wrong: &Wrong, tokens: &[Token<'_>]) -> Option<(usize, Kind, &'static str)> {
    let opens = |at| (at, Kind::OpenBrace, "{");
    match *wrong {
        Wrong::Swapped(at) => Some(opens(at)),
        Wrong::Unopened(at) => (tokens[at].kind == Kind::OpenParen).then(|| opens(at)),
        Wrong::Missing(behind, _) => {
            word_for_a_brace(tokens, behind).map(|at| (at, Kind::CloseBrace, "}"))
        }
        Wrong::Stray(_) => None,
    }
}

/// The word after a token that ends a block in other languages, on a line without other words.
fn word_for_a_brace(tokens: &[Token<'_>], behind: usize) -> Option<usize> {
    let mut solid = (behind + 1..tokens.len()).filter(|at| !tokens[*at].kind.is_trivia());
    let at = solid.next().filter(|at| matches!(tokens[*at].text, "end" | "END" | "fi" | "done"))?;
    let ends_line = tokens.get(at + 1).is_none_or(Token::ends_line);
    ends_line.then_some(at)
}

/// The numbers of opening and of closing braces.
fn count(tokens: &[Token<'_>]) -> (usize, usize) {
    let count = |kind: Kind| tokens.iter().filter(|token| token.kind == kind).count();
    (count(Kind::OpenBrace), count(Kind::CloseBrace))
}

/// The first wrong brace of a file whose braces do not match.
fn find(tokens: &[Token<'_>]) -> Option<Wrong> {
    let (opened, closed) = count(tokens);
    if opened == closed {
        return None;
    }
    let mut reader =
        Reader { tokens, too_many: closed > opened, open: Vec::new(), lines: Vec::new() };
    let (mut number, mut indent, mut last) = (0, 0, None);
    let mut is_first = true;
    for (at, token) in tokens.iter().enumerate() {
        if token.kind.is_passed_over() {
            if let Some((_, line)) = token.text.rsplit_once('\n') {
                number += token.text.matches('\n').count();
                indent = line.len() - line.trim_start().len();
                is_first = true;
            }
            continue;
        }
        if std::mem::take(&mut is_first) {
            let is_head = keywords::has(token.text, HEAD);
            reader.lines.push(Line { number, indent, is_head, opens: false, first: at, last: at });
            if let Some(wrong) = reader.line(at, last) {
                return Some(wrong);
            }
        }
        let wrong = match token.kind {
            Kind::OpenBrace => reader.opening(at),
            Kind::CloseBrace => reader.closing(at, last),
            Kind::Arrow => {
                reader.arrow(at);
                None
            }
            _ => None,
        };
        if wrong.is_some() {
            return wrong;
        }
        if let Some(line) = reader.lines.last_mut() {
            line.last = at;
        }
        last = Some(at);
    }
    None
}

struct Reader<'t, 's> {
    tokens: &'s [Token<'t>],
    /// Whether there are surplus braces instead of missing braces.
    too_many: bool,
    open: Vec<Opened>,
    lines: Vec<Line>,
}

impl Reader<'_, '_> {
    /// Handles a line that begins with a token that closes nothing: it ends bodies that began at
    /// its column or further right, unless their own lines are not indented.
    fn line(&mut self, at: usize, last: Option<usize>) -> Option<Wrong> {
        let line = *self.lines.last()?;
        let Opened { at: opener, line: from, is_flat } = *self.open.last()?;
        let is_right = line.indent > from.indent;
        let is_flat = is_flat
            .unwrap_or_else(|| line.number > from.number && !is_right && self.is_inside(from, at));
        if line.number > from.number {
            self.open.last_mut()?.is_flat = Some(is_flat);
        }
        let is_over = self.tokens[at].kind != Kind::CloseBrace
            && line.number > from.number
            && !is_right
            && !is_flat;
        (is_over && !self.too_many).then(|| Wrong::Missing(last.unwrap_or(opener), opener))
    }

    /// Whether a line begins with the content of the body of a head.
    fn is_inside(&self, head: Line, at: usize) -> bool {
        let mut head = self.tokens[head.first..].iter().filter(|token| !token.kind.is_trivia());
        let (first, third) = (head.next().map_or("", |it| it.text), head.nth(1).map(|it| it.kind));
        let word = self.tokens[at].text;
        let is_tool = keywords::has(word, TOP | TOOL);
        match first {
            "plan" | "scenario" | "enum" | "table" => !keywords::has(word, TOP),
            "device" | "sensor" | "robot" => !is_tool,
            // A template, or an item of a plan.
            "actor" | "supervisor" | "computation" if third == Some(Kind::OpenBrace) => !is_tool,
            _ => !is_tool && !keywords::has(word, BODY),
        }
    }

    fn opening(&mut self, at: usize) -> Option<Wrong> {
        if !self.too_many && !self.can_open(at) {
            return Some(Wrong::Stray(at));
        }
        let line = self.lines.last_mut()?;
        line.opens = true;
        let mut behind = self.tokens[at + 1..].iter().take_while(|token| !token.ends_line());
        // Content on the line of its brace counts as indented.
        let is_flat = behind.any(|token| !token.kind.is_trivia()).then_some(false);
        self.open.push(Opened { at, line: *line, is_flat });
        None
    }

    /// Whether a body may begin with this brace.
    fn can_open(&self, at: usize) -> bool {
        let mut behind = self.tokens[at + 1..].iter();
        let mut ends_line = false;
        let next = behind.find(|token| {
            ends_line |= token.ends_line();
            !token.kind.is_trivia()
        });
        let Some(next) = next.filter(|_| !ends_line) else { return self.stands_behind_head(at) };
        let mut on_line = behind.take_while(|token| !token.ends_line());
        let sign = on_line.find(|token| !token.kind.is_trivia()).map(|token| token.kind);
        match next.kind {
            Kind::CloseBrace => true,
            // The rows of a table.
            Kind::OpenParen => {
                self.lines.last().is_some_and(|line| self.tokens[line.first].text == "table")
            }
            Kind::Name if keywords::has(next.text, BODY) => {
                self.lines.last().is_none_or(|it| it.first != at)
            }
            Kind::Name => {
                matches!(sign, Some(Kind::Arrow | Kind::Comma | Kind::Equal | Kind::Name))
                    || self.is_list(at)
            }
            _ => false,
        }
    }

    /// An element with an arrow after its template has no body.
    fn arrow(&mut self, at: usize) {
        let mut before = self.tokens[..at].iter().rev().filter(|token| !token.kind.is_trivia());
        let kinds = (before.next().map(|it| it.kind), before.next().map(|it| it.kind));
        let is_template =
            matches!(kinds, (Some(Kind::CloseParen), _) | (_, Some(Kind::Colon | Kind::Dot)));
        if let Some(line) = self.lines.last_mut().filter(|line| is_template && !line.opens) {
            line.is_head = false;
        }
    }

    /// Whether a brace has other tokens on its line, or the line before is a head, which may span
    /// several lines.
    fn stands_behind_head(&self, at: usize) -> bool {
        let [.., before, line] = self.lines.as_slice() else { return true };
        let is_end = self.tokens[before.last].kind == Kind::CloseParen;
        line.first != at || before.is_head && !before.opens || is_end
    }

    /// Whether the body has only names.
    fn is_list(&self, at: usize) -> bool {
        let solid: Vec<_> =
            self.tokens[..at].iter().rev().filter(|it| !it.kind.is_trivia()).take(2).collect();
        solid.last().is_some_and(|token| token.text == "enum")
    }

    fn closing(&mut self, at: usize, last: Option<usize>) -> Option<Wrong> {
        let line = *self.lines.last()?;
        let leads = line.last == at;
        let is_deeper = self.open.last().is_none_or(|it| line.indent > it.line.indent);
        if self.too_many
            && leads
            && is_deeper
            && let Some(head) = self.head_without_brace(line)
        {
            return Some(Wrong::Unopened(head));
        }
        if self.too_many && !leads && self.begins_body(line, at) {
            return Some(Wrong::Swapped(at));
        }
        let Some(Opened { at: opener, line: from, .. }) = self.open.pop() else {
            return self.too_many.then_some(Wrong::Stray(at));
        };
        if line.number == from.number {
            return None;
        }
        if self.too_many && (!leads || line.indent > from.indent) {
            let head = self.body_without_brace(line).filter(|_| !leads);
            return Some(head.map_or(Wrong::Stray(at), Wrong::Unopened));
        }
        let is_outer = leads && line.indent < from.indent;
        (is_outer && !self.too_many).then(|| Wrong::Missing(last.unwrap_or(opener), opener))
    }

    /// Whether a closing brace follows a head without a body, and the next line is indented
    /// further.
    fn begins_body(&self, line: Line, at: usize) -> bool {
        let mut behind = self.tokens[at + 1..].iter();
        let Some(space) = behind.next().filter(|token| token.kind.is_trivia()) else {
            return false;
        };
        let Some((_, indent)) = space.text.rsplit_once('\n') else { return false };
        let is_text = behind.next().is_some_and(|token| token.kind == Kind::Name);
        line.is_head && !line.opens && is_text && indent.len() > line.indent
    }

    /// The end of the line at the column of this line, or further right, that this line closes
    /// without an open brace.
    fn head_without_brace(&self, line: Line) -> Option<usize> {
        let before = self.lines.iter().rev().skip(1);
        let mut inside = before.take_while(|other| other.indent >= line.indent);
        let head = inside.find(|other| other.indent == line.indent)?;
        (head.is_head && !head.opens).then_some(head.last)
    }

    /// The token before the first edge of a body on the line of its head, without an opening brace.
    fn body_without_brace(&self, line: Line) -> Option<usize> {
        if !line.is_head || line.opens {
            return None;
        }
        let solid: Vec<usize> =
            (line.first..=line.last).filter(|at| !self.tokens[*at].kind.is_trivia()).collect();
        let edge = solid.windows(2).position(|pair| {
            self.tokens[pair[0]].kind == Kind::Name && self.tokens[pair[1]].kind == Kind::Arrow
        })?;
        solid.get(edge.checked_sub(1)?).copied()
    }
}
