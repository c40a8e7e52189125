//! From text to a lossless tree.
//!
//! Parsing never fails: whatever the text is, the tree holds every byte of it, holes stay holes, and
//! every error is reported. The tree knows the grammar only; names and types come later.

use rowan::{GreenNode, GreenNodeData, GreenTokenData, Language, NodeOrToken};

use crate::diagnostics::Diagnostics;
use crate::kind::Afp;
use crate::source::Span;
use crate::{lexer, parser};

/// A node of the tree.
pub type Node = rowan::SyntaxNode<Afp>;
/// A token of the tree.
pub type Token = rowan::SyntaxToken<Afp>;

#[derive(Clone, Debug)]
pub struct Parse {
    green: GreenNode,
    pub(crate) file: u16,
}

impl Parse {
    /// The root of the tree.
    pub fn root(&self) -> Node {
        Node::new_root(self.green.clone())
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
    let green = parser::parse(tokens, file, diags);
    diags.join(file, text);
    Parse { green, file }
}

/// Cuts a text into tokens and tells how many there are: the first thing a compilation does, and
/// the measure for what the rest of it may take.
pub fn count_tokens(text: &str) -> usize {
    lexer::lex(text, 0, &mut Diagnostics::default()).len()
}

/// The place of a token.
pub fn token_span(token: &Token, file: u16) -> Span {
    let range = token.text_range();
    Span { file, start: range.start().into(), end: range.end().into() }
}

/// The place of a node without the trivia at its ends.
pub fn node_span(node: &Node, file: u16) -> Span {
    green_span(&node.green(), node.text_range().start().into(), file)
}

/// The place of a node that starts at a byte, without the trivia at its ends.
pub(crate) fn green_span(green: &GreenNodeData, start: u32, file: u16) -> Span {
    let end = start + u32::from(green.text_len());
    match (leading(green), trailing(green)) {
        (Ok(before), Ok(behind)) => Span { file, start: start + before, end: end - behind },
        _ => Span { file, start, end: start },
    }
}

/// The length of the trivia in front of everything else; of the whole node when it has nothing else.
fn leading(node: &GreenNodeData) -> Result<u32, u32> {
    trivia(node.children(), leading)
}

/// The length of the trivia behind everything else, as in [`leading`].
fn trailing(node: &GreenNodeData) -> Result<u32, u32> {
    trivia(node.children().rev(), trailing)
}

/// Adds up trivia until something else comes. It goes over the tree's own nodes, because spans are
/// asked for everywhere and each step of a cursor costs an allocation.
fn trivia<'a>(
    elements: impl Iterator<Item = NodeOrToken<&'a GreenNodeData, &'a GreenTokenData>>,
    within: fn(&GreenNodeData) -> Result<u32, u32>,
) -> Result<u32, u32> {
    let mut length = 0;
    for element in elements {
        let found = match element {
            NodeOrToken::Node(node) => within(node),
            NodeOrToken::Token(token) => match Afp::kind_from_raw(token.kind()).is_trivia() {
                true => Err(u32::from(token.text_len())),
                false => Ok(0),
            },
        };
        match found {
            Ok(more) => return Ok(length + more),
            Err(all) => length += all,
        }
    }
    Err(length)
}

#[cfg(test)]
mod tests;
