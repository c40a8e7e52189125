//! Logs of a robot that continue in the simulator.

use std::process::Stdio;

use serde_json::{Value, json};

use crate::attach::Client;
use crate::common::{Place, said};
use crate::profile::Running;

const PLAN: &str = "use std
use carbot

plan Drive {
    start lap
    in way: length = 4 cm
    var rounds: int = 0
    subplan lap: Lap(way = way) { OK -> count }
    computation count: Count(value = rounds, limit = 1000, next => rounds) {
        Again -> lap
        Done -> terminate
    }
}

plan Lap {
    in way: length
    var steps: int = 0
    start ahead
    actor ahead: Forward(distance = way) { ForwardSuccessful -> count }
    computation count: Count(value = steps, limit = 2, next => steps) {
        Again -> rest
        Done -> terminate
    }
    actor rest: Wait(duration = 150 ms) { Elapsed -> ahead }
}
";

/// A number of logs for a test by day; `AFP_FORKS` sets another one.
const LOGS: u64 = 3;

/// The elements of the stack, and the entries with values.
fn moment(client: &mut Client) -> (Vec<String>, Value) {
    // The state that the clients of a studio see.
    client.ask("afp/subscribe", json!({"state": true}));
    let mut state = client.event("afp/state");
    client.ask("afp/subscribe", json!({"state": false}));
    let stack = state["stack"].as_array().unwrap().iter();
    let stack = stack.map(|path| path.as_str().unwrap().to_owned()).collect();
    (stack, state["entries"].take())
}

/// Forks a log at a share of its time; returns the console.
fn forks(place: &Place, share: f64) {
    let mut client = Client::of(place.command().current_dir(place.path("mycar")).arg("dap"));
    client.ask("initialize", json!({"clientID": "test", "adapterID": "afp"}));
    client.ask("launch", json!({"log": "run.mcap", "stopOnEntry": true}));
    client.event("initialized");
    client.ask("configurationDone", json!({}));
    client.event("stopped");
    client.ask("afp/seek", json!({"at": 1e6}));
    client.event("stopped");
    client.ask("afp/subscribe", json!({"state": true}));
    let end = client.event("afp/state")["at"].as_f64().unwrap();
    client.ask("afp/subscribe", json!({"state": false}));
    let at = share * end;
    client.ask("afp/seek", json!({"at": at}));
    client.event("stopped");
    let recorded = moment(&mut client);
    client.ask("afp/fork", json!({}));
    let stopped = client.event("stopped");
    assert_eq!(stopped["reason"], "goto", "{at}: {stopped}");
    let forked = moment(&mut client);
    assert_eq!(forked, recorded, "at {at} s of {end} s");
    // It drives on: the entries count from the log's.
    client.ask("setDataBreakpoints", json!({"breakpoints": [{"dataId": "rounds"}]}));
    client.ask("continue", json!({"threadId": 1}));
    assert_eq!(client.event("stopped")["reason"], "data breakpoint");
    let (_, entries) = moment(&mut client);
    let rounds = |entries: &Value| entries["rounds"].as_str().unwrap().parse::<i64>().unwrap();
    assert_eq!(rounds(&entries), rounds(&recorded.1) + 1, "at {at} s of {end} s");
    client.ask("terminate", json!({}));
    client.event("terminated");
}

#[test]
fn the_log_of_a_robot_continues_in_the_simulator_at_any_moment() {
    let logs = std::env::var("AFP_FORKS").map_or(LOGS, |logs| logs.parse().unwrap());
    for nth in 0..logs {
        let place = Place::new();
        place.afpc("new mycar --profile carbot").succeeds();
        place.write("mycar/plans/drive.afp", PLAN);
        let controller = Running::start(|_| {});
        let port = format!("robot.port={}", controller.port);
        // Every log has another length, so that all elements are hit.
        let until = format!("{}ms", 1500 + 370 * (nth % 5));
        let words = ["run", "plans/drive.afp", "--robot", "hardware", "--until", &until, "--svg"];
        let mut command = place.command();
        command.current_dir(place.path("mycar")).args(words).args(["none", "--log", "run.mcap"]);
        command.args(["--set", &port, "--set", "robot.realtime.stall=10s"]);
        command.env("XDG_RUNTIME_DIR", place.path("")).stdin(Stdio::null());
        said(command.output().unwrap()).succeeds();
        // Spread over the run, without its end, where the plan is over.
        let share = (0.07 + 0.381_966 * nth as f64).fract() * 0.95;
        forks(&place, share);
    }
}

#[test]
fn a_fork_of_a_log_takes_a_changed_plan_and_a_changed_value() {
    let place = Place::new();
    place.write("drive.afp", PLAN);
    place.afpc("run drive.afp --until 10s --log run.mcap --svg none").succeeds();
    place.write("drive.afp", &PLAN.replace("limit = 2,", "limit = 3,"));
    let mut client = Client::new(&place, &["dap"]);
    client.ask("initialize", json!({"clientID": "test", "adapterID": "afp"}));
    client.ask("launch", json!({"log": "run.mcap", "at": 4.5, "program": "drive.afp"}));
    client.event("initialized");
    client.ask("configurationDone", json!({}));
    client.event("stopped");
    let text = client.event("output")["output"].to_string();
    assert!(text.contains("from 4.500 s the simulator continues the log"), "{text}");
    let place = client.event("output")["output"].to_string();
    assert!(place.contains("the robot is at") && !place.contains("odometry"), "{place}");
    let (stack, entries) = moment(&mut client);
    assert_eq!(stack[0], "lap", "{stack:?} {entries}");
    client.ask("setExpression", json!({"expression": "rounds", "value": "41"}));
    let counted = json!({"dataId": "rounds", "condition": "rounds > 41"});
    client.ask("setDataBreakpoints", json!({"breakpoints": [counted]}));
    client.ask("continue", json!({"threadId": 1}));
    // The end of the configuration may report the stop again.
    while client.event("stopped")["reason"] != "data breakpoint" {}
    assert_eq!(moment(&mut client).1["rounds"], "42");
    let again = client.refused("afp/fork", json!({}));
    assert!(again.contains("open the log again"), "{again}");
}

#[test]
fn an_element_that_is_set_aside_starts_instead_of_its_handler() {
    let place = Place::new();
    let plan = "use std
plan P {
    start work
    actor work: Wait(duration = 4 s) {
        supervise late: CheckTimeout(duration = 1 s) { TimedOut -> suspend handle }
        Elapsed -> terminate
    }
    actor handle: Wait(duration = 1 s) { Elapsed -> return }
}
";
    place.write("p.afp", plan);
    place.afpc("run p.afp --until 9s --log run.mcap --svg none").succeeds();
    let at = |second: f64| {
        let mut client = Client::new(&place, &["dap"]);
        client.ask("initialize", json!({"clientID": "test", "adapterID": "afp"}));
        client.ask("launch", json!({"log": "run.mcap", "stopOnEntry": true}));
        client.event("initialized");
        client.ask("configurationDone", json!({}));
        client.event("stopped");
        client.ask("afp/seek", json!({"at": second}));
        client.event("stopped");
        client
    };
    let mut client = at(1.5);
    assert_eq!(moment(&mut client).0, ["handle"]);
    client.ask("afp/fork", json!({}));
    client.event("stopped");
    assert_eq!(moment(&mut client).0, ["work"]);
    // After the end there is nothing to continue, and the log stays open.
    let mut client = at(1e6);
    let why = client.refused("afp/fork", json!({}));
    assert!(why.contains("the plan is not running at this moment"), "{why}");
    client.ask("afp/seek", json!({"at": 0.5}));
}
