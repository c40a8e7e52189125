//! Something wrong in a text: in a world, a map or a project file.

use std::error::Error;
use std::fmt;
use std::ops::Range;

use crate::{Mark, Report, Severity};

/// What is wrong in a text, and what to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mistake {
    /// The bytes of the text, where the place is known.
    pub span: Option<Range<usize>>,
    /// What is wrong, without the place.
    pub message: String,
    /// What to write instead; empty where nobody knows.
    pub help: String,
}

impl Mistake {
    /// Something wrong at some bytes of the text, where the place is known.
    pub fn new(span: Option<Range<usize>>, message: impl Into<String>) -> Self {
        Mistake { span, message: message.into(), help: String::new() }
    }

    /// The same with what to write instead.
    pub fn with_help(self, help: impl Into<String>) -> Self {
        Mistake { help: help.into(), ..self }
    }

    /// What is made of its report, in a text of a file.
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
