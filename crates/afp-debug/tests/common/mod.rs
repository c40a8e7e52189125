//! Clients of the adapter, and the plans that they debug.

#![allow(dead_code)] // Each test file uses only a part.

use std::sync::Arc;
use std::time::Duration;

use afp_debug::{Adapter, ClientId, Host, Launch, Outgoing, Program, SessionTarget, Target};
use afp_dsl::Toolboxes;
use afp_dsl::compile_plan;
use afp_dsl::files::Texts;
use afp_dsl::graph::Graph;
use afp_session::{AnySession, Loader};
use afp_syntax::source::Source;
use serde_json::{Value, json};

/// Plans from a text, for the Carbot in its own world.
pub struct Texted(pub String);

/// `FILE:Plan` of a text.
pub fn compiled(text: &str, program: &str) -> Result<(Graph, Program), String> {
    let source = Source::new("plan.afp", text);
    let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
    let plan = program.split_once(':').map(|(_, plan)| plan);
    let compiled = compile_plan(&source, &toolboxes, &Texts::default(), plan);
    let graph = compiled.graph.clone().ok_or_else(|| compiled.render(false))?;
    let program = Program::new(&graph, &compiled.sources, &str::to_owned);
    Ok((graph, program))
}

/// A session of a plan before its first step.
pub fn session(graph: &Graph, launch: &Launch) -> Result<Box<dyn AnySession>, String> {
    let robot = afp_sim::carbot(|_| {});
    let world = robot.kind().world(robot.kind().default_world());
    let world = world.map_err(|why| why.to_string())?;
    let session = robot.session(graph, &*world, launch.seed.unwrap_or(0), &[]);
    let mut session = session.map_err(|why| why.to_string())?;
    for (name, text) in &launch.set {
        session.set(name, text).map_err(|why| why.to_string())?;
    }
    Ok(session)
}

impl Host<'static> for Texted {
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target>, String> {
        let (graph, program) = compiled(&self.0, &launch.program)?;
        let launch = launch.clone();
        let make = move || session(&graph, &launch);
        Ok(Box::new(SessionTarget::new(Arc::new(program), Box::new(make))?))
    }

    fn path(&self, path: &str) -> String {
        path.to_owned()
    }
}

/// Clients of a shared adapter.
pub struct Clients {
    adapter: Adapter<'static>,
    all: Vec<ClientId>,
    said: i64,
    now: Duration,
    /// Their messages, a line each: `<--`, and from the second client on with its number, `<2-`.
    pub told: String,
}

impl Clients {
    pub fn new(host: Box<dyn Host<'static>>) -> Clients {
        Clients::of(Adapter::new(host))
    }

    pub fn of(adapter: Adapter<'static>) -> Clients {
        Clients { adapter, all: Vec::new(), said: 0, now: Duration::ZERO, told: String::new() }
    }

    /// The client with that number, from 1; it joins with its first request.
    fn client(&mut self, number: usize) -> ClientId {
        while self.all.len() < number {
            self.all.push(self.adapter.join());
        }
        self.all[number - 1]
    }

    pub fn say(&mut self, line: &str) {
        self.say_as(1, line);
    }

    /// Sends a request; the word `answer` by itself answers a question of the adapter.
    pub fn say_as(&mut self, number: usize, line: &str) {
        let (command, arguments) = line.split_once(' ').unwrap_or((line, "null"));
        let arguments: Value = serde_json::from_str(arguments).expect("arguments are JSON");
        self.said += 1;
        let kind = if command == "answer" { "response" } else { "request" };
        let message = json!({
            "seq": self.said, "type": kind, "command": command, "arguments": arguments,
        });
        let from = self.client(number);
        let answers = self.adapter.handle(from, &message.to_string(), self.now);
        self.hear(answers);
    }

    /// Breaks a client's connection.
    pub fn lose(&mut self, number: usize) {
        let gone = self.client(number);
        let told = self.adapter.leave(gone);
        self.hear(told);
    }

    pub fn tick(&mut self, wall: Option<u64>) {
        if let Some(wall) = wall {
            self.now += Duration::from_millis(wall);
            let told = self.adapter.tick(self.now);
            return self.hear(told);
        }
        for _ in 0..100_000 {
            let Some(due) = self.adapter.due() else { return };
            self.now += due;
            let told = self.adapter.tick(self.now);
            self.hear(told);
        }
        panic!("the run never stands still");
    }

    fn hear(&mut self, messages: Vec<Outgoing>) {
        for Outgoing { to, message } in messages {
            let message: Value = serde_json::from_str(&message).expect("messages are JSON");
            let word = |key: &str| message[key].as_str().unwrap_or("").to_owned();
            let line = match (message["type"].as_str(), message["success"] == true) {
                (Some("response"), true) => format!("{} {}", word("command"), message["body"]),
                (Some("response"), false) => {
                    format!("{} refused: {}", word("command"), message["message"])
                }
                (Some("request"), _) => format!("asks {}", word("command")),
                _ => format!("event {} {}", word("event"), message["body"]),
            };
            let number = self.all.iter().position(|id| *id == to).expect("it has joined") + 1;
            let arrow = if number == 1 { "<--".to_owned() } else { format!("<{number}-") };
            self.told += &format!("{arrow} {}\n", line.trim_end_matches(" null"));
        }
    }
}
