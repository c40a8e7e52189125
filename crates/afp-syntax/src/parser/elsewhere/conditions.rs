//! Conditions of declared computations in the syntax of other languages.

use super::matcher::between;
use crate::diagnostics::{Code, Diagnostic};
use crate::habits::PLAN;
use crate::kind::Kind;
use crate::lexer::Token;
use crate::message;
use crate::parser::Parser;

/// Words that begin a condition in other languages.
const WHEN: &[&str] = &["if", "where", "while", "whenever", "provided"];
/// Words and signs that end a condition in other languages.
const THEN: &[&str] = &["then", "do", ":", "->", "=>"];
/// Words for the state of all other cases.
const REST: &[&str] = &["else", "otherwise", "default"];
/// Signs and words between two comparisons.
const AND: &[&str] = &["and", "&&", "&", ",", "AND"];
const OR: &[&str] = &["or", "|", "xor", "OR"];

impl<'t> Parser<'t, '_> {
    /// Whether 'when' begins a condition after a state. Reports a substitute for 'when'; reports
    /// and skips a condition of another language.
    pub(in crate::parser) fn at_condition(&mut self) -> bool {
        if !self.on_same_line() || self.at(Kind::OpenBrace) {
            return false;
        }
        if REST.contains(&self.word(0)) && self.nth(1) == Kind::OpenBrace {
            let message = "the last state needs no word: it is for all other cases";
            self.instead(1, message, "remove it", "");
            return false;
        }
        let line = self.tokens_of_condition();
        let Some(first) = line.first() else { return false };
        let is_when = self.at_word("when");
        let is_word = is_when || WHEN.contains(&first.text) || self.at_slip("when");
        let inner = &line[usize::from(is_word || first.text == ":")..];
        let compares = inner.iter().any(|token| token.kind.is_comparison());
        if !is_word && !compares {
            return is_when;
        }
        let said = Said::of(inner);
        if said.fault.is_some() || !is_word {
            self.condition_elsewhere(&line, is_word, said);
            return false;
        }
        if !is_when {
            let error = Diagnostic::new(Code::E0102, self.next_span(), NO_WHEN);
            self.error(error.write("when"));
            self.slip = Some((self.at, "when"));
        }
        true
    }

    /// The tokens up to the brace of the body, or to the next part of the template.
    fn tokens_of_condition(&self) -> Vec<Token<'t>> {
        let Some(start) = self.next_written() else { return Vec::new() };
        let mut line = self.written_line(start, PLAN);
        let mut depth = 0_usize;
        let end = line.iter().enumerate().position(|(at, token)| {
            match token.kind {
                Kind::OpenParen | Kind::OpenBracket => depth += 1,
                Kind::CloseParen | Kind::CloseBracket => depth = depth.saturating_sub(1),
                _ => {}
            }
            let name_at = |at: usize| line.get(at).is_some_and(|next| next.kind == Kind::Name);
            let is_part = name_at(at + 1)
                && matches!(
                    token.text,
                    "state" | "event" | "exclusive" | "icon" | "uses" | "needs"
                );
            // The next part may follow a comma; a name cannot follow another one in a condition.
            let ends = token.kind == Kind::Comma && name_at(at + 1) && name_at(at + 2);
            depth == 0 && (token.kind == Kind::OpenBrace || is_part || ends)
        });
        line.truncate(end.unwrap_or(line.len()));
        line
    }

    /// Reports and skips a condition of another language.
    fn condition_elsewhere(&mut self, line: &[Token<'t>], is_word: bool, said: Said) {
        let (Some(first), Some(last)) = (line.first(), line.last()) else { return };
        let here = self.span_of(*first).to(self.span_of(*last));
        let error = |message| Diagnostic::new(Code::E0102, here, message);
        let space = if first.text == ":" { " " } else { "" };
        self.supersede(here);
        self.error(match said {
            Said { fault, write: Ok(text) } => {
                let better = format!("when {text}");
                let error = error(fault.filter(|_| is_word).unwrap_or(NO_WHEN));
                error.help(message!("write '{}'", better)).fix(here, format!("{space}{better}"))
            }
            Said { fault, write: Err(help) } => error(fault.unwrap_or(NO_WHEN)).help(help),
        });
        self.pass_to(|p| p.token(0).is_none_or(|token| token.start >= here.end));
    }
}

const NO_WHEN: &str = "a condition begins with 'when'";
const NO_SIGN: &str = "a condition compares two values";

/// The error of a condition.
struct Said {
    /// The first fault, if there is one.
    fault: Option<&'static str>,
    /// The condition in the words of the language, or the help if there is none.
    write: Result<String, &'static str>,
}

impl Said {
    fn of(tokens: &[Token<'_>]) -> Said {
        let mut tokens = tokens.to_vec();
        let mut faults = Vec::new();
        while tokens.last().is_some_and(|last| THEN.contains(&last.text)) {
            tokens.pop();
            faults.push("the body follows the condition directly");
        }
        let negates = |pair: &[Token<'_>]| {
            matches!(pair[0].text, "not" | "!") && pair[1].kind == Kind::OpenParen
        };
        if tokens.windows(2).any(negates) {
            let help = "write the opposite comparison, such as '>=' for '<'";
            return Said { fault: Some("a condition has no 'not'"), write: Err(help) };
        }
        if without_brackets(&mut tokens) {
            faults.push("a comparison has no brackets around it");
        }
        if split(&tokens, OR).len() > 1 {
            let help = "write a state for each side, with the same body";
            return Said { fault: Some("a condition has no 'or'"), write: Err(help) };
        }
        let sides = split(&tokens, AND);
        if sides.len() > split(&tokens, &["and"]).len() {
            faults.push("comparisons are joined by 'and'");
        }
        let parts: Vec<_> = sides.into_iter().map(|side| comparison(side, &mut faults)).collect();
        Said { fault: faults.first().copied(), write: Ok(parts.join(" and ")) }
    }
}

/// The parts between signs that are outside of brackets.
fn split<'a, 't>(tokens: &'a [Token<'t>], signs: &[&str]) -> Vec<&'a [Token<'t>]> {
    let mut depth = 0_usize;
    let parts = tokens.split(|token| {
        match token.kind {
            Kind::OpenParen => depth += 1,
            Kind::CloseParen => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0 && signs.contains(&token.text)
    });
    parts.filter(|part| !part.is_empty()).collect()
}

/// Removes the brackets around comparisons. Returns whether there are some.
fn without_brackets(tokens: &mut Vec<Token<'_>>) -> bool {
    let (mut open, mut around) = (Vec::new(), Vec::new());
    for (at, token) in tokens.iter().enumerate() {
        let joins = AND.contains(&token.text) && token.kind != Kind::Comma;
        match token.kind {
            Kind::OpenParen | Kind::OpenBracket => open.push((at, token.kind == Kind::OpenBracket)),
            Kind::CloseParen | Kind::CloseBracket => {
                if let Some((from, true)) = open.pop() {
                    around.extend([from, at]);
                }
            }
            _ if token.kind.is_comparison() || joins || OR.contains(&token.text) => {
                open.iter_mut().for_each(|(_, compares)| *compares = true);
            }
            _ => {}
        }
    }
    let mut places = 0..;
    tokens.retain(|_| places.next().is_some_and(|at| !around.contains(&at)));
    !around.is_empty()
}

/// One comparison in the words of the language.
fn comparison(tokens: &[Token<'_>], faults: &mut Vec<&'static str>) -> String {
    let texts: Vec<_> = tokens.iter().map(|token| token.text).collect();
    let signs = (0..tokens.len()).filter(|at| tokens[*at].kind.is_comparison());
    let signs: Vec<_> = signs.collect();
    let is = texts.iter().position(|text| matches!(*text, "is" | "equals" | "eq"));
    match (&texts[..], &signs[..]) {
        (["not" | "!", name], _) if tokens[1].kind == Kind::Name => {
            faults.push(NO_SIGN);
            format!("{name} == false")
        }
        ([name], _) if tokens[0].kind == Kind::Name && !matches!(*name, "true" | "false") => {
            faults.push(NO_SIGN);
            format!("{name} == true")
        }
        (_, []) if let Some(is) = is.filter(|is| *is > 0) => {
            faults.push("two values are compared with '=='");
            let is_not = texts.get(is + 1) == Some(&"not");
            let right = is + 1 + usize::from(is_not);
            let sign = if is_not { "!=" } else { "==" };
            format!("{} {sign} {}", between(&tokens[..is]), between(&tokens[right..]))
        }
        (_, [first, second]) if *second > first + 1 && second + 1 < tokens.len() => {
            faults.push("a comparison has two sides");
            let (left, right) = tokens.split_at(*second);
            let middle = between(&left[first + 1..]);
            format!("{} and {middle} {}", between(left), between(right))
        }
        _ => between(tokens),
    }
}
