//! Random valid plans for the differential test of the two back ends.
//!
//! The build script compiles the same plans to Rust, so this module is independent of the package.

// The path is explicit, because the build script includes this file.
#[path = "random/declared.rs"]
mod declared;
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

use declared::Declared;
use dice::Dice;
use plan::Shape;
use table::Table;

/// A random plan with its facts for a script.
#[derive(Clone, Debug)]
pub struct RandomPlan {
    pub text: String,
    /// The names of its components in scripts.
    pub channels: Vec<Channel>,
    /// The entries of the outermost plan.
    pub entries: Vec<String>,
}

/// A component for a script.
#[derive(Clone, Debug)]
pub struct Channel {
    /// Its `name` input.
    pub name: String,
    pub outcomes: &'static [&'static str],
    pub actor: bool,
}

/// The plan of a seed; equal seeds give equal plans on every platform.
pub fn plan(seed: u64) -> RandomPlan {
    let mut dice = Dice::new(seed);
    let mut channels = Vec::new();
    let tables: Vec<Table> =
        (0..dice.between(0, 3)).map(|number| Table::new(number, &mut dice)).collect();
    let declared: Vec<Declared> =
        (0..dice.between(0, 3)).map(|number| Declared::new(number, &mut dice)).collect();
    // Inner plans first, since their users need their ports.
    let mut shapes: Vec<Shape> = Vec::new();
    for number in (0..dice.between(1, 4)).rev() {
        let shape = Shape::new(number, (&shapes, &tables, &declared), &mut dice, &mut channels);
        shapes.push(shape);
    }
    let mut text = "use std\nuse testing\n".to_owned();
    for table in &tables {
        let _ = write!(text, "\n{}", table.text);
    }
    for declared in &declared {
        let _ = write!(text, "\n{}", declared.text);
    }
    for shape in shapes.iter().rev() {
        let _ = write!(text, "\n{}", shape.text);
    }
    let outermost = shapes.last().map(Shape::entry_names).unwrap_or_default();
    RandomPlan { text, channels, entries: outermost }
}
