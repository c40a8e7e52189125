//! Lines and columns as in editors.
//!
//! Protocols of editors count both from zero, and columns mostly in units of UTF-16, independent of
//! the encoding of the text. The starts of lines are computed once for a file; a column then takes
//! time linear in its line.

/// A position as in editors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LineColumn {
    /// The line, from 0.
    pub line: u32,
    /// The column, from 0, in units of the [`Encoding`].
    pub column: u32,
}

/// The unit of columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Encoding {
    Utf8,
    /// Units of 16 bits: characters beyond the first 65,536 count as two.
    Utf16,
}

/// The lines of a file. As in editors, they end with `\n`, `\r\n` or `\r`.
#[derive(Clone, Debug)]
pub struct Lines<'t> {
    text: &'t str,
    starts: Vec<usize>,
}

impl<'t> Lines<'t> {
    pub fn new(text: &'t str) -> Lines<'t> {
        let bytes = text.as_bytes();
        let ends_line = |at: &usize| match bytes[*at] {
            b'\n' => true,
            b'\r' => bytes.get(at + 1) != Some(&b'\n'),
            _ => false,
        };
        let starts = (0..bytes.len()).filter(ends_line).map(|at| at + 1);
        Lines { text, starts: std::iter::once(0).chain(starts).collect() }
    }

    /// Line and column of a byte. An offset inside a character means that character, one after the
    /// end means the end.
    pub fn position(&self, offset: u32, encoding: Encoding) -> LineColumn {
        let offset = self.text.floor_char_boundary(offset as usize);
        let line = self.starts.partition_point(|start| *start <= offset) - 1;
        let before = &self.text[self.starts[line]..offset];
        let column = match encoding {
            Encoding::Utf8 => before.len(),
            Encoding::Utf16 => before.encode_utf16().count(),
        };
        let number = |count| u32::try_from(count).unwrap_or(u32::MAX);
        LineColumn { line: number(line), column: number(column) }
    }

    /// The byte at a line and column. A column inside a character means that character, one after
    /// the end of its line means that end, a line after the last one means the end of the text.
    pub fn offset(&self, position: LineColumn, encoding: Encoding) -> u32 {
        let (line, column) = (position.line as usize, position.column as usize);
        let number = |count| u32::try_from(count).unwrap_or(u32::MAX);
        let Some(start) = self.starts.get(line) else { return number(self.text.len()) };
        let end = self.starts.get(line + 1).copied().unwrap_or(self.text.len());
        let content = self.text[*start..end].trim_end_matches(['\r', '\n']);
        let within = match encoding {
            Encoding::Utf8 => content.floor_char_boundary(column),
            Encoding::Utf16 => {
                let mut units = 0;
                let reached = content.char_indices().find(|(_, letter)| {
                    units += letter.len_utf16();
                    units > column
                });
                reached.map_or(content.len(), |(at, _)| at)
            }
        };
        number(start + within)
    }
}

#[cfg(test)]
mod tests {
    use super::{Encoding, LineColumn, Lines};

    /// Characters of 1, 2, 3 and 4 bytes, the last one with two units of UTF-16; all line endings.
    const TEXT: &str = "a°€𝄞b\r\n\n𝄞\rx\n";

    #[test]
    fn columns_are_counted_in_the_requested_units() {
        let lines = Lines::new(TEXT);
        let at = |offset, encoding| {
            let LineColumn { line, column } = lines.position(offset, encoding);
            (line, column)
        };
        for (offset, bytes, units) in [
            (0, (0, 0), (0, 0)),
            (1, (0, 1), (0, 1)),
            (3, (0, 3), (0, 2)),
            (6, (0, 6), (0, 3)),
            (10, (0, 10), (0, 5)),
            (11, (0, 11), (0, 6)),
            (13, (1, 0), (1, 0)),
            (14, (2, 0), (2, 0)),
            (18, (2, 4), (2, 2)),
            (19, (3, 0), (3, 0)),
            (21, (4, 0), (4, 0)),
        ] {
            assert_eq!(at(offset, Encoding::Utf8), bytes, "byte {offset}");
            assert_eq!(at(offset, Encoding::Utf16), units, "byte {offset}");
        }
        assert_eq!(at(8, Encoding::Utf16), (0, 3), "inside of a character");
        assert_eq!(at(99, Encoding::Utf16), (4, 0), "past the end");
    }

    #[test]
    fn positions_lead_back_to_their_bytes() {
        let lines = Lines::new(TEXT);
        for encoding in [Encoding::Utf8, Encoding::Utf16] {
            // A line break of two characters has a position at the first one only.
            let places = (0..=TEXT.len()).filter(|at| TEXT.is_char_boundary(*at) && *at != 12);
            for place in places.filter_map(|at| u32::try_from(at).ok()) {
                let position = lines.position(place, encoding);
                assert_eq!(lines.offset(position, encoding), place, "{position:?}");
            }
        }
    }

    #[test]
    fn missing_positions_become_the_nearest_position_before() {
        let lines = Lines::new(TEXT);
        let at = |line, column| lines.offset(LineColumn { line, column }, Encoding::Utf16);
        assert_eq!(at(0, 4), 6, "inside of a character");
        assert_eq!(at(0, 99), 11, "past the end of a line");
        assert_eq!(at(1, 1), 13, "past the end of an empty line");
        assert_eq!(at(9, 9), 21, "past the last line");
        assert_eq!(lines.offset(LineColumn { line: 0, column: 2 }, Encoding::Utf8), 1);
        assert_eq!(Lines::new("").position(3, Encoding::Utf8), LineColumn::default());
    }
}
