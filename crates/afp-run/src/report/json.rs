//! Events as lines of JSON.
//!
//! Nothing here depends on the machine: interpreter and generated binary print the same bytes.

use afp_log::event::{ending_word, kind_word};
use afp_log::instant;
use afp_log::proto::afp::plan_event::{Cause, Kind};
use afp_log::proto::afp::value::Value as Told;
use afp_log::proto::afp::{PlanEvent, Value};
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
}

/// An event as a line of JSON, without its end.
pub(super) fn line(event: &PlanEvent) -> Option<String> {
    let (lateness_s, cause, skipped) = match event.kind() {
        Kind::Missed => (
            Some(event.lateness_ns as f64 / 1e9),
            match event.cause() {
                Cause::LateRelease => "late_release",
                Cause::LongPoll => "long_poll",
                Cause::NoCause => "",
            },
            Some(event.skipped),
        ),
        _ => (None, "", None),
    };
    let line = Line {
        t: instant(&event.time).as_secs_f64(),
        kind: kind_word(event.kind()),
        component: &event.component,
        outcome: &event.outcome,
        target: &event.target,
        supervisor: &event.supervisor,
        entry: &event.entry,
        old: event.old.as_ref().map(value),
        new: event.value.as_ref().map(value),
        unit: &event.unit,
        ending: ending_word(event.ending()),
        fault: &event.fault,
        text: &event.fault_text,
        lateness_s,
        cause,
        skipped,
    };
    serde_json::to_string(&line).ok()
}

fn value(value: &Value) -> serde_json::Value {
    match &value.value {
        None => serde_json::Value::Null,
        Some(Told::Truth(truth)) => (*truth).into(),
        Some(Told::Integer(integer)) => (*integer).into(),
        Some(Told::Number(number)) => (*number).into(),
        Some(Told::Text(text) | Told::Choice(text) | Told::Object(text)) => text.as_str().into(),
    }
}
