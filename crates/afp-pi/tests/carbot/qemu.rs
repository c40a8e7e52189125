//! The driver with the controller's program for a microcontroller, on the serial port of an
//! emulated board.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command as Program, Stdio};
use std::thread::sleep;
use std::time;

use afp_carbot::devices::{Invalid, Navigator, Odometry};
use afp_carbot::guard::CONTROLLER_RESTARTED;
use afp_core::Platform;
use afp_core::quantity::{AngularSpeed, Speed};
use afp_drive::{Command, LONGEST, Report, Setup, VERSION};
use afp_pi::{Heard, Link, SerialCarbot};
use afp_platform::{Hardware, RealTime, Settings};
use afp_session::Robot;

use super::{LATE, SETTINGS, until};

/// An emulated board.
struct Board {
    process: Child,
    monitor: ChildStdin,
    port: String,
}

impl Board {
    fn start() -> Board {
        let image = std::env::var("AFP_CONTROLLER").expect("AFP_CONTROLLER names the image");
        let mut qemu = Program::new("qemu-system-arm");
        qemu.args(["-machine", "microbit", "-display", "none", "-serial", "pty"]);
        qemu.args(["-monitor", "stdio", "-kernel", &image]);
        let mut process = qemu.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
        let monitor = process.stdin.take().unwrap();
        let lines = BufReader::new(process.stdout.take().unwrap()).lines();
        let named = |line: String| {
            let (_, rest) = line.split_once("redirected to ")?;
            rest.split(' ').next().map(str::to_owned)
        };
        let port = lines.map_while(Result::ok).find_map(named).expect("QEMU names the port");
        Board { process, monitor, port }
    }

    fn open(&self) -> SerialCarbot {
        let port = [("port", &*self.port)];
        SerialCarbot::open(&Settings::new(SETTINGS.into_iter().chain(port))).unwrap()
    }

    fn restart(&mut self) {
        self.monitor.write_all(b"system_reset\n").unwrap();
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Sends commands until a report fulfils something.
fn talk(
    link: &mut Link<LONGEST>,
    commands: &[Command],
    mut holds: impl FnMut(&Report) -> bool,
) -> Report {
    let (time, late) = (RealTime::start(), time::Instant::now() + LATE.into());
    loop {
        commands.iter().for_each(|command| link.send(command));
        sleep(time::Duration::from_millis(10));
        match link.hear(&time, Report::is_possible) {
            Some(Heard::Message(report, _)) if holds(&report) => return report,
            Some(Heard::Restarted | Heard::Version(_)) => panic!("another program answers"),
            heard => assert!(time::Instant::now() < late, "it takes too long: {heard:?}"),
        }
    }
}

#[test]
#[ignore = "needs QEMU and the controller's image; `cargo xtask gate firmware` runs it"]
fn a_microcontroller_drives_and_stops_by_itself() {
    let board = Board::start();
    let mut link = Link::<LONGEST>::open(&board.port, 115_200, VERSION).unwrap();
    let (time, late) = (RealTime::start(), time::Instant::now() + LATE.into());
    // The port takes a moment, so the hello is repeated.
    while link.hear(&time, Report::is_possible).is_none() {
        link.hello();
        sleep(time::Duration::from_millis(20));
        assert!(time::Instant::now() < late, "it does not answer");
    }
    let begin = [Command::Setup(Setup::default()), Command::Start];
    talk(&mut link, &begin, |report| !report.stopped);
    let drive = [Command::Drive { speed: 0.2, turn: 0.5 }];
    // A busy machine may stop the controller; then it starts again.
    let restart = [Command::Start, drive[0]];
    let driven = talk(&mut link, &restart, |report| {
        let [x, _, heading] = report.pose;
        x > 0.1 && heading > 0.1 && report.speed > 0.19
    });
    let rates = (driven.speed - 0.2, driven.turn - 0.5);
    assert!(rates.0.abs() < 0.05 && rates.1.abs() < 0.3, "{driven:?}");
    // Silence.
    let stopped = talk(&mut link, &[], |report| report.stopped && report.speed == 0.0);
    // It needs a start.
    let mut reports = 0;
    let later = talk(&mut link, &drive, |_| {
        reports += 1;
        reports > 10
    });
    assert_eq!((later.pose, later.stopped), (stopped.pose, true));
    talk(&mut link, &restart, |report| report.pose[0] > stopped.pose[0] + 0.05);
    let stop = [Command::Stop];
    talk(&mut link, &stop, |report| report.stopped && report.speed == 0.0);
}

#[test]
#[ignore = "needs QEMU and the controller's image; `cargo xtask gate firmware` runs it"]
fn a_microcontroller_that_restarts_is_named_and_stays_stopped() {
    let mut board = Board::start();
    let mut robot = driving(&board);
    board.restart();
    until(&mut robot, 0.2, |it| it.motion().value == Err(Invalid::Restarted));
    assert_eq!(Robot::broken(&robot), Some(CONTROLLER_RESTARTED));
    let later = robot.now() + afp_core::Duration::from_millis(500);
    until(&mut robot, 0.2, |it| it.now() > later);
    assert_eq!(robot.motion().value, Err(Invalid::Restarted));
    drop(robot);
    // The next program drives again.
    driving(&board);
}

/// A robot that drives. On a busy machine, the driver may lose the controller.
fn driving(board: &Board) -> SerialCarbot {
    for _ in 0..5 {
        let mut robot = board.open();
        let late = robot.now() + LATE;
        while robot.now() < late {
            match robot.motion().value {
                Ok(motion) if motion.x.si() > 0.05 => return robot,
                _ => {
                    let now = robot.now();
                    robot.drive(Speed::from_si(0.2), AngularSpeed::from_si(0.0), now);
                    robot.advance(now + afp_core::Duration::from_millis(10));
                }
            }
        }
    }
    panic!("no robot of five drives");
}
