//! A text that changes in steps, and the combined edits of all steps.
//!
//! A change such as an extraction cuts and inserts several times, each time on the tree of the
//! current text. At the end the remaining pieces of the original text give the edits.

use std::ops::Range;
use std::rc::Rc;

use afp_dsl::Toolboxes;
use afp_syntax::diagnostics::{Diagnostics, Edit, Severity};
use afp_syntax::source::Span;
use afp_syntax::{Node, parse};

pub(super) type Splice = (Range<usize>, String);

/// A text during a change.
pub(super) struct TextBuffer {
    /// The templates, in addition to plans.
    pub toolboxes: Rc<Toolboxes>,
    text: String,
    root: Node,
    syntax_errors: usize,
    pieces: Vec<Piece>,
}

#[derive(Clone, Debug)]
enum Piece {
    Kept(Range<usize>),
    New(String),
}

impl Piece {
    fn len(&self) -> usize {
        match self {
            Piece::Kept(range) => range.len(),
            Piece::New(text) => text.len(),
        }
    }

    fn cut(&self, at: usize) -> (Piece, Piece) {
        match self {
            Piece::Kept(range) => {
                let middle = range.start + at;
                (Piece::Kept(range.start..middle), Piece::Kept(middle..range.end))
            }
            Piece::New(text) => (Piece::New(text[..at].into()), Piece::New(text[at..].into())),
        }
    }
}

impl TextBuffer {
    pub fn new(text: &str, toolboxes: Rc<Toolboxes>) -> TextBuffer {
        let (root, syntax_errors) = tree(text);
        let pieces = vec![Piece::Kept(0..text.len())];
        TextBuffer { toolboxes, text: text.to_owned(), root, syntax_errors, pieces }
    }

    pub fn text(&self) -> &str {
        &self.text
    }

    pub fn root(&self) -> Node {
        self.root.clone()
    }

    pub fn syntax_errors(&self) -> usize {
        self.syntax_errors
    }

    /// Replaces ranges of the current text, which must not overlap.
    pub fn splice(&mut self, mut splices: Vec<Splice>) {
        splices.sort_by_key(|(range, _)| (range.start, range.end));
        for (range, text) in splices.into_iter().rev() {
            self.replace(range, text);
        }
        (self.root, self.syntax_errors) = tree(&self.text);
    }

    fn replace(&mut self, range: Range<usize>, text: String) {
        let mut before = Vec::new();
        let mut after = Vec::new();
        let mut at = 0;
        for piece in self.pieces.drain(..) {
            let (start, end) = (at, at + piece.len());
            at = end;
            if end <= range.start {
                before.push(piece);
            } else if start >= range.end {
                after.push(piece);
            } else {
                if start < range.start {
                    before.push(piece.cut(range.start - start).0);
                }
                if end > range.end {
                    after.push(piece.cut(range.end - start).1);
                }
            }
        }
        self.text.replace_range(range, &text);
        before.push(Piece::New(text));
        before.append(&mut after);
        self.pieces = before;
    }

    pub fn is_canonical(&self) -> bool {
        afp_format::format(&self.text).is_ok_and(|formatted| formatted == self.text)
    }

    /// Formats the current text, if it is valid.
    pub fn make_canonical(&mut self) {
        let formatted = afp_format::format(&self.text).ok();
        if let Some(edit) = formatted.and_then(|formatted| difference(&self.text, &formatted)) {
            let Span { start, end, .. } = edit.span;
            self.splice(vec![(start as usize..end as usize, edit.text)]);
        }
    }

    /// Returns the edits from the original text, of `length` bytes, to the current one, in order;
    /// `file` is the file of their spans.
    pub fn edits(self, length: usize, file: u16) -> Vec<Edit> {
        let mut edits = Vec::new();
        let mut new = String::new();
        let mut at = 0;
        for piece in self.pieces.into_iter().chain([Piece::Kept(length..length)]) {
            match piece {
                Piece::New(text) => new += &text,
                Piece::Kept(range) => {
                    if range.start > at || !new.is_empty() {
                        edits.push(Edit { span: span(file, at..range.start), text: new });
                        new = String::new();
                    }
                    at = range.end;
                }
            }
        }
        edits
    }
}

pub(super) fn span(file: u16, range: Range<usize>) -> Span {
    let offset = |at| u32::try_from(at).unwrap_or(u32::MAX);
    Span { file, start: offset(range.start), end: offset(range.end) }
}

/// The edit between two texts, at line borders; `None` if they are equal.
pub fn difference(before: &str, after: &str) -> Option<Edit> {
    if before == after {
        return None;
    }
    let same = |lines: &mut dyn Iterator<Item = (&str, &str)>| {
        lines.take_while(|(a, b)| a == b).map(|(a, _)| a.len()).sum::<usize>()
    };
    let start = same(&mut before.split_inclusive('\n').zip(after.split_inclusive('\n')));
    let (rest, new) = (&before[start..], &after[start..]);
    let mut back = rest.split_inclusive('\n').rev().zip(new.split_inclusive('\n').rev());
    let end = same(&mut back);
    let span = span(0, start..before.len() - end);
    Some(Edit { span, text: new[..new.len() - end].to_owned() })
}

fn tree(text: &str) -> (Node, usize) {
    let mut diags = Diagnostics::default();
    let parse = parse(text, 0, &mut diags);
    (parse.root(), diags.iter().filter(|each| each.severity == Severity::Error).count())
}

#[cfg(test)]
mod tests {
    use std::rc::Rc;

    use super::{TextBuffer, difference};
    use crate::edit::apply;

    #[test]
    fn steps_combine_to_one_list_of_edits() {
        let text = "plan P { start a }";
        let mut buffer = TextBuffer::new(text, Rc::default());
        buffer.splice(vec![(5..6, "Q".into()), (15..16, "long".into())]);
        buffer.splice(vec![(15..17, "lo".into()), (0..0, "use x ".into())]);
        let after = buffer.text().to_owned();
        let edits = buffer.edits(text.len(), 0);
        assert_eq!(edits.len(), 3);
        assert_eq!(apply(text, &edits), after);
    }

    #[test]
    fn a_cut_leaves_an_edit() {
        let mut buffer = TextBuffer::new("abc", Rc::default());
        buffer.splice(vec![(1..3, String::new())]);
        buffer.splice(vec![(0..1, String::new())]);
        let edits = buffer.edits(3, 0);
        assert_eq!(edits.len(), 1);
        assert_eq!(apply("abc", &edits), "");
    }

    #[test]
    fn the_difference_converts_one_text_into_the_other() {
        let texts =
            ["", "a\n", "a\nb\nc\n", "a\nx\nc\n", "a\nc\n", "a\nb\nc", "a\na\na\n", "a\na\n"];
        for before in texts {
            for after in texts {
                let edits: Vec<_> = difference(before, after).into_iter().collect();
                assert_eq!(apply(before, &edits), after);
            }
        }
    }
}
