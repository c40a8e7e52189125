//! Cases: a plan with its script and its expected trace, all in one `.afp` file.
//!
//! ```text
//! // The subject of the case.
//! //
//! // script
//! //   at 10 ms: a Done
//! //   until 20 ms
//! use testing
//! plan P { ... }
//! // trace
//! //   0.000000 a started
//! ```

use std::path::Path;
use std::{fs, io};

use crate::script::{Script, ScriptError};

#[derive(Clone, Debug)]
pub struct Case {
    /// The text before the expected trace, which is compiled.
    pub plan: String,
    pub script: Script,
    pub trace: Vec<String>,
}

/// The line above the expected trace.
const TRACE: &str = "// trace";

impl Case {
    /// Parses a case.
    ///
    /// # Errors
    /// A line of the script is unknown.
    pub fn parse(text: &str) -> Result<Self, ScriptError> {
        let mut lines = text.lines();
        let plan = lines.by_ref().take_while(|line| *line != TRACE).collect::<Vec<_>>().join("\n");
        let indented = |line: &str| line.strip_prefix("//   ").map(str::to_owned);
        let trace = lines.filter_map(indented).collect();
        let script = plan.lines().skip_while(|line| *line != "// script").skip(1);
        let script: Vec<String> = script.map_while(indented).collect();
        Ok(Case { script: script.join("\n").parse()?, plan, trace })
    }

    /// Writes the case with a new trace.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn bless(&self, path: &Path, trace: &[String]) -> io::Result<()> {
        let trace: String = trace.iter().map(|line| format!("//   {line}\n")).collect();
        fs::write(path, format!("{}\n{TRACE}\n{trace}", self.plan.trim_end()))
    }
}
