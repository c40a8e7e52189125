//! Robots on a computer's own pins, with their guard: on a test rig, without cargo.

#[path = "../../../afp-pi/examples/rig.rs"]
pub mod rig;

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::common::{Place, Said, said};
use rig::Rig;

/// A limit for outcomes that are due within 150 ms, on a busy machine.
const LATE: Duration = Duration::from_secs(5);

/// The project of a profile, and a rig with the robot at a pose.
fn project(profile: &str, pose: [f64; 3]) -> (Place, Rig) {
    let place = Place::new();
    let made = place.afpc(&format!("new mycar --profile {profile}"));
    made.succeeds();
    let rig = Rig::start(&place.path("rig"), pose).unwrap();
    (place, rig)
}

/// A command in the project, without cargo.
fn inside(place: &Place, arguments: &str) -> Command {
    let mut command = place.command();
    command.current_dir(place.path("mycar")).args(arguments.split_whitespace());
    command.env("PATH", "").env("CARGO", "no-such-cargo");
    command
}

fn runs(place: &Place, arguments: &str) -> Said {
    said(inside(place, arguments).output().unwrap())
}

/// A run on the rig. A busy machine is not a fault of the robot.
fn drive(place: &Place, plan: &str, until: &str) -> Command {
    let chip = place.path("rig");
    let set = format!("--set robot.realtime.stall=10s --set robot.chip={}", chip.display());
    inside(place, &format!("run {plan} --robot hardware {set} --until {until}"))
}

fn wait(what: &str, mut holds: impl FnMut() -> bool) {
    let late = Instant::now() + LATE;
    while !holds() {
        assert!(Instant::now() < late, "{what}");
        sleep(Duration::from_millis(2));
    }
}

/// A run that drives; a run that the busy machine has stopped starts again.
fn driving(place: &Place, rig: &Rig) -> Child {
    for _ in 0..5 {
        let mut command = drive(place, "plans/mycar.afp", "60s");
        let mut run = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        let before = rig.state().ways;
        let late = Instant::now() + LATE;
        while run.try_wait().unwrap().is_none() && Instant::now() < late {
            let moves =
                rig.state().ways.iter().zip(before).all(|(way, before)| way - before > 0.02);
            if moves {
                return run;
            }
            sleep(Duration::from_millis(5));
        }
        let _ = run.kill();
        let _ = run.wait();
        rig.state().pose = [1.0, 1.0, 0.5];
    }
    panic!("no run of five drives");
}

/// The process that a run has started: its guard.
fn guard_of(run: u32) -> Option<u32> {
    let parent = |process: &str| {
        let stat = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
        stat.rsplit(')').next()?.split_whitespace().nth(1)?.parse::<u32>().ok()
    };
    let all = fs::read_dir("/proc").ok()?.flatten();
    let mut names = all.filter_map(|entry| entry.file_name().into_string().ok());
    names.find(|name| parent(name) == Some(run))?.parse().ok()
}

/// How often a test of the guard is repeated, and its limit: at night `AFP_GUARD=100`, strictly.
fn nightly() -> (u32, Duration) {
    match std::env::var("AFP_GUARD").ok().and_then(|times| times.parse().ok()) {
        Some(times) => (times, Duration::from_millis(150)),
        None => (5, LATE),
    }
}

#[test]
fn a_robot_on_pins_follows_a_wall() {
    let (place, rig) = project("pi", [0.8, 0.8, -0.6]);
    let plan = concat!(env!("CARGO_MANIFEST_DIR"), "/../../plans/wall_following.afp");
    fs::copy(plan, place.path("mycar/plans/wall.afp")).unwrap();
    runs(&place, "check plans/wall.afp").succeeds();
    let followed = (0..3).any(|_| {
        {
            let mut state = rig.state();
            (state.pose, state.bumps) = ([0.8, 0.8, -0.6], 0);
        }
        let ran = said(drive(&place, "plans/wall.afp", "14s").output().unwrap());
        let state = rig.state();
        // It has found the wall below, turned it to its right side, and driven along it.
        let [x, y, heading] = state.pose;
        let is_along = (0.2..0.7).contains(&y) && heading.abs() < 0.5 && x > 1.5;
        ran.code == 0 && state.bumps == 0 && is_along
    });
    assert!(followed, "{:?}", rig.state().pose);
}

#[test]
fn after_a_killed_run_the_motors_are_off() {
    let (place, rig) = project("pi", [1.0, 1.0, 0.5]);
    let ((times, limit), mut slowest) = (nightly(), Duration::ZERO);
    for _ in 0..times {
        rig.state().pose = [1.0, 1.0, 0.5];
        let mut run = driving(&place, &rig);
        assert!(rig.state().enabled.0);
        let killed = Instant::now();
        run.kill().unwrap();
        wait("the motors stay on", || !rig.state().enabled.0);
        let after = rig.state().enabled.1.duration_since(killed);
        assert!(after < limit, "{after:?}");
        slowest = slowest.max(after);
        run.wait().unwrap();
    }
    println!("killed runs: {times}, the slowest stop took {slowest:?}");
}

#[test]
fn after_a_killed_guard_the_run_ends_and_commands_nothing() {
    let (place, rig) = project("pi", [1.0, 1.0, 0.5]);
    let ((times, limit), mut slowest) = (nightly(), Duration::ZERO);
    for _ in 0..times {
        rig.state().pose = [1.0, 1.0, 0.5];
        let mut run = driving(&place, &rig);
        let guard = guard_of(run.id()).unwrap();
        let kill = Command::new("/bin/kill").args(["-9", &guard.to_string()]).status().unwrap();
        assert!(kill.success());
        let killed = Instant::now();
        let mut status = None;
        wait("the run does not end", || {
            status = run.try_wait().unwrap();
            status.is_some()
        });
        let after = killed.elapsed();
        assert!(after < limit, "{after:?}");
        slowest = slowest.max(after);
        assert_eq!(status.and_then(|status| status.code()), Some(3));
        let state = rig.state();
        assert_eq!((state.power, state.enabled.0), ([0.0; 2], false));
    }
    println!("killed guards: {times}, the slowest run ended after {slowest:?}");
}

#[test]
fn a_suspended_run_loses_the_motors() {
    let (place, rig) = project("pi", [1.0, 1.0, 0.5]);
    let mut run = driving(&place, &rig);
    let id = run.id().to_string();
    let signal = |name: &str| Command::new("/bin/kill").args([name, &id]).status().unwrap();
    assert!(signal("-STOP").success());
    wait("the motors stay on", || !rig.state().enabled.0);
    assert!(signal("-CONT").success());
    wait("the run drives on", || run.try_wait().unwrap().is_some());
}

#[test]
fn the_check_knows_that_a_car_neither_turns_on_the_spot_nor_counts() {
    let (place, _rig) = project("picarx", [1.0, 1.0, 0.0]);
    let checked = runs(&place, "check plans/mycar.afp");
    checked.succeeds();
    assert!((checked.out + &checked.err).contains("'Curve' needs 'odometry'"), "{:?}", checked.err);
    let turn = "use carbot\nplan Spin {\n    start spin\n    actor spin: Turn { TurnSuccessful -> terminate }\n}\n";
    place.write("mycar/plans/spin.afp", turn);
    let texts = ["E0518", "'Turn' needs 'turning_in_place', which the robot does not have"];
    runs(&place, "check plans/spin.afp").fails(1, &texts);
}

#[test]
fn a_wrong_pin_is_shown_at_its_place() {
    let (place, _rig) = project("pi", [1.0, 1.0, 0.0]);
    let text = place.read("mycar/afp.toml");
    for (old, new, message) in [
        ("line = 25", "line = 99", "from 0 to 27"),
        ("line = 25", "line = 6", "line 6 already belongs to 'left.in'"),
        ("in = [5, 6]", "in = [5, 5]", "line 5 already belongs to 'left.in'"),
        ("\"pwmchip0/1\"", "\"pwmchip0/0\"", "channel 'pwmchip0/0' already belongs to 'left.pwm'"),
        ("\"tb6612\"", "\"drv8833\"", "\"tb6612\" or \"l298n\""),
        ("trigger = 23", "triger = 23", "'ultrasonic' has no 'triger'"),
    ] {
        place.write("mycar/afp.toml", &text.replace(old, new));
        runs(&place, "check plans/mycar.afp").fails(1, &[message]);
    }
    place.write("mycar/afp.toml", &text);
    let ran = runs(&place, "run plans/mycar.afp --robot hardware --set robot.chip=/no/chip");
    ran.fails(2, &["/no/chip"]);
}
