//! Texts of Action Flow Plans: a lossless tree of them, and what is wrong with them.
//!
//! It knows the grammar and nothing of what a text means. It does no I/O. Of the workspace it needs
//! `afp-excerpt`, which shows where mistakes are, and `afp-types`, which reads numbers.

pub mod ast;
pub mod diagnostics;
pub mod dimension;
pub mod habits;
pub mod item;
mod keywords;
pub mod kind;
mod lexer;
pub mod literal;
mod parser;
pub mod source;
mod text;
mod tree;
pub mod units;

pub use ast::may_have_scenario;
pub use kind::{Afp, Kind};
pub use text::unquote;
pub use tree::{Node, Parse, Token, count_tokens, node_span, parse, token_span};
