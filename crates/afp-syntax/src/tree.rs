//! Parses a file to a lossless tree.
//!
//! Parsing never fails: for any text, the tree holds every byte, and every error is reported. The
//! tree knows the grammar only; names and types are checked later.

use rowan::{GreenNode, GreenNodeData, GreenTokenData, Language, NodeOrToken};

use crate::diagnostics::Diagnostics;
use crate::kind::Afp;
use crate::source::Span;
use crate::{lexer, parser};

pub type Node = rowan::SyntaxNode<Afp>;
pub type Token = rowan::SyntaxToken<Afp>;

#[derive(Clone, Debug)]
pub struct Parse {
    green: GreenNode,
    pub(crate) file: u16,
}

impl Parse {
    pub fn root(&self) -> Node {
        Node::new_root(self.green.clone())
    }

    /// The text, byte for byte.
    pub fn text(&self) -> String {
        self.root().text().to_string()
    }
}

/// Parses a file; `file` is its index for spans.
///
/// Takes time and memory linear in the length of the text, and a stack of bounded depth.
pub fn parse(text: &str, file: u16, diags: &mut Diagnostics) -> Parse {
    let tokens = lexer::lex(text, file, diags);
    let green = parser::parse(tokens, file, diags);
    diags.join(file, text);
    Parse { green, file }
}

/// Counts the tokens of a file. A compilation does this first, to limit the cost of its other
/// stages.
pub fn count_tokens(text: &str) -> usize {
    lexer::lex(text, 0, &mut Diagnostics::default()).len()
}

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

/// The length of the trivia at the begin; `Err` with the length of the whole node if it has nothing
/// else.
fn leading(node: &GreenNodeData) -> Result<u32, u32> {
    trivia(node.children(), leading)
}

/// The length of the trivia at the end, as in [`leading`].
fn trailing(node: &GreenNodeData) -> Result<u32, u32> {
    trivia(node.children().rev(), trailing)
}

/// Adds up trivia up to another token. Reads the green tree for speed: spans are needed everywhere,
/// and each step of a cursor costs an allocation.
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
