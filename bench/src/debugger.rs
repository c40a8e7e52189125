//! The delays of a debugger's requests, and the cost of debugging a run: a minute of wall following
//! in the simulator.

use std::sync::Arc;
use std::time::{Duration as Wall, Instant as Clock};

use afp_core::{Duration, Instant};
use afp_debug::{Adapter, ClientId, Host, Launch, Program, SessionTarget, Target};
use afp_dsl::Toolboxes;
use afp_dsl::compile;
use afp_dsl::files::Texts;
use afp_session::Loader;
use afp_syntax::source::Source;
use serde_json::{Value, json};

use crate::report::{Report, Row};

const PLAN: &str = include_str!("../../plans/wall_following.afp");
const FILE: &str = "plan.afp";
/// The simulated time.
const MINUTE: Duration = Duration::from_secs(60);
/// The number of breakpoints, which are never hit.
const BREAKPOINTS: usize = 100;
/// The number of measurements of each request.
const TURNS: usize = 30;
/// The number of runs with and without breakpoints, in turns.
const DRIVES: usize = 5;

/// The shipped plan on the Carbot in the plan's own world.
struct Simulated;

impl Host<'static> for Simulated {
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target>, String> {
        let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        let compiled = compile(&Source::new(FILE, PLAN), &toolboxes, &Texts::default());
        let graph = compiled.graph.clone().ok_or_else(|| compiled.render(false))?;
        let program = Program::new(&graph, &compiled.sources, &str::to_owned);
        let seed = launch.seed.unwrap_or_default();
        let make = move || {
            let robot = afp_sim::carbot(|_| {});
            let world = robot.kind().world(robot.kind().default_world());
            let world = world.map_err(|why| why.to_string())?;
            robot.session(&graph, &*world, seed, &[]).map_err(|why| why.to_string())
        };
        Ok(Box::new(SessionTarget::new(Arc::new(program), Box::new(make))?))
    }

    fn path(&self, path: &str) -> String {
        path.to_owned()
    }
}

struct Client {
    adapter: Adapter<'static>,
    id: ClientId,
    said: u64,
    now: Wall,
}

/// Measures requests, a jump back over a minute, and a run with many breakpoints.
pub fn run(_: u32, report: &mut Report) {
    requests(report);
    going_back(report);
    breakpoints(report);
}

/// Requests during a pause of the run.
fn requests(report: &mut Report) {
    let mut client = Client::held(5.0);
    for (command, arguments) in [
        ("threads", json!({})),
        ("stackTrace", json!({ "threadId": 1 })),
        ("scopes", json!({ "frameId": 1 })),
        ("variables", json!({ "variablesReference": 1 })),
        ("evaluate", json!({ "expression": "2 * walldist" })),
        ("setBreakpoints", json!({ "source": { "path": FILE }, "breakpoints": [{ "line": 20 }] })),
        ("afp/why", json!({ "path": "followWall" })),
        ("afp/subscribe", json!({ "state": true })),
    ] {
        let took = 1e3 * median(|| client.ask(command, arguments.clone()));
        let row = Row::new(format!("debugger/{command}"), took, "us");
        report.add(row.limit("<= 1000 us", took <= 1000.0));
    }
}

/// From the end of a minute to its beginning, far before the kept keyframes.
fn going_back(report: &mut Report) {
    let mut client = Client::held(79.9);
    let took = median(|| {
        let took = client.ask("afp/seek", json!({ "at": 19.9 }));
        client.ask("afp/seek", json!({ "at": 79.9 }));
        client.drive();
        took
    });
    let row = Row::new("debugger/a minute back", took, "ms");
    report.add(row.limit("<= 100 ms", took <= 100.0));
}

/// The cost of breakpoints that are not hit.
fn breakpoints(report: &mut Report) {
    let steps = steps();
    let mut best = [f64::INFINITY; 2];
    for _ in 0..DRIVES {
        for (best, number) in best.iter_mut().zip([0, BREAKPOINTS]) {
            let mut client = Client::launched(MINUTE.as_secs_f64());
            client.set(number);
            client.ask("configurationDone", Value::Null);
            let begun = Clock::now();
            client.drive();
            *best = best.min(begun.elapsed().as_secs_f64() * 1e9 / steps as f64);
        }
    }
    let [without, with] = best;
    report.add(Row::new("debugger/a step without breakpoints", without, "ns"));
    let row = Row::new(format!("debugger/a step with {BREAKPOINTS} breakpoints"), with, "ns");
    let row = row.against("debugger/a step without breakpoints", with / without);
    report.add(row.limit("<= 1000 ns more", with - without <= 1000.0));
}

/// The number of steps in a minute.
fn steps() -> u64 {
    let target = Simulated.launch(&Launch::default());
    let mut target = target.unwrap_or_else(|why| panic!("{why}"));
    while target.now() < Instant::ZERO + MINUTE {
        let advance = target.advance(Instant::ZERO + MINUTE, &mut |_, _| {});
        advance.unwrap_or_else(|why| panic!("{why}"));
    }
    target.steps()
}

/// The median in milliseconds.
fn median(mut action: impl FnMut() -> Wall) -> f64 {
    let mut times: Vec<_> = (0..TURNS).map(|_| action()).collect();
    times.sort();
    times[times.len() / 2].as_secs_f64() * 1e3
}

impl Client {
    /// A client with a run before its first step.
    fn launched(until: f64) -> Client {
        let mut adapter = Adapter::new(Box::new(Simulated));
        let id = adapter.join();
        let mut client = Client { adapter, id, said: 0, now: Wall::ZERO };
        client.ask("launch", json!({ "program": FILE, "until": until }));
        client
    }

    /// A client with a run that is paused at a time.
    fn held(at: f64) -> Client {
        let mut client = Client::launched(1e6);
        client.ask("configurationDone", Value::Null);
        client.ask("afp/seek", json!({ "at": at }));
        client.drive();
        client
    }

    /// Sets that many breakpoints on all possible events, with a condition that never holds.
    fn set(&mut self, number: usize) {
        let lines = 1..=PLAN.lines().count();
        let all = lines.cycle().take(number);
        let all: Vec<_> =
            all.map(|line| json!({ "line": line, "condition": "walldist < 0 cm" })).collect();
        self.ask("setBreakpoints", json!({ "source": { "path": FILE }, "breakpoints": all }));
    }

    /// Advances the run until it stops.
    fn drive(&mut self) {
        while self.adapter.due().is_some() {
            self.now += Wall::from_millis(1);
            self.adapter.tick(self.now);
        }
    }

    /// Sends a request and returns the time to its response.
    fn ask(&mut self, command: &str, arguments: Value) -> Wall {
        self.said += 1;
        let message = json!({
            "seq": self.said, "type": "request", "command": command, "arguments": arguments,
        });
        let message = message.to_string();
        let begun = Clock::now();
        let told = self.adapter.handle(self.id, &message, self.now);
        let took = begun.elapsed();
        let refused = told.iter().find(|told| told.message.contains("\"success\":false"));
        assert!(refused.is_none(), "{command}: {refused:?}");
        took
    }
}
