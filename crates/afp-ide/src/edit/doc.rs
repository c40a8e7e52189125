//! Help text and notes before an item.

use std::ops::Range;

use super::buffer::{Splice, TextBuffer};
use super::list::Page;
use super::tree::{self, range, solid_range, tokens};
use super::{Item, Refused};
use afp_syntax::Token;
use afp_syntax::kind::Kind;

/// Sets or removes an item's lines of a kind: `///` lines, or the `//` lines before them.
pub(super) fn set(
    buffer: &mut TextBuffer,
    item: &Item,
    text: &str,
    kind: Kind,
) -> Result<(), Refused> {
    let root = buffer.root();
    let node = tree::find(&root, item)?;
    let start = solid_range(&node).map(|range| range.start);
    let start = start.ok_or_else(|| Refused::new("the item is empty"))?;
    let page = Page { text: buffer.text(), root };
    let slashes = if kind == Kind::Doc { "///" } else { "//" };
    let lines: Vec<_> =
        text.lines().map(|line| format!("{slashes} {line}").trim_end().to_owned()).collect();
    // A comment after the previous item belongs to that one.
    let above = |token: &Token| {
        range(token).start < start && (kind == Kind::Doc || page.begins_line(range(token).start))
    };
    let old: Vec<_> = tokens(&node, kind).filter(above).collect();
    if old.iter().map(|line| line.text().trim_end()).eq(lines.iter().map(String::as_str)) {
        return Ok(());
    }
    let mut splices = removed(&page, old.iter().map(range), start);
    let help = tokens(&node, Kind::Doc).map(|doc| range(&doc).start).find(|doc| *doc < start);
    let place = if kind == Kind::Doc { start } else { help.unwrap_or(start) };
    let indent = page.indent(place).to_owned();
    let new: String = lines.iter().map(|line| format!("{line}\n{indent}")).collect();
    if page.begins_line(place) {
        splices.push((place..place, new));
    } else if !new.is_empty() {
        splices.push((place..place, format!("\n{indent}{new}")));
    }
    buffer.splice(splices);
    Ok(())
}

/// Removes lines together with their line breaks.
fn removed(
    page: &Page<'_>,
    lines: impl Iterator<Item = Range<usize>>,
    start: usize,
) -> Vec<Splice> {
    let splice = |line: Range<usize>| match page.begins_line(line.start) {
        true => {
            let from = line.start - page.indent(line.start).len();
            (from..(line.end + 1).min(start), String::new())
        }
        false => (line, String::new()),
    };
    lines.map(splice).collect()
}
