//! What compiler and run time say alike: times and values, the arithmetic of formulas, how texts become numbers and
//! numbers texts, what components, entries, devices and parts of rows are, how much one step may do, and which number
//! tells texts apart.
//!
//! A formula that is constant is computed by the compiler, any other by the interpreter or by
//! generated Rust; `35 cm` may stand in a plan, in a text that an entry is read from, or on a command
//! line. All of them come here, so that they cannot disagree. Nothing panics, allocates or needs an
//! operating system.
#![no_std]
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod arithmetic;
mod comparison;
mod decimal;
pub mod devices;
mod exact;
mod formula;
pub mod function;
mod hash;
mod id;
mod kind;
mod meaning;
mod measured;
mod read;
mod row;
mod target;
mod text;
mod time;
mod units;
mod value;

pub use arithmetic::{
    bool_to_float, bool_to_int, finite, float_to_int, int_add, int_mul, int_neg, int_rem, int_sub,
    int_to_float, rem,
};
pub use comparison::Comparison;
pub use decimal::{Decimal, number_length};
pub use exact::{RADIANS_PER_DEGREE, Scale, exact};
pub use formula::{Node, Op, Operator, Part, Shape, Source};
pub use function::{Function, Signature};
pub use hash::TextHash;
pub use id::{ElementId, EntryId, PlanId, ReasonId, SupervisorId, ToolboxId};
pub use kind::{ComponentKind, EntryKind};
pub use meaning::Meaning;
pub use measured::{EXACT, Measured};
pub use read::{Quantity, Unit, parse_bool, parse_choice, parse_float, parse_int, parse_quantity};
pub use row::{Child, ElementKind, ElementRow, Events, PlanTable, Range, SupervisorRow, Timing};
pub use target::Target;
pub use text::{Nanoseconds, Rounded};
pub use time::{Duration, Instant};
pub use units::{Powers, SiUnit, SingleUnit};
pub use value::{Text, Value, ValueOf, ValueRef};

use core::fmt;

/// Greatest length of a text in bytes of UTF-8.
pub const MAX_TEXT: usize = 64;

/// Edges that one step may take, all levels together. A plan that needs more lets no time pass.
pub const MAX_TRANSITIONS_PER_STEP: u32 = 1000;

/// Why a formula has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error {
    /// An integer leaves 64 bits.
    Overflow,
    /// A division or remainder by zero.
    DivisionByZero,
    /// The result is infinite or not a number.
    NotFinite,
    /// A range whose least value is above its greatest one.
    NoRange,
    /// A text of more than [`MAX_TEXT`] bytes.
    TooLong,
    /// A text is no value of the wanted type.
    NotAValue,
    /// An entry has no value before the plan runs; only the compiler meets this error.
    Unknown,
    /// A part of the formula has another type than its use needs, which the check rules out.
    Mistyped,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Error::Overflow => "an integer leaves 64 bits",
            Error::DivisionByZero => "a division by zero",
            Error::NotFinite => "the result is not finite",
            Error::NoRange => "the least value of a range is above its greatest one",
            Error::TooLong => "a text of more than 64 bytes",
            Error::NotAValue => "a text is no value of the wanted type",
            Error::Unknown => "an entry has no value yet",
            Error::Mistyped => "a part of a formula has the wrong type",
        })
    }
}

impl core::error::Error for Error {}
