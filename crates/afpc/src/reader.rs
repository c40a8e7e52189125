//! Who reads what is wrong: people, on standard error, or tools, which get objects on standard output.

use afp_run::{EXIT_FAILED, RunError, say};
use afp_syntax::diagnostics::Diagnostics;
use afp_syntax::source::Sources;

use crate::commands::print;
use crate::no_plan::NoPlan;

/// Who reads what is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    /// Excerpts on standard error.
    People,
    /// An object on a line of standard output each.
    Tools,
}

impl Reader {
    /// The one that `--json` asks for.
    pub fn of(json: bool) -> Reader {
        if json { Reader::Tools } else { Reader::People }
    }

    /// Tells what is wrong with plans and toolboxes.
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

    /// Tells why something cannot be done and gives the exit code that says so.
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

    /// The exit code of a command that could not do its work, and tools are told why; people are by whoever called it.
    ///
    /// # Errors
    /// Standard output cannot be written, or people are to be told.
    pub fn end(self, why: NoPlan) -> Result<u8, NoPlan> {
        match (self, why) {
            (Reader::Tools, NoPlan::File(error)) => self.error(&error),
            (Reader::Tools, NoPlan::Wrong | NoPlan::NotBuilt(_)) => Ok(EXIT_FAILED),
            (Reader::People, why) => Err(why),
        }
    }
}
