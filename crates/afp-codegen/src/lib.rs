//! The Rust back end: typed templates from a toolbox, a native plan from a graph, a whole crate.
//!
//! There is one function per construct, which returns tokens, and one module per generated
//! artifact. The code of a plan reads like a hand-written program: its actors, its supervisors, the
//! plan, its rules, under the plan's own names. Of the run time, it only uses `afp_core::rt` and
//! the types that components see.

mod enums;
mod formula;
mod input;
mod krate;
mod layout;
mod linked;
mod manifest;
mod names;
mod places;
mod plan;
mod rust_type;
mod scenarios;
mod toolbox;
mod wrong;

use proc_macro2::TokenStream;
use quote::quote;

pub use input::MacroInput;
pub use krate::{CrateFile, CrateOptions, Hardware, crate_files};
pub use layout::{code, file};
pub use linked::{LinkOptions, extension_files, runner_files};
pub use manifest::{Dependency, Features, MADE_BY, Origin, RUST_MADE_BY};
pub use places::Places;
pub use plan::{Generated, Module, plan};
pub use scenarios::{ScenarioSetting, ScenarioTests};
pub use toolbox::{Asked, Support, complete, declaration, register_supported, toolbox};
pub use wrong::{compile_error, compile_errors};

/// The names that generated code uses.
#[derive(Clone, Debug)]
pub struct Options {
    /// The path of `afp_core`, such as `::afp_core` or `::afp::core`.
    pub core: TokenStream,
    /// For a toolbox: the expression of its text, such as `include_str!("x.afp")`.
    pub source: TokenStream,
    /// For a plan: whether debuggers can hold it. Without it, only elements that an event suspends
    /// have code for it.
    pub hold: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options { core: quote!(::afp_core), source: quote!(""), hold: false }
    }
}
