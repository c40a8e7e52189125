//! The line ends of a file. Texts have only `\n`, for counting lines and columns. The original ends
//! are kept, individually if they are mixed.

use std::borrow::Cow;
use std::collections::VecDeque;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum LineEnds {
    All(&'static str),
    Each(Vec<&'static str>),
}

impl Default for LineEnds {
    fn default() -> LineEnds {
        LineEnds::All("\n")
    }
}

/// A text with `\n` line ends.
pub(crate) fn with_newlines(text: &str) -> Cow<'_, str> {
    if text.contains('\r') {
        text.replace("\r\n", "\n").replace('\r', "\n").into()
    } else {
        text.into()
    }
}

/// The most lines of texts that are compared.
const MOST: usize = 10_000;

impl LineEnds {
    pub fn of(file: &str) -> LineEnds {
        let bytes = file.as_bytes();
        let ends = bytes.iter().enumerate().filter_map(|(at, byte)| match byte {
            b'\n' if at > 0 && bytes[at - 1] == b'\r' => Some("\r\n"),
            b'\n' => Some("\n"),
            b'\r' if bytes.get(at + 1) != Some(&b'\n') => Some("\r"),
            _ => None,
        });
        LineEnds::from(ends.collect())
    }

    fn from(ends: Vec<&'static str>) -> LineEnds {
        match ends.first() {
            None => LineEnds::default(),
            Some(first) if ends.iter().all(|end| end == first) => LineEnds::All(first),
            Some(_) => LineEnds::Each(ends),
        }
    }

    /// Line ends for a changed text: unchanged lines keep theirs, and a new line gets the end of
    /// the line that it replaces, or of the line before. In very long texts all lines get the first
    /// one's.
    pub fn follow(&self, before: &str, text: &str) -> LineEnds {
        let LineEnds::Each(ends) = self else { return self.clone() };
        let all = before.lines().count().max(text.lines().count());
        if all > MOST {
            return LineEnds::All(ends.first().copied().unwrap_or("\n"));
        }
        let patch = diffy::DiffOptions::new().set_context_len(all).create_patch(before, text);
        let Some(hunk) = patch.hunks().first() else { return self.clone() };
        let mut ends = ends.iter().copied();
        let (mut made, mut replaced) = (Vec::new(), VecDeque::new());
        let mut last = ends.clone().next().unwrap_or("\n");
        for line in hunk.lines() {
            match line {
                diffy::Line::Context(_) => {
                    replaced.clear();
                    last = ends.next().unwrap_or(last);
                    made.push(last);
                }
                diffy::Line::Delete(_) => replaced.extend(ends.next()),
                diffy::Line::Insert(_) => {
                    last = replaced.pop_front().unwrap_or(last);
                    made.push(last);
                }
            }
        }
        // The part after the last line end also counts as a line.
        made.truncate(text.matches('\n').count());
        LineEnds::from(made)
    }

    pub fn applied(&self, text: &str) -> String {
        match self {
            LineEnds::All(end) => text.replace('\n', end),
            LineEnds::Each(ends) => {
                let mut ends = ends.iter();
                let line = |line: &str| match line.strip_suffix('\n') {
                    Some(line) => [line, ends.next().unwrap_or(&"\n")].concat(),
                    None => line.to_owned(),
                };
                text.split_inclusive('\n').map(line).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unchanged_lines_keep_their_ends() {
        for (file, text, expected) in [
            ("a\r\nb\nc\rd", "a\nb\nc\nd", "a\r\nb\nc\rd"),
            ("a\r\nb\nc\rd", "a\nB\nc\nd\n", "a\r\nB\nc\rd\r"),
            ("a\r\nb\nc\rd", "new\na\nb\nc\nd", "new\r\na\r\nb\nc\rd"),
            ("a\r\nb\nc\rd", "a\nb\nnew\nc\nd", "a\r\nb\nnew\nc\rd"),
            ("a\r\nb\nc\rd", "b\nd", "b\nd"),
            ("a\r\nb\nc\rd", "A\nB\nC\nD", "A\r\nB\nC\rD"),
            ("a\r\nb\nc\rd", "", ""),
            ("a\r\nb\r\n", "b\nc\n", "b\r\nc\r\n"),
            ("a\rb\r", "a\nb\nc\n", "a\rb\rc\r"),
            ("a", "a\nb\n", "a\nb\n"),
        ] {
            let before = with_newlines(file);
            let ends = LineEnds::of(file);
            assert_eq!(ends.applied(&before), file);
            assert_eq!(ends.follow(&before, text).applied(text), expected, "{file:?} {text:?}");
        }
    }
}
