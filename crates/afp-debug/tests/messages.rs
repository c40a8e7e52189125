//! Any messages of several clients in any order: each request has one response, and nothing panics.

mod common;

use afp_debug::{Adapter, ClientId, Outgoing};
use common::Texted;
use proptest::prelude::*;
use serde_json::{Value, json};
use std::time::Duration;

const PLAN: &str = "use std

plan Inner {
    in  pause: duration
    start wait
    actor wait: Wait(duration = pause) { Elapsed -> terminate }
}

plan P {
    in  pause: duration = 250 ms
    var left: int = 0
    start a
    actor a: Wait(duration = pause) {
        Elapsed -> count
        supervise late: CheckTimeout(duration = 4 s) { TimedOut -> b }
    }
    computation count: Count(value = left, limit = 3, next => left) { Again -> b, Done -> terminate }
    subplan b: Inner(pause = 2 * pause) { OK -> a, Error -> terminate }
    supervise old: CheckTimeout(duration = 1 min) { TimedOut -> terminate }
}
";

/// Known requests, each with possibly valid arguments.
fn requests() -> Vec<(&'static str, Value)> {
    let line = json!({ "source": { "path": "plan.afp" }, "line": 14 });
    let mut pointed = line.clone();
    (pointed["expression"], pointed["context"]) = (json!("a"), json!("hover"));
    let stops = json!([{ "line": 14, "condition": "left == 1" }, { "line": 19, "hitCondition": "2" }, { "line": 3, "logMessage": "{left}" }]);
    vec![
        ("initialize", json!({ "adapterID": "afp", "clientName": "x" })),
        ("launch", json!({ "program": "plan.afp:P", "until": 3 })),
        ("launch", json!({ "program": "plan.afp:P", "speed": 1, "stopOnEntry": true })),
        ("launch", json!({ "program": "plan.afp:Nothing" })),
        ("attach", json!({ "role": "operator", "lease": true })),
        ("attach", Value::Null),
        ("configurationDone", Value::Null),
        ("setBreakpoints", json!({ "source": { "path": "plan.afp" }, "breakpoints": stops })),
        (
            "setFunctionBreakpoints",
            json!({ "breakpoints": [{ "name": "a.late.TimedOut" }, { "name": "b" }] }),
        ),
        ("dataBreakpointInfo", json!({ "name": "left" })),
        ("setDataBreakpoints", json!({ "breakpoints": [{ "dataId": "left" }] })),
        ("setExceptionBreakpoints", json!({ "filters": ["interruption", "collision"] })),
        ("breakpointLocations", line.clone()),
        ("gotoTargets", line),
        ("goto", json!({ "threadId": 1, "targetId": 3 })),
        ("threads", Value::Null),
        ("stackTrace", json!({ "threadId": 1 })),
        ("scopes", json!({ "frameId": 2 })),
        ("variables", json!({ "variablesReference": 1 })),
        ("setVariable", json!({ "variablesReference": 1, "name": "pause", "value": "1 s" })),
        ("setExpression", json!({ "expression": "pause", "value": "100 ms" })),
        ("evaluate", json!({ "expression": "left + 1" })),
        ("evaluate", pointed),
        ("evaluate", json!({ "expression": "pause = 2 s" })),
        ("exceptionInfo", json!({ "threadId": 1 })),
        ("continue", json!({ "threadId": 1 })),
        ("next", json!({ "threadId": 1 })),
        ("stepIn", json!({ "threadId": 1, "granularity": "instruction" })),
        ("stepOut", json!({ "threadId": 1 })),
        ("stepBack", json!({ "threadId": 1 })),
        ("reverseContinue", json!({ "threadId": 1 })),
        ("pause", json!({ "threadId": 1 })),
        ("restart", Value::Null),
        ("terminate", Value::Null),
        ("disconnect", Value::Null),
        ("source", json!({ "sourceReference": 1 })),
        ("afp/press", json!({ "control": "touch.touch" })),
        ("afp/fault", json!({ "fault": "wheels.slip", "amount": 0.5, "seconds": 1 })),
        ("afp/force", json!({ "path": "pause", "value": "10 ms", "seconds": 1 })),
        ("afp/force", json!({ "path": "a.Elapsed" })),
        ("afp/release", Value::Null),
        ("afp/role", json!({ "take": "operator", "lease": true })),
        ("afp/role", json!({ "release": true })),
        ("afp/seek", json!({ "at": 1.2 })),
        ("afp/seek", json!({ "at": 1e300 })),
        ("afp/speed", json!({ "factor": 2 })),
        ("afp/speed", json!({})),
        ("afp/subscribe", json!({ "state": true, "trace": true })),
        ("afp/why", json!({ "path": "b", "at": 0.3 })),
        ("afp/world", json!({ "program": "plan.afp" })),
        ("nonsense", json!([1])),
    ]
}

#[derive(Clone, Debug)]
enum Next {
    /// A client sends a request.
    Ask(usize, usize),
    Answer(usize),
    /// Milliseconds pass.
    Pass(u64),
    /// A client leaves, and a new one joins.
    Leave(usize),
}

fn next() -> impl Strategy<Value = Next> {
    prop_oneof![
        8 => (0..3_usize, 0..requests().len()).prop_map(|(from, what)| Next::Ask(from, what)),
        1 => (0..3_usize).prop_map(Next::Answer),
        4 => (0..700_u64).prop_map(Next::Pass),
        1 => (0..3_usize).prop_map(Next::Leave),
    ]
}

/// The number of cases by day; `AFP_BY_NIGHT` multiplies it by forty.
fn cases() -> u32 {
    if std::env::var_os("AFP_BY_NIGHT").is_some() { 64 * 40 } else { 64 }
}

fn responses(told: &[Outgoing], to: ClientId) -> usize {
    let is_response = |told: &&Outgoing| {
        let message: Value = serde_json::from_str(&told.message).expect("messages are JSON");
        told.to == to && message["type"] == "response"
    };
    told.iter().filter(is_response).count()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]

    #[test]
    fn each_request_has_one_response(all in prop::collection::vec(next(), 1..60)) {
        let mut adapter = Adapter::new(Box::new(Texted(PLAN.to_owned())));
        let mut clients = [adapter.join(), adapter.join(), adapter.join()];
        let (mut now, requests) = (Duration::ZERO, requests());
        for (at, next) in (1..).zip(all) {
            match next {
                Next::Ask(from, what) => {
                    let (command, arguments) = &requests[what];
                    let message = json!({ "seq": at, "type": "request", "command": command, "arguments": arguments });
                    let told = adapter.handle(clients[from], &message.to_string(), now);
                    prop_assert_eq!(responses(&told, clients[from]), 1, "{}", command);
                }
                Next::Answer(from) => {
                    let message = json!({ "seq": at, "type": "response", "command": "afp/lease", "success": true });
                    let told = adapter.handle(clients[from], &message.to_string(), now);
                    prop_assert_eq!(responses(&told, clients[from]), 0);
                }
                Next::Pass(passed) => {
                    now += Duration::from_millis(passed);
                    let told = adapter.tick(now);
                    prop_assert_eq!(clients.iter().map(|id| responses(&told, *id)).sum::<usize>(), 0);
                }
                Next::Leave(who) => {
                    adapter.leave(clients[who]);
                    clients[who] = adapter.join();
                }
            }
        }
    }
}
