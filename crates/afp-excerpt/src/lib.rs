//! Errors in files, shown like compiler errors: the message, the place, the line and a mark.
//!
//! Plans, worlds and project files have different parsers. This crate draws all their errors, and
//! writes them for tools in one form. It is independent of the texts' meaning.

pub mod hidden;
mod json;
mod mistake;
mod table;
pub mod words;

use std::ops::Range;

pub use mistake::Mistake;
pub use table::LineTable;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};

pub use json::place;

/// The severity of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// The text is invalid.
    Error,
    /// The text is valid, but probably not intended.
    Warning,
    /// Information; nothing needs to change.
    Note,
}

impl Severity {
    /// The word before the code.
    pub fn as_str(self) -> &'static str {
        match self {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        }
    }
}

/// A report about texts.
#[derive(Clone, Debug)]
pub struct Report<'a> {
    /// How bad it is.
    pub severity: Severity,
    /// The code for `afpc explain`; may be empty.
    pub code: &'a str,
    pub message: &'a str,
    /// The help; may be empty. It is shown at the first mark instead of its label.
    pub help: &'a str,
    /// The places, the first one to fix first. Marks of one file are shown together unless they are
    /// far apart.
    pub marks: Vec<Mark<'a>>,
}

/// A place in a text.
#[derive(Clone, Debug)]
pub struct Mark<'a> {
    /// The file's path as shown.
    pub path: &'a str,
    pub text: &'a str,
    /// The lines of the text, if they are shared by many reports; `None` counts them for each
    /// report.
    pub lines: Option<&'a LineTable<'a>>,
    /// The bytes; `None` for the whole file. Offsets outside of the text or inside a character move
    /// to the nearest place.
    pub span: Option<Range<usize>>,
    /// The label; may be empty.
    pub label: String,
}

impl Report<'_> {
    /// The report as text without a final line break; `colour` adds terminal colours.
    pub fn render(&self, colour: bool) -> String {
        let mut title = level(self.severity).primary_title(self.message);
        if !self.code.is_empty() {
            title = title.id(self.code);
        }
        let mut group = Group::with_title(title);
        let help = format!("help: {}", self.help);
        let mut shown = vec![false; self.marks.len()];
        for (index, mark) in self.marks.iter().enumerate() {
            if shown[index] {
                continue;
            }
            let together = self.near(index, &shown);
            together.iter().for_each(|place| shown[*place] = true);
            let marks =
                || together.iter().filter_map(|place| Some((*place, self.marks.get(*place)?)));
            let ranges = marks().filter_map(|(_, other)| other.span.as_ref());
            let (lines, first) = lines(mark, ranges.map(|span| range(mark.text, span)));
            let mut annotations = marks()
                .filter_map(|(place, other)| {
                    let (kind, label) = match place {
                        0 if !self.help.is_empty() => (AnnotationKind::Primary, help.clone()),
                        0 => (AnnotationKind::Primary, other.label.clone()),
                        _ => (AnnotationKind::Context, other.label.clone()),
                    };
                    let span = range(other.text, other.span.as_ref()?);
                    let span = span.start - lines.start..span.end - lines.start;
                    Some(kind.span(span).label((!label.is_empty()).then_some(label)))
                })
                .peekable();
            group = match annotations.peek() {
                Some(_) => {
                    let text = Snippet::source(&mark.text[lines.clone()]).line_start(first);
                    group.element(text.path(mark.path).annotations(annotations))
                }
                None => group.element(Origin::path(mark.path)),
            };
        }
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        let text = renderer.decor_style(DecorStyle::Ascii).render(&[group]).to_string();
        let is_shown = self.marks.first().is_some_and(|mark| mark.span.is_some());
        match is_shown || self.help.is_empty() {
            true => text,
            false => format!("{text}\n  {help}"),
        }
    }

    /// The marks that are shown together with one: those of its file that are not too far away.
    fn near(&self, first: usize, shown: &[bool]) -> Vec<usize> {
        let mark = &self.marks[first];
        let start = |mark: &Mark<'_>| mark.span.as_ref().map(|span| span.start);
        let fits = |(_, other): &(usize, &Mark<'_>)| {
            let is_here = other.path == mark.path && std::ptr::eq(other.text, mark.text);
            let distance = start(mark).zip(start(other)).map(|(one, two)| one.abs_diff(two));
            is_here && distance.is_none_or(|distance| distance <= FAR)
        };
        let marks = self.marks.iter().enumerate().skip(first);
        marks.filter(|(index, _)| !shown[*index]).filter(fits).map(|(index, _)| index).collect()
    }
}

/// Marks farther apart than this number of bytes are shown separately: the text between them would
/// be read for each report only to be left out.
const FAR: usize = 16 << 10;

/// Line and column of a byte, both counted from 1; columns count characters.
///
/// An offset past the end or inside a character moves to the nearest one before it.
pub fn line_column(text: &str, offset: usize) -> (usize, usize) {
    let before = &text[..text.floor_char_boundary(offset)];
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

fn level(severity: Severity) -> Level<'static> {
    match severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    }
}

/// The span, limited to the text and to character borders.
fn range(text: &str, span: &Range<usize>) -> Range<usize> {
    let end = text.len().min(span.end);
    let start = text.floor_char_boundary(span.start.min(end));
    start..text.ceil_char_boundary(end)
}

/// The lines of some ranges in a text, and the number of the first. The time depends on these
/// lines, and not on the whole text.
fn lines(mark: &Mark<'_>, ranges: impl Iterator<Item = Range<usize>>) -> (Range<usize>, usize) {
    let text = mark.text;
    let all = ranges.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end)).unwrap_or(0..0);
    let start = text[..all.start].rfind('\n').map_or(0, |at| at + 1);
    let end = text[all.end..].find('\n').map_or(text.len(), |at| all.end + at + 1);
    let first = match mark.lines {
        Some(table) => table.line_column(start).0,
        None => text[..start].bytes().filter(|byte| *byte == b'\n').count() + 1,
    };
    (start..end, first)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report<'a>(marks: Vec<Mark<'a>>) -> Report<'a> {
        Report { severity: Severity::Error, code: "", message: "it is wrong", help: "", marks }
    }

    fn mark<'a>(text: &'a str, span: Option<Range<usize>>) -> Mark<'a> {
        Mark { path: "a.toml", text, lines: None, span, label: "it is 'a'".to_owned() }
    }

    #[test]
    fn the_mark_is_under_the_text() {
        let marks = vec![mark("x = 1\nä = 'cd'\n", Some(11..15))];
        let shown = Report { help: "write 'b'", ..report(marks) }.render(false);
        let wanted = "error: it is wrong
 --> a.toml:2:5
  |
2 | ä = 'cd'
  |     ^^^^ help: write 'b'";
        assert_eq!(shown, wanted);
    }

    #[test]
    fn an_error_without_a_place_names_its_file() {
        let shown = report(vec![mark("x", None)]);
        assert_eq!(shown.render(false), "error: it is wrong\n--> a.toml");
        let shown = Report { help: "write 'b'", ..shown };
        assert_eq!(shown.render(false), "error: it is wrong\n--> a.toml\n  help: write 'b'");
        let shown = Report { marks: Vec::new(), ..shown };
        assert_eq!(shown.render(false), "error: it is wrong\n  help: write 'b'");
    }

    #[test]
    fn the_marks_of_one_file_are_shown_together() {
        let [one, two] = ["a = 1\nb = 2\n", "c\n"];
        let other = Mark { path: "b.toml", ..mark(two, Some(0..1)) };
        let marks = vec![mark(one, Some(0..1)), other, mark(one, Some(6..7))];
        let report = Report { code: "E1", severity: Severity::Note, ..report(marks) };
        let wanted = "note[E1]: it is wrong
 --> a.toml:1:1
  |
1 | a = 1
  | ^ it is 'a'
2 | b = 2
  | - it is 'a'
  |
 ::: b.toml:1:1
  |
1 | c
  | - it is 'a'";
        assert_eq!(report.render(false), wanted);
    }

    /// The text in between was once read again for each error of a long file.
    #[test]
    fn marks_far_from_each_other_are_shown_one_after_the_other() {
        let text = format!("a = 1\n{}b = 2\n", "\n".repeat(FAR));
        let table = LineTable::new(&text);
        let far = text.len() - 6;
        let marks = [far..far + 1, 0..1]
            .map(|span| Mark { lines: Some(&table), ..mark(&text, Some(span)) });
        let wanted = "error: it is wrong
     --> a.toml:16386:1
      |
16386 | b = 2
      | ^ it is 'a'
      |
     ::: a.toml:1:1
      |
    1 | a = 1
      | - it is 'a'";
        assert_eq!(report(marks.to_vec()).render(false), wanted);
    }

    #[test]
    fn any_span_is_shown() {
        for text in ["", "a", "ä\n\nö", "\n"] {
            for start in 0..6 {
                for end in 0..6 {
                    let shown = report(vec![mark(text, Some(start..end))]).render(true);
                    assert!(shown.contains("a.toml:"), "{shown}");
                }
            }
        }
    }

    #[test]
    fn lines_and_columns_count_characters_from_one() {
        let text = "ab\nä°c\n";
        let cases = [(0, (1, 1)), (3, (2, 1)), (7, (2, 3)), (4, (2, 1)), (99, (3, 1))];
        for (offset, wanted) in cases {
            assert_eq!(line_column(text, offset), wanted, "byte {offset}");
        }
    }
}
