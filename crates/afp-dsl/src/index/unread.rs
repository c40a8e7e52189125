//! Names in text that could not be parsed, which are never resolved.

use super::record::{Found, Meanings, key};
use afp_syntax::Node;
use afp_syntax::kind::Kind;
use afp_syntax::source::Span;

/// Adds the names of a tree without a meaning.
pub(crate) fn unread(root: &Node, file: u16, meanings: &mut Meanings) {
    let mut missing = Vec::new();
    for token in root.descendants_with_tokens().filter_map(|each| each.into_token()) {
        if token.kind() == Kind::Name {
            let range = token.text_range();
            let span = Span { file, start: range.start().into(), end: range.end().into() };
            if meanings.get(span).is_none() {
                missing.push((span, Found::Unread));
            }
        }
    }
    meanings.names.extend(missing);
    meanings.names.sort_by_key(|(name, _)| key(*name));
}
