//! `afpc deploy`, `afpc robot` and `afpc agent`: a robot without motors on this machine.

mod failures;
#[cfg(feature = "pi")]
mod real;
mod setup;
pub mod ssh;
#[cfg(feature = "pi")]
mod whole;

use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::common::{Place, Said, WALL_FOLLOWING};

/// A robot whose service runs until it is dropped.
struct Robot {
    place: Place,
    service: Child,
}

impl Robot {
    fn new() -> Robot {
        Robot::with("")
    }

    /// A robot with a project file.
    fn with(project: &str) -> Robot {
        Robot::in_environment(project, &[])
    }

    /// A robot whose service has these variables.
    fn in_environment(project: &str, variables: &[(&str, &str)]) -> Robot {
        let place = Place::with_plan();
        place.write("robot/afp.toml", project);
        place.write("afp.toml", project);
        let service = serve(&place, variables);
        let robot = Robot { place, service };
        robot.answers();
        robot
    }

    fn answers(&self) {
        self.until("the service answers", |status| !status.contains("does not answer"));
    }

    /// Stops the service and starts it again.
    fn serve_again(&mut self) {
        self.signal("-TERM", self.service.id());
        self.service.wait().unwrap();
        self.service = serve(&self.place, &[]);
        self.answers();
    }

    /// Ends the program that runs.
    fn kill(&self) {
        let service = self.service.id();
        let children = format!("/proc/{service}/task/{service}/children");
        let child = std::fs::read_to_string(children).unwrap().trim().parse().unwrap();
        self.signal("-KILL", child);
    }

    /// The host for `afpc deploy` and `afpc robot`.
    fn host(&self) -> String {
        let root = self.place.path("robot");
        format!("exec:{} agent --root {}", env!("CARGO_BIN_EXE_afpc"), root.display())
    }

    fn deploy(&self, arguments: &str) -> Said {
        let mut command = self.place.command();
        command.arg("deploy").args(arguments.split(' ')).args(["--to", &self.host()]);
        crate::common::said(command.output().unwrap())
    }

    fn robot(&self, verb: &str, more: &str) -> Said {
        let mut command = self.place.command();
        command.args(["robot", verb, &self.host()]).args(more.split_whitespace());
        crate::common::said(command.output().unwrap())
    }

    fn status(&self) -> String {
        self.robot("status", "").out
    }

    /// Waits for a status.
    fn until(&self, what: &str, is_so: impl Fn(&str) -> bool) {
        let began = Instant::now();
        loop {
            let status = self.status();
            if is_so(&status) {
                return;
            }
            assert!(began.elapsed() < Duration::from_secs(60), "{what}: {status}");
            std::thread::sleep(Duration::from_millis(50));
        }
    }

    fn signal(&self, signal: &str, process: u32) {
        let sent = Command::new("kill").args([signal, &process.to_string()]).status();
        assert!(sent.unwrap().success());
    }
}

fn serve(place: &Place, variables: &[(&str, &str)]) -> Child {
    let mut command = place.command();
    command.envs(variables.iter().copied());
    command.args(["agent", "--serve", "--root", "robot"]).stdin(Stdio::null());
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

impl Drop for Robot {
    fn drop(&mut self) {
        self.signal("-TERM", self.service.id());
        self.service.wait().ok();
    }
}

const DEPLOY: &str = "wall_following.afp --robot sim";

#[test]
fn a_plan_is_deployed_armed_replaced_and_rolled_back() {
    let robot = Robot::new();
    let first = robot.deploy(DEPLOY);
    assert!(first.succeeds().out.starts_with("ready: WallFollowing "), "{first:?}");
    assert!(
        first.err.contains("files to send: 1, with ") && first.err.contains("disarmed"),
        "{first:?}"
    );
    assert!(robot.status().starts_with("disarmed: WallFollowing "), "{}", robot.status());

    robot.robot("arm", "").succeeds();
    assert!(robot.status().starts_with("armed: WallFollowing "), "{}", robot.status());
    robot.place.write("wall_following.afp", &WALL_FOLLOWING.replace("-60 deg", "-70 deg"));
    let moving = robot.deploy(DEPLOY);
    moving.fails(2, &["the robot is armed and may be moving", "help: stop it first"]);
    let second = robot.deploy(&format!("{DEPLOY} --stop-first"));
    assert_ne!(second.succeeds().out, first.out);
    assert!(robot.status().starts_with("disarmed: "), "{}", robot.status());
    let back = robot.robot("rollback", "");
    assert_eq!(back.succeeds().out, first.out);
    assert_eq!(robot.robot("rollback", "").succeeds().out, second.out);
}

#[test]
fn the_log_of_a_robot_repeats_its_run_elsewhere() {
    let robot = Robot::new();
    robot.deploy(DEPLOY).succeeds();
    robot.robot("arm", "").succeeds();
    std::thread::sleep(Duration::from_millis(300));
    robot.robot("stop", "").succeeds();
    assert!(robot.status().starts_with("disarmed: "), "{}", robot.status());
    let listed = robot.robot("logs", "").out;
    assert!(listed.contains(" WallFollowing-1-1.mcap\n"), "{listed}");
    robot.robot("logs", "WallFollowing-1-1.mcap").succeeds();
    let elsewhere = Place::new();
    std::fs::copy(robot.place.path("WallFollowing-1-1.mcap"), elsewhere.path("r.mcap")).unwrap();
    let again = elsewhere.afpc("run --again r.mcap --log none --svg none");
    assert!(again.succeeds().out.contains("WallFollowing ended: Interrupted"), "{again:?}");
    assert!(!again.err.contains("trace"), "{again:?}");
    robot.robot("logs", "nothing").fails(2, &["the robot has no log 'nothing'"]);
}

#[test]
fn a_release_that_does_not_start_leaves_the_old_one_running() {
    let robot = Robot::new();
    let none = robot.deploy("wall_following.afp");
    none.fails(2, &["the release is on the robot, but does not run", "did not start"]);
    robot.deploy(DEPLOY).succeeds();
    let status = robot.status();
    let fallen = robot.deploy("wall_following.afp --set walldist=50cm");
    fallen.fails(1, &["did not start: ", "the project has no real robot"]);
    let after = robot.status();
    assert_eq!(after.lines().next(), status.lines().next(), "the old release runs: {after}");
    assert!(after.contains("trouble: release "), "{after}");
}

#[test]
fn deploys_that_cannot_work_are_refused_with_a_reason() {
    let robot = Robot::new();
    robot.place.write("robot/afp.toml", "[robot]\ntoolbox = \"vacuum\"\nsim = \"Vacuum\"\n\n[toolboxes]\nvacuum = { path = \"vacuum.afp\" }\n");
    let other = "the plan is for the robot 'carbot', and this robot is 'vacuum'";
    robot.deploy(DEPLOY).fails(2, &[other]);
    let to = |host: &str| {
        let mut command = robot.place.command();
        command.args(["deploy", "wall_following.afp", &format!("--to={host}")]);
        crate::common::said(command.output().unwrap())
    };
    to("-oProxyCommand=x").fails(2, &["'-oProxyCommand=x' is not a host"]);
    to("exec:echo Welcome").fails(1, &["it printed: Welcome", "must print nothing"]);
    to("exec:false").fails(1, &["could not be reached, or has no 'afpc agent'"]);
    let second = robot.place.afpc("agent --serve --root robot");
    second.fails(2, &["another service runs the releases"]);
}
