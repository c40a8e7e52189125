//! Tables of constants, which files of plans declare and `Row` of `std` reads.

use crate::types::{Constant, Type};
use afp_syntax::source::Span;

/// A table as its file declares it.
#[derive(Clone, Debug)]
pub struct Table {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    pub columns: Vec<Column>,
    /// Its rows as written, each with a value for every column; those with errors are missing.
    pub rows: Vec<Vec<Cell>>,
    /// The name in the text.
    pub span: Span,
}

/// A column of a table.
#[derive(Clone, Debug)]
pub struct Column {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// The type of its values; `None` where that is wrong. No object, nor a type of ports.
    pub ty: Option<Type>,
    /// The name in the text.
    pub span: Span,
}

/// A value of a row.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The value, of its column's type.
    pub value: Constant,
    /// The place of its formula.
    pub span: Span,
}
