//! A run in a terminal: it reads Escape, and it restores the terminal when it ends or is suspended.

use std::ffi::OsStr;
use std::fs::File;
use std::io::Write;
use std::os::unix::ffi::OsStrExt;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use crate::common::Place;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{LocalModes, tcgetattr};

/// A plan that logs every millisecond.
const PLAN: &str = "use std\nplan P {\n  start w\n  actor w: Wait(duration=1ms) {Elapsed->w}\n}\n";
const RUN: &str = "run p.afp --log none --svg none --until 1h --speed";
const PATIENCE: Duration = Duration::from_secs(30);

/// Both ends of a terminal.
struct Terminal {
    keyboard: File,
    screen: File,
}

impl Terminal {
    fn open() -> Terminal {
        let keyboard = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
        grantpt(&keyboard).unwrap();
        unlockpt(&keyboard).unwrap();
        let name = ptsname(&keyboard, Vec::new()).unwrap();
        let screen =
            File::options().read(true).write(true).open(OsStr::from_bytes(name.to_bytes()));
        Terminal { keyboard: keyboard.into(), screen: screen.unwrap() }
    }

    /// Starts a command in a new session on this terminal. Its output is a pipe.
    fn start(&self, place: &Place, command: &[&str]) -> Child {
        Command::new("setsid")
            .args(["--ctty", "--wait"])
            .args(command)
            .env("AFPC", env!("CARGO_BIN_EXE_afpc"))
            .current_dir(place.path(""))
            .stdin(self.screen.try_clone().unwrap())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap()
    }

    fn press(&mut self, keys: &str) {
        self.keyboard.write_all(keys.as_bytes()).unwrap();
    }

    /// Whether the terminal echoes and edits input: false while a run reads keys.
    fn is_free(&self) -> bool {
        let modes = tcgetattr(&self.screen).unwrap().local_modes;
        modes.contains(LocalModes::ECHO | LocalModes::ICANON)
    }

    #[track_caller]
    fn becomes(&self, free: bool) {
        until(|| (self.is_free() == free).then_some(()));
    }
}

/// Waits for an event.
#[track_caller]
fn until<T>(mut happens: impl FnMut() -> Option<T>) -> T {
    let begun = Instant::now();
    loop {
        match happens() {
            Some(it) => return it,
            None => assert!(begun.elapsed() < PATIENCE, "it does not happen"),
        }
        thread::sleep(Duration::from_millis(5));
    }
}

#[track_caller]
fn ended(child: &mut Child) -> ExitStatus {
    until(|| child.try_wait().unwrap())
}

fn place() -> Place {
    let place = Place::new();
    place.write("p.afp", PLAN);
    place
}

#[test]
fn ctrl_c_restores_the_terminal() {
    let (place, mut terminal) = (place(), Terminal::open());
    let run = format!("exec $AFPC {RUN} 1x > out");
    let mut child = terminal.start(&place, &["sh", "-c", &run]);
    terminal.becomes(false);
    terminal.press("\x03");
    assert_eq!(ended(&mut child).code(), Some(0));
    assert!(terminal.is_free());
}

#[test]
fn a_second_ctrl_c_ends_a_hanging_run_and_restores_the_terminal() {
    let (place, mut terminal) = (place(), Terminal::open());
    // The run blocks on its full pipe and never notices the first Ctrl-C.
    let run = format!("exec $AFPC {RUN} 100x");
    let mut child = terminal.start(&place, &["sh", "-c", &run]);
    terminal.becomes(false);
    thread::sleep(Duration::from_secs(2));
    assert!(child.try_wait().unwrap().is_none());
    terminal.press("\x03");
    thread::sleep(Duration::from_millis(300));
    assert!(child.try_wait().unwrap().is_none(), "it does not hang");
    assert!(!terminal.is_free());
    terminal.press("\x03");
    assert_eq!(ended(&mut child).code(), Some(130));
    assert!(terminal.is_free());
}

#[test]
fn a_suspended_run_lends_the_terminal_until_it_continues() {
    let (place, mut terminal) = (place(), Terminal::open());
    // A shell with job control that waits for a line in between.
    let script = format!("set -m; $AFPC {RUN} 1x > out; read line; fg; exit");
    let mut child = terminal.start(&place, &["sh", "-c", &script]);
    terminal.becomes(false);
    terminal.press("\x1a");
    terminal.becomes(true);
    thread::sleep(Duration::from_millis(200));
    assert!(terminal.is_free(), "it did not stop");
    assert!(child.try_wait().unwrap().is_none());
    terminal.press("go on\n");
    terminal.becomes(false);
    terminal.press("\x03");
    ended(&mut child);
    assert!(terminal.is_free());
}

#[test]
fn a_run_suspended_by_another_process_lends_the_terminal_and_continues() {
    let (place, mut terminal) = (place(), Terminal::open());
    let run = format!("echo $$ > pid; exec $AFPC {RUN} 1x > out");
    let script = format!("set -m; sh -c '{run}'; read line; fg; exit");
    let mut child = terminal.start(&place, &["sh", "-c", &script]);
    let length = || place.bytes("out").len();
    terminal.becomes(false);
    let pid = place.read("pid");
    Command::new("kill").args(["-TSTP", pid.trim()]).status().unwrap();
    terminal.becomes(true);
    thread::sleep(Duration::from_millis(200));
    assert!(terminal.is_free(), "it took the terminal again before it slept");
    let so_far = length();
    thread::sleep(Duration::from_millis(200));
    assert_eq!(length(), so_far, "it did not sleep");
    terminal.press("go on\n");
    terminal.becomes(false);
    let so_far = length();
    until(|| (length() > so_far).then_some(()));
    terminal.press("\x03");
    ended(&mut child);
    assert!(terminal.is_free());
}

#[test]
fn a_background_run_does_not_change_the_terminal() {
    let (place, mut terminal) = (place(), Terminal::open());
    let script = format!("set -m; $AFPC {RUN} 1x > out & read line; fg; exit");
    let mut child = terminal.start(&place, &["sh", "-c", &script]);
    until(|| (place.exists("out") && !place.bytes("out").is_empty()).then_some(()));
    assert!(terminal.is_free());
    terminal.press("go on\n");
    terminal.becomes(false);
    terminal.press("\x03");
    ended(&mut child);
    assert!(terminal.is_free());
}
