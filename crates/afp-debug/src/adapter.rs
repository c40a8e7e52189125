//! The adapter: messages of a client in, messages to it out.

mod force;
mod launch;
mod look;
mod outside;
mod places;
mod steer;
mod stop;
mod time;
mod trace;
mod why;
mod world;

use std::time::Duration as Wall;

use afp_core::Instant;
use afp_session::{Drawing, Droppable};
use afp_token::Token;
use dapts::{IEvent, IRequest, event, request};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use crate::breakpoints::Breakpoints;
use crate::target::Target;

pub use launch::Launch;
use steer::{Mode, Pace};

/// What an adapter cannot do by itself.
pub trait Host<'h> {
    /// A run of a plan at its start.
    ///
    /// # Errors
    /// There is none: why, and what to do.
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target + 'h>, String>;

    /// What a run would take place in, before there is one.
    ///
    /// # Errors
    /// There is none: why, and what to do.
    fn world(&mut self, launch: &Launch) -> Result<Surroundings, String> {
        Err(format!("nothing is known of the world of '{}'", launch.program))
    }

    /// A path as [`Program::files`](crate::Program::files) have it, however it is written.
    fn path(&self, path: &str) -> String;
}

/// What a run takes place in.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// What a picture shows of it.
    pub drawing: Drawing,
    /// Other worlds that a run may take place in, as `launch` takes them, each with where it comes from.
    pub worlds: Vec<(String, &'static str)>,
    /// The shapes that can be dropped into it while a plan runs.
    pub drops: &'static [Droppable],
    /// Whether the robot has a camera.
    pub camera: bool,
}

/// A debug adapter for one client.
pub struct Adapter<'h> {
    host: Box<dyn Host<'h> + 'h>,
    client: Client,
    run: Option<Run<'h>>,
    breakpoints: Breakpoints,
    /// The number of the last message to the client.
    sent: i64,
    out: Vec<Value>,
    /// Whether the client has said goodbye.
    over: bool,
    /// What the client has to know.
    token: Option<Token>,
}

/// How a client counts.
#[derive(Clone, Copy, Debug)]
struct Client {
    /// The number of the first line.
    first_line: u32,
    /// The number of the first column.
    first_column: u32,
}

/// What is debugged.
struct Run<'h> {
    target: Box<dyn Target + 'h>,
    launch: Launch,
    mode: Mode,
    pace: Pace,
    /// Steps in which an element started, ended or was interrupted, in order.
    transitions: Vec<u64>,
    /// The last thing that went wrong.
    exception: Option<(&'static str, String)>,
    /// Whether the client wants to be told what is the case.
    told: bool,
    /// What happened and was not told yet, where the client wants to be told.
    traced: Option<Vec<Value>>,
    /// When it was told so last.
    told_at: Wall,
    /// When the plan is stopped at the latest.
    end: Instant,
    /// What the client holds in place.
    forces: Vec<force::Force>,
}

/// Why a request is refused.
struct Refusal(String);

impl<T: Into<String>> From<T> for Refusal {
    fn from(why: T) -> Self {
        Refusal(why.into())
    }
}

type Answer<T> = Result<T, Refusal>;

impl<'h> Adapter<'h> {
    /// An adapter that nobody has spoken to yet.
    pub fn new(host: Box<dyn Host<'h> + 'h>) -> Adapter<'h> {
        Adapter {
            host,
            client: Client { first_line: 1, first_column: 1 },
            run: None,
            breakpoints: Breakpoints::default(),
            sent: 0,
            out: Vec::new(),
            over: false,
            token: None,
        }
    }

    /// The same for anybody who can reach it: it launches nothing without this token among the arguments.
    pub fn guarded(host: Box<dyn Host<'h> + 'h>, token: &Token) -> Adapter<'h> {
        Adapter { token: Some(token.clone()), ..Adapter::new(host) }
    }

    /// Whether the client has said goodbye.
    pub fn is_over(&self) -> bool {
        self.over
    }

    /// Answers a message; what goes back, in order. `now` is the time on the wall, from whenever.
    pub fn handle(&mut self, message: &str, now: Wall) -> Vec<String> {
        match serde_json::from_str::<dapts::Request>(message) {
            Ok(asked) => self.answer(asked, now),
            Err(why) => self.output("stderr", &format!("not a request: {why}\n")),
        }
        self.take()
    }

    /// Lets the run go on by what has passed on the wall; what is to be told.
    pub fn tick(&mut self, now: Wall) -> Vec<String> {
        self.drive(now);
        self.take()
    }

    fn take(&mut self) -> Vec<String> {
        let numbered = self.out.drain(..).zip(self.sent + 1..).map(|(mut message, number)| {
            message["seq"] = json!(number);
            message.to_string()
        });
        let messages: Vec<_> = numbered.collect();
        self.sent += messages.len() as i64;
        messages
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
        // What a request brings about is told after it was answered.
        self.out.insert(before, response);
    }

    fn dispatch(&mut self, command: &str, arguments: Value, now: Wall) -> Answer<Value> {
        match command {
            request::Initialize::COMMAND => {
                self.on::<request::Initialize>(arguments, Self::initialize)
            }
            "launch" => self.launch(parse(arguments)?, now),
            "restart" => self.restart(now),
            request::ConfigurationDone::COMMAND => self.configured(now),
            "disconnect" | "terminate" => self.stop(command),
            request::SetBreakpoints::COMMAND => {
                self.on::<request::SetBreakpoints>(arguments, Self::set_breakpoints)
            }
            request::SetFunctionBreakpoints::COMMAND => {
                self.on::<request::SetFunctionBreakpoints>(arguments, Self::set_functions)
            }
            request::DataBreakpointInfo::COMMAND => {
                self.on::<request::DataBreakpointInfo>(arguments, Self::data_info)
            }
            request::SetDataBreakpoints::COMMAND => {
                self.on::<request::SetDataBreakpoints>(arguments, Self::set_data)
            }
            request::SetExceptionBreakpoints::COMMAND => {
                let asked: dapts::SetExceptionBreakpointsArguments = parse(arguments)?;
                self.set_filters(&asked)
            }
            request::BreakpointLocations::COMMAND => {
                self.on::<request::BreakpointLocations>(arguments, Self::locations)
            }
            request::Source::COMMAND => self.on::<request::Source>(arguments, Self::source),
            request::ExceptionInfo::COMMAND => {
                self.on::<request::ExceptionInfo>(arguments, |me, _| me.exception_info())
            }
            "threads" => self.threads(),
            request::StackTrace::COMMAND => {
                self.on::<request::StackTrace>(arguments, Self::stack_trace)
            }
            request::Scopes::COMMAND => self.on::<request::Scopes>(arguments, Self::scopes),
            request::Variables::COMMAND => {
                self.on::<request::Variables>(arguments, Self::variables)
            }
            request::SetVariable::COMMAND => {
                self.on::<request::SetVariable>(arguments, Self::set_variable)
            }
            request::Evaluate::COMMAND => self.on::<request::Evaluate>(arguments, Self::evaluate),
            _ => self.steer(command, arguments, now),
        }
    }

    /// Answers a request of the protocol.
    fn on<R: IRequest>(
        &mut self,
        arguments: Value,
        answer: impl FnOnce(&mut Self, R::Arguments) -> Answer<R::Response>,
    ) -> Answer<Value> {
        let response = answer(self, parse(arguments)?)?;
        serde_json::to_value(response).map_err(|why| Refusal(why.to_string()))
    }

    /// The run.
    fn run(&mut self) -> Answer<&mut Run<'h>> {
        self.run
            .as_mut()
            .ok_or_else(|| Refusal("nothing runs yet: 'launch' comes first".to_owned()))
    }

    fn event<E: IEvent>(&mut self, body: &E::Body) {
        let body = serde_json::to_value(body).unwrap_or_default();
        self.tell(E::EVENT, body);
    }

    /// Sends an event.
    fn tell(&mut self, event: &str, body: Value) {
        let mut message = json!({"type": "event", "event": event});
        if !body.is_null() {
            message["body"] = body;
        }
        self.out.push(message);
    }

    /// Shows a text where the client shows such texts.
    fn output(&mut self, category: &str, text: &str) {
        let category = match category {
            "stderr" => dapts::OutputEventCategory::Stderr,
            "important" => dapts::OutputEventCategory::Important,
            _ => dapts::OutputEventCategory::Console,
        };
        let output = text.to_owned();
        self.event::<event::Output>(&dapts::OutputEvent {
            category: Some(category),
            output,
            ..dapts::OutputEvent::default()
        });
    }
}

/// The arguments of a request; a client may leave out what is empty.
fn parse<T: DeserializeOwned>(arguments: Value) -> Answer<T> {
    let arguments = if arguments.is_null() { json!({}) } else { arguments };
    serde_json::from_value(arguments).map_err(|why| Refusal(format!("wrong arguments: {why}")))
}
