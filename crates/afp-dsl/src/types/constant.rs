//! Values that are known before a plan runs.

/// A value known when a toolbox is read, already of its port's type.
#[derive(Clone, Debug, PartialEq)]
pub enum Constant {
    /// A truth value.
    Bool(bool),
    /// An integer.
    Int(i64),
    /// A number or a quantity in SI units.
    Float(f64),
    /// A text.
    Text(String),
    /// A value of an enum, by position.
    Choice(u16),
}
