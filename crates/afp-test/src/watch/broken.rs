//! Unmet expectations.

use afp_core::Instant;
use afp_syntax::source::Span;

/// An unmet expectation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// The line of the scenario.
    pub text: String,
    /// Its place.
    pub span: Span,
    /// The time when it became clear.
    pub at: Instant,
    /// The actual behaviour.
    pub why: String,
}
