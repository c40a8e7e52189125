//! What was not as a scenario expects.

use afp_core::Instant;
use afp_syntax::source::Span;

/// Something that was not as expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// The line of the scenario.
    pub text: String,
    /// Its place.
    pub span: Span,
    /// When it became clear.
    pub at: Instant,
    /// What happened instead.
    pub why: String,
}
