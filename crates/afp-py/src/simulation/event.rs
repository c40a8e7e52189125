//! `Event`: one thing that happened.

use afp::load::PlanNames;
use afp_log::event::{describe, ending_word, kind_word};
use afp_log::instant;
use afp_log::proto::afp::plan_event::{Cause, Kind};
use afp_log::proto::afp::value::Value as Told;
use afp_log::proto::afp::{PlanEvent, Value};
use afp_session::OwnedRecord;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;

/// One thing that happened in a run.
#[pyclass(module = "afp", frozen)]
pub struct Event {
    event: PlanEvent,
    line: Option<String>,
}

impl Event {
    /// From a record of a run.
    pub fn new(record: &OwnedRecord, names: &PlanNames) -> Event {
        let (at, what) = (record.at, record.get());
        Event { event: describe(at, &what, names), line: line(record, names) }
    }

    /// From a log.
    pub fn logged(event: PlanEvent) -> Event {
        Event { event, line: None }
    }
}

#[pymethods]
impl Event {
    /// When, seconds since the start.
    #[getter]
    fn time(&self) -> f64 {
        instant(&self.event.time).as_secs_f64()
    }

    /// What happened: `started`, `event`, `finished`, `interrupted`, `committed`, `faulted`, `ended`, ...
    #[getter]
    fn kind(&self) -> &'static str {
        kind_word(self.event.kind())
    }

    /// Whom it happened to: the path of an element or supervisor; who wrote, for `committed`.
    #[getter]
    fn component(&self) -> &str {
        &self.event.component
    }

    /// The state or event.
    #[getter]
    fn outcome(&self) -> Option<&str> {
        text(&self.event.outcome)
    }

    /// Where the outcome leads.
    #[getter]
    fn target(&self) -> Option<&str> {
        text(&self.event.target)
    }

    /// The supervisor that diverted a start.
    #[getter]
    fn supervisor(&self) -> Option<&str> {
        text(&self.event.supervisor)
    }

    /// The entry that was written.
    #[getter]
    fn entry(&self) -> Option<&str> {
        text(&self.event.entry)
    }

    /// The input port that was read.
    #[getter]
    fn port(&self) -> Option<&str> {
        text(&self.event.port)
    }

    /// The value before a commit.
    #[getter]
    fn old(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        value(py, self.event.old.as_ref())
    }

    /// The value of an entry after a commit, or of an input.
    #[getter]
    fn value(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        value(py, self.event.value.as_ref())
    }

    /// The SI unit of the values.
    #[getter]
    fn unit(&self) -> Option<&str> {
        text(&self.event.unit)
    }

    /// How a plan ended: `ok`, `interrupted`, `error`.
    #[getter]
    fn ending(&self) -> Option<&'static str> {
        Some(ending_word(self.event.ending())).filter(|word| !word.is_empty())
    }

    /// The code of a fault.
    #[getter]
    fn fault(&self) -> Option<&str> {
        text(&self.event.fault)
    }

    /// The fault in words.
    #[getter]
    fn fault_text(&self) -> Option<&str> {
        text(&self.event.fault_text)
    }

    /// By how much a deadline was missed, seconds.
    #[getter]
    fn lateness(&self) -> Option<f64> {
        (self.event.kind() == Kind::Missed).then(|| self.event.lateness_ns as f64 / 1e9)
    }

    /// Why a deadline was missed: `late_release` or `long_poll`.
    #[getter]
    fn cause(&self) -> Option<&'static str> {
        match self.event.cause() {
            Cause::NoCause => None,
            Cause::LateRelease => Some("late_release"),
            Cause::LongPoll => Some("long_poll"),
        }
    }

    /// The line of `afpc run`, for events that it shows.
    fn __str__(&self) -> String {
        match &self.line {
            Some(line) => line.clone(),
            None => {
                let outcome = self.outcome().unwrap_or_default();
                let text =
                    format!("{:9.3} {} {} {outcome}", self.time(), self.component(), self.kind());
                text.trim_end().to_owned()
            }
        }
    }

    fn __repr__(&self) -> String {
        format!("<Event {}>", self.__str__().trim())
    }
}

/// The line of a timeline, without colours; none for what is not worth one.
pub fn line(record: &OwnedRecord, names: &PlanNames) -> Option<String> {
    let styled = afp_run::line(record.at, &record.get(), names)?;
    Some(anstream::adapter::strip_str(&styled).to_string())
}

/// A text that is there or not.
fn text(text: &str) -> Option<&str> {
    Some(text).filter(|text| !text.is_empty())
}

/// A value as Python has it.
pub fn value(py: Python<'_>, value: Option<&Value>) -> PyResult<Py<PyAny>> {
    match value.and_then(|value| value.value.as_ref()) {
        None => Ok(py.None()),
        Some(Told::Truth(truth)) => truth.into_py_any(py),
        Some(Told::Integer(integer)) => integer.into_py_any(py),
        Some(Told::Number(number)) => number.into_py_any(py),
        Some(Told::Choice(choice)) => {
            choice.rsplit_once('.').map_or(&**choice, |(_, name)| name).into_py_any(py)
        }
        Some(Told::Text(text) | Told::Object(text)) => text.into_py_any(py),
    }
}
