//! A deploy to a robot with motors: its controller's own program on a pseudo-terminal.

use super::Robot;
use crate::profile::Running;

/// A calibrated robot of a new project, with its controller at a port.
fn robot_at(port: &str) -> Robot {
    let made = crate::common::Place::new();
    made.afpc("new mycar --profile carbot").succeeds();
    let text = made.read("mycar/afp.toml").replace("/dev/ttyACM0", port);
    let robot = Robot::with(&format!("{text}\n[robot.realtime]\nstall = \"10 s\"\n"));
    for folder in ["", "robot/"] {
        robot.place.write(&format!("{folder}calibration.toml"), CALIBRATION);
    }
    robot
}

const CALIBRATION: &str = "date = \"2026-11-29\"\n[drive]\ntrim = 1.0\n";

#[test]
fn the_button_of_the_robot_arms_it_if_it_is_pressed_for_a_second() {
    let controller = Running::start(|_| {});
    let robot = robot_at(&controller.port);
    robot.deploy("wall_following.afp").succeeds();
    assert!(robot.status().starts_with("disarmed: "), "{}", robot.status());
    // The button opens its switch. A busy machine may make a press longer.
    let mut armed = false;
    for _ in 0..5 {
        controller.with(|fake| fake.inputs.button = false);
        std::thread::sleep(std::time::Duration::from_millis(1500));
        assert!(robot.status().starts_with("disarmed: "), "it is still pressed");
        controller.with(|fake| fake.inputs.button = true);
        std::thread::sleep(std::time::Duration::from_millis(500));
        armed = robot.status().starts_with("armed: ");
        if armed {
            break;
        }
    }
    assert!(armed, "no press of five armed the robot");
    let began = std::time::Instant::now();
    while controller.with(|fake| fake.ways[0].abs() + fake.ways[1].abs() < 0.01) {
        assert!(began.elapsed() < std::time::Duration::from_secs(60), "it does not drive");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    robot.robot("stop", "").succeeds();
    assert!(!controller.with(|fake| fake.is_moving()));
}

#[test]
fn a_release_whose_robot_does_not_answer_does_not_start() {
    let controller = Running::start(|fake| fake.mute = true);
    let robot = robot_at(&controller.port);
    let silent = robot.deploy("wall_following.afp");
    silent.fails(2, &["the release is on the robot, but does not run"]);
    assert!(robot.status().contains("the controller does not answer"), "{}", robot.status());
}

#[test]
fn a_robot_without_calibration_or_with_another_one_is_not_deployed_to() {
    let controller = Running::start(|_| {});
    let robot = robot_at(&controller.port);
    std::fs::remove_file(robot.place.path("robot/calibration.toml")).unwrap();
    let missing = ["the robot has no calibration", "help: measure it with 'afpc calibrate'"];
    robot.deploy("wall_following.afp").fails(2, &missing);
    robot.place.write("robot/calibration.toml", &CALIBRATION.replace("1.0", "1.01"));
    let another = "the robot has another calibration than this project";
    robot.deploy("wall_following.afp").fails(2, &[another]);
    robot.place.write("robot/calibration.toml", CALIBRATION);
    robot.deploy("wall_following.afp").succeeds();
}
