//! `Verdict`: the verdict of a scenario, and `Broken`: an unmet expectation.

use std::fmt::Write as _;

use afp_dsl::Compiled;
use afp_test::Verdict as Came;
use pyo3::prelude::*;

use super::place;
use crate::simulation::plain;
use crate::value::Pickled;

/// An unmet expectation.
#[pyclass(module = "afp", frozen, get_all, eq, from_py_object)]
#[derive(Clone, PartialEq)]
pub struct Broken {
    /// The line of the scenario.
    text: String,
    file: String,
    /// Its line, from 1.
    line: usize,
    /// Its column, from 1.
    column: usize,
    /// The time when it became clear, in seconds.
    time: f64,
    /// The actual behaviour.
    why: String,
}

/// The verdict of a scenario.
#[pyclass(module = "afp", frozen, get_all, eq)]
#[derive(Clone, PartialEq)]
pub struct Verdict {
    /// Whether all expectations were met.
    passed: bool,
    /// Unmet expectations, in order of time.
    broken: Vec<Broken>,
    /// The broken lines and the timeline around the first of them, as printed by `afpc test`.
    report: String,
    /// The length of the run, in seconds.
    time: f64,
    /// How the plan ended: `ok`, `interrupted`, `error`; `running` if it did not.
    ending: String,
    /// The hash of the trace, as in `afpc test --json`.
    trace_hash: String,
    /// The timeline.
    timeline: Vec<String>,
    /// The command that repeats the scenario, or a note why none does.
    command: String,
}

/// Text, place, time and reason.
type BrokenFacts = (String, (String, usize, usize), f64, String);
/// Whether it passed, broken expectations, report, time, ending, hash, timeline, command.
type VerdictFacts = (bool, Vec<Broken>, String, f64, String, String, Vec<String>, String);

#[pymethods]
impl Broken {
    fn __repr__(&self) -> String {
        let Broken { text, file, line, .. } = self;
        format!("<Broken {file}:{line}: {text}>")
    }

    /// Restore from a pickle.
    #[staticmethod]
    fn _again(text: String, place: (String, usize, usize), time: f64, why: String) -> Broken {
        let (file, line, column) = place;
        Broken { text, file, line, column, time, why }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Pickled<'py, BrokenFacts> {
        let Broken { text, file, line, column, time, why } = self.clone();
        let again = py.get_type::<Broken>().getattr("_again")?;
        Ok((again, (text, (file, line, column), time, why)))
    }
}

#[pymethods]
impl Verdict {
    fn __repr__(&self) -> String {
        let came = if self.passed { "passed" } else { "failed" };
        format!("<Verdict {came} after {:.3} s, {} broken>", self.time, self.broken.len())
    }

    /// A table with the verdict, and the report.
    fn _repr_html_(&self, py: Python<'_>) -> PyResult<String> {
        let came = if self.passed { "passed" } else { "failed" };
        let time = format!("{:.3} s", self.time);
        let rows = [
            ("scenario", came),
            ("plan ended", &self.ending),
            ("time", &time),
            ("again", &self.command),
        ];
        let mut page = String::from("<table>");
        for (head, cell) in rows {
            let _ = write!(page, "<tr><th>{head}</th><td>{}</td></tr>", escaped(py, cell)?);
        }
        page.push_str("</table>");
        if !self.report.is_empty() {
            let _ = write!(page, "<pre>{}</pre>", escaped(py, self.report.trim_end())?);
        }
        Ok(page)
    }

    /// Restore from a pickle.
    #[staticmethod]
    fn _again(facts: VerdictFacts) -> Verdict {
        let (passed, broken, report, time, ending, trace_hash, timeline, command) = facts;
        Verdict { passed, broken, report, time, ending, trace_hash, timeline, command }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> Pickled<'py, (VerdictFacts,)> {
        let again = py.get_type::<Verdict>().getattr("_again")?;
        let Verdict { passed, broken, report, time, ending, trace_hash, timeline, command } =
            self.clone();
        Ok((again, ((passed, broken, report, time, ending, trace_hash, timeline, command),)))
    }
}

/// Makes Python's verdict, with the command that repeats it.
pub fn verdict(compiled: &Compiled, came: Came, command: String) -> Verdict {
    let broken = came.broken.iter().map(|broken| {
        let (file, line, column) = place(compiled, broken.span);
        let (text, why) = (broken.text.clone(), broken.why.clone());
        Broken { text, file, line, column, time: broken.at.as_secs_f64(), why }
    });
    let ending = match came.ending {
        None => "running",
        Some(afp_core::Ending::Ok) => "ok",
        Some(afp_core::Ending::Interrupted) => "interrupted",
        Some(afp_core::Ending::Error(_)) => "error",
    };
    Verdict {
        passed: came.passed(),
        broken: broken.collect(),
        report: plain(&came.report()),
        time: came.length().as_secs_f64(),
        ending: ending.to_owned(),
        trace_hash: format!("{:016x}", came.trace),
        timeline: came.timeline.iter().map(|(_, line)| plain(line)).collect(),
        command,
    }
}

/// Escapes a text for HTML.
fn escaped(py: Python<'_>, text: &str) -> PyResult<String> {
    py.import("html")?.call_method1("escape", (text,))?.extract()
}
