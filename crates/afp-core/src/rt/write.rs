//! Errors of writes from outside.

/// Why a write from outside was rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WriteError {
    /// The plan has no such entry.
    Unknown,
    /// `const` and `out` entries cannot be written from outside.
    ReadOnly,
    /// The value has the wrong type.
    Type,
    /// The number is not finite.
    NotFinite,
    /// The value is out of the entry's range.
    Range,
    /// Too many writes since the last step.
    QueueFull,
    /// A `var` entry cannot be written before the start.
    NotStarted,
    /// The plan has ended.
    Ended,
}

impl core::fmt::Display for WriteError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            WriteError::Unknown => "the plan has no such entry",
            WriteError::ReadOnly => "only 'in' and 'var' entries can be written from outside",
            WriteError::Type => "the value does not have the entry's type",
            WriteError::NotFinite => "the value is not finite",
            WriteError::Range => "the value is out of the entry's range",
            WriteError::QueueFull => "too many writes since the last step",
            WriteError::NotStarted => {
                "a 'var' entry gets its initial value at the start: write it later"
            }
            WriteError::Ended => "the plan has ended",
        })
    }
}

impl core::error::Error for WriteError {}
