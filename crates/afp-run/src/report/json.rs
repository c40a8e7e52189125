//! Events as lines of JSON.
//!
//! Nothing here depends on the machine: interpreter and generated binary print the same bytes.

use afp_session::{Datum, Done, EndingKind, EventKind, Facts, Miss, RunEvent};
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
    lost: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    request: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    refused: Option<&'a str>,
}

/// An event as a line of JSON, without its end.
pub(super) fn line(event: &RunEvent) -> Option<String> {
    let Facts { outcome, fault, miss, request, .. } = event.facts();
    let Facts { element, on, supervisor, entry, old, value: new, unit, ending, .. } = event.facts();
    let line = Line {
        t: event.at.as_secs_f64(),
        kind: event.kind.word(),
        component: &event.component.path,
        outcome: outcome.map_or("", |it| &it.name),
        target: outcome.map_or("", |it| &it.target),
        supervisor: supervisor.map_or("", |it| &it.path),
        element: element.map_or("", |it| &it.path),
        on,
        entry,
        old: old.map(value),
        new: new.map(value),
        unit,
        ending: ending.map_or("", EndingKind::word),
        fault: fault.map_or("", |it| &it.code),
        text: fault.map_or("", |it| &it.text),
        lateness_s: miss.map(|miss| miss.lateness.as_secs_f64()),
        cause: miss.map_or("", Miss::word),
        skipped: miss.map(|miss| miss.skipped),
        lost: match event.kind {
            EventKind::Lost(count) => Some(count),
            _ => None,
        },
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
        Datum::Bool(truth) => (*truth).into(),
        Datum::Int(integer) => (*integer).into(),
        Datum::Float(number) => (*number).into(),
        Datum::Text(text) | Datum::Choice(text) | Datum::Object(text) => text.as_str().into(),
    }
}
