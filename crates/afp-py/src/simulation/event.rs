//! `Event`: an event of a run.

use std::hash::{DefaultHasher, Hash, Hasher};

use super::keeper::Happened;
use crate::value::Pickled;
use afp::load::PlanNames;
use afp_log::{pack, unpack};
use afp_session::{Datum, Done, EndingKind, Miss, RunEvent};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// An event of a run.
#[pyclass(module = "afp", frozen, eq)]
#[derive(PartialEq)]
pub struct Event {
    event: RunEvent,
    line: Option<String>,
}

impl Event {
    /// From an event of a run.
    pub fn new(happened: &Happened, names: &PlanNames) -> Event {
        let event = match happened {
            Happened::Record(record) => RunEvent::new(record.at, &record.get(), names),
            Happened::Request(event) => (**event).clone(),
        };
        Event { event, line: line(happened, names) }
    }

    /// Its form in a log.
    pub fn told(&self) -> &RunEvent {
        &self.event
    }

    /// From a log.
    pub fn logged(event: RunEvent) -> Event {
        let line = event.facts().request.is_some().then(|| afp_run::event_line(&event)).flatten();
        Event { line: line.as_deref().map(plain), event }
    }
}

#[pymethods]
impl Event {
    /// The time in seconds since the start.
    #[getter]
    fn time(&self) -> f64 {
        self.event.at.as_secs_f64()
    }

    /// Its kind: `started`, `event`, `finished`, `interrupted`, `committed`, `faulted`, `ended`,
    /// ...
    #[getter]
    fn kind(&self) -> &'static str {
        self.event.kind.word()
    }

    /// The path of the element or supervisor; for `committed`, the author.
    #[getter]
    fn component(&self) -> &str {
        &self.event.component.path
    }

    /// The state or event.
    #[getter]
    fn outcome(&self) -> Option<&str> {
        self.event.facts().outcome.and_then(|it| text(&it.name))
    }

    /// The target of the outcome.
    #[getter]
    fn target(&self) -> Option<&str> {
        self.event.facts().outcome.and_then(|it| text(&it.target))
    }

    /// The supervisor that diverted a start, or whose event resumed.
    #[getter]
    fn supervisor(&self) -> Option<&str> {
        self.event.facts().supervisor.and_then(|it| text(&it.path))
    }

    /// The element that was active or starting when an event was taken.
    #[getter]
    fn element(&self) -> Option<&str> {
        self.event.facts().element.and_then(|it| text(&it.path))
    }

    /// Whether the element's own `on` gave the target, and not the supervisor.
    #[getter]
    fn on(&self) -> bool {
        self.event.facts().on
    }

    /// The written entry.
    #[getter]
    fn entry(&self) -> Option<&str> {
        text(self.event.facts().entry)
    }

    /// The input port.
    #[getter]
    fn port(&self) -> Option<&str> {
        text(self.event.facts().port)
    }

    /// The value before a commit.
    #[getter]
    fn old(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        value(py, self.event.facts().old)
    }

    /// The value of an entry after a commit, or of an input.
    #[getter]
    fn value(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        value(py, self.event.facts().value)
    }

    /// The SI unit of the values.
    #[getter]
    fn unit(&self) -> Option<&str> {
        text(self.event.facts().unit)
    }

    /// How a plan ended: `ok`, `interrupted`, `error`.
    #[getter]
    fn ending(&self) -> Option<&'static str> {
        self.event.facts().ending.map(EndingKind::word)
    }

    /// The code of a fault.
    #[getter]
    fn fault(&self) -> Option<&str> {
        self.event.facts().fault.and_then(|it| text(&it.code))
    }

    /// The fault in words.
    #[getter]
    fn fault_text(&self) -> Option<&str> {
        self.event.facts().fault.and_then(|it| text(&it.text))
    }

    /// The lateness of a missed deadline, in seconds.
    #[getter]
    fn lateness(&self) -> Option<f64> {
        self.event.facts().miss.map(|miss| miss.lateness.as_secs_f64())
    }

    /// The reason for a missed deadline: `late_release` or `long_poll`.
    #[getter]
    fn cause(&self) -> Option<&'static str> {
        self.event.facts().miss.map(Miss::word).filter(|word| !word.is_empty())
    }

    /// The stimulus in the words of scenarios: `press touch.touch`.
    #[getter]
    fn request(&self) -> Option<String> {
        self.event.facts().request.map(|request| request.what.to_string())
    }

    /// The reason why a stimulus was not applied, or `not reached`.
    #[getter]
    fn refused(&self) -> Option<&str> {
        match &self.event.facts().request?.done {
            Done::Done => None,
            Done::Refused(why) => Some(why),
            Done::NotReached => Some("not reached"),
        }
    }

    /// The line in `afpc run`, for events that it shows.
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

    fn __hash__(&self) -> u64 {
        let RunEvent { at, component, .. } = &self.event;
        let outcome = self.outcome().unwrap_or_default();
        let mut hasher = DefaultHasher::new();
        (at.as_nanos(), &component.path, outcome).hash(&mut hasher);
        hasher.finish()
    }

    fn __repr__(&self) -> String {
        format!("<Event {}>", self.__str__().trim())
    }

    /// Restore from a pickle.
    #[staticmethod]
    fn _again(message: &[u8], line: Option<String>) -> PyResult<Self> {
        let unknown = || PyValueError::new_err("this is not a pickled event");
        Ok(Event { event: unpack(message).ok_or_else(unknown)?, line })
    }

    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> Pickled<'py, (Bound<'py, PyBytes>, Option<String>)> {
        let again = py.get_type::<Event>().getattr("_again")?;
        let message = PyBytes::new(py, &pack(&self.event));
        Ok((again, (message, self.line.clone())))
    }
}

/// The line in a timeline without colours; `None` for events without one.
pub fn line(happened: &Happened, names: &PlanNames) -> Option<String> {
    let styled = match happened {
        Happened::Record(record) => afp_run::line(record.at, &record.get(), names),
        Happened::Request(event) => afp_run::event_line(event),
    };
    styled.as_deref().map(plain)
}

/// A text without colours.
pub fn plain(styled: &str) -> String {
    anstream::adapter::strip_str(styled).to_string()
}

/// A string, or `None` if it is empty.
fn text(text: &str) -> Option<&str> {
    Some(text).filter(|text| !text.is_empty())
}

/// Converts a value to Python.
pub fn value(py: Python<'_>, value: Option<&Datum>) -> PyResult<Py<PyAny>> {
    match value {
        None | Some(Datum::Unset) => Ok(py.None()),
        Some(Datum::Bool(truth)) => truth.into_py_any(py),
        Some(Datum::Int(integer)) => integer.into_py_any(py),
        Some(Datum::Float(number)) => number.into_py_any(py),
        Some(Datum::Choice(choice)) => {
            choice.rsplit_once('.').map_or(&**choice, |(_, name)| name).into_py_any(py)
        }
        Some(Datum::Text(text) | Datum::Object(text)) => text.into_py_any(py),
    }
}
