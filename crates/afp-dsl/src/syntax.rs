//! From text to a lossless tree.
//!
//! Parsing never fails: whatever the text is, the tree holds every byte of it, holes stay holes, and
//! every error is reported. The tree knows the grammar only; names and types come later.

pub mod ast;
pub mod kind;
mod lexer;
mod parser;

use rowan::GreenNode;

use crate::diagnostics::Diagnostics;
use crate::source::Span;

pub use kind::{Afp, Kind};

pub(crate) use lexer::unit_of_token;

/// A node of the tree.
pub type Node = rowan::SyntaxNode<Afp>;
/// A token of the tree.
pub type Token = rowan::SyntaxToken<Afp>;

/// A parsed file.
#[derive(Clone, Debug)]
pub struct Parse {
    green: GreenNode,
    file: u16,
}

impl Parse {
    /// The root of the tree.
    pub fn root(&self) -> Node {
        Node::new_root(self.green.clone())
    }

    /// The typed view of the tree.
    pub fn file(&self) -> ast::File {
        ast::File::new(self.root(), self.file)
    }

    /// The text, byte for byte as it was given.
    pub fn text(&self) -> String {
        self.root().text().to_string()
    }
}

/// Parses a text; `file` is the index that spans shall carry.
///
/// Takes time and memory linear in the length of the text, and a stack of bounded depth.
pub fn parse(text: &str, file: u16, diags: &mut Diagnostics) -> Parse {
    let tokens = lexer::lex(text, file, diags);
    let green = parser::parse(&tokens, file, diags);
    Parse { green, file }
}

/// Cuts a text into tokens and tells how many there are: the first thing a compilation does, and
/// the measure for what the rest of it may take.
pub fn count_tokens(text: &str) -> usize {
    lexer::lex(text, 0, &mut Diagnostics::default()).len()
}

/// The place of a token.
pub(crate) fn token_span(token: &Token, file: u16) -> Span {
    let range = token.text_range();
    Span { file, start: range.start().into(), end: range.end().into() }
}

/// The place of a node without the trivia at its ends.
pub(crate) fn node_span(node: &Node, file: u16) -> Span {
    let range = node.text_range();
    let inside = |token: &Token| range.contains_range(token.text_range());
    let solid = |token: &Token| !token.kind().is_trivia();
    let forth = std::iter::successors(node.first_token(), Token::next_token);
    let back = std::iter::successors(node.last_token(), Token::prev_token);
    match (forth.take_while(inside).find(solid), back.take_while(inside).find(solid)) {
        (Some(first), Some(last)) => token_span(&first, file).to(token_span(&last, file)),
        _ => {
            let start = range.start().into();
            Span { file, start, end: start }
        }
    }
}

#[cfg(test)]
mod tests;
