//! Talks with the adapter, as data: `tests/dap/*.txt` has a plan, what a client says and what it is told.
//!
//! `--> COMMAND ARGUMENTS` is a request, `tick` lets the run go on until it stands still or ends, `tick 40` for so many
//! milliseconds on the wall. The answers, `<--`, are written by the test with `AFP_BLESS=1`.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use afp_debug::{Adapter, Host, Launch, Program, SessionTarget, Target};
use afp_dsl::compile_plan;
use afp_dsl::files::Texts;
use afp_dsl::toolbox::Toolboxes;
use afp_session::Loader;
use afp_syntax::source::Source;
use serde_json::{Value, json};

/// Plans from a text, on the Carbot in its own world.
struct Texted(String);

impl Host<'static> for Texted {
    fn launch(&mut self, launch: &Launch) -> Result<Box<dyn Target>, String> {
        let source = Source::new("plan.afp", &*self.0);
        let toolboxes: Toolboxes = afp_toolboxes::sources().collect();
        let plan = launch.program.split_once(':').map(|(_, plan)| plan);
        let compiled = compile_plan(&source, &toolboxes, &Texts::default(), plan);
        let graph = compiled.graph.as_ref().ok_or_else(|| compiled.render(false))?;
        let program = Program::new(graph, &compiled.sources, &str::to_owned);
        let (graph, launch) = (graph.clone(), launch.clone());
        let make = move || {
            let robot = afp_sim::carbot(|_| {});
            let world = robot.kind().world(robot.kind().default_world());
            let world = world.map_err(|why| why.to_string())?;
            let session = robot.session(&graph, &*world, launch.seed, &[]);
            let mut session = session.map_err(|why| why.to_string())?;
            for (name, text) in &launch.set {
                session.set(name, text).map_err(|why| format!("'{name}': {why}"))?;
            }
            Ok(session)
        };
        Ok(Box::new(SessionTarget::new(Arc::new(program), Box::new(make))?))
    }

    fn path(&self, path: &str) -> String {
        path.to_owned()
    }
}

/// A client that is told things.
struct Client {
    adapter: Adapter<'static>,
    said: i64,
    now: Duration,
    told: String,
}

impl Client {
    fn new(plan: &str) -> Client {
        let adapter = Adapter::new(Box::new(Texted(plan.to_owned())));
        Client { adapter, said: 0, now: Duration::ZERO, told: String::new() }
    }

    fn say(&mut self, line: &str) {
        let (command, arguments) = line.split_once(' ').unwrap_or((line, "null"));
        let arguments: Value = serde_json::from_str(arguments).expect("arguments are JSON");
        self.said += 1;
        let message = json!({
            "seq": self.said, "type": "request", "command": command, "arguments": arguments,
        });
        let answers = self.adapter.handle(&message.to_string(), self.now);
        self.hear(answers);
    }

    fn tick(&mut self, wall: Option<u64>) {
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

/// A case with the answers that are given now.
fn answered(case: &str) -> String {
    let (plan, talk) = case.split_once("\n---\n").expect("a plan, '---', a talk");
    let mut client = Client::new(plan);
    for line in talk.lines().filter(|line| !line.starts_with("<--")) {
        client.told += line;
        client.told += "\n";
        match line.split_once(' ').unwrap_or((line, "")) {
            ("-->", said) => client.say(said),
            ("tick", "") => client.tick(None),
            ("tick", wall) => client.tick(Some(wall.parse().expect("milliseconds"))),
            _ => {}
        }
    }
    format!("{plan}\n---\n{}", client.told)
}

fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dap");
    let files = fs::read_dir(folder).expect("the folder is there");
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.sort();
    paths
}

#[test]
fn clients_are_told_what_they_were() {
    let mut wrong = Vec::new();
    for path in cases() {
        let case = fs::read_to_string(&path).expect("a text");
        let now = answered(&case);
        if now == case {
            continue;
        }
        if std::env::var_os("AFP_BLESS").is_some() {
            fs::write(&path, now).expect("it can be written");
        } else {
            let lines = case.lines().zip(now.lines()).find(|(was, is)| was != is);
            wrong.push(format!("{}: {lines:?}", path.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
