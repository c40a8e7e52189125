//! A stand-in for the second controller. It prints the path of its port and runs the controller's
//! program. The motors turn as commanded, and nothing is in front of the range sensor. It ends
//! when a run on it has ended.

use std::fs::File;
use std::io::{self, Read, Write};
use std::sync::mpsc::{Receiver as Bytes, channel};
use std::thread;

use afp_drive::{Controller, Inputs, LONGEST, STEP, Setup};
use afp_platform::RealTime;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

/// The controller on a pseudo-terminal, and the robot around it.
pub struct Fake {
    /// The controller's end of the line.
    pub port: File,
    heard: Bytes<u8>,
    time: RealTime,
    pub controller: Controller,
    pub inputs: Inputs,
    /// The distances of the rims in metres.
    pub ways: [f32; 2],
    /// The driven way over the counted way of each wheel.
    pub factors: [f32; 2],
    /// The distance between the wheels in metres.
    pub track: f32,
    /// The place in metres and the heading in radians.
    pub pose: [f64; 3],
    /// The distance that the range sensor measures.
    pub wall: Option<f32>,
    /// The power of the motors.
    pub power: [f32; 2],
    steps: u64,
    /// Whether its wire to the computer is broken.
    pub mute: bool,
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
        let mut modes = tcgetattr(&end)?;
        modes.make_raw();
        tcsetattr(&end, OptionalActions::Now, &modes)?;
        let port = File::from(port);
        let (mut line, (tell, heard)) = (port.try_clone()?, channel());
        thread::spawn(move || {
            let _end = end;
            let mut buffer = [0; 256];
            while let Ok(read) = line.read(&mut buffer) {
                if buffer[..read].iter().any(|byte| tell.send(*byte).is_err()) {
                    break;
                }
            }
        });
        let closed = Inputs { bumper: true, button: true, ..Inputs::default() };
        let fake = Fake {
            port,
            heard,
            time: RealTime::start(),
            controller: Controller::new(1),
            inputs: closed,
            ways: [0.0; 2],
            factors: [1.0; 2],
            track: Setup::default().track,
            pose: [0.0; 3],
            wall: None,
            power: [0.0; 2],
            steps: 0,
            mute: false,
        };
        Ok((fake, path))
    }

    /// Restarts it, as a loss of power would.
    pub fn restart(&mut self) {
        self.controller = Controller::new(2);
    }

    /// Runs one step in real time.
    pub fn step(&mut self) -> io::Result<()> {
        self.steps += 1;
        self.time.sleep_until(afp_core::Instant::ZERO + STEP * self.steps);
        let now = self.time.now();
        while let Ok(byte) = self.heard.try_recv() {
            self.controller.receive(byte, now);
        }
        let setup = Setup::default();
        let count = |side: usize| {
            (self.ways[side] / self.factors[side] / setup.metres_per_tick[side]) as i32
        };
        self.inputs.counts = [count(0), count(1)];
        self.inputs.ping = self.steps.is_multiple_of(5).then_some(self.wall);
        self.power = self.controller.step(&self.inputs, now).power;
        let dt = STEP.as_secs_f64() as f32;
        let ways = self.power.map(|power| power * setup.at_full_power() * dt);
        self.ways = [self.ways[0] + ways[0], self.ways[1] + ways[1]];
        let [x, y, heading] = &mut self.pose;
        let turned = f64::from((ways[1] - ways[0]) / self.track);
        let (sin, cos) = (*heading + turned / 2.0).sin_cos();
        let way = f64::from((ways[0] + ways[1]) / 2.0);
        *x += way * cos;
        *y += way * sin;
        *heading += turned;
        let mut buffer = [0; 2 * LONGEST];
        let bytes = self.controller.transmit(now, &mut buffer);
        if self.mute || bytes.is_empty() { Ok(()) } else { self.port.write_all(bytes) }
    }

    /// Whether a motor turns.
    pub fn is_moving(&self) -> bool {
        self.power != [0.0; 2]
    }
}

#[allow(dead_code)]
fn main() -> io::Result<()> {
    let (mut fake, path) = Fake::new()?;
    println!("{path}");
    let mut has_started = false;
    while !(has_started && fake.controller.is_stopped()) {
        let before = fake.is_moving();
        fake.step()?;
        if before != fake.is_moving() {
            println!("{}", if before { "the wheels stop" } else { "the wheels turn" });
        }
        has_started |= !fake.controller.is_stopped();
    }
    Ok(())
}
