//! Properties of all inputs, one function for each parser.
//!
//! Each function takes any bytes of a fuzzer and panics if a property does not hold. The same
//! functions run over the corpora in `cargo test`.

mod controller;
mod debugger;
mod deploy;
mod edits;
mod frames;
mod messages;
mod names;
mod text;

pub use controller::{controller, ugv};
pub use debugger::debugger;
pub use deploy::deploy;
pub use edits::edits;
pub use frames::frames;
pub use messages::messages;
pub use text::{checker, formatter, layout, map, parser, scenario, settings, world};

/// A property of bytes.
pub type Target = fn(&[u8]);

/// All targets, by the name of the fuzzer and of the folder of its corpus.
pub const TARGETS: &[(&str, Target)] = &[
    ("parser", parser),
    ("checker", checker),
    ("formatter", formatter),
    ("edits", edits),
    ("messages", messages),
    ("debugger", debugger),
    ("controller", controller),
    ("ugv", ugv),
    ("deploy", deploy),
    ("frames", frames),
    ("settings", settings),
    ("layout", layout),
    ("world", world),
    ("map", map),
    ("scenario", scenario),
];
