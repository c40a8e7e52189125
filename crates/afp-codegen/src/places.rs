//! The places in a plan of a generated file's lines.

use afp_syntax::source::Span;

/// The places of a file's lines. A place applies to the item that begins at its line.
#[derive(Clone, Debug, Default)]
pub struct Places {
    lines: Vec<Line>,
}

#[derive(Clone, Copy, Debug)]
struct Line {
    /// Spaces before the text; `None` for an empty line.
    indent: Option<usize>,
    /// Whether it continues an earlier item, such as `}` or `) -> u8 {`.
    continues: bool,
    place: Option<Span>,
}

impl Places {
    /// Appends a line, with the place of the item that begins there.
    pub(super) fn line(&mut self, text: &str, place: Option<Span>) {
        let inner = text.trim_start();
        self.lines.push(Line {
            indent: (!inner.is_empty()).then_some(text.len() - inner.len()),
            continues: inner.starts_with(['}', ')', ']', '{']) || inner.starts_with("where"),
            place,
        });
    }

    /// The place of the innermost item with a place around a line (counted from 1).
    pub fn at(&self, line: usize) -> Option<Span> {
        // Only lines with less indentation than all lines between belong to items around this line.
        let mut limit = usize::MAX;
        for line in self.lines.get(..line)?.iter().rev() {
            let Some(indent) = line.indent.filter(|indent| *indent <= limit) else { continue };
            if line.place.is_some() {
                return line.place;
            }
            limit = match line.continues {
                true => indent,
                false => indent.checked_sub(1)?,
            };
        }
        None
    }
}
