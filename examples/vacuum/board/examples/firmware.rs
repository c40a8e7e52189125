//! Stands in for the board where there is none: says at which port it is, and then what a board says that stands free on
//! an endless floor. It prints what it is told, once for each change.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use std::{fs, thread};

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use vacuum_protocol::{Command, Line, Report};

/// What the board says and hears.
pub struct Firmware {
    port: File,
    heard: Receiver<String>,
    /// Speed ahead and turn rate, as told.
    motion: [f64; 2],
    suction: bool,
    way: [f64; 2],
    /// Told to stop, and not yet to start again.
    stopped: bool,
    told: Instant,
    /// Whether nobody hears what it says.
    mute: bool,
}

/// A period of what it says.
const PERIOD: Duration = Duration::from_millis(20);
/// Without a word for so long it stops the motors.
const PATIENCE: Duration = Duration::from_millis(200);

impl Firmware {
    /// A board, and the path of its port.
    pub fn new() -> io::Result<(Firmware, String)> {
        let (port, end, path) = Firmware::port()?;
        let (lines, (tell, heard)) = (BufReader::new(port.try_clone()?), channel());
        thread::spawn(move || {
            // The port stays while somebody holds this end of it.
            let _end = end;
            // What is no text is noise; what ends the line ends this.
            lines.split(b'\n').map_while(Result::ok).for_each(|line| {
                drop(tell.send(String::from_utf8_lossy(&line).into_owned()));
            });
        });
        let (motion, way) = ([0.0; 2], [0.0; 2]);
        let told = Instant::now();
        let (suction, stopped, mute) = (false, false, false);
        Ok((Firmware { port, heard, motion, suction, way, stopped, told, mute }, path))
    }

    /// A port, what holds its other end open, and the path of that.
    pub fn port() -> io::Result<(File, File, String)> {
        let port = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&port)?;
        unlockpt(&port)?;
        let path = ptsname(&port, Vec::new())?.to_string_lossy().into_owned();
        let end = fs::File::options().read(true).write(true).open(&path)?;
        Ok((File::from(port), end, path))
    }

    /// Whether it was told to stop, and not yet to start again.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// Whether the wheels turn.
    pub fn is_moving(&self) -> bool {
        self.motion != [0.0; 2]
    }

    /// From now on it hears, but is not heard: the wire from the board is broken.
    pub fn mute(&mut self) {
        self.mute = true;
    }

    /// One period; gives what it was told and had not been told before.
    pub fn step(&mut self) -> io::Result<Vec<Command>> {
        thread::sleep(PERIOD);
        let mut new = Vec::new();
        while let Ok(line) = self.heard.try_recv() {
            // What is noise or was cut keeps no motor going.
            let Some(command) = Command::read(&line) else { continue };
            let before = (self.motion, self.suction, self.stopped);
            self.obey(command);
            self.told = Instant::now();
            if before != (self.motion, self.suction, self.stopped) {
                new.push(command);
            }
        }
        if self.stopped || self.told.elapsed() > PATIENCE {
            (self.motion, self.suction) = ([0.0; 2], false);
        }
        for (way, speed) in self.way.iter_mut().zip(self.motion) {
            *way += speed * PERIOD.as_secs_f64();
        }
        if !self.mute {
            let report = Report { way: self.way, stopped: self.stopped, ..Report::default() };
            write!(self.port, "{}", Line(report))?;
        }
        Ok(new)
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
    while !firmware.is_stopped() {
        for command in firmware.step()? {
            println!("{command}");
        }
    }
    Ok(())
}
