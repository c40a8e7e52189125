//! Meanings of templates for checks and reports, beyond their declarations in toolboxes.
//!
//! Only this file names templates outside of their own crates; everything else uses the meaning.

/// The effect of a computation, or the condition of a supervisor. States and events are given by
/// position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Meaning {
    /// Logs its input.
    Logs,
    /// Ends in 0 and writes a row of a table; ends in 1 after the last row.
    ReadsRow,
    /// Ends in the state that its input, a value of an enum, selects.
    Selects,
    /// Reports from the time in its first input on.
    TimesOut,
    /// Reports 0 if its first input is below the second, 1 if it is above.
    Limits,
    /// Reports 0 if the free distance in the direction of its first input is below the second, 1 if
    /// above.
    LooksFar,
    /// Reports if the shares of red, green and blue light equal its first three inputs within the
    /// fourth.
    SeesColor,
    /// Reports 0 if the light is stronger than its first input, 1 if it is weaker.
    SeesDark,
}

impl Meaning {
    /// The meaning of a template; `None` if only its declaration is known.
    pub fn of(toolbox: &str, template: &str) -> Option<Meaning> {
        Some(match (toolbox, template) {
            ("std", "CheckTimeout") => Meaning::TimesOut,
            ("std", "CheckValue") => Meaning::Limits,
            ("std", "Log") => Meaning::Logs,
            ("std", "Row") => Meaning::ReadsRow,
            ("std", "Switch") => Meaning::Selects,
            ("carbot", "CheckColor") => Meaning::SeesColor,
            ("carbot", "CheckDistance") => Meaning::LooksFar,
            ("carbot", "CheckInfrared") => Meaning::SeesDark,
            _ => return None,
        })
    }

    /// Whether it is a computation whose state depends only on its inputs.
    pub fn is_choice(self) -> bool {
        matches!(self, Meaning::ReadsRow | Meaning::Selects)
    }
}
