//! The compiler of Action Flow Plans: text in; diagnostics, outline and static graph out.
//!
//! It does no I/O and depends only on `afp-syntax` and `afp-types`.

mod check;
mod compile;
pub mod files;
mod flow;
mod gather;
pub mod graph;
pub mod index;
pub mod outline;
pub mod rows;
pub mod scenario;
pub mod table;
pub mod timing;
pub mod toolbox;
pub mod types;
pub mod unfold;

pub use check::scenario::{VERBS, outputs};
pub use check::watch;
pub use compile::{Compiled, compile, compile_plan, compile_unchecked, index_files};
pub use gather::Toolboxes;
