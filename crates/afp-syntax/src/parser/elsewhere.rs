//! Finds habits of other languages by one table, and reports the plan text for them.

mod blocks;
mod conditions;
mod matcher;
mod meant;
mod words;

use super::Parser;
use super::habits::is_operator;
use crate::diagnostics::{Code, Diagnostic, Words};
use crate::habits::{
    BEHIND, BODY, FILE, Habit, OPERATOR, PLAN, Places, TARGET, TEMPLATE, VALUE, Write, action,
};
use crate::keywords;
use crate::kind::Kind;
use crate::lexer::Token;
use crate::message;
use crate::source::Span;
use matcher::{ANY_CASE, Matcher, beginning, between, is_written};
pub(super) use matcher::{QUOTES, is_large};
use meant::Reads;
use words::{choose, comparison, shown, time, type_of, with_first};

/// The maximum number of tokens that are compared.
const MOST_TOKENS: usize = 64;
/// Templates of `std` in the table.
const OF_STD: &[&str] = &[
    "Assign(",
    "Changed(",
    "Compare(",
    "Count(",
    "CheckTimeout",
    "CheckValue(",
    "Every(",
    "Idle ",
    "Is(",
    "Log(",
    "Wait",
];

/// A habit that was found.
struct Found<'t> {
    habit: &'static Habit,
    captures: Vec<String>,
    /// The tokens that a pattern may use.
    line: Vec<Token<'t>>,
    /// The number of tokens of the pattern, and the index where parsing continues.
    end: usize,
    next: usize,
}

impl<'t> Parser<'t, '_> {
    /// Reports a habit and skips it. Returns whether there is one.
    pub(super) fn habit(&mut self, place: Places) -> bool {
        let Some(found) = self.find_habit(place) else { return false };
        let line = &found.line;
        // The error of another place does not decide where parsing continues.
        let end = match found.habit.write {
            Write::Say(_) | Write::Drop(_) => found.next.min(found.end),
            Write::Edit(_) => found.end,
        };
        let last = end.checked_sub(1).and_then(|last| line.get(last));
        let (Some(&first), Some(last)) = (line.first(), last) else { return false };
        let here = self.span_of(first).to(self.span_of(*last));
        // A ';' at the end of the line belongs to it.
        let behind = line.get(end).filter(|token| token.text == ";");
        let whole = behind.map_or(here, |sign| here.to(self.span_of(*sign)));
        let says = self.filled(found.habit.says, &found, place);
        let error = |says| Diagnostic::new(Code::E0102, whole, message!("{}", Words(says)));
        let error = match found.habit.write {
            Write::Drop(text) => {
                let help = self.filled(text, &found, place);
                error(says).help(message!("{}", Words(help))).fix(whole, "")
            }
            Write::Edit("") => error(says).help("remove it").fix(whole, ""),
            Write::Edit(text) => error(says).write_at(whole, self.filled(text, &found, place)),
            Write::Say(text) => {
                let help = self.filled(text, &found, place);
                let meant = self.no_entry((&says, &help), &found);
                let (says, help) = meant.unwrap_or((says, help));
                let help = self.with_declarations(help, &found);
                error(says).elsewhere(message!("{}", Words(help)))
            }
        };
        if place & PLAN != 0
            && let Some(items) = self.items_ahead(line)
        {
            self.supersede(here);
            self.error(error);
            self.items_in_braces(items);
            return true;
        }
        let next = line.get(found.next).map_or(whole.end, |token| token.start);
        self.supersede(here);
        let error = self.with_block(error, first, place, next);
        // A program of another language has many such items; the first says it.
        let is_program = place & FILE != 0 && found.habit.at & PLAN != 0;
        if !(is_program && self.is_foreign) {
            self.error(error);
        }
        self.is_foreign |= is_program;
        true
    }

    /// A help with the declarations that its plan text needs.
    fn with_declarations(&self, mut help: String, found: &Found<'_>) -> String {
        let entries = &self.known().entries;
        if let Some((_, rest)) = help.split_once("result => ")
            && let Some((name, _)) = rest.split_once(')')
            && !entries.contains_key(name)
            && !help.contains(&format!("var {name}"))
        {
            let declared = format!("declare 'var {name}: int = 0', and ");
            return match help.strip_prefix("remove it, ") {
                Some(rest) => format!("remove it, {declared}{rest}"),
                None => declared + &help,
            };
        }
        let written = found.captures.first().filter(|_| found.habit.pattern.starts_with("ENTRY"));
        let declared = written.and_then(|name| Some((name, entries.get(name.as_str())?)));
        if let Some((name, word @ (&"in" | &"const"))) = declared {
            help = format!("declare '{name}' with 'var', not '{word}', and {help}");
        }
        if let Some(Reads { name, value, .. }) = Reads::of(&help)
            && !entries.contains_key(name)
            && !name.contains('.')
        {
            help = format!("declare 'var {name} = {value}', and {help}");
        }
        if !self.has_std && OF_STD.iter().any(|template| help.contains(template)) {
            help += "; 'use std' at the top";
        }
        help
    }

    /// The habit at this place, unless its line already has an error.
    fn find_habit(&self, place: Places) -> Option<Found<'t>> {
        let start = self.next_written()?;
        if self.tokens.get(start)?.start < self.quiet || !self.explains() {
            return None;
        }
        let word = self.tokens.get(start)?.text;
        let fitting = beginning(word, place);
        if fitting.is_empty() {
            return None;
        }
        let line = self.written_line(start, place);
        let is_formula = place & (VALUE | OPERATOR) != 0;
        let any_case = place & ANY_CASE != 0;
        fitting.into_iter().find_map(|habit| {
            let entries = &self.known().entries;
            let mut matcher = Matcher {
                line: &line,
                entries,
                captures: Vec::new(),
                next: None,
                is_formula,
                any_case,
            };
            let end = matcher.matches(habit.pattern, 0)?;
            let Matcher { captures, next, .. } = matcher;
            if end == 0 {
                return None;
            }
            let line = line.clone();
            Some(Found { habit, captures, line, end, next: next.unwrap_or(end) })
        })
    }

    /// The next token with a text; it may be a sign of another language.
    pub(super) fn next_written(&self) -> Option<usize> {
        let before = self.at.checked_sub(1).and_then(|before| self.solid.get(before));
        let from = before.map_or(0, |before| *before as usize + 1);
        Some(from + self.tokens.get(from..)?.iter().position(is_written)?)
    }

    /// The tokens from an index to the end of its line; brackets and braces may span lines.
    fn written_line(&self, start: usize, place: Places) -> Vec<Token<'t>> {
        let (mut line, mut depth) = (Vec::new(), 0_usize);
        for token in self.tokens.get(start..).unwrap_or_default() {
            if depth == 0 && token.ends_line() || line.len() == MOST_TOKENS {
                break;
            }
            match token.kind {
                Kind::OpenBrace | Kind::OpenParen | Kind::OpenBracket => depth += 1,
                Kind::CloseBrace | Kind::CloseParen | Kind::CloseBracket if depth == 0 => break,
                Kind::CloseBrace | Kind::CloseParen | Kind::CloseBracket => depth -= 1,
                Kind::Comma if depth == 0 && place & (VALUE | OPERATOR) != 0 => break,
                _ => {}
            }
            if is_written(token) {
                line.push(*token);
            }
        }
        line
    }

    /// Whether a habit is in the place of a template and its ports; reports it.
    pub(super) fn habit_of_template(&mut self) -> bool {
        matches!(self.nth(1), Kind::OpenParen | Kind::OpenBrace) && self.habit(TEMPLATE)
    }

    /// Drops the lexer's errors about signs of a habit and of the rest of its line.
    pub(super) fn supersede(&mut self, here: Span) {
        let end = self.next_line(here.end);
        let cause = self.reported_before(here.start);
        if cause.is_some_and(|cause| cause >= here.start && self.foreign.contains(&cause)) {
            self.reported.remove(&self.next_line(here.start));
        }
        if self.foreign.range(here.start..end).next().is_some() {
            match self.superseded.last_mut().filter(|(_, last)| here.start <= *last) {
                Some((_, last)) => *last = end.max(*last),
                None => self.superseded.push((here.start, end)),
            }
        }
    }

    /// Withdraws superseded errors.
    pub(super) fn drop_superseded(&mut self) {
        let (file, ranges) = (self.file, std::mem::take(&mut self.superseded));
        if ranges.is_empty() {
            return;
        }
        self.diags.retain(|each| {
            let start = each.span.start;
            let at = ranges.partition_point(|(from, _)| *from <= start);
            let is_in = at.checked_sub(1).is_some_and(|at| start < ranges[at].1);
            let is_of_lexer = matches!(each.code, Code::E0101 | Code::E0113);
            each.span.file != file || !is_of_lexer || !is_in
        });
    }

    /// `while (true) { actor go: ... }`: the number of tokens before the items in the braces of a
    /// habit.
    fn items_ahead(&self, line: &[Token<'t>]) -> Option<usize> {
        let brace = line.iter().position(|token| token.kind == Kind::OpenBrace)?;
        let first = line.get(brace + 1).filter(|_| self.balanced && self.depth == 0)?;
        let ahead = self.solid.get(self.at..).unwrap_or_default();
        let ahead = ahead.partition_point(|at| self.tokens[*at as usize].start < first.start);
        let is_item = keywords::has(self.word(ahead), keywords::PLAN);
        (is_item && self.nth(ahead + 1) == Kind::Name).then_some(ahead)
    }

    /// Reads the items in the braces of a habit.
    fn items_in_braces(&mut self, ahead: usize) {
        self.pass(ahead);
        self.depth += 1;
        while self.at_plan_item() {
            self.repeat(Self::plan_item);
        }
        self.depth -= 1;
        self.pass_to(|p| p.at(Kind::CloseBrace));
        if self.at(Kind::CloseBrace) {
            self.pass(1);
        }
    }

    /// A sentence of the table with its placeholders replaced.
    fn filled(&self, sentence: &str, found: &Found<'_>, place: Places) -> String {
        let mut text = String::new();
        let mut rest = sentence;
        while let Some(at) = rest.find('{') {
            let (before, behind) = rest.split_at(at);
            text += before;
            let end = behind.find('}').unwrap_or(behind.len());
            let hole = behind.get(1..end).unwrap_or_default();
            if hole.is_empty() || !hole.bytes().all(|it| it.is_ascii_alphanumeric() || it == b':') {
                text.push('{');
                rest = &behind[1..];
                continue;
            }
            text += &self.hole(hole, found, place);
            rest = &behind[end + 1..];
        }
        text + rest
    }

    /// The text of a placeholder.
    fn hole(&self, hole: &str, found: &Found<'_>, place: Places) -> String {
        let parts: Vec<_> = hole.split(':').collect();
        let capture = |at: &str| -> Option<&String> {
            at.parse::<usize>().ok().and_then(|at| found.captures.get(at.checked_sub(1)?))
        };
        let number = |unit: &str| {
            let text = parts.get(1).and_then(|at| capture(at)).map_or("", String::as_str);
            time(text, unit)
        };
        match parts[..] {
            ["word"] => {
                let is_sign = |it: &&Token<'_>| matches!(it.text, "@" | "with" | "using");
                found.line.iter().find(|it| !is_sign(it)).map_or("", |it| it.text).to_owned()
            }
            ["last"] => found.line[..found.end].last().map_or("", |it| it.text).to_owned(),
            ["here"] => self.element.to_owned(),
            ["event"] => self.event.to_owned(),
            ["act", ref part @ ..] => self.act(found, part),
            ["shown", at] => shown(capture(at).map_or("", String::as_str)),
            // Calls count in milliseconds if the number is large.
            ["wait", at] => {
                let number = capture(at).map_or("", String::as_str);
                let is_large = number.parse::<f64>().is_ok_and(|number| number >= 50.0);
                time(number, if is_large { "ms" } else { "s" })
            }
            ["on", event, then] => {
                let names = [event, then].map(|at| capture(at).map_or("", String::as_str));
                self.watch_for(names[0], names[1])
            }
            ["target"] => self.word_before().to_owned(),
            ["template"] => self.template.to_owned(),
            ["left"] if place & OPERATOR != 0 => self.operand_before(),
            ["chosen"] => {
                let end = found.line.iter().position(|token| token.text == "?");
                let right = between(&found.line[..end.unwrap_or(found.end)]);
                let left =
                    if place & OPERATOR == 0 { String::new() } else { self.operand_before() };
                choose(&format!("{left} {right}"), self.element, self.element)
            }
            ["left"] => self.int.to_owned(),
            ["right"] => {
                let next = found.line.get(1).filter(|it| it.kind == Kind::Int);
                next.map_or("3", |token| token.text).to_owned()
            }
            ["state", "here"] => self.state_of(self.element),
            ["state", at] => self.state_of(capture(at).map_or("", String::as_str)),
            ["type", at] => type_of(capture(at).map_or("", String::as_str)),
            ["ms", _] => number("ms"),
            ["s", _] => number("s"),
            ["number", at] => {
                let number = capture(at).map_or("3", String::as_str);
                number.split(' ').next().unwrap_or_default().to_owned()
            }
            // From a capture to the end.
            ["written", at] => {
                let value = found.line.iter().position(|token| token.text == "=");
                let from = value.filter(|_| at == "2").map_or(0, |value| value + 1);
                between(found.line.get(from..found.end).unwrap_or_default())
            }
            ["Large", at] => with_first(capture(at), |first| first.to_ascii_uppercase()),
            ["small", at] => capture(at).map_or_else(String::new, |name| name.to_lowercase()),
            ["left" | "right", at] => {
                let condition = capture(at).map_or("", String::as_str);
                let (left, _, right) = comparison(condition).unwrap_or(("n", ">", "3"));
                if parts[0] == "left" { left.to_owned() } else { right.to_owned() }
            }
            ["choose", at, then] => {
                let then = match then {
                    "here" => self.element,
                    "target" => self.word_before(),
                    at => capture(at).map_or("terminate", String::as_str),
                };
                let condition = capture(at).map_or("", String::as_str);
                choose(condition, then, self.element)
            }
            [at] => capture(at).cloned().unwrap_or_default(),
            _ => String::new(),
        }
    }

    /// The plan text for a call or an action: the text, its name, or a help with it.
    fn act(&self, found: &Found<'_>, part: &[&str]) -> String {
        let is_word = |it: &&Token<'_>| matches!(it.kind, Kind::Name | Kind::Text);
        let words = found.line[..found.end].iter().filter(is_word);
        let text = action(words.map(|word| word.text));
        let text = text.replace("{here}", self.element).replace("{int}", self.int);
        match part {
            ["name"] => text.split([' ', ':']).nth(1).unwrap_or_default().to_owned(),
            ["help"] if text.starts_with("supervise") => format!("write '{text}'"),
            ["help"] => format!("write an element, and lead an edge to it: '{text}'"),
            _ => text,
        }
    }

    /// The first state of an element that has an edge in the file, for help texts.
    fn state_of(&self, element: &str) -> String {
        let token = |at: usize| self.solid.get(at).map(|at| self.tokens[*at as usize]);
        let text = |at: usize| token(at).map_or("", |token| token.text);
        let mut depth = 0_usize;
        let head = (0..self.solid.len()).find(|at| text(*at) == element && text(at + 1) == ":");
        for at in head.unwrap_or(self.solid.len())..self.solid.len() {
            match text(at) {
                "{" => depth += 1,
                "}" if depth <= 1 => break,
                "}" => depth -= 1,
                state if depth == 1 && is_large(state) && text(at + 1) == "->" => {
                    return state.to_owned();
                }
                _ => {}
            }
        }
        "State".to_owned()
    }

    /// Whether a habit follows an arrow or its target; reports it.
    pub(super) fn habit_of_target(&mut self) -> bool {
        self.on_same_line() && self.habit(TARGET)
    }

    /// Whether a habit follows the target; reports it.
    pub(super) fn habit_behind_target(&mut self) {
        let is_foreign = || self.next_written().is_some_and(|at| at < self.token_index(0));
        if self.on_same_line() || is_foreign() {
            self.habit(BEHIND);
        }
    }

    /// Whether a habit is in the place of an edge or of another part of a body; reports it.
    pub(super) fn habit_of_body(&mut self, place: Places) -> bool {
        let is_state = self.word(0).starts_with(|first: char| first.is_ascii_uppercase());
        let is_usual = is_state
            && (self.nth(1) == Kind::Arrow || self.nth(1) == Kind::Comma && self.at_edge())
            || self.at_word("supervise")
            || place == BODY && self.at_head_elsewhere(&["supervise"])
            || self.at_word_before_edge();
        !is_usual && self.habit(place)
    }

    /// Whether a habit follows an operand; reports it.
    pub(super) fn habit_of_operator(&mut self) -> bool {
        let is_foreign = self.next_written().is_some_and(|at| at < self.token_index(0));
        let is_word = self.on_same_line() && !self.names_something(0);
        let is_strange = is_foreign
            || match self.nth(0) {
                Kind::Name => is_word && is_operator(self.word(0)),
                Kind::Pipe | Kind::OpenBracket | Kind::Dot | Kind::Caret => self.on_same_line(),
                kind => kind.is_comparison(),
            };
        is_strange && self.habit(OPERATOR)
    }

    /// Whether a habit begins in the place of an operand; reports it.
    pub(super) fn habit_of_operand(&mut self) -> bool {
        let is_foreign = self.next_written().is_some_and(|at| at < self.token_index(0));
        let is_strange = is_foreign
            || matches!(self.nth(0), Kind::OpenBracket | Kind::Slash)
            || self.at(Kind::OpenBrace) && self.on_same_line()
            || matches!(self.word(0), "if" | "not")
            || self.at(Kind::Name) && matches!(self.nth(1), Kind::OpenParen | Kind::Dot)
            || self.nth(1).is_comparison();
        is_strange && !self.names_something(0) && self.habit(VALUE)
    }
}
