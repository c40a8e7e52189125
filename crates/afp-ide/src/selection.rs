//! Growing selections: from the word at a place to the whole file.

use crate::View;
use afp_syntax::source::Span;

/// Returns the spans around a byte offset, from the smallest to the whole file.
pub fn selections(view: &View, offset: u32) -> Vec<Span> {
    let length = u32::try_from(view.text().len()).unwrap_or(u32::MAX);
    let file = Span { file: view.file, start: 0, end: length };
    let at = rowan::TextSize::from(offset.min(u32::from(view.root().text_range().end())));
    let found = view.root().token_at_offset(at);
    // Between two tokens the solid one counts.
    let token = found.clone().find(|token| !token.kind().is_trivia()).or(found.right_biased());
    let mut all: Vec<Span> = Vec::new();
    let mut add = |span: Span| {
        let grows = all.last().is_none_or(|last| span.contains(*last) && span != *last);
        if grows && span.contains(view.place(offset.min(length))) && span.start < span.end {
            all.push(span);
        }
    };
    if let Some(token) = token {
        if !token.text().trim().is_empty() {
            add(view.token_span(&token));
        }
        for node in token.parent_ancestors() {
            add(view.node_span(&node));
        }
    }
    if all.last() != Some(&file) {
        all.push(file);
    }
    all
}
