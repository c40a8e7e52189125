//! The reason why a change is refused.

use std::fmt;

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// Lower case, no final period, names in single quotes.
    pub reason: String,
}

impl Refused {
    pub(crate) fn new(reason: impl Into<String>) -> Refused {
        Refused { reason: reason.into() }
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)
    }
}

impl std::error::Error for Refused {}
