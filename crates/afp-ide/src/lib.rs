//! Plain data for editors of plans, whatever protocol they speak: one file for each feature.
//!
//! It does no I/O: texts come in as values, answers and edits of them go out. What a file says is
//! asked of a [`View`] of it; places are bytes, as everywhere in the compiler. Every question has an
//! answer for any text, however broken.

pub mod actions;
pub mod candidates;
pub mod completion;
pub mod definition;
mod describe;
pub mod edit;
pub mod folding;
pub mod hints;
pub mod hover;
pub mod lenses;
pub mod palette;
pub mod references;
pub mod selection;
pub mod signature;
pub mod symbols;
pub mod tokens;
mod view;

pub use view::View;
