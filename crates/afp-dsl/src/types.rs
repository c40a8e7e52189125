//! Types of entries, ports and formulas.

pub mod converter;
pub mod readable;
pub mod text;

use std::fmt;
use std::sync::Arc;

use afp_syntax::diagnostics::{Arg, ToArg};
use afp_syntax::source::Span;

pub use afp_syntax::dimension::Dimension;

/// A value that is known before a run, converted to the type of its port or entry. It is always set
/// and never an object.
pub type Constant = afp_types::Value;

/// The type of an entry, a port or a formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Type {
    /// `bool`
    Bool,
    /// `int`, 64 bit
    Int,
    /// A `float` (dimensionless) or a quantity, 64 bit in SI units.
    Quantity(Dimension),
    /// `string`, at most 64 bytes of UTF-8
    Text,
    /// An enum; equal if name and origin, a toolbox or a plan file, are equal.
    Enum(Arc<Enum>),
    /// An object type; equal if name and origin are equal.
    Object(Arc<Object>),
    /// `any`, only in ports of toolboxes.
    Any,
    /// `number`, only in ports of toolboxes.
    Number,
    /// `discrete`, only in ports of toolboxes: a type that is compared only for equality.
    Discrete,
}

/// An enum of a toolbox or of a plan file.
#[derive(Clone, Debug)]
pub struct Enum {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// The toolbox that declares it; `None` for an enum of a plan file.
    pub toolbox: Option<String>,
    /// The names of its values.
    pub variants: Vec<String>,
    /// The spans of these names.
    pub variant_spans: Vec<Span>,
    /// The span of the name.
    pub span: Span,
}

/// An opaque type of a toolbox.
#[derive(Clone, Debug)]
pub struct Object {
    pub name: String,
    /// Its `///` lines.
    pub doc: String,
    /// The toolbox that declares it.
    pub toolbox: String,
    /// The span of the name.
    pub span: Span,
}

/// The conversion between two types.
#[derive(Clone, Debug, PartialEq)]
pub enum Conversion {
    /// `int` to `float`, exact up to 2^53.
    IntToFloat,
    /// `float` to `int`, toward zero; a fault if out of range.
    FloatToInt,
    /// `bool` to `int`: 0 or 1.
    BoolToInt,
    /// `bool` to `float`: 0 or 1.
    BoolToFloat,
    /// Any type but an object to a string. Quantities have their SI value and unit.
    ToText(Type),
    /// A string to a type, in the literal syntax of that type, with the unit.
    FromText(Type),
}

impl PartialEq for Enum {
    fn eq(&self, other: &Self) -> bool {
        let home = |choices: &Enum| choices.toolbox.is_none().then_some(choices.span.file);
        (&self.name, &self.toolbox, home(self)) == (&other.name, &other.toolbox, home(other))
    }
}

impl PartialEq for Object {
    fn eq(&self, other: &Self) -> bool {
        (&self.name, &self.toolbox) == (&other.name, &other.toolbox)
    }
}

impl Type {
    /// `float`.
    pub const FLOAT: Type = Type::Quantity(Dimension::NONE);

    /// Whether formulas can compute with it.
    pub fn is_numeric(&self) -> bool {
        matches!(self, Type::Int | Type::Quantity(_) | Type::Number)
    }

    /// Whether its values are compared only for equality.
    pub fn is_discrete(&self) -> bool {
        matches!(self, Type::Bool | Type::Int | Type::Text | Type::Enum(_) | Type::Discrete)
    }

    /// Whether it is a different type in each use of a template.
    pub(crate) fn is_generic(&self) -> bool {
        matches!(self, Type::Any | Type::Number | Type::Discrete)
    }

    /// The name of its declaration; `None` for a built-in one.
    pub fn declaration(&self) -> Option<Span> {
        match self {
            Type::Enum(home) => Some(home.span),
            Type::Object(home) => Some(home.span),
            _ => None,
        }
    }

    /// The name of an enum or object type; empty for a built-in type.
    pub fn declared_name(&self) -> &str {
        match self {
            Type::Enum(home) => &home.name,
            Type::Object(home) => &home.name,
            _ => "",
        }
    }

    /// The SI unit of its values; empty unless it is a quantity.
    pub fn si_unit(&self) -> String {
        match self {
            Type::Quantity(dimension) => dimension.si_unit(),
            _ => String::new(),
        }
    }

    /// The values of an enum; empty for other types.
    pub fn choices(&self) -> &[String] {
        match self {
            Type::Enum(choices) => &choices.variants,
            _ => &[],
        }
    }
}

/// Names of types that plans can write, without dimensions.
pub(crate) const PLAIN: &[&str] = &["bool", "int", "float", "string"];

/// Names of types that only ports of toolboxes have.
pub(crate) const GENERIC: &[&str] = &["any", "number", "discrete"];

pub fn is_built_in(name: &str) -> bool {
    PLAIN.contains(&name) || GENERIC.contains(&name) || Dimension::named(name).is_some()
}

impl fmt::Display for Type {
    /// In the spelling of a plan: `length`, `int`, `Side`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Type::Bool => f.write_str("bool"),
            Type::Int => f.write_str("int"),
            Type::Quantity(dimension) => f.write_str(&dimension.name()),
            Type::Text => f.write_str("string"),
            Type::Enum(choices) => f.write_str(&choices.name),
            Type::Object(object) => f.write_str(&object.name),
            Type::Any => f.write_str("any"),
            Type::Number => f.write_str("number"),
            Type::Discrete => f.write_str("discrete"),
        }
    }
}

impl ToArg for Type {
    fn to_arg(&self) -> Arg {
        Arg::Name(self.to_string())
    }
}
