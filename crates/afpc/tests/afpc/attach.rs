//! `afpc attach` and `afpc dap`: debuggers of a run on a robot, and of one in real time.

use std::collections::VecDeque;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::common::Place;
use crate::deploy::ssh::{SSHD, Server};
use crate::profile::Running;

const PLAN: &str = "use std
use carbot

plan Drive {
    start ahead
    var rounds: int = 0
    actor ahead: Forward(distance = 15 cm) { ForwardSuccessful -> count }
    computation count: Count(value = rounds, limit = 1000, next => rounds) {
        Again -> rest
        Done -> terminate
    }
    actor rest: Wait(duration = 200 ms) { Elapsed -> ahead }
}
";

/// The longest wait for a message; a busy machine is slow.
const PATIENCE: Duration = Duration::from_secs(60);

/// A client that talks to an adapter over the standard streams of a process.
pub struct Client {
    child: Child,
    to: ChildStdin,
    arrived: Receiver<Value>,
    waiting: VecDeque<Value>,
    seq: i64,
}

impl Client {
    pub fn new(place: &Place, words: &[&str]) -> Client {
        let mut command = place.command();
        command.args(words).env("XDG_RUNTIME_DIR", place.path(""));
        Client::of(&mut command)
    }

    pub fn of(command: &mut std::process::Command) -> Client {
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let (to, from) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let (sender, arrived) = channel();
        thread::spawn(move || {
            let mut from = BufReader::new(from);
            while let Some(message) = message(&mut from) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        Client { child, to, arrived, waiting: VecDeque::new(), seq: 0 }
    }

    fn send(&mut self, command: &str, arguments: &Value) -> i64 {
        self.seq += 1;
        let body = json!({
            "seq": self.seq, "type": "request", "command": command, "arguments": arguments,
        });
        let body = body.to_string();
        write!(self.to, "Content-Length: {}\r\n\r\n{body}", body.len()).unwrap();
        self.seq
    }

    /// The answer to a request; it must succeed.
    pub fn ask(&mut self, command: &str, arguments: Value) -> Value {
        let seq = self.send(command, &arguments);
        let answer = self.wait(command, |it| it["type"] == "response" && it["request_seq"] == seq);
        assert_eq!(answer["success"], true, "{command}: {answer}");
        answer["body"].clone()
    }

    /// The reason why a request is rejected.
    pub fn refused(&mut self, command: &str, arguments: Value) -> String {
        let seq = self.send(command, &arguments);
        let answer = self.wait(command, |it| it["type"] == "response" && it["request_seq"] == seq);
        assert_eq!(answer["success"], false, "{command}: {answer}");
        answer["message"].as_str().unwrap_or_default().to_owned()
    }

    pub fn event(&mut self, name: &str) -> Value {
        self.wait(name, |it| it["type"] == "event" && it["event"] == name)["body"].clone()
    }

    fn wait(&mut self, what: &str, is_it: impl Fn(&Value) -> bool) -> Value {
        let since = Instant::now();
        loop {
            if let Some(at) = self.waiting.iter().position(&is_it) {
                return self.waiting.remove(at).unwrap();
            }
            let left = PATIENCE.saturating_sub(since.elapsed());
            match self.arrived.recv_timeout(left) {
                Ok(message) => self.waiting.push_back(message),
                Err(why) => panic!("no {what}: {why}; {:#?}", self.waiting),
            }
        }
    }

    /// Attaches and finishes the configuration.
    pub fn attach(&mut self, arguments: Value) {
        self.ask("initialize", json!({"clientID": "test", "adapterID": "afp"}));
        self.ask("attach", arguments);
        self.event("initialized");
        self.ask("configurationDone", json!({}));
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        self.child.kill().ok();
        self.child.wait().ok();
    }
}

fn message(from: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if from.read_line(&mut line).ok()? == 0 {
            return None;
        }
        match line.trim() {
            "" => break,
            line => {
                if let Some(text) = line.strip_prefix("Content-Length: ") {
                    length = text.parse().ok()?;
                }
            }
        }
    }
    let mut body = vec![0; length];
    from.read_exact(&mut body).ok()?;
    serde_json::from_slice(&body).ok()
}

/// A robot on a pseudo-terminal, and a run on it.
struct Robot {
    place: Place,
    controller: Running,
    run: Child,
}

impl Robot {
    fn new() -> Robot {
        let place = Place::new();
        place.afpc("new mycar --profile carbot").succeeds();
        place.write("mycar/plans/drive.afp", PLAN);
        let controller = Running::start(|_| {});
        // A busy machine is no fault of the robot.
        let port = format!("robot.port={}", controller.port);
        let words = ["run", "plans/drive.afp", "--robot", "hardware", "--log", "../run.mcap"];
        let mut command = place.command();
        command.current_dir(place.path("mycar")).args(words).args(["--set", &port]);
        command.args(["--set", "robot.realtime.stall=10s"]);
        command.env("XDG_RUNTIME_DIR", place.path("")).stdin(Stdio::null());
        let run = command.stdout(Stdio::null()).spawn().unwrap();
        Robot { place, controller, run }
    }

    fn socket(&mut self) -> String {
        socket(&self.place, &mut self.run)
    }

    fn way(&self) -> f64 {
        self.controller.with(|fake| fake.ways[0].into())
    }

    /// Asserts that the wheels do not turn for a while.
    fn stands(&self) {
        // Until the motors have stopped.
        thread::sleep(Duration::from_millis(300));
        let before = self.way();
        thread::sleep(Duration::from_millis(500));
        assert!((self.way() - before).abs() < 1e-6, "it drives: {before} m, {} m", self.way());
    }

    /// Waits until the wheels have turned.
    fn drives(&self) {
        let (before, since) = (self.way(), Instant::now());
        while (self.way() - before).abs() < 0.01 {
            assert!(since.elapsed() < PATIENCE, "it does not drive");
            thread::sleep(Duration::from_millis(10));
        }
    }
}

/// The socket of the only run.
fn socket(place: &Place, run: &mut Child) -> String {
    let since = Instant::now();
    loop {
        let folder = fs::read_dir(place.path("afp")).ok();
        let found: Option<PathBuf> =
            folder.and_then(|all| all.flatten().next()).map(|it| it.path());
        if let Some(path) = found {
            return path.display().to_string();
        }
        assert!(since.elapsed() < PATIENCE, "there is no socket");
        assert!(run.try_wait().unwrap().is_none(), "the run has ended");
        thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_breakpoint_holds_a_robot_and_anybody_stops_it() {
    let mut robot = Robot::new();
    let socket = robot.socket();
    let mode =
        std::os::unix::fs::PermissionsExt::mode(&fs::metadata(&socket).unwrap().permissions());
    assert_eq!(mode & 0o777, 0o660);
    // `afpc dap` proves for its editor that the operator is there.
    let mut editor = Client::new(&robot.place, &["dap"]);
    editor.attach(json!({"socket": socket, "role": "operator"}));
    let set = json!({"breakpoints": [{"name": "ahead", "condition": "rounds > 0"}]});
    let bound = editor.ask("setFunctionBreakpoints", set);
    assert_eq!(bound["breakpoints"][0]["verified"], true, "{bound}");
    let stopped = editor.event("stopped");
    assert_eq!(stopped["reason"], "function breakpoint", "{stopped}");
    robot.stands();
    let stack = editor.ask("stackTrace", json!({"threadId": 1}));
    assert!(stack["stackFrames"][0]["name"].as_str().unwrap().contains("ahead"), "{stack}");
    editor.ask("setFunctionBreakpoints", json!({"breakpoints": []}));
    editor.ask("continue", json!({"threadId": 1}));
    robot.drives();
    editor.ask("pause", json!({"threadId": 1}));
    assert_eq!(editor.event("stopped")["reason"], "pause");
    robot.stands();
    // A step drives to the next transition and holds before it.
    editor.ask("next", json!({"threadId": 1}));
    let stopped = editor.event("stopped");
    assert_eq!(stopped["reason"], "step", "{stopped}");
    robot.stands();
    let back = editor.refused("stepBack", json!({"threadId": 1}));
    assert!(back.contains("the robot itself runs this plan"), "{back}");
    // Another client watches, and stops the robot.
    let mut other = Client::new(&robot.place, &["attach"]);
    other.attach(json!({}));
    assert_eq!(other.event("stopped")["allThreadsStopped"], true);
    let why = other.refused("continue", json!({"threadId": 1}));
    assert!(why.contains("operates this run"), "{why}");
    other.ask("terminate", json!({}));
    for client in [&mut editor, &mut other] {
        assert_eq!(client.event("afp/ended")["ending"], "interrupted");
        client.event("terminated");
    }
    assert!(robot.run.wait().unwrap().success());
    robot.controller.with(|fake| assert!(fake.controller.is_stopped() && !fake.is_moving()));
    // Without a run, nobody reads its messages.
    drop(robot.controller);
    // The log has the requests.
    let log = robot.place.afpc("log run.mcap").out;
    for line in ["● hold", "● step", "● continue", "● stop", "is held"] {
        assert!(log.contains(line), "{line} in {log}");
    }
}

#[test]
fn an_operator_that_is_gone_neither_starts_nor_stops_the_robot() {
    let mut robot = Robot::new();
    let socket = robot.socket();
    let mut editor = Client::new(&robot.place, &["attach", &socket]);
    editor.attach(json!({"role": "operator"}));
    editor.ask("pause", json!({"threadId": 1}));
    editor.event("stopped");
    robot.stands();
    drop(editor);
    robot.stands();
    // It holds until somebody continues.
    let mut next = Client::new(&robot.place, &["dap"]);
    next.attach(json!({"socket": socket, "role": "operator"}));
    next.event("stopped");
    next.ask("continue", json!({"threadId": 1}));
    robot.drives();
    drop(next);
    robot.drives();
    robot.run.kill().unwrap();
    robot.run.wait().unwrap();
}

#[test]
fn a_simulated_run_in_real_time_is_held_and_repeats_from_its_log() {
    let place = Place::new();
    place.write("drive.afp", PLAN);
    let mut command = place.command();
    command.args(["run", "drive.afp", "--attach", "--log", "run.mcap", "--svg", "none"]);
    command.env("XDG_RUNTIME_DIR", place.path("")).stdin(Stdio::null());
    let mut run = command.stdout(Stdio::null()).spawn().unwrap();
    let mut client = Client::new(&place, &["dap"]);
    client.attach(json!({"socket": socket(&place, &mut run), "role": "operator"}));
    let set = json!({"breakpoints": [{"name": "rest"}]});
    client.ask("setFunctionBreakpoints", set);
    assert_eq!(client.event("stopped")["reason"], "function breakpoint");
    client.ask("setExpression", json!({"expression": "rounds", "value": "7"}));
    client.ask("continue", json!({"threadId": 1}));
    client.event("stopped");
    client.ask("terminate", json!({}));
    client.event("terminated");
    assert!(run.wait().unwrap().success());
    let again = place.afpc("run --again run.mcap --log none --svg none");
    assert!(again.succeeds().out.contains("is held"), "{again:?}");
    assert!(!again.err.contains("trace"), "{again:?}");
}

#[test]
fn a_robot_is_debugged_through_ssh() {
    if !Path::new(SSHD).exists() {
        println!("left out: there is no {SSHD}");
        return;
    }
    let mut robot = Robot::new();
    robot.socket();
    let (folder, afpc) = (robot.place.path(""), env!("CARGO_BIN_EXE_afpc"));
    let program = format!("exec env XDG_RUNTIME_DIR={} {afpc} attach", folder.display());
    let server = Server::only("afpc attach", &program);
    let mut command = robot.place.command();
    command.args(["attach", "robot.test"]).env("PATH", server.path());
    let mut client = Client::of(&mut command);
    client.ask("initialize", json!({"clientID": "test", "adapterID": "afp"}));
    client.ask("attach", json!({"role": "operator"}));
    client.event("initialized");
    client.ask("setFunctionBreakpoints", json!({"breakpoints": [{"name": "rest"}]}));
    client.ask("configurationDone", json!({}));
    assert_eq!(client.event("stopped")["reason"], "function breakpoint");
    robot.stands();
    // The operator's computer answers the lease.
    thread::sleep(Duration::from_secs(4));
    let role = client.ask("afp/role", json!({}));
    assert_eq!(role["operator"], role["you"], "{role}");
    client.ask("terminate", json!({}));
    client.event("terminated");
    assert!(robot.run.wait().unwrap().success());
}

#[test]
fn a_robot_that_cannot_be_reached_is_reported_with_the_next_step() {
    let place = Place::new();
    let path = format!("{}:{}", place.path("bin").display(), std::env::var("PATH").unwrap());
    for (said, message, help) in [
        (
            "ssh: Could not resolve hostname robto.local: Name or service not known",
            "does not know the name 'robto.local'",
            "check the name",
        ),
        ("bash: afpc: command not found", "has no afpc", "afpc robot setup afp@robto.local"),
        ("afp@robto.local: Permission denied (publickey).", "your key", "ssh-copy-id"),
        (
            "error: no run on this machine lets debuggers attach",
            "no run that lets debuggers attach",
            "afpc robot arm",
        ),
    ] {
        place.program("bin/ssh", &format!("#!/bin/sh\necho '{said}' >&2\nexit 255\n"));
        let mut command = place.command();
        command.args(["attach", "afp@robto.local"]).env("PATH", &path).stdin(Stdio::piped());
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        // An editor that waits keeps its end open.
        let editor = child.stdin.take();
        let ended = crate::common::said(child.wait_with_output().unwrap());
        drop(editor);
        ended.fails(1, &[said, message, help]);
        let mut command = place.command();
        let mut editor = Client::of(command.arg("dap").env("PATH", &path));
        editor.ask("initialize", json!({"clientID": "test", "adapterID": "afp"}));
        let why = editor.refused("attach", json!({"host": "afp@robto.local"}));
        assert!(why.contains(message) && why.contains(help), "{why}");
    }
}
