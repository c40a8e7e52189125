//! One scenario as it is made, and the text that it becomes.

use std::fmt::Write;

use afp_core::Ending;

use crate::verdict::Verdict;

/// A scenario before it is text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Draft {
    /// Its name.
    pub title: String,
    /// The plan that it is for.
    pub plan: String,
    /// The lines before the element is active.
    pub setting: Vec<String>,
    /// The element whose activation its times count from.
    pub element: String,
    /// What happens from then on and what is expected.
    pub lines: Vec<String>,
    /// How long after that it ends.
    pub until: String,
    /// Whether it expects an end.
    pub ends: bool,
    /// Whether it has run and passed.
    pub proven: bool,
}

impl Draft {
    /// Writes its text behind others.
    pub fn write(&self, text: &mut String) {
        let Draft { title, plan, element, until, .. } = self;
        // Writing to a String cannot fail.
        let _ = write!(text, "\nscenario \"{title}\" for {plan} {{\n");
        for line in &self.setting {
            let _ = writeln!(text, "    {line}");
        }
        let _ = writeln!(text, "    from {element} active {{");
        for line in &self.lines {
            let _ = writeln!(text, "        {line}");
        }
        let _ = write!(text, "        until {until}\n    }}\n}}\n");
    }

    /// Takes into account what its run came to. It passed, or it expects from now on that the plan ends in `Error` and has
    /// to run again.
    ///
    /// # Errors
    /// Why it cannot pass.
    pub fn judge(&mut self, verdict: &Verdict) -> Result<(), String> {
        let Some(first) = verdict.broken.first() else {
            self.proven = true;
            return Ok(());
        };
        if matches!(verdict.ending, Some(Ending::Error(_))) && !self.ends {
            // What comes behind the event is not what it is about, but a plan must not fail unexpectedly.
            self.lines.push("expect end by Error".to_owned());
            self.ends = true;
            return Ok(());
        }
        let at = first.at.as_secs_f64();
        Err(format!(
            "'{}' does not pass ('{}': {}, at {at:.3} s)",
            self.title, first.text, first.why
        ))
    }
}
