//! The driver of the profile `ugv` on a pseudo-terminal.
#![cfg(unix)]

#[path = "../examples/ugv.rs"]
mod controller;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::Duration as Span;

use afp_carbot::devices::{Button, Buttons, Invalid, Navigator, Odometry};
use afp_core::quantity::{AngularSpeed, Speed};
use afp_core::{Duration, Environment, Platform};
use afp_pi::Ugv;
use afp_platform::{Hardware, Settings};
use controller::Fake;

/// A limit for outcomes that are due within 200 ms, on a busy machine.
const LATE: Duration = Duration::from_secs(5);

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
                thread::sleep(Span::from_millis(1));
            }
        });
        Running { fake, ends, thread: Some(thread), port }
    }

    fn with<T>(&self, act: impl FnOnce(&mut Fake) -> T) -> T {
        act(&mut self.fake.lock().unwrap())
    }

    fn open(&self) -> Ugv {
        let settings = Settings::new([
            ("body.length", "24 cm"),
            ("body.width", "24 cm"),
            ("drive.track", "17 cm"),
            ("drive.fastest", "35 cm/s"),
            ("port", &self.port),
        ]);
        Ugv::open(&settings).unwrap()
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        self.ends.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

/// Drives until something holds.
fn until(robot: &mut Ugv, speed: f64, turn: f64, holds: impl Fn(&Ugv) -> bool) {
    let late = robot.now() + LATE;
    while !holds(robot) {
        assert!(robot.now() < late, "it takes too long");
        let now = robot.now();
        robot.drive(Speed::from_si(speed), AngularSpeed::from_si(turn), now);
        robot.advance(now + Duration::from_millis(10));
    }
}

#[test]
fn it_drives_turns_and_shortens_the_dead_man() {
    let controller = Running::start();
    let mut robot = controller.open();
    assert_eq!(robot.pressed(Button::Escape).value, Ok(false));
    until(&mut robot, 0.2, 0.0, |it| it.motion().value.is_ok_and(|motion| motion.x.si() > 0.1));
    until(&mut robot, 0.0, 1.0, |it| {
        it.motion().value.is_ok_and(|motion| motion.heading.si() > 0.3)
    });
    assert_eq!(controller.with(|fake| fake.dead_man), Span::from_millis(200));
    robot.emergency_stop();
    let late = std::time::Instant::now() + Span::from(LATE);
    while controller.with(|fake| fake.speeds != [0.0; 2]) {
        assert!(std::time::Instant::now() < late, "it does not stop");
    }
}

#[test]
fn a_restart_is_noticed_by_counters_that_jump() {
    let controller = Running::start();
    let mut robot = controller.open();
    until(&mut robot, 0.3, 0.0, |it| it.motion().value.is_ok_and(|motion| motion.x.si() > 0.3));
    controller.with(Fake::restart);
    until(&mut robot, 0.3, 0.0, |it| it.motion().value == Err(Invalid::Restarted));
    until(&mut robot, 0.3, 0.0, |_| controller.with(|fake| fake.speeds == [0.0; 2]));
}
