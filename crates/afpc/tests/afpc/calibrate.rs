//! `afpc calibrate` with a robot whose measures are wrong, and a user with a perfect tape.

#[allow(dead_code)]
#[path = "../../../afp-pi/examples/ugv.rs"]
pub mod ugv;

use std::io::{BufRead, BufReader, Write};
use std::process::Stdio;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;

use crate::common::Place;
use crate::profile::Running;

/// A place and a heading.
type Pose = [f64; 3];

/// A robot at a port.
trait Robot {
    fn port(&self) -> &str;
    fn pose(&self) -> Pose;
    /// Puts the robot in front of a wall.
    fn before_wall(&self) {}
}

impl Robot for Running {
    fn port(&self) -> &str {
        &self.port
    }

    fn pose(&self) -> Pose {
        self.with(|fake| fake.pose)
    }
}

/// Answers a question of `afpc calibrate`. The robot was sent from `start`.
fn answer(question: &str, robot: &dyn Robot, start: &mut Pose) -> Option<String> {
    let pose = robot.pose();
    if question.contains("Press Enter") {
        *start = pose;
        return Some(String::new());
    }
    if question.contains("in front of a wall") {
        robot.before_wall();
    }
    let (dx, dy) = (pose[0] - start[0], pose[1] - start[1]);
    let (sin, cos) = start[2].sin_cos();
    let turned = (pose[2] - start[2]).to_degrees();
    let known = [
        ("[y/n]", "y".to_owned()),
        ("How far along", format!("{:.2} cm", (dx * cos + dy * sin) * 100.0)),
        ("left of the line", format!("{:.2} cm", (dy * cos - dx * sin) * 100.0)),
        ("beyond ten turns", format!("{:.1} deg", turned - 3600.0)),
        ("beyond two turns", format!("{:.1} deg", turned - 720.0)),
        ("is the wall from", "50 cm".to_owned()),
    ];
    known.into_iter().find(|(words, _)| question.contains(words)).map(|(_, answer)| answer)
}

/// Calibrates a project's robot, and ends the input after so many answers. Returns the exit code
/// and the questions.
fn calibrate(place: &Place, robot: &dyn Robot, mut answers: usize) -> (i32, Vec<String>) {
    let mut command = place.command();
    command.current_dir(place.path("mycar")).args(["calibrate", "--port", robot.port()]);
    command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let mut input = child.stdin.take();
    let (mut asked, mut start) = (Vec::new(), [0.0; 3]);
    for line in BufReader::new(child.stderr.take().unwrap()).lines() {
        let line = line.unwrap();
        if let Some(answer) = answer(&line, robot, &mut start) {
            if answers == 0 {
                input = None;
            } else if let Some(input) = &mut input {
                answers -= 1;
                writeln!(input, "{answer}").unwrap();
            }
        }
        asked.push(line);
    }
    (child.wait().unwrap().code().unwrap(), asked)
}

/// The number of a value in millimetres, or without a unit.
fn number(text: &str, key: &str) -> f64 {
    let line = text.lines().find_map(|line| line.strip_prefix(&format!("{key} = "))).unwrap();
    line.trim_matches('"').split(' ').next().unwrap().parse().unwrap()
}

#[test]
fn errors_of_five_percent_are_measured_and_used() {
    let place = Place::new();
    place.afpc("new mycar --profile carbot").succeeds();
    let controller = Running::start(|_| {});
    // Wheels that are too large, and differ; a track that is too wide.
    let (scale, trim, track) = (1.05_f32, 0.95_f32, 0.14 * 1.05_f32);
    controller.with(|fake| {
        let left = 2.0 * scale / (1.0 + trim);
        (fake.factors, fake.track, fake.wall) = ([left, left * trim], track, Some(0.488));
    });
    // The user leaves after the drive of 2 m. On a busy machine, the driver may lose the controller,
    // and the next call continues.
    let kept = || match place.exists("mycar/calibration.part.json") {
        true => place.read("mycar/calibration.part.json"),
        false => String::new(),
    };
    let left = (0..10).any(|_| {
        let answers = if kept().contains("\"wheels\": true") { 3 } else { 6 };
        let (code, asked) = calibrate(&place, &controller, answers);
        assert_eq!(code, 2, "{asked:#?}");
        asked.iter().any(|line| line.contains("the calibration is not finished"))
    });
    assert!(left && kept().contains("\"counted\""), "{}", kept());
    assert!(!place.exists("mycar/calibration.toml"));
    let finished = (0..10).any(|_| {
        let (code, asked) = calibrate(&place, &controller, 100);
        assert!(!asked.iter().any(|line| line.contains("It drives 2 m")), "{asked:#?}");
        code == 0
    });
    assert!(finished, "{}", kept());
    assert!(controller.with(|fake| !fake.is_moving() && fake.controller.is_stopped()));

    let text = place.read("mycar/calibration.toml");
    let near = |key: &str, expected: f64| {
        let found = number(&text, key);
        assert!((found / expected - 1.0).abs() < 0.005, "{key}: {found}, not {expected}");
    };
    // A count of the controller is 0.142 mm at the rim.
    near("wheel_diameter", 0.142 * 1440.0 / std::f64::consts::PI * f64::from(scale));
    near("track", f64::from(track) * 1000.0);
    near("trim", f64::from(trim));
    assert!((number(&text, "offset") - 12.0).abs() < 1.0, "{text}");
    assert!((50.0..2000.0).contains(&number(&text, "stop")), "{text}");
    assert!(!place.exists("mycar/calibration.part.json"));
    // The simulator takes the measured track.
    let here = |arguments: &str| {
        let mut command = place.command();
        command.current_dir(place.path("mycar")).args(arguments.split(' '));
        crate::common::said(command.output().unwrap())
    };
    let calibrated = here("run plans/mycar.afp --until 10s").succeeds().out.clone();
    std::fs::remove_file(place.path("mycar/calibration.toml")).unwrap();
    assert_ne!(here("run plans/mycar.afp --until 10s").succeeds().out, calibrated);
    place.write("mycar/calibration.toml", "[drive]\ntrak = \"1 cm\"\n");
    let wrong = here("check plans/mycar.afp");
    wrong.fails(1, &["'drive' has no 'trak'", "calibration.toml:2:1"]);
}

#[test]
fn a_robot_that_cannot_be_calibrated_is_refused_with_the_reason() {
    let place = Place::new();
    place.afpc("calibrate").fails(2, &["the project in this folder has no robot with a profile"]);
    place.afpc("new mycar --profile carbot").succeeds();
    let controller = Running::start(|_| {});
    // A motor that turns backwards never reaches the end of its way.
    controller.with(|fake| fake.factors = [-1.0, -1.0]);
    let stuck = (0..10).any(|_| {
        let (code, asked) = calibrate(&place, &controller, 1);
        assert_eq!(code, 2, "{asked:#?}");
        asked.iter().any(|line| line.contains("the wheels do not count as the robot drives"))
    });
    assert!(stuck && controller.with(|fake| !fake.is_moving()));
}

/// A UGV that runs until it is dropped.
pub struct Ugv {
    pub port: String,
    pub fake: Arc<Mutex<ugv::Fake>>,
    ends: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Ugv {
    pub fn start() -> Ugv {
        let (fake, port) = ugv::Fake::new().unwrap();
        let (fake, ends) = (Arc::new(Mutex::new(fake)), Arc::new(AtomicBool::new(false)));
        let (stepped, is_over) = (fake.clone(), ends.clone());
        let thread = std::thread::spawn(move || {
            while !is_over.load(Ordering::Relaxed) {
                stepped.lock().unwrap().step().unwrap();
                // Others may look at it.
                std::thread::sleep(std::time::Duration::from_millis(1));
            }
        });
        Ugv { port, fake, ends, thread: Some(thread) }
    }
}

impl Drop for Ugv {
    fn drop(&mut self) {
        self.ends.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

impl Robot for Ugv {
    fn port(&self) -> &str {
        &self.port
    }

    fn pose(&self) -> Pose {
        self.fake.lock().unwrap().pose
    }
}

#[test]
fn errors_of_a_ugv_are_measured() {
    let place = Place::new();
    place.afpc("new mycar --profile ugv").succeeds();
    let robot = Ugv::start();
    let (scale, trim, track) = (0.95, 1.05, 0.17 * 0.95);
    let left = 2.0 * scale / (1.0 + trim);
    {
        let mut fake = robot.fake.lock().unwrap();
        (fake.factors, fake.track) = ([left, left * trim], track);
    }
    let finished = (0..10).any(|_| calibrate(&place, &robot, 100).0 == 0);
    assert!(finished, "no call of ten finished");
    let text = place.read("mycar/calibration.toml");
    for (key, expected) in [("scale", scale), ("track", track * 1000.0), ("trim", trim)] {
        let found = number(&text, key);
        assert!((found / expected - 1.0).abs() < 0.005, "{key}: {found}, not {expected}");
    }
}

/// A car on the rig, which has the rig's path in its project.
#[cfg(target_os = "linux")]
impl Robot for crate::wired::rig::Rig {
    fn port(&self) -> &str {
        "none"
    }

    fn pose(&self) -> Pose {
        self.state().pose
    }

    fn before_wall(&self) {
        // The room ends at 4 m, and the sensor is 8 cm ahead of the axis.
        self.state().pose = [4.0 - 0.488 - 0.08, 1.5, 0.0];
    }
}

#[cfg(target_os = "linux")]
#[test]
fn errors_of_a_car_are_measured_and_used() {
    use crate::wired::rig::{Car, Rig};

    let place = Place::new();
    place.afpc("new mycar --profile picarx").succeeds();
    let path = place.path("rig");
    let rig = Rig::start(&path, [0.6, 1.5, 0.0]).unwrap();
    let (scale, wheelbase, aside) = (1.05, 0.0872 * 0.95, 0.02);
    rig.state().car = Some(Car { scale, wheelbase, aside });
    let text = place.read("mycar/afp.toml").replace("/dev/gpiochip0", &path.display().to_string());
    place.write("mycar/afp.toml", &text);
    let finished = (0..10).any(|_| {
        rig.state().pose = [0.6, 1.5, 0.0];
        calibrate(&place, &rig, 100).0 == 0
    });
    assert!(finished, "no call of ten finished");
    assert!(!rig.state().enabled.0);
    let text = place.read("mycar/calibration.toml");
    for (key, expected) in [("fastest", 45.0 * scale), ("wheelbase", wheelbase * 1000.0)] {
        let found = number(&text, key);
        assert!((found / expected - 1.0).abs() < 0.005, "{key}: {found}, not {expected}");
    }
    assert!((number(&text, "straight") + aside.to_degrees()).abs() < 0.1, "{text}");
    assert!((number(&text, "offset") - 12.0).abs() < 1.0, "{text}");
    assert!(!text.contains("stop"), "{text}");
    // The driver takes the values.
    let mut check = place.command();
    check.current_dir(place.path("mycar")).args(["check", "plans/mycar.afp"]);
    crate::common::said(check.output().unwrap()).succeeds();
}
