//! Adding and removing items of lists, in the style of their neighbours.

use std::ops::Range;

use super::Refused;
use super::buffer::Splice;
use super::tree::{is_comment, own_range, range, solid_after, solid_before};
use afp_syntax::kind::Kind;
use afp_syntax::{Node, Token};

pub(super) enum Place {
    After(Node),
    Before(Node),
    /// At the top of the body, or of the file.
    Top,
}

/// A text and its tree.
pub(super) struct Page<'t> {
    pub text: &'t str,
    pub root: Node,
}

impl Page<'_> {
    pub fn indent(&self, at: usize) -> &str {
        let line = &self.text[self.line_start(at)..];
        &line[..line.len() - line.trim_start_matches([' ', '\t']).len()]
    }

    fn line_start(&self, at: usize) -> usize {
        self.text[..at].rfind('\n').map_or(0, |found| found + 1)
    }

    fn line_end(&self, at: usize) -> usize {
        self.text[at..].find('\n').map_or(self.text.len(), |found| at + found)
    }

    /// Whether only spaces precede a place on its line.
    pub fn begins_line(&self, at: usize) -> bool {
        self.text[self.line_start(at)..at].trim().is_empty()
    }

    fn ends_line(&self, at: usize) -> bool {
        self.text[at..self.line_end(at)].trim().is_empty()
    }

    /// Adds items, given as lines without indentation, to the list of a node; `apart` asks for a
    /// blank line next to their neighbour.
    pub fn insert_lines(
        &self,
        list: &Node,
        place: Place,
        lines: &str,
        apart: bool,
    ) -> Result<Splice, Refused> {
        let gap = if apart { "\n" } else { "" };
        match place {
            Place::Before(item) => {
                let at = own_range(&item).start;
                let indent = self.indent(at);
                let text = indented(lines, indent);
                if self.begins_line(at) {
                    let start = self.line_start(at);
                    return Ok((start..start, format!("{text}\n{gap}")));
                }
                Ok((at..at, format!("\n{text}\n{gap}{indent}")))
            }
            Place::After(item) => {
                let own = own_range(&item);
                let text = indented(lines, self.indent(own.start));
                Ok(self.below(own.end, &format!("\n{gap}{text}"), self.indent(own.start)))
            }
            Place::Top if list.kind() == Kind::File => {
                let text = indented(lines, "");
                let rest = if self.text.trim().is_empty() { "" } else { gap };
                Ok((0..0, format!("{text}\n{rest}")))
            }
            Place::Top => {
                let open = open_bracket(list)?;
                let outer = self.indent(range(&open).start).to_owned();
                let inner = format!("{outer}    ");
                let text = format!("\n{}", indented(lines, &inner));
                let at = self.behind_comment(&open);
                let close = close_bracket(list)?;
                if self.text[at..range(&close).start].trim().is_empty()
                    && !self.begins_line(range(&close).start)
                {
                    return Ok((at..range(&close).start, format!("{text}\n{outer}")));
                }
                Ok(self.below(at, &(text + gap), &inner))
            }
        }
    }

    /// Adds lines after a place, and moves the rest of its line after them.
    fn below(&self, at: usize, text: &str, indent: &str) -> Splice {
        if self.ends_line(at) {
            return (at..at, text.to_owned());
        }
        let rest = &self.text[at..];
        let blanks = rest.len() - rest.trim_start_matches([' ', '\t']).len();
        (at..at + blanks, format!("{text}\n{indent}"))
    }

    /// The place after a token and the comment on its line.
    fn behind_comment(&self, token: &Token) -> usize {
        let mut end = range(token).end;
        let mut next = token.next_token();
        while let Some(token) = next {
            match token.kind() {
                Kind::Whitespace if !token.text().contains('\n') => {}
                Kind::Comment => end = range(&token).end,
                _ => break,
            }
            next = token.next_token();
        }
        end
    }

    /// Adds an edge or binding after the last of `items`: on the same line if the list has one
    /// line, else on a new line.
    pub fn append(&self, list: &Node, items: &[Node], text: &str) -> Result<Splice, Refused> {
        let (open, close) = (open_bracket(list)?, close_bracket(list)?);
        let inner = range(&open).end..range(&close).start;
        let one_line = !self.text[inner.clone()].contains('\n');
        let Some(last) = items.last() else {
            return self.first(list, &open, inner, text);
        };
        let own = own_range(last);
        if one_line {
            let comma = last.last_token().is_some_and(|token| token.kind() == Kind::Comma);
            let joint = if comma { " " } else { ", " };
            return Ok((own.end..own.end, format!("{joint}{text}")));
        }
        let tokens = last.descendants_with_tokens().filter_map(|each| each.into_token());
        let closing = tokens.filter(|token| !token.kind().is_trivia()).last();
        let comma = closing.is_some_and(|token| token.kind() == Kind::Comma);
        let text = if comma { format!("{text},") } else { text.to_owned() };
        self.insert_lines(list, Place::After(last.clone()), &text, false)
    }

    fn first(
        &self,
        list: &Node,
        open: &Token,
        inner: Range<usize>,
        text: &str,
    ) -> Result<Splice, Refused> {
        if !self.text[inner.clone()].trim().is_empty()
            || list.children().any(|c| c.kind() == Kind::Guard)
        {
            let after = list.children().filter(|child| child.kind() == Kind::Guard).last();
            let place = after.map_or(Place::Top, Place::After);
            return self.insert_lines(list, place, text, false);
        }
        if open.kind() == Kind::OpenParen {
            return Ok((inner, text.to_owned()));
        }
        match list.kind() {
            Kind::Guard => Ok((inner, format!(" {text} "))),
            _ => self.insert_lines(list, Place::Top, text, false),
        }
    }

    pub fn remove(&self, node: &Node) -> Splice {
        let own = own_range(node);
        if self.begins_line(own.start) && self.ends_line(own.end) {
            return (self.whole_lines(own), String::new());
        }
        let before = solid_before(&self.root, own.start);
        let after = solid_after(&self.root, own.end);
        let closes = after.as_ref().is_some_and(is_close);
        match (&before, &after) {
            (Some(before), Some(after)) if closes && is_open(before) => {
                let inner = range(before).end..range(after).start;
                let rest = format!(
                    "{}{}",
                    &self.text[inner.start..own.start],
                    &self.text[own.end..inner.end]
                );
                if rest.trim().is_empty() { (inner, String::new()) } else { (own, String::new()) }
            }
            (Some(before), _) if closes => {
                let start = if before.kind() == Kind::Comma {
                    range(before).start
                } else {
                    range(before).end
                };
                let gap = &self.text[start..own.start];
                let bare = gap.trim_matches([',', ' ', '\t']).is_empty();
                (if bare { start..own.end } else { own }, String::new())
            }
            _ => {
                let rest = &self.text[own.end..];
                let blanks = rest.len() - rest.trim_start_matches([' ', '\t']).len();
                (own.start..own.end + blanks, String::new())
            }
        }
    }

    /// Whole lines, with a superfluous blank line before or after them.
    fn whole_lines(&self, own: Range<usize>) -> Range<usize> {
        let start = self.line_start(own.start);
        let end = (self.line_end(own.end) + 1).min(self.text.len());
        let above = &self.text[..start];
        let below = &self.text[end..];
        let blank_above = above.trim_end_matches([' ', '\t', '\r', '\n']).len();
        let blanks_above = above[blank_above..].matches('\n').count();
        let next = below.trim_start_matches([' ', '\t', '\r', '\n']);
        let is_blank_below = below[..below.len() - next.len()].contains('\n')
            && below.lines().next().is_some_and(|line| line.trim().is_empty());
        let opens = above.trim_end().is_empty() || self.opens_above(start);
        if is_blank_below && (blanks_above > 1 || opens) {
            let first = self.text.len() - next.len();
            return start..self.line_start(first).max(end);
        }
        if blanks_above > 1 && (next.is_empty() || next.starts_with(['}', ')'])) && !is_blank_below
        {
            return (blank_above + above[blank_above..].find('\n').map_or(0, |at| at + 1))..end;
        }
        start..end
    }

    fn opens_above(&self, at: usize) -> bool {
        let Some(before) = solid_before(&self.root, at) else { return false };
        let between = &self.text[range(&before).end..at];
        is_open(&before) && between.trim().is_empty()
    }

    /// The text of an item with its comments, as lines without indentation.
    pub fn lines_of(&self, node: &Node) -> String {
        let own = own_range(node);
        dedented(&self.text[own.clone()], self.indent(own.start))
    }
}

pub(super) fn indented(lines: &str, indent: &str) -> String {
    let line = |line: &str| if line.is_empty() { String::new() } else { format!("{indent}{line}") };
    lines.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// Removes up to the given indentation from every line but the first.
pub(super) fn dedented(text: &str, indent: &str) -> String {
    let line = |line: &str| {
        let common = line.bytes().zip(indent.bytes()).take_while(|(a, b)| a == b).count();
        line[common..].trim_end().to_owned()
    };
    let mut lines = text.lines();
    let first = lines.next().unwrap_or_default().trim_end().to_owned();
    std::iter::once(first).chain(lines.map(line)).collect::<Vec<_>>().join("\n")
}

fn is_open(token: &Token) -> bool {
    matches!(token.kind(), Kind::OpenBrace | Kind::OpenParen)
}

fn is_close(token: &Token) -> bool {
    matches!(token.kind(), Kind::CloseBrace | Kind::CloseParen)
}

pub(super) fn open_bracket(list: &Node) -> Result<Token, Refused> {
    bracket(list, [Kind::OpenParen, Kind::OpenBrace])
}

pub(super) fn close_bracket(list: &Node) -> Result<Token, Refused> {
    bracket(list, [Kind::CloseParen, Kind::CloseBrace])
}

fn bracket(list: &Node, kinds: [Kind; 2]) -> Result<Token, Refused> {
    let all = list.children_with_tokens().filter_map(|each| each.into_token());
    let mut brackets = all.filter(|token| !is_comment(token) && kinds.contains(&token.kind()));
    brackets.next().ok_or_else(|| Refused::new("a bracket of the list is missing"))
}
