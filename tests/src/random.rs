//! Random valid plans: what the differential test of the two back ends runs.
//!
//! The build script compiles the same plans to Rust, so this module uses nothing of the package.

// Named by path, because the build script includes this file from elsewhere.
#[path = "random/dice.rs"]
pub mod dice;
#[path = "random/element.rs"]
mod element;
#[path = "random/entries.rs"]
mod entries;
#[path = "random/formula.rs"]
mod formula;
#[path = "random/plan.rs"]
mod plan;
#[path = "random/table.rs"]
mod table;

use std::fmt::Write;

use dice::Dice;
use plan::Shape;
use table::Table;

/// A random plan and what a script needs to know of it.
#[derive(Clone, Debug)]
pub struct RandomPlan {
    /// The text.
    pub text: String,
    /// The names by which scripts speak of its components.
    pub channels: Vec<Channel>,
    /// The entries of the outermost plan.
    pub entries: Vec<String>,
}

/// A component that a script can speak of.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Its `name` input.
    pub name: String,
    /// What it can report.
    pub outcomes: &'static [&'static str],
    /// Whether it is an actor.
    pub actor: bool,
}

/// The plan of a seed; equal seeds give equal plans, on every platform.
pub fn plan(seed: u64) -> RandomPlan {
    let mut dice = Dice::new(seed);
    let mut channels = Vec::new();
    let tables: Vec<Table> =
        (0..dice.between(0, 3)).map(|number| Table::new(number, &mut dice)).collect();
    // Inner plans first: whoever uses one must know its ports.
    let mut shapes: Vec<Shape> = Vec::new();
    for number in (0..dice.between(1, 4)).rev() {
        let shape = Shape::new(number, (&shapes, &tables), &mut dice, &mut channels);
        shapes.push(shape);
    }
    let mut text = "use std\nuse testing\n".to_owned();
    for table in &tables {
        let _ = write!(text, "\n{}", table.text);
    }
    for shape in shapes.iter().rev() {
        let _ = write!(text, "\n{}", shape.text);
    }
    let outermost = shapes.last().map(Shape::entry_names).unwrap_or_default();
    RandomPlan { text, channels, entries: outermost }
}
