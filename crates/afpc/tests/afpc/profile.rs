//! Robots made of parts: from `afpc new` to a real robot, without cargo.

#[path = "../../../afp-pi/examples/controller.rs"]
mod controller;

use std::fs;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::common::{Place, Said, said};
use controller::Fake;

/// A controller that runs until it is dropped.
pub struct Running {
    pub port: String,
    fake: Arc<Mutex<Fake>>,
    ends: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Running {
    pub fn start(mut each_step: impl FnMut(&mut Fake) + Send + 'static) -> Running {
        let (fake, port) = Fake::new().unwrap();
        let (fake, ends) = (Arc::new(Mutex::new(fake)), Arc::new(AtomicBool::new(false)));
        let (stepped, is_over) = (fake.clone(), ends.clone());
        let thread = thread::spawn(move || {
            while !is_over.load(Ordering::Relaxed) {
                let mut fake = stepped.lock().unwrap();
                each_step(&mut fake);
                fake.step().unwrap();
                drop(fake);
                // Others may look at it.
                thread::sleep(Duration::from_millis(1));
            }
        });
        Running { port, fake, ends, thread: Some(thread) }
    }

    /// Waits until the last commands of a run have arrived and the robot has stopped.
    fn stops(&self) {
        let late = Instant::now() + Duration::from_secs(20);
        while !self.with(|fake| fake.controller.is_stopped() && !fake.is_moving()) {
            assert!(Instant::now() < late, "the robot does not stop");
            thread::sleep(Duration::from_millis(1));
        }
    }

    pub fn with<T>(&self, act: impl FnOnce(&mut Fake) -> T) -> T {
        act(&mut self.fake.lock().unwrap())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.ends.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

/// Runs a command in the project without cargo.
fn inside(place: &Place, arguments: &str) -> Said {
    let mut command = place.command();
    command.current_dir(place.path("mycar")).args(arguments.split_whitespace());
    said(command.env("PATH", "").env("CARGO", "no-such-cargo").output().unwrap())
}

fn drive(place: &Place, controller: &Running, until: &str) -> Said {
    // A busy machine is no fault of the robot.
    let set = format!("--set robot.realtime.stall=10s --set robot.port={}", controller.port);
    inside(place, &format!("run plans/mycar.afp --robot hardware {set} --until {until}"))
}

#[test]
fn a_robot_from_parts_is_simulated_and_driven_without_cargo() {
    let place = Place::new();
    let made = place.afpc("new mycar --profile carbot");
    made.succeeds();
    assert!(made.out.contains("--robot hardware"), "{}", made.out);
    inside(&place, "check plans/mycar.afp").succeeds();
    inside(&place, "graph plans/mycar.afp").succeeds();
    inside(&place, "run plans/mycar.afp --until 10s").succeeds();
    let tested = inside(&place, "test");
    tested.succeeds();
    assert!(tested.out.contains("3 passed, 0 failed"), "{}", tested.out);
    // On a busy machine the two programs may lose each other.
    let drove = (0..5).any(|_| {
        let controller = Running::start(|_| {});
        let ran = drive(&place, &controller, "2s");
        controller.stops();
        controller.with(|fake| ran.code == 0 && fake.ways.iter().all(|way| *way > 0.05))
    });
    assert!(drove, "no run of five drove the robot");
    let log = "log target/afp/runs/mycar.mcap --budgets --times times.svg";
    let budgets = inside(&place, log);
    budgets.succeeds();
    for text in ["carbot.", " us", "\nsupervisor ", "\n[target.robot]\nbudgets.carbot."] {
        assert!(budgets.out.contains(text), "no {text:?} in {}", budgets.out);
    }
    let picture = place.read("mycar/times.svg");
    for name in ["late wake-ups", "calls of carbot."] {
        assert!(picture.contains(name), "no {name:?} in {picture}");
    }
    // Lines of budgets are valid in 'afp.toml'.
    let toml = place.read("mycar/afp.toml");
    let (_, target) = budgets.out.split_once("[target.robot]").unwrap();
    place.write("mycar/afp.toml", &format!("{toml}\n[target.robot]{target}"));
    inside(&place, "check plans/mycar.afp --target robot").succeeds();
}

#[test]
fn the_times_of_a_simulated_run_are_an_error() {
    let place = Place::with_plan();
    place.afpc("run wall_following.afp --until 1s --log a.mcap --svg none").succeeds();
    let error = ["the log has no times of a real robot's control loop"];
    place.afpc("log a.mcap --budgets").fails(2, &error);
    place.afpc("log a.mcap --times a.svg").fails(2, &error);
    place.afpc("log a.mcap info --budgets").fails(2, &["'--budgets' is only for events"]);
}

#[test]
fn scenarios_run_with_the_real_driver_and_a_simulated_robot_behind_its_protocol() {
    let place = Place::new();
    // Without the scenarios that take a minute, or press a button that the robot does not have.
    for (profile, filters) in [("carbot", "bumper escape"), ("ugv", "square")] {
        let _ = fs::remove_dir_all(place.path("mycar"));
        place.afpc(&format!("new mycar --profile {profile}")).succeeds();
        // On a busy machine the driver may lose the controller.
        let test = format!("test --in-the-loop {filters}");
        let passed = (0..3).any(|_| inside(&place, &test).out.contains(" 0 failed"));
        assert!(passed, "{profile}: no run of three passed");
    }
    let plain = Place::with_plan();
    plain.write("t.afp", "use \"wall_following.afp\"\nscenario \"a\" for WallFollowing {\n    never collision\n    until 1 s\n}\n");
    let refused = plain.afpc("test t.afp --in-the-loop");
    refused.fails(2, &["'--in-the-loop' needs a robot with a profile"]);
}

#[test]
fn a_controller_that_restarts_in_mid_drive_ends_the_run_and_stays_stopped() {
    let place = Place::new();
    place.afpc("new mycar --profile carbot").succeeds();
    let mut restarted = false;
    let controller = Running::start(move |fake| {
        if !restarted && fake.ways[0] > 0.02 {
            restarted = true;
            fake.restart();
        }
    });
    let ran = drive(&place, &controller, "20s");
    ran.fails(3, &[]);
    controller.stops();
}

#[test]
fn the_simulator_takes_the_measures_of_the_robot() {
    let place = Place::new();
    place.afpc("new mycar --profile carbot").succeeds();
    let ran = || {
        let ran = inside(&place, "run plans/mycar.afp --until 20s");
        ran.succeeds();
        ran.out
    };
    let one = ran();
    let toml = place.path("mycar/afp.toml");
    let text = fs::read_to_string(&toml).unwrap();
    fs::write(&toml, text.replace("track = \"14 cm\"", "track = \"17 cm\"")).unwrap();
    assert_ne!(one, ran());
}

#[test]
fn errors_of_a_profile_are_shown_at_their_place() {
    let place = Place::new();
    place.afpc("new mycar --profile carbott").fails(2, &["no profile 'carbott'", "'carbot'"]);
    place.afpc("new mycar --profile carbot").succeeds();
    let set = "run plans/mycar.afp --robot hardware --until 1s --set robot.drive.track=2km";
    inside(&place, set).fails(2, &["'drive.track' cannot be '2km'", "from 3 cm to 100 cm"]);
    let nowhere = "run plans/mycar.afp --robot hardware --until 1s --set robot.port=/no/such";
    inside(&place, nowhere).fails(2, &["'/no/such'"]);
    let toml = place.path("mycar/afp.toml");
    let text = fs::read_to_string(&toml).unwrap();
    fs::write(&toml, text.replace("track =", "trak =")).unwrap();
    inside(&place, "check plans/mycar.afp").fails(1, &["'drive' has no 'trak'", "afp.toml:12:1"]);
}

#[test]
fn a_plan_for_a_missing_part_is_an_error_of_the_check() {
    let place = Place::new();
    place.afpc("new mycar --profile carbot").succeeds();
    let text = place.read("mycar/afp.toml");
    let sonar = text.split("[robot.ultrasonic]").nth(1).unwrap().split("[robot.").next().unwrap();
    place.write("mycar/afp.toml", &text.replace(&format!("[robot.ultrasonic]{sonar}"), ""));
    let texts = ["E0518", "'CheckDrivingLane' commands 'rotator', which the robot does not have"];
    inside(&place, "check plans/mycar.afp").fails(1, &texts);
    // Sensors are checked, too, and the robot is not opened.
    place.write("mycar/afp.toml", &text);
    let plan = "use carbot\nplan Look {\n    start hold\n    actor hold: Hold {\n        supervise low: CheckBattery { BatteryLow -> terminate }\n    }\n}\n";
    place.write("mycar/plans/look.afp", plan);
    let texts = ["E0518", "'CheckBattery' needs 'battery', which the robot does not have"];
    let set = "--set robot.port=/no/such --until 1s";
    inside(&place, &format!("run plans/look.afp --robot hardware {set}")).fails(1, &texts);
}
