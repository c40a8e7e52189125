//! The driver of the profile `carbot` on a pseudo-terminal, with the controller's own program at the
//! other end.
#![cfg(unix)]

#[path = "../examples/controller.rs"]
mod controller;
#[path = "carbot/qemu.rs"]
mod qemu;

use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};

use afp_carbot::devices::{Button, Buttons, Invalid, Navigator, Odometry, TouchSensor, Ultrasonic};
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Environment, Platform};
use afp_drive::{LONGEST, VERSION};
use afp_pi::SerialCarbot;
use afp_platform::{Hardware, Settings};
use afp_wire::Sender;
use controller::Fake;

/// A limit for outcomes that are due within 200 ms, on a busy machine.
const LATE: Duration = Duration::from_secs(5);
const SETTINGS: [(&str, &str); 10] = [
    ("body.length", "24 cm"),
    ("body.width", "18 cm"),
    ("drive.track", "14 cm"),
    ("drive.wheel_diameter", "65 mm"),
    ("drive.ticks", "1440"),
    ("drive.fastest", "50 cm/s"),
    ("drive.ramp", "150 ms"),
    ("ultrasonic.forward", "8 cm"),
    ("bumper.closed", "free"),
    ("port", ""),
];

/// A controller in its own thread.
struct Running {
    fake: Arc<Mutex<Fake>>,
    ends: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
    port: String,
}

impl Running {
    fn start() -> Running {
        let (fake, port) = Fake::new().unwrap();
        let (fake, ends) = (Arc::new(Mutex::new(fake)), Arc::new(AtomicBool::new(false)));
        let (stepped, is_over) = (fake.clone(), ends.clone());
        let thread = thread::spawn(move || {
            while !is_over.load(Ordering::Relaxed) {
                stepped.lock().unwrap().step().unwrap();
                thread::sleep(std::time::Duration::from_millis(1));
            }
        });
        Running { fake, ends, thread: Some(thread), port }
    }

    fn with<T>(&self, act: impl FnOnce(&mut Fake) -> T) -> T {
        act(&mut self.fake.lock().unwrap())
    }

    fn open(&self) -> Result<SerialCarbot, String> {
        let port = [("port", self.port.as_str())];
        let settings = Settings::new(SETTINGS.into_iter().chain(port));
        SerialCarbot::open(&settings).map_err(|why| why.to_string())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.ends.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

/// Drives ahead until something holds.
fn until(robot: &mut SerialCarbot, speed: f64, holds: impl Fn(&SerialCarbot) -> bool) {
    let late = robot.now() + LATE;
    while !holds(robot) {
        assert!(robot.now() < late, "it takes too long");
        let now = robot.now();
        robot.drive(Speed::from_si(speed), AngularSpeed::from_si(0.0), now);
        robot.advance(now + Duration::from_millis(10));
    }
}

#[test]
fn it_drives_and_reads_the_bumper() {
    let controller = Running::start();
    let mut robot = controller.open().unwrap();
    until(&mut robot, 0.2, |it| it.motion().value.is_ok_and(|motion| motion.x.si() > 0.1));
    assert_eq!(robot.touched().value, Ok(false));
    // The robot has no button.
    assert_eq!(robot.pressed(Button::Escape).value, Ok(false));
    assert!(robot.echo().value.is_ok_and(|echo| echo.distance.is_none()));
    controller.with(|fake| fake.inputs.bumper = false);
    until(&mut robot, 0.2, |it| it.touched().value == Ok(true));
    assert!(robot.last_bump().is_some());
    until(&mut robot, 0.0, |it| it.motion().value.is_ok_and(|motion| motion.stands()));
    robot.emergency_stop();
    drop(robot);
    let late = std::time::Instant::now() + std::time::Duration::from(LATE);
    while !controller.with(|fake| fake.controller.is_stopped()) {
        assert!(std::time::Instant::now() < late, "it does not stop");
    }
}

#[test]
fn a_restart_is_reported_and_the_robot_stays_stopped() {
    let controller = Running::start();
    let mut robot = controller.open().unwrap();
    until(&mut robot, 0.2, |it| it.motion().value.is_ok_and(|motion| motion.x.si() > 0.02));
    controller.with(Fake::restart);
    until(&mut robot, 0.2, |it| it.motion().value == Err(Invalid::Restarted));
    let before = controller.with(|fake| fake.ways);
    let late = robot.now() + Duration::from_millis(300);
    until(&mut robot, 0.2, |it| it.now() > late);
    assert_eq!(controller.with(|fake| fake.ways), before);
    assert_eq!(robot.motion().value, Err(Invalid::Restarted));
}

#[test]
fn a_silent_or_faulty_controller_is_stopped() {
    for noise in [&[][..], &[0x5a; 300], &[0; 40], &[1, 2, 3, 0, 255, 255, 0]] {
        let controller = Running::start();
        let mut robot = controller.open().unwrap();
        until(&mut robot, 0.2, |it| it.motion().value.is_ok_and(|motion| motion.x.si() > 0.02));
        controller.with(|fake| fake.mute = true);
        let late = robot.now() + LATE;
        while robot.motion().value.is_ok() || controller.with(|fake| fake.is_moving()) {
            assert!(robot.now() < late, "it takes too long: {noise:?}");
            controller.with(|fake| fake.port.write_all(noise)).unwrap();
            let now = robot.now();
            robot.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0), now);
            robot.advance(now + Duration::from_millis(10));
        }
        assert_eq!(robot.motion().value, Err(Invalid::NoAnswer));
    }
}

#[test]
fn an_unusable_controller_is_reported() {
    let controller = Running::start();
    controller.with(|fake| fake.mute = true);
    let port = controller.port.clone();
    let why = controller.open().unwrap_err();
    assert_eq!(why, format!("'{port}': the controller does not answer"));
    let mut other = Sender::new(9, VERSION + 1);
    let hello = other.hello(&mut [0; LONGEST]).unwrap().to_vec();
    let opened = thread::scope(|scope| {
        let opening = scope.spawn(|| controller.open().map(drop));
        while !opening.is_finished() {
            controller.with(|fake| fake.port.write_all(&hello)).unwrap();
            thread::sleep(Duration::from_millis(5).into());
        }
        opening.join().unwrap()
    });
    let version = format!("has version {} of the protocol", VERSION + 1);
    assert!(opened.unwrap_err().contains(&version));
    controller.with(|fake| fake.mute = false);
    let _robot = controller.open().unwrap();
    assert!(controller.open().unwrap_err().contains("has it open"));
}
