//! The line starts of a text, for many lookups of places.

use std::ops::Range;

/// Columns are counted from a stop; two stops are at most this number of bytes apart.
const APART: usize = 1024;

/// The lines of a text. The constructor reads the text once; then each lookup takes a few steps,
/// even in long lines.
#[derive(Clone, Debug)]
pub struct LineTable<'t> {
    text: &'t str,
    stops: Vec<Stop>,
}

/// A place with a known line and column: the start of a line, or a place in a long line.
#[derive(Clone, Copy, Debug, Default)]
struct Stop {
    at: usize,
    /// Counted from 0, like the column.
    line: usize,
    column: usize,
    start: usize,
}

impl<'t> LineTable<'t> {
    pub fn new(text: &'t str) -> LineTable<'t> {
        let mut stops = vec![Stop::default()];
        let mut start = 0;
        for (line, content) in text.split('\n').enumerate() {
            if line > 0 {
                stops.push(Stop { at: start, line, column: 0, start });
            }
            let (mut from, mut column) = (0, 0);
            while content.len() - from > APART {
                let to = content.floor_char_boundary(from + APART);
                column += content[from..to].chars().count();
                from = to;
                stops.push(Stop { at: start + from, line, column, start });
            }
            start += content.len() + 1;
        }
        LineTable { text, stops }
    }

    /// Line and column of a byte, both counted from 1; columns count characters.
    ///
    /// An offset past the end or inside a character moves to the nearest one before it.
    pub fn line_column(&self, offset: usize) -> (usize, usize) {
        let offset = self.text.floor_char_boundary(offset);
        let stop = self.stop(offset);
        (stop.line + 1, stop.column + self.text[stop.at..offset].chars().count() + 1)
    }

    pub fn text(&self) -> &'t str {
        self.text
    }

    /// The line of a byte, including its line break.
    pub fn line(&self, offset: usize) -> Range<usize> {
        let Stop { line, start, .. } = self.stop(offset.min(self.text.len()));
        let behind = self.stops.partition_point(|stop| stop.line <= line);
        start..self.stops.get(behind).map_or(self.text.len(), |next| next.start)
    }

    /// The last stop up to a byte.
    fn stop(&self, offset: usize) -> Stop {
        let behind = self.stops.partition_point(|stop| stop.at <= offset);
        behind.checked_sub(1).and_then(|last| self.stops.get(last)).copied().unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::LineTable;
    use crate::line_column;

    #[test]
    fn places_equal_those_counted_from_the_start() {
        let long = "ä°c".repeat(2000);
        for text in ["", "\n", "a\n\nb", "ab\nä°c\n", &long, &format!("x\n{long}\n\n{long}y\n")] {
            let table = LineTable::new(text);
            for offset in (0..text.len() + 3).filter(|at| at % 7 < 5 || at % 1024 < 3) {
                assert_eq!(table.line_column(offset), line_column(text, offset), "byte {offset}");
                let before = &text[..text.floor_char_boundary(offset)];
                let start = before.rfind('\n').map_or(0, |at| at + 1);
                let end = text[before.len()..].find('\n');
                let end = end.map_or(text.len(), |more| before.len() + more + 1);
                assert_eq!(table.line(offset), start..end, "byte {offset}");
            }
        }
    }
}
