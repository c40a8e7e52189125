//! A stand-in for the controller of a Waveshare UGV: prints the path of its port, and reports wheels
//! that turn as commanded. It ends when it has stopped by itself after a drive.

use std::fs::File;
use std::io::{self, Read, Write};
use std::sync::mpsc::{Receiver as Bytes, channel};
use std::thread;
use std::time::{Duration, Instant};

use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

/// The period of its steps and reports.
const STEP: Duration = Duration::from_millis(20);
/// The distance between its wheels, in metres.
const TRACK: f64 = 0.17;

/// The controller on a pseudo-terminal.
pub struct Fake {
    port: File,
    heard: Bytes<u8>,
    line: Vec<u8>,
    /// The speeds of the left and the right wheel, in m/s.
    pub speeds: [f64; 2],
    /// The counted distances of the wheels, in metres.
    pub ways: [f64; 2],
    /// The driven distance over the counted distance of each wheel.
    pub factors: [f64; 2],
    /// The distance between the wheels in metres.
    pub track: f64,
    /// The place in metres and the heading in radians.
    pub pose: [f64; 3],
    /// It stops after this time without a command.
    pub dead_man: Duration,
    commanded: Instant,
    reports: bool,
}

impl Fake {
    /// A controller, and the path of its port.
    pub fn new() -> io::Result<(Fake, String)> {
        let port = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&port)?;
        unlockpt(&port)?;
        let path = ptsname(&port, Vec::new())?.to_string_lossy().into_owned();
        // The port exists while this end of it is open.
        let end = File::options().read(true).write(true).open(&path)?;
        let port = File::from(port);
        let (mut from, (tell, heard)) = (port.try_clone()?, channel());
        thread::spawn(move || {
            let _end = end;
            let mut buffer = [0; 256];
            while let Ok(read) = from.read(&mut buffer) {
                if buffer[..read].iter().any(|byte| tell.send(*byte).is_err()) {
                    break;
                }
            }
        });
        let fake = Fake {
            port,
            heard,
            line: Vec::new(),
            speeds: [0.0; 2],
            ways: [0.0; 2],
            factors: [1.0; 2],
            track: TRACK,
            pose: [0.0; 3],
            dead_man: Duration::from_secs(3),
            commanded: Instant::now(),
            reports: false,
        };
        Ok((fake, path))
    }

    /// Restarts it, as a loss of power would.
    pub fn restart(&mut self) {
        (self.speeds, self.ways) = ([0.0; 2], [0.0; 2]);
        self.dead_man = Duration::from_secs(3);
    }

    /// Runs one step in real time.
    pub fn step(&mut self) -> io::Result<()> {
        thread::sleep(STEP);
        while let Ok(byte) = self.heard.try_recv() {
            match byte {
                b'\n' => self.obey(),
                byte => self.line.push(byte),
            }
        }
        if self.commanded.elapsed() > self.dead_man {
            self.speeds = [0.0; 2];
        }
        for (way, speed) in self.ways.iter_mut().zip(self.speeds) {
            *way += speed * STEP.as_secs_f64();
        }
        let driven = |side: usize| self.speeds[side] * self.factors[side] * STEP.as_secs_f64();
        let (left, right) = (driven(0), driven(1));
        let [x, y, heading] = &mut self.pose;
        let turned = (right - left) / self.track;
        let (sin, cos) = (*heading + turned / 2.0).sin_cos();
        *x += (left + right) / 2.0 * cos;
        *y += (left + right) / 2.0 * sin;
        *heading += turned;
        if !self.reports {
            return Ok(());
        }
        let ([left, right], [odl, odr]) = (self.speeds, self.ways.map(|way| way * 100.0));
        let report = format!(
            "{{\"T\":1001,\"L\":{left},\"R\":{right},\"gz\":-3,\"odl\":{odl:.2},\"odr\":{odr:.2},\"v\":1180}}\r\n"
        );
        self.port.write_all(report.as_bytes())
    }

    fn obey(&mut self) {
        let line = std::mem::take(&mut self.line);
        let Ok(command) = serde_json::from_slice::<serde_json::Value>(&line) else { return };
        let number = |key: &str| command[key].as_f64().unwrap_or_default();
        match command["T"].as_i64() {
            Some(1) => self.drive([number("L"), number("R")]),
            Some(13) => {
                let (speed, across) = (number("X"), number("Z") * TRACK / 2.0);
                self.drive([speed - across, speed + across]);
            }
            Some(131) => self.reports = number("cmd") == 1.0,
            Some(136) => self.dead_man = Duration::from_secs_f64(number("cmd") / 1000.0),
            _ => {}
        }
    }

    fn drive(&mut self, speeds: [f64; 2]) {
        (self.speeds, self.commanded) = (speeds, Instant::now());
    }
}

#[allow(dead_code)]
fn main() -> io::Result<()> {
    let (mut fake, path) = Fake::new()?;
    println!("{path}");
    let mut has_driven = false;
    while !has_driven || fake.commanded.elapsed() < fake.dead_man {
        let before = fake.speeds;
        fake.step()?;
        if before != fake.speeds {
            println!("{:?}", fake.speeds);
        }
        has_driven |= fake.speeds != [0.0; 2];
    }
    Ok(())
}
