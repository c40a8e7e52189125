//! A stand-in for the board: prints the path of its port, and reports the movements of a robot on an endless floor. It prints
//! each new command.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::sync::mpsc::{Receiver as Bytes, channel};
use std::thread;
use std::time::Duration;

use afp_platform::RealTime;
use afp_wire::{COMMAND_TIMEOUT, Received, Receiver, Rejected, Sender};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use vacuum_protocol::{Command, LONGEST, Report, VERSION};

/// The board's messages and state.
pub struct Firmware {
    port: File,
    heard: Bytes<u8>,
    time: RealTime,
    sender: Sender,
    receiver: Receiver<LONGEST>,
    /// Speed ahead and turn rate, as commanded.
    motion: [f64; 2],
    suction: bool,
    way: [f64; 2],
    /// Whether it obeys no command before `Start`.
    stopped: bool,
    /// Whether its wire to the computer is broken.
    mute: bool,
}

/// A period of its reports.
const PERIOD: Duration = Duration::from_millis(20);

impl Firmware {
    /// A board, and the path of its port.
    pub fn new() -> io::Result<(Firmware, String)> {
        let (port, end, path) = Firmware::port()?;
        let (mut line, (tell, heard)) = (port.try_clone()?, channel());
        thread::spawn(move || {
            // The port exists while this end of it is open.
            let _end = end;
            let mut buffer = [0; 256];
            while let Ok(read) = line.read(&mut buffer) {
                if buffer[..read].iter().any(|byte| tell.send(*byte).is_err()) {
                    break;
                }
            }
        });
        let firmware = Firmware {
            port,
            heard,
            time: RealTime::start(),
            sender: Sender::new(1, VERSION),
            receiver: Receiver::new(VERSION),
            motion: [0.0; 2],
            suction: false,
            way: [0.0; 2],
            stopped: true,
            mute: false,
        };
        Ok((firmware, path))
    }

    /// A port, the open other end, and its path.
    pub fn port() -> io::Result<(File, File, String)> {
        let port = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&port)?;
        unlockpt(&port)?;
        let path = ptsname(&port, Vec::new())?.to_string_lossy().into_owned();
        let end = fs::File::options().read(true).write(true).open(&path)?;
        Ok((File::from(port), end, path))
    }

    /// Whether it obeys no command before `Start`.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// Whether the wheels turn.
    pub fn is_moving(&self) -> bool {
        self.motion != [0.0; 2]
    }

    /// Breaks its wire to the computer.
    pub fn mute(&mut self) {
        self.mute = true;
    }

    /// Restarts it, as a loss of power would: with another boot id and counters of zero. It is `stopped` or obeys at once.
    pub fn restart(&mut self, stopped: bool) {
        self.sender = Sender::new(2, VERSION);
        (self.motion, self.way, self.suction) = ([0.0; 2], [0.0; 2], false);
        self.stopped = stopped;
    }

    /// Runs one period and returns the commands that changed something.
    pub fn step(&mut self) -> io::Result<Vec<Command>> {
        thread::sleep(PERIOD);
        let mut new = Vec::new();
        while let Ok(byte) = self.heard.try_recv() {
            match self.receiver.receive::<Command>(byte, self.time.now()) {
                Some(Ok(Received::Hello)) => self.greet()?,
                Some(Ok(Received::Message { message, .. })) if message.is_possible() => {
                    let before = (self.motion, self.suction, self.stopped);
                    self.obey(message);
                    if before != (self.motion, self.suction, self.stopped) {
                        new.push(message);
                    }
                }
                // A new program begins: the board does not move before its `Start`.
                Some(Err(Rejected::Restarted)) => {
                    self.receiver.forget();
                    self.stopped = true;
                }
                _ => {}
            }
        }
        // A computer that was held up does not know what has happened meanwhile: it must start again.
        let moves = self.is_moving() || self.suction;
        self.stopped |= moves && self.receiver.is_silent(self.time.now(), COMMAND_TIMEOUT);
        if self.stopped {
            (self.motion, self.suction) = ([0.0; 2], false);
        }
        for (way, speed) in self.way.iter_mut().zip(self.motion) {
            *way += speed * PERIOD.as_secs_f64();
        }
        self.report()?;
        Ok(new)
    }

    fn greet(&mut self) -> io::Result<()> {
        let mut buffer = [0; LONGEST];
        let frame = self.sender.hello(&mut buffer).map_err(io::Error::other)?;
        self.port.write_all(frame)
    }

    fn report(&mut self) -> io::Result<()> {
        if self.mute {
            return Ok(());
        }
        let report = Report { way: self.way, stopped: self.stopped, ..Report::default() };
        let mut buffer = [0; LONGEST];
        let frame = self.sender.send(&report, &mut buffer).map_err(io::Error::other)?;
        self.port.write_all(frame)
    }

    fn obey(&mut self, command: Command) {
        match command {
            Command::Drive { speed, turn } => self.motion = [speed, turn],
            Command::Suck(on) => self.suction = on,
            Command::Stop => self.stopped = true,
            Command::Start => self.stopped = false,
        }
    }
}

#[allow(dead_code)]
fn main() -> io::Result<()> {
    let (mut firmware, path) = Firmware::new()?;
    println!("{path}");
    let mut has_started = false;
    while !(has_started && firmware.is_stopped()) {
        for command in firmware.step()? {
            println!("{command:?}");
        }
        has_started |= !firmware.is_stopped();
    }
    Ok(())
}
