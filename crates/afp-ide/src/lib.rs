//! Editor features as plain data, independent of a protocol: one file for each feature.
//!
//! The crate does no I/O: texts come in as values, and answers and edits go out. Each query reads a
//! [`View`] of a file, with places as byte offsets like in the compiler. Every query has an answer
//! for any text, also with errors.

pub mod actions;
pub mod candidates;
pub mod completion;
pub mod copy;
pub mod definition;
mod describe;
pub mod edit;
pub mod folding;
pub mod hints;
pub mod hover;
pub mod lenses;
pub mod palette;
pub mod parts;
pub mod references;
pub mod selection;
pub mod signature;
pub mod symbols;
pub mod tokens;
mod view;

pub use view::View;
