//! The lossless syntax tree of Action Flow Plans, and its diagnostics.
//!
//! This crate knows the grammar but not the meaning of a plan. It does no I/O. In the workspace it
//! depends only on `afp-excerpt`, which shows the places of mistakes, and on `afp-types`, which
//! reads numbers.

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
