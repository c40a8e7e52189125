//! The line to a controller in this program, for robots without a second controller.
//!
//! A thread runs the program of the second controller, [`afp_drive`], on the pins. The line to it
//! is a pair of sockets with the same frames as a serial port, so that a run which hangs loses the
//! motors as with a second controller. The [guard](crate::guard) stops them if the process ends.

use std::hash::{BuildHasher, RandomState};
use std::io::{self, ErrorKind, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use std::fs::File;

use afp_core::{Duration, Fault, Instant, faults};
use afp_drive::{Command, Controller, LONGEST, Report, STEP, Setup, VERSION};
use afp_platform::{LastResort, RealTime, Settings, open_device};

use super::{Line, wire};
use crate::board::{Board, Wired};
use crate::guard::Guard;
use crate::link::{Heard, Link};
use crate::port::Port;

/// The guard must answer within this time.
const PATIENCE: Duration = Duration::from_secs(1);
/// A thread that is later than this has not driven the motors meanwhile.
const LATE: Duration = Duration::from_millis(100);

faults! {
    /// The pins or the guard failed.
    pub(crate) DRIVE_LOST = "drive-lost",
        "the guard ended, or a pin of the motors failed; the motors' power was cut";
}

/// The line to a controller in this program, with the pins of a profile.
#[derive(Debug)]
pub struct LocalLine<W> {
    link: Link<LONGEST>,
    setup: Setup,
    /// Whether the controller has given up.
    lost: Arc<AtomicBool>,
    /// Keeps other programs away from the chip.
    _chip: Option<File>,
    wired: std::marker::PhantomData<W>,
}

impl<W: Wired> Line for LocalLine<W> {
    const PROFILE: &'static str = W::PROFILE;
    const PLACE: &'static str = "chip";

    fn open(settings: &Settings, setup: &Setup) -> io::Result<Self> {
        let value = |name: &str| {
            settings.get(name).ok_or_else(|| io::Error::other(format!("'{name}' has no value")))
        };
        let chip = value("chip")?;
        let is_file = Path::new(chip).metadata().is_ok_and(|chip| {
            use std::os::unix::fs::FileTypeExt;
            !chip.file_type().is_socket()
        });
        let lock = is_file.then(|| open_device(File::options().read(true), chip)).transpose()?;
        let (ours, theirs) = UnixStream::pair()?;
        ours.set_nonblocking(true)?;
        theirs.set_nonblocking(true)?;
        let time = RealTime::start();
        // Pins are opened first, because the guard does not wait for a slow system. Boards that
        // need the motors' supply are quick.
        let early = match W::SETTLES {
            Duration::ZERO => Some(W::open(settings, setup)?),
            _ => None,
        };
        let mut guard = Guard::start(chip, value("guard.line")?)?;
        enable(&mut guard, &time, W::SETTLES)?;
        let board = early.map_or_else(|| W::open(settings, setup), Ok)?;
        let lost = Arc::new(AtomicBool::new(false));
        let mut drive = Drive {
            line: theirs,
            guard,
            board,
            // The keys of a hasher are random, and differ at each call.
            controller: Controller::new(RandomState::new().hash_one(0) as u32),
            time,
        };
        let gives_up = lost.clone();
        thread::Builder::new().name("afp-drive".to_owned()).spawn(move || {
            if drive.run().is_err() {
                gives_up.store(true, Ordering::Relaxed);
            }
            drive.board.off();
        })?;
        let link = Link::over(Port::over(ours.into()), VERSION);
        Ok(LocalLine { link, setup: *setup, lost, _chip: lock, wired: std::marker::PhantomData })
    }

    fn begin(&mut self) {
        wire::begin(&mut self.link, &self.setup);
    }

    fn send(&mut self, command: &Command, _: Instant) {
        self.link.send(command);
    }

    fn discard(&mut self) {}

    fn hear(&mut self, time: &RealTime) -> Option<Heard<Report>> {
        self.link.hear(time, Report::is_possible)
    }

    fn last_resort(&self) -> Option<LastResort> {
        self.link.last_resort()
    }

    fn release(&self) {}

    fn broken(&self) -> Option<Fault> {
        self.lost.load(Ordering::Relaxed).then_some(DRIVE_LOST)
    }
}

/// Waits until the guard has switched the motors on, and for `settles` longer.
fn enable(guard: &mut Guard, time: &RealTime, settles: Duration) -> io::Result<()> {
    let (patience, mut ready) = (time.now() + PATIENCE, None);
    loop {
        let now = time.now();
        if !guard.beat(now) || !guard.is_ready() && now > patience {
            return Err(io::Error::other("the guard does not answer"));
        }
        if guard.is_ready() && now.since(*ready.get_or_insert(now)) >= settles {
            return Ok(());
        }
        time.sleep_until(now + STEP);
    }
}

/// The thread of the controller.
struct Drive {
    line: UnixStream,
    guard: Guard,
    board: Box<dyn Board>,
    controller: Controller,
    time: RealTime,
}

impl Drive {
    /// Runs the controller until the run ends.
    ///
    /// # Errors
    /// The guard or the board failed.
    fn run(&mut self) -> io::Result<()> {
        let mut due = self.time.now();
        while self.listen()? {
            let now = self.time.now();
            if !self.guard.beat(now) {
                return Err(io::Error::other("the guard has ended"));
            }
            let inputs = self.board.read(now)?;
            let outputs = self.controller.step(&inputs, now);
            self.board.apply(&outputs)?;
            let mut buffer = [0; 2 * LONGEST];
            let bytes = self.controller.transmit(now, &mut buffer);
            // A run that does not read is late, and hears a later report.
            let _ = self.line.write(bytes);
            // The grid begins again after a stall, instead of many steps at once.
            due = if now.since(due) > LATE { now } else { due } + STEP;
            self.time.sleep_until(due);
        }
        Ok(())
    }

    /// Takes the commands; returns whether the run is still there.
    fn listen(&mut self) -> io::Result<bool> {
        let mut bytes = [0; 256];
        loop {
            match self.line.read(&mut bytes) {
                Ok(0) => return Ok(false),
                Ok(read) => {
                    let now = self.time.now();
                    for byte in bytes.get(..read).unwrap_or_default() {
                        self.controller.receive(*byte, now);
                    }
                }
                Err(error) if error.kind() == ErrorKind::WouldBlock => return Ok(true),
                Err(error) if error.kind() == ErrorKind::ConnectionReset => return Ok(false),
                Err(error) => return Err(error),
            }
        }
    }
}
