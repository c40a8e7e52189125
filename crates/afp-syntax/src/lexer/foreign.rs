//! Signs of other languages and of word processors.
//!
//! The lexer reads each sign as its equivalent in AFP, so that its line has no further errors.

use super::{Lexer, Line, is_blank, is_word, line_length, sign};
use crate::diagnostics::{Code, Diagnostic, Message};
use crate::habits::BRANCH;
use crate::kind::Kind;
use crate::message;
use afp_excerpt::hidden::trick;

/// Signs that look like ours, longest first: each with its name and its replacement.
const SIGNS: &[(&str, Kind, &str)] = &[
    ("–>", Kind::Arrow, "->"),
    ("—>", Kind::Arrow, "->"),
    ("−>", Kind::Arrow, "->"),
    ("→", Kind::Arrow, "->"),
    ("⟶", Kind::Arrow, "->"),
    ("➔", Kind::Arrow, "->"),
    ("➜", Kind::Arrow, "->"),
    ("⇒", Kind::FatArrow, "=>"),
    ("⟹", Kind::FatArrow, "=>"),
    ("≤", Kind::LessEqual, "<="),
    ("≥", Kind::GreaterEqual, ">="),
    ("≠", Kind::NotEqual, "!="),
    ("~=", Kind::NotEqual, "!="),
    ("−", Kind::Minus, "-"),
    ("×", Kind::Star, "*"),
    ("·", Kind::Star, "*"),
    ("⋅", Kind::Star, "*"),
    ("÷", Kind::Slash, "/"),
];

/// Opening quotes of other languages, and their closing quotes.
const QUOTES: (&str, &str) = ("'`“”„‟‘’‚«»", "'`“”‟‘’»«");

/// Signs that begin a comment line in other languages.
const COMMENTS: [&str; 3] = ["--", ";", "%"];

/// The maximum number of lines of a string that is read as one.
const MOST_LINES: usize = 8;

/// The beginnings of conflict markers.
const VERSION_MARKS: [&str; 4] = ["<<<<<<<", "|||||||", "=======", ">>>>>>>"];

impl<'t> Lexer<'t, '_> {
    /// Reads characters without a meaning as their likely equivalent.
    pub(super) fn unknown(&mut self) {
        let rest = &self.text[self.at..];
        let hidden = rest.find(|each| trick(each).is_none()).unwrap_or(rest.len());
        if hidden > 0 {
            self.push(Kind::Unknown, hidden);
            return;
        }
        // In other places these mean a minus, a dash and an arrow.
        if let Some(dash) = rest.chars().next().filter(|dash| matches!(dash, '–' | '—'))
            && !rest[dash.len_utf8()..].starts_with('>')
        {
            let error = self.error(Kind::Minus, dash.len_utf8(), "write '-', or '->' for an arrow");
            return self.diags.push(error);
        }
        if let Some((foreign, kind, ours)) = SIGNS.iter().find(|(sign, ..)| rest.starts_with(sign))
        {
            return self.instead(*kind, foreign.len(), message!("write '{}'", ours), ours);
        }
        if let Some(behind) = rest.strip_prefix("#define ") {
            return self.define(&behind[..line_length(behind)]);
        }
        let behind = rest.strip_prefix("#include").map(|behind| behind.chars().next());
        if behind.is_some_and(|next| next.is_none_or(|next| !is_word(next))) {
            return self.include();
        }
        let is_target = self.text[..self.at].trim_end_matches(' ').ends_with("->");
        if rest.starts_with('#') && !is_target && self.begins_comment() {
            return self.foreign_comment("#");
        }
        if let Some((length, inner)) = self.foreign_text() {
            let text = format!("\"{}\"", inner.replace('\\', "\\\\").replace('"', "\\\""));
            return self.instead(Kind::Text, length, "write the string in '\"'", &text);
        }
        let length = rest.find(is_known).unwrap_or(rest.len());
        let length = length.max(rest.chars().next().map_or(1, char::len_utf8));
        let is_power = |each: char| matches!(each, '²' | '³' | '¹' | '⁰' | '⁴'..='⁹' | '⁻');
        let behind_word = self.text[..self.at].ends_with(is_word);
        match &rest[..length] {
            power if power.starts_with(is_power) => {
                const POWER: &str = "write a product such as 'x * x', or a unit such as 'm/s^2'";
                let error = self.error(Kind::Unknown, length, POWER);
                self.diags.push(error);
            }
            "?" if behind_word => self.instead(Kind::Unknown, length, "remove it", ""),
            "!" if let Some(start) = self.only_word_of_line("expect") => {
                let place = self.span(start, self.at + length);
                let error = self.error(Kind::Unknown, length, "write 'never' instead of 'expect'");
                self.diags.push(error.fix(place, "never "));
            }
            "&&" | "&" if self.begins_claim() => {
                let error =
                    self.error(Kind::Unknown, length, "write two lines, each with one claim");
                self.diags.push(error);
            }
            "&&" | "&" | "!" | "?" => {
                let error = self.error(Kind::Unknown, length, BRANCH);
                self.diags.push(error.elsewhere(BRANCH));
            }
            "#" => {
                self.instead(Kind::Unknown, length, "remove it, or start a comment with '//'", "")
            }
            _ => self.instead(Kind::Unknown, length, "remove it", ""),
        }
    }

    /// The start of the only word between the beginning of this line and here.
    fn only_word_of_line(&self, word: &str) -> Option<usize> {
        let before = self.text[..self.at].trim_end_matches([' ', '\t']).strip_suffix(word)?;
        let is_first = before.trim_end_matches([' ', '\t']).ends_with('\n');
        is_first.then_some(before.len())
    }

    /// A string that ends on one of the next lines, after words only: its length, and its text on
    /// one line.
    pub(super) fn text_of_lines(&self, line: &str) -> Option<(usize, String)> {
        let (mut at, mut text) = (self.at + line.len(), line.trim_end().to_owned());
        for _ in 0..MOST_LINES {
            let behind = self.text.get(at..)?;
            at += behind.len() - behind.trim_start_matches(['\r', '\n']).len();
            let next = self.text.get(at..at + line_length(self.text.get(at..)?))?;
            let (words, ends) = next.split_once('"').map_or((next, false), |(it, _)| (it, true));
            if words.contains(['{', '}', '(', ')', '=', '>', ':', '/']) {
                return None;
            }
            at += words.len();
            text = format!("{text} {}", words.trim());
            if ends {
                return Some((at + 1 - self.at, text.trim_end().to_owned() + "\""));
            }
        }
        None
    }

    /// Whether this line begins with the word of a claim.
    fn begins_claim(&mut self) -> bool {
        let first = self.text[self.line().start..].split_whitespace().next();
        matches!(first, Some("expect" | "never"))
    }

    /// Whether a comment of another language begins here: no token of plans follows its sign.
    fn begins_comment(&mut self) -> bool {
        let Line { end, sign, .. } = self.line();
        let sign = sign.filter(|sign| *sign >= self.at).unwrap_or_else(|| {
            let next = self.rest_of_line().find(['{', '}', '(', ')', '>', '=', ':']);
            next.map_or(end, |next| self.at + next)
        });
        self.line.sign = Some(sign);
        sign == end
    }

    /// The length of a string in quotes of another language, and its content.
    fn foreign_text(&mut self) -> Option<(usize, &'t str)> {
        let (opening, closing) = QUOTES;
        let line = self.rest_of_line();
        let first = line.chars().next().filter(|first| opening.contains(*first))?;
        if self.at < self.line.unquoted {
            return None;
        }
        let behind = &line[first.len_utf8()..];
        let Some((end, last)) = behind.char_indices().find(|(_, each)| closing.contains(*each))
        else {
            self.line.unquoted = self.line.end;
            return None;
        };
        Some((first.len_utf8() + end + last.len_utf8(), &behind[..end]))
    }

    /// The comment sign of another language at the beginning of a line, if words follow that cannot
    /// be a formula.
    pub(super) fn comment_sign(&mut self) -> Option<&'static str> {
        let rest = &self.text[self.at..];
        let sign = COMMENTS.into_iter().find(|sign| rest.starts_with(sign))?;
        let before = self.text[..self.at].trim_end_matches([' ', '\t']);
        // This test is first, because a line may be long and have only such signs.
        if !before.is_empty() && !before.ends_with('\n') {
            return None;
        }
        let line = self.rest_of_line().get(sign.len()..).unwrap_or_default();
        let is_text = |word: &str| word.chars().all(|each| is_word(each) || each == '\'');
        let mut words = line.split_whitespace();
        let follow = words.next().is_some_and(is_text) && words.next().is_some_and(is_text);
        (line.starts_with(' ') && follow && self.begins_comment()).then_some(sign)
    }

    /// Reads the rest of a line that is a comment in another language.
    pub(super) fn foreign_comment(&mut self, sign: &str) {
        let rest = &self.text[self.at..];
        let length = line_length(rest);
        let text = match sign {
            "#" => rest[..length].trim_start_matches('#'),
            _ => &rest[sign.len()..length],
        };
        let better = format!("//{text}");
        let help = "start the comment with '//'";
        let message = message!("comments do not begin with '{}'", sign);
        let span = self.push(Kind::Comment, length);
        self.diags.push(Diagnostic::new(Code::E0101, span, message).help(help).replace(better));
    }

    /// Whether a line is a conflict marker, as version control and the studio write them.
    pub(super) fn is_version_mark(&self) -> bool {
        let rest = &self.text[self.at..];
        let mut tails = VERSION_MARKS.iter().filter_map(|mark| rest.strip_prefix(mark));
        tails.any(|tail| tail.is_empty() || tail.starts_with([' ', '\r', '\n']))
            && (self.at == 0 || self.text[..self.at].ends_with('\n'))
    }

    /// Reads a conflict marker.
    pub(super) fn version_mark(&mut self) {
        let length = line_length(&self.text[self.at..]);
        let span = self.push(Kind::Comment, length);
        let error = Diagnostic::new(
            Code::E0101,
            span,
            "this line is a conflict marker of a version control system",
        );
        let help = "keep one of the versions between '<<<<<<<' and '>>>>>>>', and remove the other version and the markers";
        self.diags.push(error.elsewhere(help));
    }

    /// `#define LEFT 1`
    fn define(&mut self, what: &str) {
        let (name, value) = what.trim().split_once(' ').unwrap_or((what.trim(), "1"));
        let span = self.push(Kind::Comment, "#define ".len() + what.len());
        let help = message!("write 'const {} = {}' in a plan", name.to_lowercase(), value.trim());
        let message = "'#define' has no meaning here";
        self.diags.push(Diagnostic::new(Code::E0101, span, message).help(help));
    }

    /// `#include "walls.afp"`, `#include <carbot>`
    fn include(&mut self) {
        let rest = &self.text[self.at..];
        let length = line_length(rest);
        let what = rest["#include".len()..length].trim();
        let name = what.trim_matches(['<', '>', '"']);
        let is_name = !name.is_empty() && name.chars().all(is_word);
        let better = match what.starts_with('"') && name.ends_with(".afp") {
            true => Some(format!("use \"{name}\"")),
            false => is_name.then(|| format!("use {name}")),
        };
        let span = self.push(Kind::Comment, length);
        let error = Diagnostic::new(Code::E0101, span, "'#include' has no meaning here");
        self.diags.push(match better {
            Some(better) => error.write(better),
            None => error.help("write 'use' and a toolbox, such as 'use carbot'"),
        });
    }

    /// Reports characters that have a replacement.
    fn instead(&mut self, kind: Kind, length: usize, help: impl Into<Message>, ours: &str) {
        let error = self.error(kind, length, help).replace(ours);
        self.diags.push(error);
    }

    fn error(&mut self, kind: Kind, length: usize, help: impl Into<Message>) -> Diagnostic {
        let shown: String = self.text[self.at..self.at + length].chars().take(20).collect();
        let message = match kind {
            Kind::Text => "a string needs double quotes".into(),
            _ => message!("'{}' has no meaning here", shown.escape_debug().to_string()),
        };
        let span = self.push(kind, length);
        Diagnostic::new(Code::E0101, span, message).help(help)
    }
}

/// An unterminated string up to the first closing bracket that it does not open.
pub(super) fn before_bracket(line: &str) -> &str {
    let mut depth = 0_usize;
    for (at, each) in line.char_indices() {
        match each {
            '(' | '{' => depth += 1,
            ')' | '}' if depth == 0 => return line[..at].trim_end(),
            ')' | '}' => depth -= 1,
            _ => {}
        }
    }
    line
}

/// Returns the help for a name with letters that are not ASCII.
pub(super) fn spelled(name: &str) -> Message {
    let mut better = String::new();
    for each in name.chars() {
        match each {
            'ä' | 'æ' => better += "ae",
            'ö' | 'œ' => better += "oe",
            'ü' => better += "ue",
            'Ä' => better += "Ae",
            'Ö' => better += "Oe",
            'Ü' => better += "Ue",
            'ß' => better += "ss",
            'à'..='å' => better.push('a'),
            'ç' => better.push('c'),
            'è'..='ë' => better.push('e'),
            'ì'..='ï' => better.push('i'),
            'ñ' => better.push('n'),
            'ò'..='õ' | 'ø' => better.push('o'),
            'ù'..='û' => better.push('u'),
            each => better.push(each),
        }
    }
    match better.is_ascii() {
        true => message!("write '{}'", better),
        false => "use the letters a to z and A to Z, digits and '_'".into(),
    }
}

/// Whether a character has a meaning or a replacement.
fn is_known(each: char) -> bool {
    is_blank(each)
        || trick(each).is_some()
        || is_word(each)
        || each.is_ascii_digit()
        || each == '"'
        || each == '#'
        || QUOTES.0.contains(each)
        || sign(each.encode_utf8(&mut [0; 4])).is_some()
        || SIGNS.iter().any(|(foreign, ..)| foreign.starts_with(each))
}
