//! Deploys that the robot refuses, with the message that a person sees.

use afp_deploy::client::{ClientError, Connection, check_version};
use afp_deploy::disk::ThisDisk;
use afp_deploy::manifest::Kind;
use afp_deploy::store::{Store, names_in};
use afp_deploy::wire::{Calibration, State};

use crate::fake::{Robot, deploy, is_sound, release};

/// Deploys a second release to a robot with a change. Nothing is written, and the first one stays.
fn refused(change: impl FnOnce(&mut Robot), expected: &str) {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    deploy(&mut robot, &release(1), false).unwrap();
    change(&mut robot);
    let before = names_in(&folder.path().join("objects"));
    let said = deploy(&mut robot, &release(2), false).unwrap_err();
    assert!(said.to_string().contains(expected), "{said}");
    assert_eq!(names_in(&folder.path().join("objects")), before);
    let store = Store::open(folder.path(), &ThisDisk).unwrap();
    assert_eq!(store.current().unwrap().release, release(1).0.id());
    assert!(is_sound(folder.path()));
}

#[test]
fn a_release_that_does_not_fit_the_robot_is_refused_before_a_byte_is_written() {
    refused(
        |robot| robot.hello.model = "vacuum".to_owned(),
        "the plan is for the robot 'carbot', and this robot is 'vacuum'",
    );
    refused(|robot| robot.hello.space = Some(9 << 10), "the robot has 9 KiB of free disk");
    refused(|robot| robot.state = State::Armed, "the robot is armed and may be moving");
    refused(|robot| robot.serves = false, "no plan can start on the robot");
}

#[test]
fn a_plan_for_motors_needs_the_calibration_of_the_robot() {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    let (ours, other) = (afp_deploy::sha256(b"ours"), afp_deploy::sha256(b"other"));
    let mut plan = release(1);
    plan.0.calibration = Some(ours.clone());
    robot.hello.calibration = Calibration::Missing;
    // Without motors the numbers of the robot do not matter.
    assert_eq!(plan.0.robot, "sim");
    deploy(&mut robot, &plan, false).unwrap();
    plan.0.robot = "hardware".to_owned();
    let mut said = |calibration: Calibration| {
        robot.hello.calibration = calibration;
        deploy(&mut robot, &plan, false).map(|_| ()).map_err(|why| why.to_string())
    };
    assert_eq!(said(Calibration::Missing).unwrap_err(), "the robot has no calibration");
    let another = "the robot has another calibration than this project";
    assert_eq!(said(Calibration::Of(other)).unwrap_err(), another);
    assert_eq!(said(Calibration::Of(ours)), Ok(()));
    assert_eq!(said(Calibration::Unneeded), Ok(()));
}

#[test]
fn a_program_for_another_processor_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut built = release(1);
    built.0.kind = Kind::Built { architecture: "x86_64".to_owned() };
    let said = deploy(&mut Robot::new(folder.path()), &built, false).unwrap_err().to_string();
    assert_eq!(said, "the program is for x86_64, and the robot has aarch64");
}

#[test]
fn an_armed_robot_is_stopped_first_if_permitted() {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    deploy(&mut robot, &release(1), false).unwrap();
    robot.state = State::Armed;
    assert_eq!(deploy(&mut robot, &release(2), true).unwrap().plan, "Patrol2");
    assert_eq!(robot.state, State::Disarmed, "the new release waits to be armed");
}

#[test]
fn a_plan_that_behaves_differently_on_the_robot_does_not_replace_the_old_one() {
    for (trace, expected) in [
        (Ok("beef".to_owned()), "the first second on the robot has the trace beef, and here 00ff"),
        (Err("E0518".to_owned()), "the plan does not run on the robot: E0518"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let mut robot = Robot::new(folder.path());
        deploy(&mut robot, &release(1), false).unwrap();
        robot.trace = trace;
        let said = deploy(&mut robot, &release(2), false).unwrap_err().to_string();
        assert!(said.contains(expected), "{said}");
        robot.boot();
        assert_eq!(robot.running, Some(release(1).0.id()));
    }
}

#[test]
fn two_deploys_at_once_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut robot = Robot::new(folder.path());
    deploy(&mut robot, &release(1), false).unwrap();
    let lock = std::fs::File::create(folder.path().join("deploy.lock")).unwrap();
    lock.lock().unwrap();
    let said = deploy(&mut robot, &release(2), false).unwrap_err().to_string();
    assert_eq!(said, "another deploy to this robot is running");
    drop(lock);
    deploy(&mut robot, &release(2), false).unwrap();
}

#[test]
fn an_interpreted_plan_needs_the_same_version_and_a_program_does_not() {
    let folder = tempfile::tempdir().unwrap();
    let hello = Robot::new(folder.path()).hello;
    let mut manifest = release(1).0;
    let said = check_version(&hello, &manifest, "2").unwrap_err();
    assert_eq!(said.to_string(), "the robot has afpc 1, and this is 2");
    assert!(check_version(&hello, &manifest, "1").is_ok());
    manifest.kind = Kind::Built { architecture: "aarch64".to_owned() };
    assert!(check_version(&hello, &manifest, "2").is_ok());
}

#[test]
fn output_that_is_not_from_an_agent_is_shown() {
    for said in ["", "afp", "Welcome to Debian\nsh: afpc: not found\n"] {
        match Connection::new(said.as_bytes(), Vec::new()).map(|_| ()) {
            Err(ClientError::NotAgent(shown)) => assert_eq!(shown, said.trim()),
            other => panic!("{other:?}"),
        }
    }
}
