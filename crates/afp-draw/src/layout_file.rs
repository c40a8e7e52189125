//! The side file with the positions of a drawing, `plan.afp.layout`.
//!
//! It has one line for each element, sorted, so that two users who move different elements do not
//! cause conflicts: `Plan.element X Y`, the upper left corner in pixels of the drawing. Local
//! supervisors and entries have positions too; `start`, `terminate` and `ignore` name the tags of a
//! plan. Positions never change the meaning of a plan, and an invalid line does not affect the
//! others.

mod read;

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use afp_dsl::outline::{Outline, Plan};
use afp_syntax::item::Item;

/// The names of a plan's tags.
const TAGS: [&str; 3] = ["start", "terminate", "ignore"];

/// A position in a drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// Pixels to the right.
    pub x: i32,
    /// Pixels downwards.
    pub y: i32,
}

/// The positions of a file's elements.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// Comments and invalid lines, in order.
    unknown: Vec<String>,
    placed: BTreeMap<Item, Placed>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Placed {
    position: Position,
    /// The text after the position.
    rest: String,
    /// The contents of further lines for the item, without its path: the user decides.
    again: Vec<String>,
}

/// An invalid line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LayoutError {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1, in characters.
    pub column: usize,
    /// The message: lower case, no final period.
    pub message: String,
}

impl fmt::Display for LayoutError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

impl std::error::Error for LayoutError {}

impl Layout {
    /// Reads the text of a layout file.
    ///
    /// A valid line begins with the path of an item and its position. Other lines are errors unless
    /// they are comments, and a second line for an item is an error, too. All lines are kept for
    /// [`Layout::write`].
    pub fn read(text: &str) -> (Layout, Vec<LayoutError>) {
        read::read(text, None)
    }

    /// Like [`Layout::read`], for a file of an outline, by its number. A line for an unknown item
    /// of that file is an error, too; its position is kept.
    pub fn read_for(text: &str, outline: &Outline, file: u16) -> (Layout, Vec<LayoutError>) {
        let plans = outline.plans.iter().filter(|plan| plan.file() == file);
        let items = plans.flat_map(items_of).map(|item| (item.clone(), item.to_string()));
        read::read(text, Some(&items.collect()))
    }

    /// The text of the file: first the lines without positions, then the positions sorted by path.
    pub fn write(&self) -> String {
        let mut text = String::new();
        for line in &self.unknown {
            text += &format!("{line}\n");
        }
        let mut lines: Vec<_> =
            self.placed.iter().map(|(item, placed)| (item.to_string(), placed)).collect();
        lines.sort_by(|a, b| a.0.cmp(&b.0));
        for (path, Placed { position, rest, again }) in lines {
            let gap = if rest.is_empty() { "" } else { " " };
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{path} {} {}{gap}{rest}", position.x, position.y);
            for line in again {
                let _ = writeln!(text, "{path} {line}");
            }
        }
        text
    }

    /// The position of an item; `None` leaves it to the automatic layout.
    pub fn get(&self, item: &Item) -> Option<Position> {
        self.placed.get(item).map(|placed| placed.position)
    }

    pub fn set(&mut self, item: Item, position: Position) {
        match self.placed.get_mut(&item) {
            Some(placed) => placed.position = position,
            None => {
                self.placed.insert(item, Placed::at(position));
            }
        }
    }

    /// Removes the positions of an item and its parts.
    pub fn remove(&mut self, item: &Item) {
        self.placed.retain(|known, _| !known.lies_in(item));
    }

    /// All items with a position, in the order of their names.
    pub fn iter(&self) -> impl Iterator<Item = (&Item, Position)> {
        self.placed.iter().map(|(item, placed)| (item, placed.position))
    }

    /// Moves an item and its parts to another path, and discards an old position of that path.
    pub fn relocate(&mut self, from: &Item, to: &Item) {
        let all = std::mem::take(&mut self.placed).into_iter();
        let (moved, stays): (Vec<_>, Vec<_>) = all.partition(|(item, _)| item.lies_in(from));
        let is_apart = !from.lies_in(to) && !to.lies_in(from);
        let stays = stays.into_iter().filter(|(item, _)| !(is_apart && item.lies_in(to)));
        self.placed = stays.collect();
        self.placed.extend(moved.into_iter().map(|(item, placed)| (item.moved(from, to), placed)));
    }
}

impl Placed {
    fn at(position: Position) -> Placed {
        Placed { position, rest: String::new(), again: Vec::new() }
    }
}

/// The items of a plan that can have a position.
fn items_of(plan: &Plan) -> impl Iterator<Item = Item> {
    let tag = |name| Item::inner(plan.item.name(), name);
    let parts = plan.components().map(|component| &component.item);
    let entries = plan.entries.iter().map(|entry| &entry.item);
    parts.chain(entries).cloned().chain(TAGS.map(tag))
}

#[cfg(test)]
mod tests;
