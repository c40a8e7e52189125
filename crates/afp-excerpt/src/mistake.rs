//! An error in a world, a map or a project file.

use std::error::Error;
use std::fmt;
use std::ops::Range;

use crate::{Mark, Report, Severity};

/// An error in a text, with its fix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The bytes of the text, if the place is known.
    pub span: Option<Range<usize>>,
    /// The message, without the place.
    pub message: String,
    /// The fix; empty if it is unknown.
    pub help: String,
}

impl Mistake {
    /// An error at some bytes of the text, if the place is known.
    pub fn new(span: Option<Range<usize>>, message: impl Into<String>) -> Self {
        Mistake { span, message: message.into(), help: String::new() }
    }

    /// Adds a fix.
    pub fn with_help(self, help: impl Into<String>) -> Self {
        Mistake { help: help.into(), ..self }
    }

    /// Passes its report, in a text of a file, to a function.
    pub fn report<T>(&self, path: &str, text: &str, make: impl FnOnce(&Report<'_>) -> T) -> T {
        let Mistake { span, message, help } = self;
        let mark = Mark { path, text, lines: None, span: span.clone(), label: String::new() };
        make(&Report { severity: Severity::Error, code: "", message, help, marks: vec![mark] })
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for Mistake {}
