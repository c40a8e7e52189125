use crate::Node;

/// The text of a node on one line: spaces replace other separators.
pub(crate) fn in_one_line(node: &Node) -> String {
    let all = node.text().to_string();
    let trimmed = all.trim();
    if !["\n", "\t", "  ", "//", "/*"].iter().any(|gap| trimmed.contains(gap)) {
        return trimmed.to_owned();
    }
    let mut text = String::new();
    let mut apart = false;
    for token in node.descendants_with_tokens().filter_map(|each| each.into_token()) {
        if token.kind().is_trivia() {
            apart = !text.is_empty();
            continue;
        }
        if std::mem::take(&mut apart) {
            text.push(' ');
        }
        text += token.text();
    }
    text
}
