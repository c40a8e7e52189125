//! Clients of the adapter, and the plans that they debug.

#![allow(dead_code)] // Each test file uses a part.

use std::sync::Arc;
use std::time::Duration;

use afp_debug::{Adapter, Host, Launch, Program, SessionTarget, Target};
use afp_dsl::compile_plan;
use afp_dsl::files::Texts;
use afp_dsl::graph::Graph;
use afp_dsl::toolbox::Toolboxes;
use afp_session::{AnySession, Loader};
use afp_syntax::source::Source;
use serde_json::{Value, json};

/// Plans from a text, on the Carbot in its own world.
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

/// A session of a plan at its start.
pub fn session(graph: &Graph, launch: &Launch) -> Result<Box<dyn AnySession>, String> {
    let robot = afp_sim::carbot(|_| {});
    let world = robot.kind().world(robot.kind().default_world());
    let world = world.map_err(|why| why.to_string())?;
    let session = robot.session(graph, &*world, launch.seed, &[]);
    let mut session = session.map_err(|why| why.to_string())?;
    for (name, text) in &launch.set {
        session.set(name, text).map_err(|why| format!("'{name}': {why}"))?;
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

/// A client that is told things.
pub struct Client {
    adapter: Adapter<'static>,
    said: i64,
    now: Duration,
    /// What it was told, one line for each message.
    pub told: String,
}

impl Client {
    pub fn new(host: Box<dyn Host<'static>>) -> Client {
        let adapter = Adapter::new(host);
        Client { adapter, said: 0, now: Duration::ZERO, told: String::new() }
    }

    pub fn say(&mut self, line: &str) {
        let (command, arguments) = line.split_once(' ').unwrap_or((line, "null"));
        let arguments: Value = serde_json::from_str(arguments).expect("arguments are JSON");
        self.said += 1;
        let message = json!({
            "seq": self.said, "type": "request", "command": command, "arguments": arguments,
        });
        let answers = self.adapter.handle(&message.to_string(), self.now);
        self.hear(answers);
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

    fn hear(&mut self, messages: Vec<String>) {
        for message in messages {
            let message: Value = serde_json::from_str(&message).expect("messages are JSON");
            let line = match message["type"].as_str() {
                Some("response") if message["success"] == true => {
                    format!("{} {}", message["command"].as_str().unwrap_or(""), message["body"])
                }
                Some("response") => {
                    format!(
                        "{} refused: {}",
                        message["command"].as_str().unwrap_or(""),
                        message["message"]
                    )
                }
                _ => {
                    format!("event {} {}", message["event"].as_str().unwrap_or(""), message["body"])
                }
            };
            self.told += &format!("<-- {}\n", line.trim_end_matches(" null"));
        }
    }
}
