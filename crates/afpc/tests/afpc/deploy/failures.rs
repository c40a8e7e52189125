//! Programs on a robot that crash, and restarts of the robot: it is armed only by somebody, or at boot
//! if its project sets `autostart`.

use super::{DEPLOY, Robot};

const CARBOT: &str = "\
[robot]
profile = \"carbot\"
autostart = true
logs = \"1 MB\"

[robot.body]
length = \"24 cm\"
width = \"18 cm\"

[robot.drive]
track = \"14 cm\"
wheel_diameter = \"65 mm\"
ticks = 1440
fastest = \"45 cm/s\"

[robot.ultrasonic]
forward = \"8 cm\"

[robot.bumper]
[robot.button]
";

#[test]
fn a_robot_whose_program_crashed_comes_back_disarmed() {
    let robot = Robot::new();
    robot.deploy(DEPLOY).succeeds();
    robot.robot("arm", "").succeeds();
    robot.kill();
    robot.until("it is disarmed again", |status| {
        status.starts_with("disarmed: ") && status.contains("while it was armed: signal: 9")
    });
}

#[test]
fn a_program_that_crashes_again_and_again_is_reported_with_the_number_of_crashes() {
    let robot = Robot::new();
    robot.deploy(DEPLOY).succeeds();
    for _ in 0..3 {
        robot.until("it is ready again", |status| status.starts_with("disarmed: "));
        robot.kill();
        robot.until("it has ended", |status| status.starts_with("stopped"));
    }
    robot.until("the crashes are counted", |status| status.contains(", 3 times in a row"));
    robot.until("it is ready again", |status| status.starts_with("disarmed: "));
    robot.deploy(&format!("{DEPLOY} --set walldist=50cm")).succeeds();
    assert!(!robot.status().contains("trouble"), "{}", robot.status());
}

#[test]
fn autostart_arms_at_boot_and_not_after_a_deploy_a_crash_or_a_restart_of_the_service() {
    let mut robot = Robot::with(CARBOT);
    robot.deploy(DEPLOY).succeeds();
    robot.kill();
    let crashed = |status: &str| status.starts_with("disarmed: ") && status.contains("signal: 9");
    robot.until("a crash after a deploy", crashed);
    robot.serve_again();
    robot.until("the service again", |status| status.starts_with("disarmed: "));
    // The number of the last boot is another one.
    robot.place.write("robot/boot", "0");
    robot.serve_again();
    robot.until("the computer boots", |status| status.starts_with("armed: "));
    robot.kill();
    robot.until("a crash of an armed robot", crashed);
}

#[test]
fn old_logs_are_removed_and_the_new_one_stays() {
    let robot = Robot::with(CARBOT);
    for name in ["Old-0-1.mcap", "Old-0-2.mcap"] {
        robot.place.write(&format!("robot/logs/{name}"), &"x".repeat(800_000));
    }
    robot.deploy(DEPLOY).succeeds();
    robot.robot("arm", "").succeeds();
    robot.until("the log exists", |_| robot.robot("logs", "").out.contains("WallFollowing-1-1"));
    let logs = robot.robot("logs", "").out;
    assert!(!logs.contains("Old-0-1.mcap") && logs.contains("Old-0-2.mcap"), "{logs}");
}

/// A library that gives a program another wall clock.
const FAKE_TIME: &str = "/usr/lib/x86_64-linux-gnu/faketime/libfaketime.so.1";

#[test]
fn a_robot_whose_clock_is_in_1970_runs_plans_and_keeps_their_logs_in_order() {
    if !std::path::Path::new(FAKE_TIME).exists() {
        println!("left out: there is no {FAKE_TIME}");
        return;
    }
    let clock = [
        ("LD_PRELOAD", FAKE_TIME),
        ("FAKETIME", "@1970-01-01 00:00:05"),
        ("FAKETIME_DONT_FAKE_MONOTONIC", "1"),
    ];
    let robot = Robot::in_environment(CARBOT, &clock);
    for change in ["", " --set walldist=50cm"] {
        robot.deploy(&format!("{DEPLOY}{change}")).succeeds();
        robot.robot("arm", "").succeeds();
        std::thread::sleep(std::time::Duration::from_millis(300));
        robot.robot("stop", "").succeeds();
    }
    for name in ["WallFollowing-1-1.mcap", "WallFollowing-2-1.mcap"] {
        robot.robot("logs", name).succeeds();
        robot.place.afpc(&format!("log {name}")).succeeds();
    }
    let before = robot.status();
    robot.robot("rollback", "").succeeds();
    assert_ne!(robot.status().lines().next(), before.lines().next());
}
