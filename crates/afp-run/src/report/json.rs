//! Events as lines of JSON.
//!
//! Nothing here depends on the machine: interpreter and generated binary print the same bytes.

use afp_session::{Datum, Done, EndingKind, Miss, RunEvent};
use serde::Serialize;

#[derive(Default, Serialize)]
struct Line<'a> {
    t: f64,
    kind: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    component: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    outcome: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    target: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    supervisor: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    element: &'a str,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    on: bool,
    #[serde(skip_serializing_if = "str::is_empty")]
    entry: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    old: Option<serde_json::Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    new: Option<serde_json::Value>,
    #[serde(skip_serializing_if = "str::is_empty")]
    unit: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    ending: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    fault: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    text: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    lateness_s: Option<f64>,
    #[serde(skip_serializing_if = "str::is_empty")]
    cause: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    skipped: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    request: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<&'a str>,
}

/// An event as a line of JSON, without its end.
pub(super) fn line(event: &RunEvent) -> Option<String> {
    let missed = event.missed.as_ref();
    let request = event.request.as_ref();
    let line = Line {
        t: event.at.as_secs_f64(),
        kind: event.kind.word(),
        component: &event.component,
        outcome: &event.outcome,
        target: &event.target,
        supervisor: &event.supervisor,
        element: &event.element,
        on: event.on,
        entry: &event.entry,
        old: event.old.as_ref().map(value),
        new: event.value.as_ref().map(value),
        unit: &event.unit,
        ending: event.ending.map_or("", EndingKind::word),
        fault: &event.fault,
        text: &event.fault_text,
        lateness_s: missed.map(|miss| miss.lateness.as_secs_f64()),
        cause: missed.map_or("", Miss::word),
        skipped: missed.map(|miss| miss.skipped),
        request: request.map(|request| request.what.to_string()),
        refused: request.and_then(|request| match &request.done {
            Done::Refused(why) => Some(why.as_str()),
            Done::Done | Done::NotReached => None,
        }),
    };
    serde_json::to_string(&line).ok()
}

fn value(datum: &Datum) -> serde_json::Value {
    match datum {
        Datum::Unset => serde_json::Value::Null,
        Datum::Truth(truth) => (*truth).into(),
        Datum::Integer(integer) => (*integer).into(),
        Datum::Number(number) => (*number).into(),
        Datum::Text(text) | Datum::Choice(text) | Datum::Object(text) => text.as_str().into(),
    }
}
