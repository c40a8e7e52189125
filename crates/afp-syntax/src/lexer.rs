//! Splits source text into tokens.
//!
//! Every byte of any text belongs to exactly one token. A unit is a token only after a number on
//! the same line, so that `20 cm/s` is a speed and `20 cm / s` divides.

mod foreign;
mod unit;

use afp_excerpt::hidden::{Trick, hidden, trick};
use afp_types::number_length;

use crate::diagnostics::{Code, Diagnostic, Diagnostics, Message, Words};
use crate::kind::Kind;
use crate::message;
use crate::source::Span;

/// A piece of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'t> {
    pub kind: Kind,
    pub text: &'t str,
    /// Its first byte in the file.
    pub start: u32,
    /// The number of line breaks in it, at most two.
    pub breaks: u8,
}

impl Token<'_> {
    /// Whether the token after it is on another line than the token before it.
    pub(super) fn ends_line(&self) -> bool {
        self.breaks > 0
    }

    pub(super) fn span(&self, file: u16) -> Span {
        let end = self.start + u32::try_from(self.text.len()).unwrap_or(0);
        Span { file, start: self.start, end }
    }

    /// Its text in quotes, shortened if it is long.
    pub(super) fn shown(&self) -> Message {
        message!("'{}'", self.text.chars().take(30).collect::<String>())
    }
}

/// Splits `text` into tokens, trivia included.
pub(super) fn lex<'t>(text: &'t str, file: u16, diags: &mut Diagnostics) -> Vec<Token<'t>> {
    // Files have about this number of tokens; the capacity avoids repeated copies.
    let tokens = Vec::with_capacity(text.len() / 3);
    let mut lexer = Lexer {
        text,
        at: 0,
        file,
        tokens,
        diags,
        line: Line::default(),
        unclosed_comment: false,
        endless: false,
    };
    while lexer.at < text.len() {
        lexer.token();
    }
    lexer.report_hidden();
    lexer.tokens
}

struct Lexer<'t, 'd> {
    text: &'t str,
    at: usize,
    file: u16,
    tokens: Vec<Token<'t>>,
    diags: &'d mut Diagnostics,
    line: Line,
    unclosed_comment: bool,
    /// Whether no comment ends in the rest of the text.
    endless: bool,
}

/// Facts about the current line. A file may be one line, which is then searched once and not for
/// each token.
#[derive(Clone, Copy, Default)]
struct Line {
    start: usize,
    /// Its end, without the line break; the first byte after `start` until it is known.
    end: usize,
    /// No quote of another language ends a string before this byte.
    unquoted: usize,
    /// The next sign of a plan's text, or the end of the line; `None` until it is searched.
    sign: Option<usize>,
}

impl<'t> Lexer<'t, '_> {
    fn token(&mut self) {
        let rest = &self.text[self.at..];
        let Some(first) = rest.bytes().next() else { return };
        match Class::of(first) {
            Class::Digit => self.number(),
            Class::Letter => self.word(),
            Class::Blank => {
                self.push(Kind::Whitespace, blank_length(rest));
            }
            Class::Sign => self.sign(rest),
            Class::Foreign => self.foreign_character(rest),
        }
    }

    /// A token that begins with an ASCII sign.
    fn sign(&mut self, rest: &str) {
        match rest.as_bytes() {
            [b'"', ..] => self.quoted(),
            [b'/', b'*', ..] => self.block_comment(),
            [b'/', b'/', ..] => self.comment(),
            _ if self.is_version_mark() => self.version_mark(),
            _ => match (self.comment_sign(), sign(rest)) {
                (Some(sign), _) => self.foreign_comment(sign),
                (None, Some((kind, length))) => {
                    self.push(kind, length);
                }
                (None, None) => self.unknown(),
            },
        }
    }

    /// A token that begins with a non-ASCII character.
    fn foreign_character(&mut self, rest: &str) {
        let Some(first) = rest.chars().next() else { return };
        match first {
            // The mark at the start of a file names its encoding.
            '\u{feff}' if self.at == 0 => {
                self.push(Kind::Whitespace, first.len_utf8());
            }
            _ if is_blank(first) => {
                self.push(Kind::Whitespace, blank_length(rest));
            }
            _ if is_word(first) => self.word(),
            _ => self.unknown(),
        }
    }

    #[inline]
    fn push(&mut self, kind: Kind, length: usize) -> Span {
        let text = &self.text[self.at..self.at + length];
        let span = self.span(self.at, self.at + length);
        let breaks = match kind {
            Kind::Whitespace | Kind::BlockComment => breaks(text),
            // Every other token ends on its own line.
            _ => 0,
        };
        self.tokens.push(Token { kind, text, start: span.start, breaks });
        self.at += length;
        span
    }

    fn line(&mut self) -> Line {
        if self.at >= self.line.end {
            let start = self.text[..self.at].rfind('\n').map_or(0, |end| end + 1);
            let end = self.at + line_length(&self.text[self.at..]);
            self.line = Line { start, end, unquoted: 0, sign: None };
        }
        self.line
    }

    /// The text from here to the line break.
    fn rest_of_line(&mut self) -> &'t str {
        let end = self.line().end;
        self.text.get(self.at..end).unwrap_or_default()
    }

    fn span(&self, start: usize, end: usize) -> Span {
        let offset = |at| u32::try_from(at).unwrap_or(u32::MAX);
        Span { file: self.file, start: offset(start), end: offset(end) }
    }

    fn comment(&mut self) {
        let rest = &self.text[self.at..];
        let length = line_length(rest);
        let doc = rest.starts_with("///") && !rest.starts_with("////");
        self.push(if doc { Kind::Doc } else { Kind::Comment }, length);
    }

    fn block_comment(&mut self) {
        let rest = &self.text[self.at..];
        let length = self.nested_comment(rest).or_else(|| self.comment_to_its_end(rest));
        // Without its end, the comment is a line.
        let length = length.unwrap_or_else(|| line_length(rest));
        let text = &rest[..length];
        let inner = text[2..].strip_suffix("*/").unwrap_or(&text[2..]);
        // A line comment contains the rest of its line, so the replacement has a line of its own.
        let follows = rest[length..].trim_start_matches([' ', '\t', '\r']);
        let last = if follows.is_empty() || follows.starts_with('\n') { "" } else { "\n" };
        let lines: Vec<_> =
            inner.lines().map(|line| format!("// {}", line.trim()).trim_end().to_owned()).collect();
        let span = self.push(Kind::BlockComment, length);
        self.diags.push(
            Diagnostic::new(Code::E0105, span, "comments in '/* */' are not part of the language")
                .help("start each line of the comment with '//'")
                .replace(lines.join("\n") + last),
        );
    }

    /// The length of a comment up to the first end of a comment, if there is one.
    fn comment_to_its_end(&mut self, rest: &str) -> Option<usize> {
        let end = rest.get(2..).filter(|_| !self.endless)?.find("*/");
        // No later comment has an end, either.
        self.endless = end.is_none();
        Some(end? + 4)
    }

    /// The length of a comment that may contain comments; `None` if one of them is unclosed.
    fn nested_comment(&mut self, rest: &str) -> Option<usize> {
        let (mut depth, mut at) = (1_usize, 2);
        while depth > 0 && !self.unclosed_comment {
            let Some(next) = rest[at..].find(['/', '*']) else {
                // All later comments are unclosed, too.
                self.unclosed_comment = true;
                break;
            };
            at += next;
            at += match rest.as_bytes()[at..] {
                [b'/', b'*', ..] => {
                    depth += 1;
                    2
                }
                [b'*', b'/', ..] => {
                    depth -= 1;
                    2
                }
                _ => 1,
            };
        }
        (depth == 0).then_some(at)
    }

    fn word(&mut self) {
        let rest = &self.text[self.at..];
        let plain = |byte| matches!(Class::of(byte), Class::Letter | Class::Digit);
        let length = run_of(rest, plain, |each| is_word(each) || each.is_ascii_digit());
        let text = &rest[..length];
        let span = self.push(Kind::Name, length);
        if !text.is_ascii() {
            let message = message!("the name '{}' has characters that are not ASCII", text);
            self.diags
                .push(Diagnostic::new(Code::E0113, span, message).help(foreign::spelled(text)));
        }
    }

    fn number(&mut self) {
        let rest = &self.text[self.at..];
        let length = number_length(rest).max(1);
        let whole = rest[..length].bytes().all(|byte| byte.is_ascii_digit());
        self.push(if whole { Kind::Int } else { Kind::Float }, length);
        self.unit();
    }

    /// A string up to the closing quote, at most to the end of the line.
    fn quoted(&mut self) {
        let line = self.rest_of_line();
        let mut escaped = false;
        for (index, each) in line.char_indices().skip(1) {
            match each {
                _ if escaped => escaped = false,
                '\\' => escaped = true,
                '"' => {
                    self.push(Kind::Text, index + 1);
                    return;
                }
                _ => {}
            }
        }
        // The opening brace of a body does not belong to the string.
        let before_brace = line.trim_end().strip_suffix('{').map(str::trim_end);
        let line = before_brace.map_or(line, |line| match line.rsplit_once(" for ") {
            Some((text, _)) => text,
            None => line,
        });
        let line = foreign::before_bracket(line);
        let joined = self.text_of_lines(line);
        let span = self.push(Kind::Text, line.trim_end().len());
        if let Some((length, text)) = joined {
            let place = Span { end: span.start + u32::try_from(length).unwrap_or(0), ..span };
            let error = Diagnostic::new(Code::E0104, place, "a string cannot span lines");
            self.diags.push(error.write(text));
            self.push(Kind::BlockComment, length - line.trim_end().len());
            return;
        }
        self.diags.push(
            Diagnostic::new(Code::E0104, span, "unterminated string")
                .help("end it with '\"'")
                .fix(span.after(), "\""),
        );
    }

    fn report_hidden(&mut self) {
        for hidden in hidden(self.text) {
            let span = self.span(hidden.span.start, hidden.span.end);
            let behind = self.tokens.partition_point(|token| token.start <= span.start);
            let kind = behind.checked_sub(1).and_then(|at| self.tokens.get(at)).map(|it| it.kind);
            let (help, better) = match (hidden.trick, kind) {
                (Trick::Break, Some(Kind::Text)) => ("write '\\n' for a line break", "\\n"),
                (Trick::Break, Some(Kind::Whitespace | Kind::Unknown)) => {
                    ("end the line with a line feed", "\n")
                }
                (Trick::Break, _) => ("remove it; the text after it belongs to the comment", " "),
                _ => ("remove it", ""),
            };
            let message = message!("'{}' {}", hidden.shown, Words(hidden.fault()));
            let error = Diagnostic::new(Code::E0101, span, message);
            self.diags.push(error.help(help).replace(better));
        }
    }
}

/// Operators and brackets; the longest match wins.
fn sign(text: &str) -> Option<(Kind, usize)> {
    let long = match text.as_bytes() {
        [b'=', b'>', ..] => Some(Kind::FatArrow),
        [b'-', b'>', ..] => Some(Kind::Arrow),
        [b'=', b'=', ..] => Some(Kind::EqualEqual),
        [b'!', b'=', ..] => Some(Kind::NotEqual),
        [b'<', b'=', ..] => Some(Kind::LessEqual),
        [b'>', b'=', ..] => Some(Kind::GreaterEqual),
        _ => None,
    };
    if let Some(kind) = long {
        return Some((kind, 2));
    }
    let kind = match text.bytes().next()? {
        b'(' => Kind::OpenParen,
        b')' => Kind::CloseParen,
        b'{' => Kind::OpenBrace,
        b'}' => Kind::CloseBrace,
        b'[' => Kind::OpenBracket,
        b']' => Kind::CloseBracket,
        b'@' => Kind::At,
        b',' => Kind::Comma,
        b':' => Kind::Colon,
        b'.' => Kind::Dot,
        b'=' => Kind::Equal,
        b'+' => Kind::Plus,
        b'-' => Kind::Minus,
        b'*' => Kind::Star,
        b'/' => Kind::Slash,
        b'%' => Kind::Percent,
        b'^' => Kind::Caret,
        b'|' => Kind::Pipe,
        b'<' => Kind::Less,
        b'>' => Kind::Greater,
        _ => return None,
    };
    Some((kind, 1))
}

fn is_blank(each: char) -> bool {
    each.is_whitespace()
}

fn is_word(each: char) -> bool {
    each == '_' || each.is_alphabetic() && trick(each).is_none()
}

/// The role of a byte at the beginning of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Class {
    /// ASCII white space.
    Blank,
    /// The ASCII beginning of a name.
    Letter,
    Digit,
    /// Any other ASCII character.
    Sign,
    /// The first byte of a non-ASCII character.
    Foreign,
}

impl Class {
    /// The class of every byte. One look-up per byte is faster than comparisons.
    const ALL: [Class; 256] = {
        let mut all = [Class::Sign; 256];
        let mut byte = 0;
        while byte < all.len() {
            all[byte] = match byte as u8 {
                b' ' | b'\t'..=b'\r' => Class::Blank,
                b'a'..=b'z' | b'A'..=b'Z' | b'_' => Class::Letter,
                b'0'..=b'9' => Class::Digit,
                0x80.. => Class::Foreign,
                _ => Class::Sign,
            };
            byte += 1;
        }
        all
    };

    fn of(byte: u8) -> Class {
        Class::ALL[usize::from(byte)]
    }
}

/// The length in bytes of the white space at the start.
fn blank_length(text: &str) -> usize {
    run_of(text, |byte| Class::of(byte) == Class::Blank, is_blank)
}

/// The length in bytes of the matching characters at the start.
fn run(text: &str, fits: impl Fn(char) -> bool) -> usize {
    run_of(text, |byte| byte.is_ascii() && fits(char::from(byte)), &fits)
}

/// Like [`run`], but `plain` decides for ASCII bytes.
fn run_of(text: &str, plain: impl Fn(u8) -> bool, fits: impl Fn(char) -> bool) -> usize {
    // Nearly all text is ASCII and needs no decoding.
    let plain = text.bytes().take_while(|byte| plain(*byte)).count();
    match text.as_bytes().get(plain) {
        Some(byte) if !byte.is_ascii() => {
            let rest = &text[plain..];
            plain + rest.find(|each| !fits(each)).unwrap_or(rest.len())
        }
        _ => plain,
    }
}

/// The number of line breaks in a text, at most two.
fn breaks(text: &str) -> u8 {
    text.bytes().fold(0, |count, byte| 2.min(count + u8::from(byte == b'\n')))
}

/// The length in bytes up to the line break.
fn line_length(text: &str) -> usize {
    let end = text.find('\n').unwrap_or(text.len());
    text[..end].trim_end_matches('\r').len()
}
