//! Diagnostics on standard error. Errors of writing (full disk, closed pipe) are ignored;
//! `eprintln!` would panic.

use std::fmt::Display;
use std::io::Write;

use afp_excerpt::{Report, Severity};

/// Writes a line to standard error, with colours on a terminal.
pub fn say(text: impl Display) {
    let _ = writeln!(anstream::stderr(), "{text}");
}

pub fn warn(message: &str) {
    let (severity, marks) = (Severity::Warning, Vec::new());
    let report = Report { severity, code: "", message, help: "", marks };
    say(report.render(true));
}
