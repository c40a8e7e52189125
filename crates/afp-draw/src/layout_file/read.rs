//! Reads a layout file, line by line.

use std::collections::BTreeMap;

use super::{Layout, LayoutError, Placed, Position};
use afp_syntax::diagnostics::words::nearest;
use afp_syntax::item::Item;

/// The start of a comment.
const COMMENT: char = '#';

/// Reads all lines and keeps invalid lines unchanged. `known` are the items that can have
/// positions; all can if it is `None`.
pub(super) fn read(
    text: &str,
    known: Option<&BTreeMap<Item, String>>,
) -> (Layout, Vec<LayoutError>) {
    let mut layout = Layout::default();
    let mut errors = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let read = self::line(line.trim_end());
        if !matches!(read, Ok(Some(_))) && !line.trim_end().is_empty() {
            layout.unknown.push(line.trim_end().to_owned());
        }
        let read = read.and_then(|placed| match placed {
            Some((item, placed)) => {
                layout.add(&item, placed).and_then(|()| is_known(line, &item, known))
            }
            None => Ok(()),
        });
        if let Err((column, message)) = read {
            errors.push(LayoutError { line: index + 1, column, message });
        }
    }
    (layout, errors)
}

/// The column and the message of an error in a line.
type Wrong = (usize, String);

fn line(line: &str) -> Result<Option<(Item, Placed)>, Wrong> {
    let mut words = Words { line, at: 0 };
    let column = words.column();
    let path = words.next();
    let Some(item) = item(path) else {
        let is_nothing = path.is_empty() || path.starts_with(COMMENT);
        let wrong = || format!("expected a line such as 'Plan.element 300 120', found '{path}'");
        return if is_nothing { Ok(None) } else { Err((column, wrong())) };
    };
    let column = words.column();
    let x = number(words.next(), column)?;
    let column = words.column();
    let y = number(words.next(), column)?;
    let rest = words.rest().to_owned();
    Ok(Some((item, Placed { rest, ..Placed::at(Position { x, y }) })))
}

impl Layout {
    /// Adds the position of a line; the first line of an item counts.
    fn add(&mut self, item: &Item, placed: Placed) -> Result<(), Wrong> {
        let Some(first) = self.placed.get_mut(item) else {
            self.placed.insert(item.clone(), placed);
            return Ok(());
        };
        let Placed { position: Position { x, y }, rest, .. } = placed;
        first.again.push(format!("{x} {y} {rest}").trim_end().to_owned());
        Err((1, format!("'{item}' already has a position: remove one of the lines")))
    }
}

/// Whether the item of a line exists; a line with an old name is kept all the same.
fn is_known(line: &str, item: &Item, known: Option<&BTreeMap<Item, String>>) -> Result<(), Wrong> {
    let Some(known) = known.filter(|known| !known.contains_key(item)) else { return Ok(()) };
    let path = item.to_string();
    let help = match nearest(&path, known.values().map(String::as_str)) {
        Some(near) => format!("write '{near}'"),
        None => "remove the line".to_owned(),
    };
    let column = Words { line, at: 0 }.column();
    Err((column, format!("unknown item '{path}': {help}")))
}

fn number(word: &str, column: usize) -> Result<i32, Wrong> {
    let found =
        if word.is_empty() { "the end of the line".to_owned() } else { format!("'{word}'") };
    word.parse().map_err(|_| (column, format!("expected a whole number, found {found}")))
}

/// The item of a path with two or three names.
fn item(path: &str) -> Option<Item> {
    let names: Vec<_> = path.split('.').collect();
    if !names.iter().all(|name| is_name(name)) {
        return None;
    }
    match names.as_slice() {
        [plan, name] => Some(Item::inner(*plan, *name)),
        [plan, owner, name] => Some(Item::local(*plan, *owner, *name)),
        _ => None,
    }
}

fn is_name(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_')
        && word.chars().all(|each| each.is_ascii_alphanumeric() || each == '_')
}

/// The words of a line and their columns.
struct Words<'t> {
    line: &'t str,
    at: usize,
}

impl<'t> Words<'t> {
    fn next(&mut self) -> &'t str {
        let rest = self.rest();
        let word = rest.split_whitespace().next().unwrap_or_default();
        self.at = self.line.len() - rest.len() + word.len();
        word
    }

    /// The rest of the line, without leading spaces.
    fn rest(&self) -> &'t str {
        self.line[self.at..].trim_start()
    }

    /// The column of the next word, from 1.
    fn column(&self) -> usize {
        let next = self.line.len() - self.rest().len();
        self.line[..next].chars().count() + 1
    }
}
