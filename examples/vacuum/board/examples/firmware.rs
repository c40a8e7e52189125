//! Stands in for the board where there is none: says at which port it is, and then what a board says that stands free on
//! an endless floor. It prints what it is told, once for each change.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};
use std::{fs, thread};

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

/// What the board says and hears.
pub struct Firmware {
    port: File,
    heard: Receiver<String>,
    /// Speed ahead and turn rate, as told.
    motion: [f64; 2],
    suction: bool,
    way: [f64; 2],
    /// Told to stop for good.
    stopped: bool,
    told: Instant,
}

/// A period of what it says.
const PERIOD: Duration = Duration::from_millis(20);
/// Without a word for so long it stops the motors.
const PATIENCE: Duration = Duration::from_millis(200);

impl Firmware {
    /// A board, and the path of its port.
    pub fn new() -> io::Result<(Firmware, String)> {
        let port = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&port)?;
        unlockpt(&port)?;
        let path = ptsname(&port, Vec::new())?.to_string_lossy().into_owned();
        // As a serial line: nothing is sent back, nothing is edited.
        let end = fs::File::options().read(true).write(true).open(&path)?;
        let mut modes = tcgetattr(&end)?;
        modes.make_raw();
        tcsetattr(&end, OptionalActions::Now, &modes)?;
        let port = File::from(port);
        let (lines, (tell, heard)) = (BufReader::new(port.try_clone()?), channel());
        thread::spawn(move || {
            // The port stays while somebody holds this end of it.
            let _end = end;
            lines.lines().map_while(Result::ok).for_each(|line| drop(tell.send(line)));
        });
        let (motion, way) = ([0.0; 2], [0.0; 2]);
        let told = Instant::now();
        let firmware = Firmware { port, heard, motion, suction: false, way, stopped: false, told };
        Ok((firmware, path))
    }

    /// Whether it was told to stop for good.
    pub fn is_stopped(&self) -> bool {
        self.stopped
    }

    /// Whether the wheels turn.
    pub fn is_moving(&self) -> bool {
        self.motion != [0.0; 2]
    }

    /// One period; gives what it was told and had not been told before.
    pub fn step(&mut self) -> io::Result<Vec<String>> {
        thread::sleep(PERIOD);
        let before = (self.motion, self.suction, self.stopped);
        let mut new = Vec::new();
        while let Ok(line) = self.heard.try_recv() {
            self.told = Instant::now();
            self.hear(&line);
            if before != (self.motion, self.suction, self.stopped) {
                new.push(line);
            }
        }
        if self.stopped || self.told.elapsed() > PATIENCE {
            (self.motion, self.suction) = ([0.0; 2], false);
        }
        for (way, speed) in self.way.iter_mut().zip(self.motion) {
            *way += speed * PERIOD.as_secs_f64();
        }
        let [ahead, turned] = self.way;
        writeln!(self.port, "{ahead:.4} {turned:.4} 0 0 0 0.0 0")?;
        Ok(new)
    }

    fn hear(&mut self, line: &str) {
        let words: Vec<_> = line.split_whitespace().collect();
        let number = |word: &str| word.parse().unwrap_or(0.0);
        match words.as_slice() {
            ["drive", speed, turn] => self.motion = [number(speed), number(turn)],
            ["suck", on] => self.suction = *on == "1",
            ["stop"] => self.stopped = true,
            _ => {}
        }
    }
}

#[allow(dead_code)]
fn main() -> io::Result<()> {
    let (mut firmware, path) = Firmware::new()?;
    println!("{path}");
    while !firmware.is_stopped() {
        for line in firmware.step()? {
            println!("{line}");
        }
    }
    Ok(())
}
