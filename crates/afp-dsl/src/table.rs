//! Tables of constants, declared in plan files and read by `Row` of `std`.

use crate::types::{Constant, Type};
use afp_syntax::source::Span;

#[derive(Clone, Debug)]
pub struct Table {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    pub columns: Vec<Column>,
    /// Its rows in source order, each with a value for every column; rows with errors are missing.
    pub rows: Vec<Vec<Cell>>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Column {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// The type of its values, neither an object nor generic; `None` if invalid.
    pub ty: Option<Type>,
    pub span: Span,
}

#[derive(Clone, Debug)]
pub struct Cell {
    pub value: Constant,
    pub span: Span,
}
