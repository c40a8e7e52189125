//! Diagnostics on standard error. Where nobody takes them, a full disk or a closed pipe, they are lost, not a reason to
//! end: `eprintln!` would panic.

use std::fmt::Display;
use std::io::Write;

use afp_excerpt::{Report, Severity};

/// Writes a line to standard error, with colours where they are seen.
pub fn say(text: impl Display) {
    let _ = writeln!(anstream::stderr(), "{text}");
}

/// Writes a warning to standard error.
pub fn warn(message: &str) {
    let (severity, marks) = (Severity::Warning, Vec::new());
    let report = Report { severity, code: "", message, help: "", marks };
    say(report.render(true));
}
