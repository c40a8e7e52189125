//! The readers of diagnostics: people, on standard error, or tools, with JSON objects on standard
//! output.

use afp_run::{EXIT_FAILED, RunError, say};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Sources;

use crate::commands::print;
use crate::no_plan::NoPlan;

/// The reader of diagnostics.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    /// Excerpts on standard error.
    People,
    /// One object per line on standard output.
    Tools,
}

impl Reader {
    /// The reader that `--json` selects.
    pub fn of(json: bool) -> Reader {
        if json { Reader::Tools } else { Reader::People }
    }

    /// Reports the diagnostics of plans and toolboxes.
    ///
    /// # Errors
    /// Standard output cannot be written.
    pub fn tell(self, diags: &Diagnostics, sources: &Sources) -> Result<(), NoPlan> {
        match self {
            _ if diags.is_empty() => {}
            Reader::People => say(diags.render(sources, true)),
            Reader::Tools => {
                print(&diags.json_lines(sources))?;
            }
        }
        Ok(())
    }

    /// Reports an error and returns its exit code.
    ///
    /// # Errors
    /// Standard output cannot be written.
    pub fn error(self, error: &RunError) -> Result<u8, NoPlan> {
        match self {
            Reader::People => say(error.styled()),
            Reader::Tools => {
                print(&error.json_lines())?;
            }
        }
        Ok(error.code())
    }

    /// The exit code of a failed command. Tools get the error here; people get it from the caller.
    ///
    /// # Errors
    /// Standard output cannot be written, or the error is for people.
    pub fn end(self, why: NoPlan) -> Result<u8, NoPlan> {
        match (self, why) {
            (Reader::Tools, NoPlan::File(error)) => self.error(&error),
            (Reader::Tools, NoPlan::Wrong | NoPlan::NotBuilt(_)) => Ok(EXIT_FAILED),
            (Reader::People, why) => Err(why),
        }
    }
}
