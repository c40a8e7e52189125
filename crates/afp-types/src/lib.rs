//! Definitions that compiler and run time share: times and values, arithmetic of formulas, parsing
//! and printing of numbers, kinds of components, entries, devices and rows, limits of a step, and
//! the hash of strings.
//!
//! The compiler evaluates constant formulas, the interpreter or generated Rust evaluates the
//! others. `35 cm` may occur in a plan, in a string for an entry, or on a command line. All of them
//! use this crate, so that their results are identical. Nothing panics, allocates or needs an
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
pub use measured::{EXACT, Measured};
pub use read::{Quantity, Unit, parse_bool, parse_choice, parse_float, parse_int, parse_quantity};
pub use row::{Child, ElementKind, ElementRow, Events, PlanTable, Range, SupervisorRow, Timing};
pub use target::Target;
pub use text::{Nanoseconds, Rounded};
pub use time::{Duration, Instant};
pub use units::{Powers, SiUnit, SingleUnit};
pub use value::{Text, Value, ValueOf, ValueRef};

use core::fmt;

/// Maximum length of a string in bytes of UTF-8.
pub const MAX_TEXT: usize = 64;

/// Maximum number of edges per step, on all levels together. A plan that needs more does not let
/// time pass.
pub const MAX_TRANSITIONS_PER_STEP: u32 = 1000;

/// Why a formula has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error {
    /// Integer overflow.
    Overflow,
    /// A division or remainder by zero.
    DivisionByZero,
    /// The result is infinite or not a number.
    NotFinite,
    /// A range with its minimum above its maximum.
    NoRange,
    /// A string of more than [`MAX_TEXT`] bytes.
    TooLong,
    /// A string is not a value of the required type.
    NotAValue,
    /// An entry has no value before the plan runs; occurs only in the compiler.
    Unknown,
    /// A part of the formula has the wrong type; the checker excludes it.
    Mistyped,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Error::Overflow => "an integer does not fit 64 bits",
            Error::DivisionByZero => "a division by zero",
            Error::NotFinite => "the result is not finite",
            Error::NoRange => "the lower bound of a range is above its upper bound",
            Error::TooLong => "a string of more than 64 bytes",
            Error::NotAValue => "a string is not a value of the wanted type",
            Error::Unknown => "an entry has no value yet",
            Error::Mistyped => "a part of a formula has the wrong type",
        })
    }
}

impl core::error::Error for Error {}
