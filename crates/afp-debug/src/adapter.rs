//! The adapter: client messages in, messages to clients out.

mod again;
mod clients;
mod ended;
mod force;
mod fork;
mod goto;
mod hover;
mod launch;
mod live;
mod look;
mod mode;
mod outside;
mod places;
mod roles;
mod steer;
mod stop;
mod time;
mod trace;
mod why;
mod world;

use std::collections::BTreeMap;
use std::time::Duration as Wall;

use afp_core::Instant;
use afp_dsl::files::path_of;
use afp_session::{Drawing, Droppable, Pose2};
use afp_token::Token;
use dapts::event;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use crate::breakpoints::Breakpoints;
use crate::program::Program;
use crate::state::State;
use crate::target::Target;

pub use clients::{ClientId, Outgoing};
pub use launch::Launch;

use clients::Client;
use mode::{Mode, Pace};

/// The environment of an adapter.
pub trait Host<'h> {
    /// Makes a run of a plan, before its first step.
    ///
    /// # Errors
    /// The reason and an action.
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target + 'h>, String>;

    /// Returns the world of a run before the run exists.
    ///
    /// # Errors
    /// The reason and an action.
    fn world(&mut self, launch: &Launch) -> Result<Surroundings, String> {
        Err(format!("'{}' has no known world", launch.program))
    }

    /// Makes a simulated run that continues a recorded run, before its first step, and sentences
    /// about it.
    ///
    /// # Errors
    /// The reason and an action.
    fn fork(&mut self, fork: &Fork<'_>) -> Result<(Box<dyn Target + 'h>, Vec<String>), String> {
        let _ = fork;
        Err("a log cannot change: run its plan first".to_owned())
    }

    /// Normalizes a path for [`Program::files`](crate::Program::files).
    fn path(&self, path: &str) -> String;
}

/// A moment of a recorded run.
pub struct Fork<'a> {
    /// The log, and the plan's file if its text counts.
    pub launch: &'a Launch,
    pub at: Instant,
    pub program: &'a Program,
    pub state: &'a State,
    /// The recorded pose of the robot.
    pub pose: Option<Pose2>,
}

/// The world of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// Its picture.
    pub drawing: Drawing,
    /// Available worlds, as `launch` accepts them, each with its origin.
    pub worlds: Vec<(String, &'static str)>,
    /// Shapes that clients can add during a run.
    pub drops: &'static [Droppable],
    pub camera: bool,
    /// The seed of a recorded run.
    pub seed: Option<u64>,
    /// The reason why a recording is incomplete.
    pub cut_short: Option<String>,
}

/// A debug adapter for clients that share a run: one is the operator, all watch, and each can end
/// the run.
pub struct Adapter<'h> {
    host: Box<dyn Host<'h> + 'h>,
    clients: BTreeMap<ClientId, Client>,
    /// The number of clients so far.
    joined: u32,
    /// The client whose request is being answered.
    asker: ClientId,
    operator: Option<ClientId>,
    /// The time of the last call.
    called: Wall,
    run: Option<Run<'h>>,
    breakpoints: Breakpoints,
    out: Vec<(ClientId, Value)>,
    /// The token and the limit for clients.
    guard: Option<Guard>,
}

/// Admission of clients.
struct Guard {
    token: Token,
    most: usize,
}

/// The run being debugged.
struct Run<'h> {
    target: Box<dyn Target + 'h>,
    launch: Launch,
    mode: Mode,
    pace: Pace,
    /// Steps in which an element started, ended or was interrupted, in order.
    transitions: Vec<u64>,
    /// The last fault.
    exception: Option<(&'static str, String)>,
    /// Events not sent yet, if a client subscribed to the trace.
    traced: Option<Vec<Value>>,
    /// Whether the run was started.
    has_begun: bool,
    /// The last thing that the robot touched.
    touched: Option<String>,
    /// The time limit of the plan.
    end: Instant,
    /// Values and outcomes that the operator forces.
    forces: Vec<force::Force>,
    /// The client that ended a live run.
    ended_by: Option<String>,
    /// The breakpoint that a live run will be held for.
    hit: Option<live::Hit>,
    /// The earliest time of the next state message.
    next_state: Wall,
}

/// The reason for a rejected request.
struct Refusal(String);

impl<T: Into<String>> From<T> for Refusal {
    fn from(why: T) -> Self {
        Refusal(why.into())
    }
}

type Answer<T> = Result<T, Refusal>;

impl<'h> Adapter<'h> {
    /// An adapter without clients.
    pub fn new(host: Box<dyn Host<'h> + 'h>) -> Adapter<'h> {
        Adapter {
            host,
            clients: BTreeMap::new(),
            joined: 0,
            asker: ClientId::default(),
            operator: None,
            called: Wall::ZERO,
            run: None,
            breakpoints: Breakpoints::default(),
            out: Vec::new(),
            guard: None,
        }
    }

    /// An adapter on an open port: `launch` and `attach` need the token, and the number of admitted
    /// clients is limited.
    pub fn guarded(host: Box<dyn Host<'h> + 'h>, token: &Token, most: usize) -> Adapter<'h> {
        Adapter { guard: Some(Guard { token: token.clone(), most }), ..Adapter::new(host) }
    }

    /// Answers a message of a joined client and returns messages with their receivers, in order.
    /// `now` is wall-clock time from an arbitrary start.
    pub fn handle(&mut self, from: ClientId, message: &str, now: Wall) -> Vec<Outgoing> {
        self.asker = from;
        self.listen_for_lease(now);
        // Of duplicate keys the last one counts, in all parts of the message.
        let mut message = serde_json::from_str::<Value>(message);
        if let Ok(message) = &mut message
            && self.clients.get(&from).is_some_and(|client| client.names_uris)
        {
            clients::rename_sources(message, path_of);
        }
        let is_answer = message.as_ref().is_ok_and(|it| it["type"] == "response");
        match message.and_then(serde_json::from_value::<dapts::Request>) {
            // The answer's content does not matter, only its arrival.
            _ if is_answer => self.on_lease_answer(from),
            Ok(asked) => self.answer(asked, now),
            Err(why) => {
                let body = output("stderr", &format!("not a request: {why}\n"));
                self.event_to::<event::Output>(from, &body);
            }
        }
        self.rewire();
        self.take()
    }

    /// Advances the run by the elapsed wall-clock time and returns the messages.
    pub fn tick(&mut self, now: Wall) -> Vec<Outgoing> {
        self.listen_for_lease(now);
        self.check_lease(now);
        self.drive(now);
        self.rewire();
        self.take()
    }

    fn answer(&mut self, asked: dapts::Request, now: Wall) {
        let dapts::Request { seq, command, arguments } = asked;
        let before = self.out.len();
        let answered = self.dispatch(&command, arguments, now);
        let mut response = json!({
            "type": "response", "request_seq": seq, "command": command, "success": answered.is_ok(),
        });
        match answered {
            Ok(Value::Null) => {}
            Ok(body) => response["body"] = body,
            Err(Refusal(why)) => {
                response["message"] = json!(why);
                response["body"] = json!({"error": {"id": 1, "format": why, "showUser": true}});
            }
        }
        // Events that a request causes follow its response.
        self.out.insert(before, (self.asker, response));
    }

    fn dispatch(&mut self, command: &str, arguments: Value, now: Wall) -> Answer<Value> {
        if command.starts_with("afp/")
            && let Some(client) = self.clients.get_mut(&self.asker)
        {
            client.ours = true;
        }
        self.check_part(command)?;
        self.may(command, now)?;
        self.check_live(command)?;
        match command {
            "initialize" => said(self.initialize(parse(arguments)?)),
            "launch" => said(self.launch(parse(arguments)?, now)),
            "attach" => said(self.attach(parse(arguments)?, now)),
            "restart" => said(self.restart(&arguments, now)),
            "configurationDone" => said(self.configured(now)),
            "terminate" => said(self.terminate()),
            "disconnect" => said(self.disconnect(parse(arguments)?)),
            "setBreakpoints" => said(self.set_breakpoints(parse(arguments)?)),
            "setFunctionBreakpoints" => said(self.set_functions(parse(arguments)?)),
            "dataBreakpointInfo" => said(self.data_info(parse(arguments)?)),
            "setDataBreakpoints" => said(self.set_data(parse(arguments)?)),
            "setExceptionBreakpoints" => said(self.set_filters(parse(arguments)?)),
            "breakpointLocations" => said(self.locations(parse(arguments)?)),
            "source" => said(self.source(parse(arguments)?)),
            "exceptionInfo" => said(self.exception_info(parse(arguments)?)),
            "threads" => said(self.threads()),
            "stackTrace" => said(self.stack_trace(parse(arguments)?)),
            "scopes" => said(self.scopes(parse(arguments)?)),
            "variables" => said(self.variables(parse(arguments)?)),
            "setVariable" => said(self.set_variable(parse(arguments)?)),
            "setExpression" => said(self.set_expression(parse(arguments)?)),
            "gotoTargets" => said(self.goto_targets(parse(arguments)?)),
            "evaluate" => said(self.evaluate(parse(arguments)?, now)),
            "continue" => said(self.go_on(now)),
            "next" | "stepIn" | "stepOut" => said(self.step(command, parse(arguments)?, now)),
            "pause" => said(self.pause()),
            "stepBack" => said(self.back(parse(arguments)?)),
            "reverseContinue" => said(self.reverse()),
            "goto" => said(self.goto(parse(arguments)?, now)),
            "afp/press" => said(self.press(parse(arguments)?)),
            "afp/fault" => said(self.fault(parse(arguments)?)),
            "afp/move" => said(self.carry(parse(arguments)?)),
            "afp/drop" => said(self.drop_into(parse(arguments)?)),
            "afp/picture" => said(self.picture()),
            "afp/force" => said(self.force(parse(arguments)?)),
            "afp/fork" => said(self.fork(parse(arguments)?, now)),
            "afp/release" => said(self.release(parse(arguments)?)),
            "afp/role" => said(self.role(parse(arguments)?, now)),
            "afp/why" => said(self.why(parse(arguments)?)),
            "afp/speed" => said(self.speed(parse(arguments)?, now)),
            "afp/seek" => said(self.seek(parse(arguments)?)),
            "afp/world" => said(self.world(parse(arguments)?)),
            "afp/subscribe" => said(self.subscribe(parse(arguments)?)),
            other => Err(Refusal(format!("unknown request '{other}'"))),
        }
    }

    /// Checks that the client takes part in the run, if the request needs that.
    fn check_part(&self, command: &str) -> Answer<()> {
        let takes_part = self.takes_part();
        let is_first = ["initialize", "launch", "attach", "disconnect"].contains(&command);
        match &self.guard {
            _ if takes_part || is_first => Ok(()),
            Some(_) => Err("send 'launch' or 'attach' first, with the token".into()),
            None if self.run.is_some() && command != "afp/world" => {
                Err("send 'attach' first to join the run".into())
            }
            None => Ok(()),
        }
    }

    fn takes_part(&self) -> bool {
        self.clients.get(&self.asker).is_some_and(|client| client.attached)
    }

    fn run(&mut self) -> Answer<&mut Run<'h>> {
        self.run.as_mut().ok_or_else(|| Refusal("nothing runs yet: send 'launch' first".to_owned()))
    }

    /// Shows a text in the client's console.
    fn output(&mut self, category: &str, text: &str) {
        self.event::<event::Output>(&output(category, text));
    }
}

fn output(category: &str, text: &str) -> dapts::OutputEvent {
    let category = match category {
        "stderr" => dapts::OutputEventCategory::Stderr,
        "important" => dapts::OutputEventCategory::Important,
        _ => dapts::OutputEventCategory::Console,
    };
    let (category, output) = (Some(category), text.to_owned());
    dapts::OutputEvent { category, output, ..dapts::OutputEvent::default() }
}

fn said(answer: Answer<impl Serialize>) -> Answer<Value> {
    serde_json::to_value(answer?).map_err(|why| Refusal(why.to_string()))
}

/// Parses the arguments of a request; a client may omit empty ones.
fn parse<T: DeserializeOwned>(arguments: Value) -> Answer<T> {
    let arguments = if arguments.is_null() { json!({}) } else { arguments };
    serde_json::from_value(arguments).map_err(|why| Refusal(format!("wrong arguments: {why}")))
}
