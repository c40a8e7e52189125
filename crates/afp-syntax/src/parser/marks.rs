//! Positions that the parser needs far ahead: ends of lines, braces, closed brackets.
//!
//! They are found once. A file may be one line with an error at every token, and a search per error
//! would take quadratic time.

use crate::kind::Kind;
use crate::lexer::Token;

/// Positions in a file, each list in ascending order.
#[derive(Default)]
pub(super) struct Marks {
    /// The line breaks, in bytes.
    newlines: Vec<u32>,
    /// The opening and the closing braces, as indices of tokens.
    open_braces: Vec<u32>,
    close_braces: Vec<u32>,
    /// The `(` that are closed before the next brace, as indices of tokens.
    closed: Vec<u32>,
}

impl Marks {
    /// Finds the positions; `solid` are the indices of the tokens that are read.
    pub(super) fn new(tokens: &[Token<'_>], solid: &[u32]) -> Marks {
        let mut marks = Marks::default();
        for token in tokens.iter().filter(|token| token.ends_line()) {
            for (at, byte) in (token.start..).zip(token.text.as_bytes()) {
                if *byte == b'\n' {
                    marks.newlines.push(at);
                }
            }
        }
        let mut open = Vec::new();
        for (index, token) in (0..).zip(solid.iter().filter_map(|at| tokens.get(*at as usize))) {
            match token.kind {
                Kind::OpenBrace => marks.open_braces.push(index),
                Kind::CloseBrace => marks.close_braces.push(index),
                Kind::OpenParen => open.push(index),
                Kind::CloseParen => marks.closed.extend(open.pop()),
                _ => {}
            }
            if matches!(token.kind, Kind::OpenBrace | Kind::CloseBrace) {
                open.clear();
            }
        }
        marks.closed.sort_unstable();
        marks
    }

    /// The first line break at or after a byte.
    pub(super) fn newline(&self, from: u32) -> Option<u32> {
        self.newlines.get(self.newlines.partition_point(|at| *at < from)).copied()
    }

    /// The first brace of a kind from an index on, among the tokens that are read.
    pub(super) fn brace(&self, kind: Kind, from: usize) -> Option<usize> {
        let all = match kind {
            Kind::OpenBrace => &self.open_braces,
            _ => &self.close_braces,
        };
        all.get(all.partition_point(|index| (*index as usize) < from)).map(|index| *index as usize)
    }

    /// Whether the bracket at an index is closed before the next brace.
    pub(super) fn is_closed(&self, index: usize) -> bool {
        u32::try_from(index).is_ok_and(|index| self.closed.binary_search(&index).is_ok())
    }
}
