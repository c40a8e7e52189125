//! Compares tokens with the pattern of a habit.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use crate::habits::{FILE, HABITS, Habit, PLAN, Places, TEMPLATE, english, is_foreign_for};
use crate::kind::Kind;
use crate::lexer::Token;
use crate::units::Unit;

/// Whether a name begins with a capital letter, as states and templates do.
pub(in crate::parser) fn is_large(name: &str) -> bool {
    name.starts_with(|first: char| first.is_ascii_uppercase())
}

/// The quotes of strings, and those of other languages.
pub(in crate::parser) const QUOTES: [char; 3] = ['"', '\'', '`'];

/// Whether a token is text of a plan, and not a comment or white space.
pub(super) fn is_written(token: &Token<'_>) -> bool {
    !token.kind.is_trivia() && !token.text.is_empty()
}

/// The habits by the first words of their patterns, each in the order of the table. A file with
/// many errors needs them for each line.
static BY_FIRST: LazyLock<BTreeMap<&'static str, Vec<usize>>> = LazyLock::new(|| {
    let mut first: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for (index, habit) in HABITS.iter().enumerate() {
        let is_optional = |part: &&str| part.split('|').any(str::is_empty);
        let optional = habit.pattern.split(' ').take_while(is_optional).count();
        let parts = habit.pattern.split(' ').take(optional + 1);
        for word in parts.flat_map(|part| part.split('|')).filter(|word| !word.is_empty()) {
            first.entry(word).or_default().push(index);
        }
    }
    first
});

/// Where words of a pattern match in any case of letters: no name of a state can be there.
pub(super) const ANY_CASE: Places = FILE | PLAN | TEMPLATE;

/// The habits of a place with patterns that may begin with a token, in the order of the table.
pub(super) fn beginning(token: &str, place: Places) -> Vec<&'static Habit> {
    let is_name = token.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_');
    let classes: &[_] = match is_name {
        true if is_large(token) => &["NAME", "ENTRY", "STATE"],
        true => &["NAME", "ENTRY"],
        false if token == "^" => &["POWER"],
        false if token == "|" => &["PIPE"],
        false if token.len() > 2 && token.starts_with(QUOTES) => &["TEXT"],
        false => &[],
    };
    let small = token.to_ascii_lowercase();
    let small = Some(&*small).filter(|small| place & ANY_CASE != 0 && *small != token);
    let words = [Some(token), small, english(token)].into_iter().flatten();
    let words = words.chain(classes.iter().copied());
    let all = words.filter_map(|word| BY_FIRST.get(word)).flatten().copied();
    let mut found: Vec<usize> = all.filter(|index| HABITS[*index].at & place != 0).collect();
    found.sort_unstable();
    found.dedup();
    found.into_iter().map(|index| &HABITS[index]).collect()
}

pub(super) struct Matcher<'l, 't> {
    pub line: &'l [Token<'t>],
    pub entries: &'l BTreeMap<&'t str, &'t str>,
    pub captures: Vec<String>,
    pub next: Option<usize>,
    pub is_formula: bool,
    pub any_case: bool,
}

impl Matcher<'_, '_> {
    /// The token after the pattern, if the pattern matches from a token on.
    pub fn matches(&mut self, pattern: &str, mut at: usize) -> Option<usize> {
        let mut rest = pattern.trim_end();
        while !rest.is_empty() {
            let (part, behind) = rest.split_once(' ').unwrap_or((rest, ""));
            if part != ";" && self.text(at) == ";" && !self.is_formula {
                at += 1;
                continue;
            }
            at = match part {
                "^" => {
                    self.next = Some(at);
                    at
                }
                ".." => return self.anything(behind, at),
                _ => self.part(part, at)?,
            };
            rest = behind;
        }
        Some(at)
    }

    /// Any tokens; the shortest match counts.
    fn anything(&mut self, behind: &str, from: usize) -> Option<usize> {
        if matches!(self.text(from), "->") {
            return None;
        }
        if behind.is_empty() {
            self.captures.push(self.between(from, self.line.len()));
            return Some(self.line.len());
        }
        let known = self.captures.len();
        let mut depth = 0_usize;
        for at in from..=self.line.len() {
            if depth == 0 {
                self.captures.push(self.between(from, at));
                if let Some(end) = self.matches(behind, at) {
                    return Some(end);
                }
                self.captures.truncate(known);
            }
            match self.text(at) {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth = depth.checked_sub(1)?,
                _ => {}
            }
        }
        None
    }

    fn part(&mut self, part: &str, at: usize) -> Option<usize> {
        let kind = self.line.get(at).map(|token| token.kind);
        let text = self.text(at);
        match part {
            "NAME" if kind == Some(Kind::Name) => self.captures.push(text.to_owned()),
            "STATE" if kind == Some(Kind::Name) && is_large(text) => {
                self.captures.push(text.to_owned());
            }
            "TEXT" if kind == Some(Kind::Text) => {
                self.captures.push(text.trim_matches(QUOTES).to_owned());
            }
            "GOAL" => return self.goal(at),
            "NUM" if matches!(kind, Some(Kind::Int | Kind::Float)) => {
                let behind = self.line.get(at + 1);
                let unit = behind.is_some_and(|token| token.kind == Kind::Unit);
                // `2 seconds`
                let meant = behind.filter(|it| it.kind == Kind::Name && it.text.len() > 1);
                if let Some(meant) = meant.and_then(|token| Unit::meant(token.text)) {
                    self.captures.push(format!("{text} {meant}"));
                    return Some(at + 2);
                }
                self.captures.push(self.between(at, at + 1 + usize::from(unit)));
                return Some(at + 1 + usize::from(unit));
            }
            "ENTRY" if self.entries.contains_key(text) => self.captures.push(text.to_owned()),
            "SAME" => return (self.captures.first()? == text).then_some(at + 1),
            "NAME" | "NUM" | "ENTRY" | "STATE" | "TEXT" => return None,
            _ => {
                let is_it = |each: &str| match each {
                    "NAME" => kind == Some(Kind::Name),
                    "PIPE" => text == "|",
                    "POWER" => text == "^",
                    _ if each.is_empty() => false,
                    _ if self.any_case && each.eq_ignore_ascii_case(text) => true,
                    _ => each == text || kind == Some(Kind::Name) && is_foreign_for(each, text),
                };
                return match part.split('|').any(is_it) {
                    true => Some(at + 1),
                    false => part.split('|').any(str::is_empty).then_some(at),
                };
            }
        }
        Some(at + 1)
    }

    /// `turn`, `'turn'`, `.turn`, `#robot.turn`: the name of a target.
    fn goal(&mut self, mut at: usize) -> Option<usize> {
        if matches!(self.text(at), "#" | ".") {
            at += 1;
        }
        let name = self.text(at).trim_matches(QUOTES);
        let is_name = |name: &str| {
            name.starts_with(|first: char| first.is_ascii_alphabetic())
                && name.bytes().all(|each| each.is_ascii_alphanumeric() || each == b'_')
        };
        let name = name.rsplit(['.', '#']).next().filter(|name| is_name(name))?.to_owned();
        let next = self.text(at + 2).to_owned();
        if self.text(at + 1) == "." && is_name(&next) {
            self.captures.push(next);
            return Some(at + 3);
        }
        self.captures.push(name);
        Some(at + 1)
    }

    fn text(&self, at: usize) -> &str {
        self.line.get(at).map_or("", |token| token.text)
    }

    fn between(&self, from: usize, to: usize) -> String {
        between(self.line.get(from..to).unwrap_or_default())
    }
}

/// The text of tokens, with a space for each gap, without a ';' at the end.
pub(super) fn between(tokens: &[Token<'_>]) -> String {
    let mut text = String::new();
    let mut end = None;
    for token in tokens {
        if end.is_some_and(|end| end < token.start) {
            text.push(' ');
        }
        text += token.text;
        end = u32::try_from(token.text.len()).ok().map(|length| token.start + length);
    }
    text.trim_end_matches(';').trim().to_owned()
}
