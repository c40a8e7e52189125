//! Help text above an item.

use super::buffer::{Splice, TextBuffer};
use super::list::Page;
use super::tree::{self, range, solid_range, tokens};
use super::{Item, Refused};
use afp_syntax::kind::Kind;

/// Sets or removes the `///` lines of an item.
pub(super) fn set(buffer: &mut TextBuffer, item: &Item, text: &str) -> Result<(), Refused> {
    let root = buffer.root();
    let node = tree::find(&root, item)?;
    let start = solid_range(&node).map(|range| range.start);
    let start = start.ok_or_else(|| Refused::new("the item is empty"))?;
    let page = Page { text: buffer.text(), root };
    let indent = page.indent(start).to_owned();
    let lines: Vec<_> =
        text.lines().map(|line| format!("/// {line}").trim_end().to_owned()).collect();
    let old: Vec<_> = tokens(&node, Kind::Doc).filter(|doc| range(doc).start < start).collect();
    if old.iter().map(|doc| doc.text().trim_end()).eq(lines.iter().map(String::as_str)) {
        return Ok(());
    }
    let mut splices: Vec<Splice> = Vec::new();
    for doc in old.iter().map(range) {
        if page.begins_line(doc.start) {
            let from = doc.start - page.indent(doc.start).len();
            splices.push((from..(doc.end + 1).min(start), String::new()));
        } else {
            splices.push((doc, String::new()));
        }
    }
    let new: String = lines.iter().map(|line| format!("{line}\n{indent}")).collect();
    if page.begins_line(start) {
        splices.push((start..start, new));
    } else if !new.is_empty() {
        splices.push((start..start, format!("\n{indent}{new}")));
    }
    buffer.splice(splices);
    Ok(())
}
