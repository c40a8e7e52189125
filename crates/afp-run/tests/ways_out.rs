//! All ends of a run on a robot: the robot receives `stop` last, or nothing after the end of its
//! program, and the exit code names the reason.
//!
//! The program runs in its own process; the robot is the other end of a pseudo-terminal.
#![cfg(unix)]

#[path = "ways_out/program.rs"]
mod program;
#[cfg(target_os = "linux")]
#[path = "ways_out/times.rs"]
mod times;

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
#[cfg(target_os = "linux")]
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::stdio::dup2_stdout;

/// The environment variable with the port.
const PORT: &str = "AFP_TEST_PORT";
/// The environment variable with the options of the program, one a line; the first line names the
/// action of its actor.
const OPTIONS: &str = "AFP_TEST_OPTIONS";

/// The environment variable with the output file of the program, if any.
const OUT: &str = "AFP_TEST_OUT";

/// Is set if the system is to trap the control thread.
const TRAP: &str = "AFP_TEST_TRAP";

/// The limit for a stop.
const LIMIT: Duration = Duration::from_secs(2);
/// The limit for everything else on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// Not a test: the other tests start it as their program.
#[test]
fn program() {
    let (Ok(port), Ok(options)) = (std::env::var(PORT), std::env::var(OPTIONS)) else { return };
    if let Ok(out) = std::env::var(OUT) {
        dup2_stdout(File::options().write(true).open(out).unwrap()).unwrap();
    }
    let options: Vec<_> = options.lines().collect();
    let (does, to) = (options[0], if options[0] == "laps" { "go" } else { "terminate" });
    let actor = format!("actor go: Go(does = \"{does}\") {{ Arrived -> {to} }}");
    let tick = match options[0] {
        "often" => {
            "supervise tick: CheckTimeout(duration = 3600 s) every 1 ms { TimedOut -> terminate }"
        }
        _ => "",
    };
    let plan =
        format!("use port\nuse std\nplan Rove {{\n    start go\n    {tick}\n    {actor}\n}}");
    program::drive(&plan, &port, &options[1..]);
}

/// A pseudo-terminal, and the path of its other end.
fn terminal() -> (File, String) {
    let port = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
    grantpt(&port).unwrap();
    unlockpt(&port).unwrap();
    let path = ptsname(&port, Vec::new()).unwrap().to_string_lossy().into_owned();
    (File::from(port), path)
}

/// The robot's end of a port.
struct Robot {
    path: String,
    /// The lines that it receives.
    heard: Receiver<String>,
    /// Keeps the port open until the program has ended.
    end: Option<File>,
}

impl Robot {
    fn new() -> Robot {
        let (port, path) = terminal();
        let end = File::options().read(true).write(true).open(&path).unwrap();
        let (hears, heard) = channel();
        thread::spawn(move || {
            // Reading fails after the other end is closed.
            let lines = BufReader::new(port).lines().map_while(Result::ok);
            lines.for_each(|line| drop(hears.send(line.trim().to_owned())));
        });
        Robot { path, heard, end: Some(end) }
    }

    /// Waits for a word; returns the words before it.
    fn waits_for(&self, word: &str, limit: Duration) -> Vec<String> {
        let (until, mut before) = (Instant::now() + limit, Vec::new());
        loop {
            match self.heard.recv_timeout(until.saturating_duration_since(Instant::now())) {
                Ok(line) if line == word => return before,
                Ok(line) => before.push(line),
                Err(why) => panic!("it does not hear '{word}' but {before:?} ({why})"),
            }
        }
    }

    /// All words until the program has ended.
    fn rest(&mut self) -> Vec<String> {
        self.end = None;
        let mut rest = Vec::new();
        loop {
            match self.heard.recv_timeout(PATIENCE) {
                Ok(line) => rest.push(line),
                Err(RecvTimeoutError::Disconnected) => return rest,
                Err(RecvTimeoutError::Timeout) => panic!("the port stays open"),
            }
        }
    }
}

/// Starts the program with an action and options.
fn start(robot: &Robot, does: &str, options: &[&str]) -> Command {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.args(["--exact", "program", "--nocapture", "--test-threads=1"]);
    let log = ["--log", "none"].iter().filter(|_| !options.contains(&"--log"));
    let options: Vec<_> = [does].iter().chain(log).chain(options).copied().collect();
    command.env(PORT, &robot.path).env(OPTIONS, options.join("\n"));
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// Waits for the end of a program; returns its standard error too.
fn ended(mut child: Child) -> (ExitStatus, String) {
    let mut stderr = child.stderr.take().unwrap();
    let (end, said) = channel();
    thread::spawn(move || {
        let mut text = String::new();
        let read = stderr.read_to_string(&mut text);
        end.send(read.map(|_| text))
    });
    match said.recv_timeout(PATIENCE) {
        Ok(said) => (child.wait().unwrap(), said.unwrap()),
        Err(_) => {
            child.kill().unwrap();
            panic!("the program does not end");
        }
    }
}

fn send(child: &Child, signal: Signal) {
    kill_process(Pid::from_child(child), signal).unwrap();
}

#[test]
fn a_run_that_ends_by_itself_stops_the_robot() {
    for (does, code) in [("arrives", 0), ("fails", 3), ("panics", 3)] {
        let mut robot = Robot::new();
        let child = start(&robot, does, &[]).spawn().unwrap();
        robot.waits_for("drive", PATIENCE);
        let (status, said) = ended(child);
        assert_eq!(status.code(), Some(code), "{does}: {said}");
        assert_eq!(robot.rest().last().unwrap(), "stop", "{does}");
    }
}

#[test]
fn a_signal_that_ends_the_run_stops_the_robot() {
    for (signal, code) in [
        (Signal::INT, 0),
        (Signal::TERM, 143),
        (Signal::HUP, 129),
        (Signal::TSTP, 0),
        (Signal::XCPU, 152),
    ] {
        let mut robot = Robot::new();
        let child = start(&robot, "drives", &[]).spawn().unwrap();
        robot.waits_for("drive", PATIENCE);
        send(&child, signal);
        robot.waits_for("stop", LIMIT);
        let (status, said) = ended(child);
        assert_eq!(status.code(), Some(code), "{signal:?}: {said}");
        let rest = robot.rest();
        assert!(rest.iter().all(|word| word == "stop"), "{signal:?}: {rest:?}");
    }
}

#[test]
fn a_program_that_is_killed_leaves_the_robot_to_its_own_dead_man() {
    let mut robot = Robot::new();
    let child = start(&robot, "drives", &[]).spawn().unwrap();
    robot.waits_for("drive", PATIENCE);
    send(&child, Signal::KILL);
    assert_eq!(ended(child).0.code(), None);
    // No thread sends `stop` for the program.
    let rest = robot.rest();
    assert!(rest.iter().all(|word| word == "drive"), "{rest:?}");
}

#[test]
fn a_suspended_run_does_not_continue_driving() {
    let mut robot = Robot::new();
    let stall = ["--set", "robot.realtime.stall=500ms"];
    let child = start(&robot, "drives", &stall).spawn().unwrap();
    robot.waits_for("drive", PATIENCE);
    send(&child, Signal::STOP);
    // Discards all earlier words.
    thread::sleep(Duration::from_secs(1));
    while robot.heard.try_recv().is_ok() {}
    send(&child, Signal::CONT);
    let before = robot.waits_for("stop", LIMIT);
    assert!(!before.contains(&"drive".to_owned()), "it drives on: {before:?}");
    let (status, said) = ended(child);
    assert_eq!(status.code(), Some(3), "{said}");
    let rest = robot.rest();
    assert!(!rest.contains(&"drive".to_owned()), "it drives on: {rest:?}");
}

#[test]
#[cfg(target_os = "linux")]
fn the_control_loop_makes_only_four_kinds_of_system_calls() {
    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("a.mcap");
    let mut robot = Robot::new();
    // The terminal is read on another thread.
    let (_keyboard, path) = terminal();
    let keys = File::options().read(true).open(&path).unwrap();
    let mut program = start(&robot, "laps", &["--log", log.to_str().unwrap()]);
    let mut child = program.stdin(keys).env(TRAP, "on").spawn().unwrap();
    robot.waits_for("trapped", PATIENCE);
    // Each lap is a dozen records; the trap kills at the first other call.
    for _ in 0..300 {
        robot.waits_for("drive", PATIENCE);
    }
    child.kill().unwrap();
    let (status, said) = ended(child);
    assert_eq!(status.signal(), Some(9), "{status}: {said}");
    robot.rest();
}

/// The FIFO priorities of a program's threads by their names, as the system has them.
#[cfg(target_os = "linux")]
fn priorities(child: &Child) -> Vec<(String, u32)> {
    let tasks = std::fs::read_dir(format!("/proc/{}/task", child.id())).unwrap();
    let of = |task: std::fs::DirEntry| {
        let name = std::fs::read_to_string(task.path().join("comm")).ok()?;
        let stat = std::fs::read_to_string(task.path().join("stat")).ok()?;
        // After the name: the 38th field is the priority, the 39th the policy.
        let fields: Vec<_> = stat.rsplit_once(')')?.1.split_whitespace().collect();
        let (priority, is_fifo) = (fields[37].parse().ok()?, fields[38] == "1");
        is_fifo.then(|| (name.trim().to_owned(), priority))
    };
    tasks.filter_map(|task| of(task.unwrap())).collect()
}

#[test]
#[cfg(target_os = "linux")]
fn the_control_loop_has_its_priority_or_a_warning_names_the_reason() {
    let set = ["--set", "robot.realtime.priority=20", "--set", "robot.realtime.cpu=1023"];
    let mut robot = Robot::new();
    let child = start(&robot, "drives", &set).spawn().unwrap();
    robot.waits_for("drive", PATIENCE);
    let mut fifo = priorities(&child);
    fifo.sort_by_key(|(_, priority)| *priority);
    send(&child, Signal::TERM);
    robot.waits_for("stop", LIMIT);
    let (_, said) = ended(child);
    // Other threads, such as the observers and the log, have none.
    let found: Vec<_> = fifo.iter().map(|(name, priority)| (&**name, *priority)).collect();
    match &found[..] {
        [(_, 20), ("afp-watchdog", 21)] => assert!(!said.contains("FIFO"), "{said}"),
        [] => assert!(said.contains("the control loop has no FIFO priority 20: "), "{said}"),
        other => panic!("{other:?}: {said}"),
    }
    assert!(said.contains("the control loop cannot run on processor 1023: "), "{said}");
    assert!(robot.rest().iter().all(|word| word == "stop"));
}

#[test]
fn a_component_that_hangs_is_named_and_the_robot_is_stopped() {
    let mut robot = Robot::new();
    let stall = ["--set", "robot.realtime.stall=500ms"];
    let mut child = start(&robot, "hangs", &stall).spawn().unwrap();
    robot.waits_for("drive", PATIENCE);
    robot.waits_for("cut", PATIENCE);
    // The watchdog prints the reason after the stop.
    let mut stderr = BufReader::new(child.stderr.take().unwrap());
    let reason = "since the call of 'go' (Go): the robot was stopped from another thread";
    let mut lines = stderr.by_ref().lines().map_while(Result::ok);
    assert!(lines.any(|line| line.contains(reason)));
    child.stderr = Some(stderr.into_inner());
    // The program hangs, so one signal ends it.
    send(&child, Signal::TERM);
    let (status, said) = ended(child);
    assert_eq!(status.code(), Some(130), "{said}");
    assert_eq!(robot.rest(), [""; 0]);
}

#[test]
fn a_full_output_stops_the_robot() {
    // A device that is always full, and a file size limit.
    let mut robot = Robot::new();
    let child = start(&robot, "drives", &[]).env(OUT, "/dev/full").spawn().unwrap();
    let (status, said) = ended(child);
    assert_eq!(status.code(), Some(1), "{said}");
    assert_eq!(robot.rest().last().unwrap(), "stop");

    let folder = tempfile::tempdir().unwrap();
    let log = folder.path().join("a.mcap");
    let mut robot = Robot::new();
    let program = start(&robot, "laps", &["--log", log.to_str().unwrap()]);
    let mut limited = Command::new("sh");
    limited.args(["-c", "ulimit -f 32; exec \"$0\" \"$@\""]).arg(program.get_program());
    limited.args(program.get_args()).stdin(Stdio::null()).stdout(Stdio::null());
    limited.envs(program.get_envs().filter_map(|(name, value)| Some((name, value?))));
    let child = limited.stderr(Stdio::piped()).spawn().unwrap();
    robot.waits_for("stop", PATIENCE);
    let (status, said) = ended(child);
    assert!(matches!(status.code(), Some(1 | 153)), "{status} {said}");
    let rest = robot.rest();
    assert!(rest.iter().all(|word| word == "stop"), "{rest:?}");
}

#[test]
fn a_slow_reader_does_not_delay_a_stop() {
    let (_reader, path) = terminal();
    let out = File::options().write(true).open(&path).unwrap();
    let mut robot = Robot::new();
    let child = start(&robot, "laps", &["--json"]).stdout(out).spawn().unwrap();
    // Each lap prints some lines, and the terminal buffers some thousand bytes.
    (0..200).for_each(|_| drop(robot.waits_for("drive", PATIENCE)));
    send(&child, Signal::TERM);
    robot.waits_for("stop", LIMIT);
    // The robot has stopped, so the rest of the report may wait for its reader.
    send(&child, Signal::TERM);
    let (status, said) = ended(child);
    assert!(matches!(status.code(), Some(130 | 143)), "{status} {said}");
    assert!(!robot.rest().contains(&"drive".to_owned()));
}

#[test]
fn a_second_program_cannot_drive_the_robot_and_names_the_first() {
    let mut robot = Robot::new();
    let first = start(&robot, "drives", &[]).spawn().unwrap();
    robot.waits_for("drive", PATIENCE);
    let (status, said) = ended(start(&robot, "drives", &[]).spawn().unwrap());
    assert_eq!(status.code(), Some(2), "{said}");
    let by = format!("process {} ", first.id());
    assert!(said.contains("has it open"), "{said}");
    assert!(said.contains(&by) || !cfg!(target_os = "linux"), "{said}");
    // The first program continues as before.
    robot.waits_for("drive", LIMIT);
    send(&first, Signal::TERM);
    let before = robot.waits_for("stop", LIMIT);
    assert!(before.iter().all(|word| word == "drive"), "{before:?}");
    assert_eq!(ended(first).0.code(), Some(143));
    assert!(robot.rest().iter().all(|word| word == "stop"));
}
