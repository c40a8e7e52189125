//! The context at a place of a project file, which may have errors: for editors during typing.

use std::ops::Range;

/// A place in a project file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Spot<'t> {
    /// The path of the table.
    pub table: Vec<&'t str>,
    pub kind: SpotKind,
    /// The name at the place; empty if there is none yet.
    pub word: Range<usize>,
}

/// The kind of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpotKind {
    /// A name in a heading.
    Heading,
    /// A key, or the place for one.
    Key,
    /// A value or a comment.
    Value,
}

/// The context at a byte offset. Quotes are removed from keys; a multi-line value counts as keys
/// from its second line on.
pub fn spot(text: &str, offset: usize) -> Spot<'_> {
    let offset =
        (0..=offset.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
    let start = text[..offset].rfind('\n').map_or(0, |at| at + 1);
    let end = text[offset..].find('\n').map_or(text.len(), |at| offset + at);
    let line = &text[start..end];
    let indent = line.len() - line.trim_start().len();
    if line[indent..].starts_with('[') && offset > start + indent {
        let inner = start + indent + line[indent..].chars().take_while(|it| *it == '[').count();
        let until = text[inner..end].find(']').map_or(end, |at| inner + at);
        if offset <= until {
            let (table, word) = path(text, inner..until, offset.max(inner));
            return Spot { table, kind: SpotKind::Heading, word };
        }
        return Spot { table: Vec::new(), kind: SpotKind::Value, word: offset..offset };
    }
    in_line(text, start..end, offset, heading(&text[..start]))
}

/// The places of all headings.
pub fn headings(text: &str) -> Vec<Range<usize>> {
    let mut start = 0;
    let lines = text.split_inclusive('\n').map(|line| {
        let at = start;
        start += line.len();
        (at, line.trim_end())
    });
    let heads = lines.filter(|(_, line)| line.trim_start().starts_with('['));
    heads.map(|(at, line)| at + line.len() - line.trim_start().len()..at + line.len()).collect()
}

/// The path of the table at the end of a text.
fn heading(before: &str) -> Vec<&str> {
    let last = headings(before).pop().map(|span| &before[span]);
    let inner = last.map(|line| line.trim_matches('['));
    let names = inner.and_then(|line| line.split(']').next());
    names.into_iter().flat_map(|names| names.split('.')).map(bare).collect()
}

/// The names before a place, and the name at it.
fn path(text: &str, names: Range<usize>, offset: usize) -> (Vec<&str>, Range<usize>) {
    let from = text[names.start..offset].rfind('.').map_or(names.start, |at| names.start + at + 1);
    let to = text[offset..names.end].find('.').map_or(names.end, |at| offset + at);
    let before = &text[names.start..from];
    let table = before.split_terminator('.').map(bare).collect();
    let word = &text[from..to];
    let start = from + word.len() - word.trim_start().len();
    (table, start..(from + word.trim_end().len()).max(start))
}

fn bare(name: &str) -> &str {
    name.trim().trim_matches(['"', '\''])
}

/// The context in a line of keys and values, including braces.
fn in_line<'t>(
    text: &'t str,
    line: Range<usize>,
    offset: usize,
    mut table: Vec<&'t str>,
) -> Spot<'t> {
    // The number of names that each brace has added, and the start of the key; `None` in a value.
    let (mut open, mut key) = (Vec::new(), Some(line.start));
    let mut names: Vec<&str> = Vec::new();
    let mut quote = None;
    for (at, letter) in text[line.start..offset].char_indices() {
        let at = line.start + at;
        match (quote, letter) {
            (Some(mark), letter) => quote = Some(mark).filter(|mark| *mark != letter),
            (None, '"' | '\'') if key.is_none() => quote = Some(letter),
            (None, '#') => return Spot { table, kind: SpotKind::Value, word: offset..offset },
            (None, '=') => {
                names = text[key.unwrap_or(at)..at].split('.').map(bare).collect();
                key = None;
            }
            (None, '{') => {
                open.push(names.len());
                table.append(&mut names);
                key = Some(at + 1);
            }
            (None, '}') => {
                let added = open.pop().unwrap_or(0);
                table.truncate(table.len().saturating_sub(added));
                key = None;
            }
            (None, ',') if !open.is_empty() => key = Some(at + 1),
            _ => {}
        }
    }
    let Some(from) = key else {
        return Spot { table, kind: SpotKind::Value, word: offset..offset };
    };
    let is_end = |letter: char| "={},#".contains(letter);
    let end = text[offset..line.end].find(is_end).map_or(line.end, |at| offset + at);
    let (before, word) = path(text, from..end, offset);
    table.extend(before);
    Spot { table, kind: SpotKind::Key, word }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The context at `|` in a text: table, kind, word.
    fn at(text: &str) -> String {
        let offset = text.find('|').expect("a mark");
        let text = text.replacen('|', "", 1);
        let Spot { table, kind, word } = spot(&text, offset);
        format!("{} {kind:?} '{}'", table.join("."), &text[word])
    }

    #[test]
    fn an_incomplete_line_has_a_place() {
        for (text, wanted) in [
            ("|", " Key ''"),
            ("[ru|n]", " Heading 'run'"),
            ("[ru|", " Heading 'ru'"),
            ("[target.p|i]\n", "target Heading 'pi'"),
            ("[run]\nwor|", "run Key 'wor'"),
            ("[run]\n  wo|rld = 1", "run Key 'world'"),
            ("[run]\nworld = |\"a\"", "run Value ''"),
            ("[run]\nworld = \"a, {b|\"", "run Value ''"),
            ("[target.pi]\nbudgets.car|bot.Forward = \"1 s\"", "target.pi.budgets Key 'carbot'"),
            ("[toolboxes]\narm = { path = \"a\", cr|", "toolboxes.arm Key 'cr'"),
            ("[toolboxes]\narm = { crate = { |}, path = 1 }", "toolboxes.arm.crate Key ''"),
            ("[toolboxes]\narm = { crate = { a = 1 }, p| = 1 }", "toolboxes.arm Key 'p'"),
            ("[toolboxes]\narm = { path = 1 } # {|", "toolboxes Value ''"),
            ("[run] # c|", " Value ''"),
            ("[\"a b\".c]\nx|", "a b.c Key 'x'"),
        ] {
            assert_eq!(at(text), wanted, "{text}");
        }
    }

    #[test]
    fn every_position_of_any_text_has_an_answer() {
        let text = "[run\n}}=,é.{[\"'\n..a.=\n[[a.]]é\n\u{1F916}=";
        for offset in 0..text.len() + 3 {
            let Spot { word, .. } = spot(text, offset);
            assert!(text.get(word).is_some());
        }
    }
}
