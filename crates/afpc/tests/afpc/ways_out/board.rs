//! The second controller at the other end of a line, with the times of commands.

use std::fs::File;
use std::io::{Read, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use afp_drive::{Command, Controller, Inputs, LONGEST, Report, STEP, Setup, VERSION};
use afp_platform::RealTime;
use afp_wire::{Received, Receiver, Sender};
use rustix::fs::OFlags;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

/// The interval between two looks at the line.
const GLANCE: Duration = Duration::from_micros(500);

/// The reports of the controller.
#[derive(Clone, Copy, PartialEq)]
pub enum Reports {
    /// Its state.
    True,
    None,
    /// Bytes that are not frames.
    Garbage,
    /// Frames with a position that is not a number.
    NotANumber,
}

/// The commands on the line, and the orders of the test.
struct Seen {
    reports: Reports,
    /// The start of the controller.
    boot: u32,
    /// Whether the last command drives; `None` without a command.
    drives: Option<bool>,
    /// The time of the first command without motion after the last one with motion.
    zero: Option<Instant>,
    /// The time at which the motors lost their power.
    off: Option<Instant>,
    ends: bool,
}

/// A controller in its own thread.
pub struct Board {
    pub port: String,
    seen: Arc<Mutex<Seen>>,
    thread: Option<JoinHandle<()>>,
}

impl Board {
    pub fn start() -> Board {
        let port = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
        grantpt(&port).unwrap();
        unlockpt(&port).unwrap();
        let path = ptsname(&port, Vec::new()).unwrap().to_string_lossy().into_owned();
        // The port exists while this end of it is open.
        let end = File::options().read(true).write(true).open(&path).unwrap();
        let mut modes = tcgetattr(&end).unwrap();
        modes.make_raw();
        tcsetattr(&end, OptionalActions::Now, &modes).unwrap();
        rustix::fs::fcntl_setfl(&port, OFlags::RDWR | OFlags::NONBLOCK).unwrap();
        let seen = Arc::new(Mutex::new(Seen {
            reports: Reports::True,
            boot: 1,
            drives: None,
            zero: None,
            off: None,
            ends: false,
        }));
        let shared = seen.clone();
        let thread = thread::spawn(move || {
            let _end = end;
            run(File::from(port), &shared);
        });
        Board { port: path, seen, thread: Some(thread) }
    }

    fn seen(&self) -> MutexGuard<'_, Seen> {
        lock(&self.seen)
    }

    /// Changes the reports; returns the time.
    pub fn report(&self, reports: Reports) -> Instant {
        self.seen().reports = reports;
        Instant::now()
    }

    /// Restarts the controller; returns the time.
    pub fn restart(&self) -> Instant {
        let mut seen = self.seen();
        seen.boot += 1;
        seen.drives = None;
        Instant::now()
    }

    /// Forgets the commands so far.
    pub fn forget(&self) {
        self.seen().drives = None;
    }

    /// Whether the last command drives.
    pub fn drives(&self) -> bool {
        self.seen().drives == Some(true)
    }

    /// Whether the last command stops the wheels.
    pub fn is_commanded_zero(&self) -> bool {
        self.seen().drives == Some(false)
    }

    /// The time from a moment to the first command without motion.
    pub fn zero_after(&self, since: Instant) -> Duration {
        self.seen().zero.unwrap().saturating_duration_since(since)
    }

    /// The time from a moment to the loss of power, if the motors have none.
    pub fn power_off_after(&self, since: Instant) -> Option<Duration> {
        self.seen().off.map(|off| off.saturating_duration_since(since))
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        self.seen().ends = true;
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

fn lock(seen: &Mutex<Seen>) -> MutexGuard<'_, Seen> {
    seen.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The controller and the line to the computer.
struct Program {
    port: File,
    controller: Controller,
    boot: u32,
    /// Reads the computer's commands.
    hears: Receiver<LONGEST>,
    /// Reads the controller's reports.
    reads: Receiver<LONGEST>,
    /// Makes frames with the same numbers and other contents.
    writes: Sender,
    time: RealTime,
    ways: [f32; 2],
}

impl Program {
    fn new(port: File, boot: u32) -> Program {
        Program {
            port,
            controller: Controller::new(boot),
            boot,
            hears: Receiver::new(VERSION),
            reads: Receiver::new(VERSION),
            writes: Sender::new(boot, VERSION),
            time: RealTime::start(),
            ways: [0.0; 2],
        }
    }

    /// Takes the commands that have arrived.
    fn listen(&mut self, seen: &Mutex<Seen>) {
        let mut bytes = [0; 256];
        let read = self.port.read(&mut bytes).unwrap_or_default();
        for byte in &bytes[..read] {
            let now = self.time.now();
            self.controller.receive(*byte, now);
            let heard = match self.hears.receive::<Command>(*byte, now) {
                Some(Ok(Received::Message { message, .. })) => message,
                // Another program begins.
                Some(Err(_)) => {
                    self.hears.forget();
                    continue;
                }
                _ => continue,
            };
            let drives = match heard {
                Command::Drive { speed, turn } => [speed, turn] != [0.0; 2],
                Command::Stop => false,
                _ => continue,
            };
            let mut seen = lock(seen);
            if drives {
                seen.zero = None;
            } else if seen.drives != Some(false) {
                seen.zero = Some(Instant::now());
            }
            seen.drives = Some(drives);
        }
    }

    /// Makes a step of the controller.
    fn step(&mut self, seen: &Mutex<Seen>) {
        let (setup, now) = (Setup::default(), self.time.now());
        let counts = [0, 1].map(|side| (self.ways[side] / setup.metres_per_tick[side]) as i32);
        let closed = Inputs { counts, bumper: true, button: true, ping: Some(None) };
        let power = self.controller.step(&closed, now).power;
        for (way, power) in self.ways.iter_mut().zip(power) {
            *way += power * setup.at_full_power() * STEP.as_secs_f64() as f32;
        }
        let mut seen = lock(seen);
        match power == [0.0; 2] && self.controller.is_stopped() {
            true => drop(seen.off.get_or_insert_with(Instant::now)),
            false => seen.off = None,
        }
        self.transmit(seen.reports);
    }

    fn transmit(&mut self, reports: Reports) {
        let (mut buffer, now) = ([0; 2 * LONGEST], self.time.now());
        let frames = self.controller.transmit(now, &mut buffer);
        let mut impossible = Vec::new();
        for byte in frames.iter() {
            let mut frame = [0; LONGEST];
            let frame = match self.reads.receive::<Report>(*byte, now) {
                None => continue,
                Some(Ok(Received::Hello)) => self.writes.hello(&mut frame),
                Some(_) => {
                    let pose = [f64::NAN, 0.0, 0.0];
                    self.writes.send(&Report { pose, ..Report::default() }, &mut frame)
                }
            };
            impossible.extend_from_slice(frame.unwrap());
        }
        let bytes: &[u8] = match reports {
            Reports::True => frames,
            Reports::NotANumber => &impossible,
            Reports::Garbage if !frames.is_empty() => &[0x5a; 40],
            Reports::Garbage | Reports::None => &[],
        };
        // A full line loses them.
        let _ = self.port.write(bytes);
    }
}

fn run(port: File, seen: &Mutex<Seen>) {
    let mut program = Program::new(port, 1);
    let mut due = Instant::now();
    loop {
        let (ends, boot) = {
            let seen = lock(seen);
            (seen.ends, seen.boot)
        };
        if ends {
            return;
        }
        if boot != program.boot {
            program = Program::new(program.port, boot);
        }
        program.listen(seen);
        if Instant::now() >= due {
            due += STEP.into();
            program.step(seen);
        }
        thread::sleep(GLANCE);
    }
}
