//! Which place of a plan each line of a generated file is made from.

use afp_syntax::source::Span;

/// The places of a file's lines. A place holds for the item that begins at its line.
#[derive(Clone, Debug, Default)]
pub struct Places {
    lines: Vec<Line>,
}

#[derive(Clone, Copy, Debug)]
struct Line {
    /// Blanks before the text; `None` for an empty line.
    indent: Option<usize>,
    /// Whether it goes on with an item that began above, such as `}` or `) -> u8 {`.
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

    /// The place of the innermost item around a line (counted from 1) that has one.
    pub fn at(&self, line: usize) -> Option<Span> {
        // Only lines that are indented less than all between belong to items around this one.
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
