//! A scenario under construction, and its text.

use std::fmt::Write;

use afp_core::Ending;

use crate::verdict::Verdict;

/// A scenario before it becomes text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Draft {
    pub title: String,
    pub plan: String,
    /// The lines before the activation of the element.
    pub setting: Vec<String>,
    /// The element whose activation is time zero.
    pub element: String,
    /// Actions and expectations after that.
    pub lines: Vec<String>,
    /// Its duration after that.
    pub until: String,
    /// Whether it expects the end of the plan.
    pub ends: bool,
    /// Whether it has passed.
    pub proven: bool,
}

impl Draft {
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

    /// Applies the verdict of its run. It has passed, or it now expects an end in `Error` and must
    /// run again.
    ///
    /// # Errors
    /// The reason why it cannot pass.
    pub fn judge(&mut self, verdict: &Verdict) -> Result<(), String> {
        let Some(first) = verdict.broken.first() else {
            self.proven = true;
            return Ok(());
        };
        if matches!(verdict.ending, Some(Ending::Error(_))) && !self.ends {
            // Later effects are outside its scope, but a plan must not fail unexpectedly.
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
