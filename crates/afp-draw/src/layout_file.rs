//! The side file with the positions of a drawing, `plan.afp.layout`.
//!
//! One line for each element, sorted, so that two people who move different elements do not get in
//! each other's way: `Plan.element X Y`, the upper left corner in pixels of the
//! drawing. Local supervisors and entries
//! have positions too; `start`, `terminate` and `ignore` name the tags of a plan. Positions never
//! change what a plan means, and a file with errors still gives all the others.

mod read;

use std::collections::BTreeMap;
use std::fmt::{self, Write};

use afp_dsl::outline::{Outline, Plan};
use afp_syntax::item::Item;

/// By what the tags of a plan go.
const TAGS: [&str; 3] = ["start", "terminate", "ignore"];

/// Where something is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// To the right.
    pub x: i32,
    /// Downwards.
    pub y: i32,
}

/// The positions of a file's elements.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// Comments, and lines that place nothing, in their order.
    unknown: Vec<String>,
    placed: BTreeMap<Item, Placed>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Placed {
    position: Position,
    /// What stands behind the position.
    rest: String,
    /// What further lines say of the item, without its path: people choose.
    again: Vec<String>,
}

/// A line that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LayoutError {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1, in characters.
    pub column: usize,
    /// What is wrong there: lower case, no final period.
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
    /// Lines that do not begin with the path of an item and its position place nothing; unless they are comments, they
    /// are errors, and so is a line that places an item a second time. All are kept for [`Layout::write`].
    pub fn read(text: &str) -> (Layout, Vec<LayoutError>) {
        read::read(text, None)
    }

    /// The same for a file of an outline, by its number there. Where a line places nothing of that file is an error,
    /// too; the position is kept.
    pub fn read_for(text: &str, outline: &Outline, file: u16) -> (Layout, Vec<LayoutError>) {
        let plans = outline.plans.iter().filter(|plan| plan.file() == file);
        let items = plans.flat_map(items_of).map(|item| (item.clone(), item.to_string()));
        read::read(text, Some(&items.collect()))
    }

    /// The text of the file: first the lines that place nothing, then the positions sorted by path.
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

    /// Where an item is drawn; `None` leaves it to the automatic layout.
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

    /// Leaves an item to the automatic layout, and what belongs to it.
    pub fn remove(&mut self, item: &Item) {
        self.placed.retain(|known, _| !known.lies_in(item));
    }

    /// All items that have a position, in the order of their names.
    pub fn iter(&self) -> impl Iterator<Item = (&Item, Position)> {
        self.placed.iter().map(|(item, placed)| (item, placed.position))
    }

    /// Gives an item, and what lies in it, another path. A position that was left there is none of theirs.
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

/// What can have a position in a plan.
fn items_of(plan: &Plan) -> impl Iterator<Item = Item> {
    let tag = |name| Item::inner(plan.item.name(), name);
    let parts = plan.components().map(|component| &component.item);
    let entries = plan.entries.iter().map(|entry| &entry.item);
    parts.chain(entries).cloned().chain(TAGS.map(tag))
}

#[cfg(test)]
mod tests;
