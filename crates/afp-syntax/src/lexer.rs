//! Cuts a text into tokens.
//!
//! Every byte lands in exactly one token, whatever the text is. A unit is a token of its own, taken
//! only behind a number on the same line, so that `20 cm/s` is a speed and `20 cm / s` divides.

mod foreign;
mod unit;

use afp_number::number_length;

use crate::diagnostics::{Code, Diagnostic, Diagnostics};
use crate::kind::Kind;
use crate::source::Span;

/// A piece of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'t> {
    /// What it is.
    pub kind: Kind,
    /// Its text.
    pub text: &'t str,
    /// Where it starts in the file, in bytes.
    pub start: u32,
}

/// Cuts `text` into tokens, trivia included.
pub(super) fn lex<'t>(text: &'t str, file: u16, diags: &mut Diagnostics) -> Vec<Token<'t>> {
    // Texts have about that many; growing would copy all of them again and again.
    let tokens = Vec::with_capacity(text.len() / 3);
    let mut lexer = Lexer { text, at: 0, file, tokens, diags };
    while lexer.at < text.len() {
        lexer.token();
    }
    lexer.tokens
}

struct Lexer<'t, 'd> {
    text: &'t str,
    at: usize,
    file: u16,
    tokens: Vec<Token<'t>>,
    diags: &'d mut Diagnostics,
}

impl<'t> Lexer<'t, '_> {
    fn token(&mut self) {
        let rest = &self.text[self.at..];
        let Some(first) = rest.chars().next() else { return };
        match first {
            '0'..='9' => self.number(),
            '"' => self.quoted(),
            '/' if rest.starts_with("/*") => self.block_comment(),
            '/' if rest.starts_with("//") => self.comment(),
            // The mark at the start of a file says how it is encoded.
            '\u{feff}' if self.at == 0 => {
                self.push(Kind::Whitespace, first.len_utf8());
            }
            _ if is_blank(first) => {
                self.push(Kind::Whitespace, run(rest, is_blank));
            }
            _ if is_word(first) => self.word(),
            _ => match (self.comment_sign(), sign(rest)) {
                (Some(sign), _) => self.foreign_comment(sign),
                (None, Some((kind, length))) => {
                    self.push(kind, length);
                }
                (None, None) => self.unknown(),
            },
        }
    }

    fn push(&mut self, kind: Kind, length: usize) -> Span {
        let text = &self.text[self.at..self.at + length];
        let span = self.span(self.at, self.at + length);
        self.tokens.push(Token { kind, text, start: span.start });
        self.at += length;
        span
    }

    fn span(&self, start: usize, end: usize) -> Span {
        let offset = |at| u32::try_from(at).unwrap_or(u32::MAX);
        Span { file: self.file, start: offset(start), end: offset(end) }
    }

    fn comment(&mut self) {
        let rest = &self.text[self.at..];
        let length = line_length(rest);
        let doc = rest.starts_with("///") && !rest.starts_with("////");
        let start = self.at;
        self.push(if doc { Kind::Doc } else { Kind::Comment }, length);
        self.invisible(start);
    }

    fn block_comment(&mut self) {
        let rest = &self.text[self.at..];
        let length = rest[2..].find("*/").map_or(rest.len(), |end| end + 4);
        let text = &rest[..length];
        let inner = text[2..].strip_suffix("*/").unwrap_or(&text[2..]);
        // A line comment swallows what follows on its line, so that goes to a line of its own.
        let tail = &rest[length..];
        let last = if tail[..line_length(tail)].trim().is_empty() { "" } else { "\n" };
        let lines: Vec<_> =
            inner.lines().map(|line| format!("// {}", line.trim()).trim_end().to_owned()).collect();
        let span = self.push(Kind::BlockComment, length);
        self.diags.push(
            Diagnostic::new(Code::E0105, span, "comments in '/* */' are not part of the language")
                .help("start each line of the comment with '//'")
                .replace(lines.join("\n") + last),
        );
    }

    fn word(&mut self) {
        let rest = &self.text[self.at..];
        let length = run(rest, |each| is_word(each) || each.is_ascii_digit());
        let text = &rest[..length];
        let span = self.push(Kind::Name, length);
        if !text.is_ascii() {
            let message = format!("the name '{text}' has characters that are not ASCII");
            self.diags.push(
                Diagnostic::new(Code::E0113, span, message)
                    .help("use the letters a to z and A to Z, digits and '_'"),
            );
        }
    }

    fn number(&mut self) {
        let rest = &self.text[self.at..];
        let length = number_length(rest).max(1);
        let behind = &rest[length..];
        let fraction = behind.strip_prefix(',').map_or(0, |tail| run(tail, |c| c.is_ascii_digit()));
        if fraction > 0 && !rest[..length].contains('.') {
            let comma = self.span(self.at + length, self.at + length + 1);
            let better = rest[..length + 1 + fraction].replace(',', ".");
            self.diags.push(
                Diagnostic::new(Code::E0106, comma, "a number has a decimal point, not a comma")
                    .help(format!("write '{better}'"))
                    .replace("."),
            );
            self.push(Kind::Float, length + 1 + fraction);
        } else {
            let whole = rest[..length].bytes().all(|byte| byte.is_ascii_digit());
            self.push(if whole { Kind::Int } else { Kind::Float }, length);
        }
        self.unit();
    }

    /// A text up to the closing quote, at most to the end of the line.
    fn quoted(&mut self) {
        let rest = &self.text[self.at..];
        let line = &rest[..line_length(rest)];
        let mut escaped = false;
        for (index, each) in line.char_indices().skip(1) {
            match each {
                _ if escaped => escaped = false,
                '\\' => escaped = true,
                '"' => {
                    let start = self.at;
                    self.push(Kind::Text, index + 1);
                    return self.invisible(start);
                }
                _ => {}
            }
        }
        let span = self.push(Kind::Text, line.trim_end().len());
        self.diags.push(
            Diagnostic::new(Code::E0104, span, "the text is not closed on its line")
                .help("end it with '\"'")
                .fix(span.after(), "\""),
        );
    }
}

/// Operators and brackets; the longest one that fits.
fn sign(text: &str) -> Option<(Kind, usize)> {
    let long = match text.get(..2) {
        Some("=>") => Some(Kind::FatArrow),
        Some("->") => Some(Kind::Arrow),
        Some("==") => Some(Kind::EqualEqual),
        Some("!=") => Some(Kind::NotEqual),
        Some("<=") => Some(Kind::LessEqual),
        Some(">=") => Some(Kind::GreaterEqual),
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
    each == '_' || each.is_alphabetic()
}

/// The length in bytes of the characters at the start that fit.
fn run(text: &str, fits: impl Fn(char) -> bool) -> usize {
    // Nearly all text is ASCII, which needs no decoding.
    let is_plain = |byte: &u8| byte.is_ascii() && fits(char::from(*byte));
    let plain = text.bytes().take_while(is_plain).count();
    match text.as_bytes().get(plain) {
        Some(byte) if !byte.is_ascii() => {
            let rest = &text[plain..];
            plain + rest.find(|each| !fits(each)).unwrap_or(rest.len())
        }
        _ => plain,
    }
}

/// The length in bytes up to the line break.
fn line_length(text: &str) -> usize {
    let end = text.find('\n').unwrap_or(text.len());
    text[..end].trim_end_matches('\r').len()
}
