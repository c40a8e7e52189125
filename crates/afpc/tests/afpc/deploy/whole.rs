//! From a new project to a log on another machine. `afpc new`, scenarios, setup, deploys over
//! ssh to a robot with a controller, its logs, and the debugger in an empty folder.
//!
//! `AFP_ROBOTS_AFPC` names a program for a Raspberry Pi; the robot then emulates one. `AFP_SLOW` limits
//! the connection to 1 Mbit/s and checks the times; the process then needs its own network namespace.

use std::process::Command;
use std::time::{Duration, Instant};

use super::setup::{EMULATED, computer};
use super::ssh::Server;
use crate::common::{Place, Said, said};
use crate::dap::{framed, told_in};
use crate::profile::Running;

const SLOW: &str = "AFP_SLOW";

/// A project for a robot with a controller at a port.
struct Project<'a> {
    place: Place,
    server: &'a Server,
}

impl Project<'_> {
    fn here(&self, arguments: &str) -> Said {
        let path = std::env::var("PATH").unwrap();
        let path = format!("{}:{path}", self.server.place.path("bin").display());
        let mut command = self.place.command();
        command.current_dir(self.place.path("mycar")).env("PATH", path);
        said(command.args(arguments.split(' ')).output().unwrap())
    }

    fn succeeds(&self, arguments: &str) -> String {
        self.here(arguments).succeeds().out.clone()
    }

    /// Deploys a plan for a controller at a port.
    fn deployed(&self, deploy: &str, port: &str) -> String {
        for _ in 0..4 {
            let said = self.here(deploy);
            if said.code == 0 {
                return said.out;
            }
            // A busy machine emulates too slowly. A program that was ended by force has locked this
            // port permanently, since the controller has it open, too.
            let port = std::fs::File::open(port).unwrap();
            rustix::termios::ioctl_tiocnxcl(port).unwrap();
        }
        self.succeeds(deploy)
    }

    /// Fetches a log into an empty folder.
    fn fetched(&self, name: &str) -> Place {
        let elsewhere = Place::new();
        let to = elsewhere.path("run.mcap");
        self.succeeds(&format!("robot logs afp@robot.test {name} -o {}", to.display()));
        elsewhere
    }

    fn until(&self, what: &str, is_so: impl Fn(&str) -> bool) {
        let began = Instant::now();
        loop {
            let status = self.succeeds("robot status afp@robot.test");
            if is_so(&status) {
                return;
            }
            assert!(began.elapsed() < Duration::from_secs(120), "{what}: {status}");
            std::thread::sleep(Duration::from_millis(100));
        }
    }
}

/// Limits the connection to 1 Mbit/s in both directions together.
fn slow_down() -> bool {
    let slow = std::env::var_os(SLOW).is_some();
    if slow {
        let limit = "ip link set lo mtu 1500 && tc qdisc add dev lo root tbf rate 1mbit burst 4kb \
                     latency 1s";
        assert!(Command::new("sh").args(["-c", limit]).status().unwrap().success());
    }
    slow
}

/// A new, calibrated project for a robot at a port, whose scenarios pass.
fn project_for<'a>(controller: &Running, server: &'a Server) -> Project<'a> {
    assert!(Command::new("chmod").args(["666", &controller.port]).status().unwrap().success());
    let project = Project { place: Place::new(), server };
    project.place.afpc("new mycar --profile carbot").succeeds();
    let text = project.place.read("mycar/afp.toml").replace("/dev/ttyACM0", &controller.port);
    project.place.write("mycar/afp.toml", &format!("{text}\n[robot.realtime]\nstall = \"10 s\"\n"));
    project.place.write("mycar/calibration.toml", "date = \"2026-11-29\"\n[drive]\ntrim = 1.0\n");
    assert!(project.succeeds("test").contains(" 0 failed"));
    project
}

#[test]
fn from_a_new_project_to_a_log_in_an_empty_folder() {
    let Some(server) = computer() else { return };
    let controller = Running::start(|_| {});
    let project = project_for(&controller, &server);
    let emulated = std::env::var(EMULATED);
    let program = emulated.as_ref().map_or(String::new(), |path| format!(" --afpc {path}"));
    project.succeeds(&format!("robot setup pi@robot.test --yes{program}"));
    let deploy = "deploy plans/mycar.afp --to afp@robot.test";
    let first = project.deployed(deploy, &controller.port);
    assert!(first.starts_with("ready: "), "{first}");
    project.succeeds("robot arm afp@robot.test");
    let began = Instant::now();
    while controller.with(|fake| fake.ways[0].abs() + fake.ways[1].abs() < 0.1) {
        assert!(began.elapsed() < Duration::from_secs(120), "it does not drive");
        std::thread::sleep(Duration::from_millis(20));
    }
    project.succeeds("robot stop afp@robot.test");
    assert!(!controller.with(|fake| fake.is_moving()));
    let logs = project.succeeds("robot logs afp@robot.test");
    let name = logs.split_whitespace().find(|word| word.ends_with("-1-1.mcap")).unwrap();
    let elsewhere = project.fetched(name);
    let shown = elsewhere.afpc("log run.mcap --coverage plan.svg");
    assert!(shown.succeeds().out.contains("▶ ahead  Forward"), "{shown:?}");
    assert!(elsewhere.read("plan.svg").contains("<svg"));

    let slow = slow_down();
    let plan = project.place.read("mycar/plans/mycar.afp");
    project.place.write("mycar/plans/mycar.afp", &format!("// changed\n{plan}"));
    let began = Instant::now();
    let second = project.succeeds(&format!("{deploy} --robot sim"));
    let changed = began.elapsed();
    assert_ne!(first, second);
    let began = Instant::now();
    assert_eq!(project.succeeds("robot rollback afp@robot.test"), first);
    let back = began.elapsed();
    println!("changed plan ready after {changed:?}, rollback after {back:?}");
    if slow && emulated.is_err() {
        assert!(changed < Duration::from_secs(5), "{changed:?}");
        assert!(back < Duration::from_secs(8), "{back:?}");
    }
    project.succeeds("robot rollback afp@robot.test");
    project.succeeds("robot arm afp@robot.test");
    std::thread::sleep(Duration::from_secs(1));
    project.succeeds("robot stop afp@robot.test");
    project.until("it waits again", |status| status.starts_with("disarmed: "));
    let logs = project.succeeds("robot logs afp@robot.test");
    let mut names = logs.lines().rev().filter_map(|line| line.split_whitespace().last());
    // The log of the simulated run has the higher numbers.
    let name = names.rfind(|name| !name.contains("-1-")).unwrap();
    let elsewhere = project.fetched(name);
    let talk = [
        framed("launch", r#"{"log":"run.mcap","stopOnEntry":true}"#),
        framed("configurationDone", "{}"),
        framed("stackTrace", r#"{"threadId":1}"#),
        framed("disconnect", "{}"),
    ];
    let debugged = told_in(&elsewhere, talk.concat().as_bytes());
    assert!(debugged.succeeds().out.contains(r#""stackFrames":[{"#), "{debugged:?}");
}
