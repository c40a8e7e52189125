//! The comments and the help above items.

use super::kind_of;
use crate::Node;
use crate::kind::Kind;

/// Whether a node is the first on its line.
fn begins_line(node: &Node) -> bool {
    let before = node.first_token().and_then(|first| first.prev_token());
    before.is_none_or(|before| before.text().contains('\n'))
}

/// The `//` lines directly above an item, without the slashes and one blank after them. A comment
/// after other code on its line does not count.
pub(super) fn note(node: &Node) -> String {
    let first = node.green().children().next().map(|first| kind_of(first.kind()));
    let mut below = first == Some(Kind::Comment) && begins_line(node);
    let mut lines: Vec<String> = Vec::new();
    for element in node.green().children() {
        let Some(token) = element.into_token() else { break };
        match kind_of(token.kind()) {
            Kind::Comment if below => {
                let text = token.text().trim_start_matches('/');
                lines.push(text.strip_prefix(' ').unwrap_or(text).trim_end().to_owned());
            }
            Kind::Whitespace => below |= token.text().contains('\n'),
            Kind::Doc => below = true,
            kind if kind.is_trivia() => {}
            _ => break,
        }
    }
    lines.join("\n")
}

/// The `///` lines above an item, without the slashes and one blank after them.
pub(super) fn doc(node: &Node) -> String {
    let mut doc = String::new();
    let mut lines = 0;
    for element in node.green().children() {
        let Some(token) = element.into_token() else { break };
        match kind_of(token.kind()) {
            Kind::Doc => {
                let text = token.text().trim_start_matches('/');
                doc += if lines > 0 { "\n" } else { "" };
                doc += text.strip_prefix(' ').unwrap_or(text).trim_end();
                lines += 1;
            }
            kind if kind.is_trivia() => {}
            _ => break,
        }
    }
    doc
}
