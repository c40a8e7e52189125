//! A simulated robot in real time, with a controller on a pseudo-terminal.

use std::fs::File;
use std::io::{self, Read, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};

use afp_carbot::devices::{Navigator, Odometry, Rotator};
use afp_core::quantity::{Angle, AngularSpeed, Speed};
use afp_core::{Instant, Platform};
use afp_drive::{STEP, Setup};
use afp_platform::RealTime;
use afp_sim::Simulation;
use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};

use super::controllers::{Controller, Moves};

/// A simulated robot that a thread moves.
pub struct Plant {
    robot: Arc<Mutex<Simulation>>,
    ends: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Plant {
    /// Starts a robot and its controller; returns the path of the controller's port.
    ///
    /// # Errors
    /// The system has no pseudo-terminals.
    pub fn start<C: Controller>(robot: Simulation, setup: &Setup) -> io::Result<(Plant, String)> {
        let port = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&port)?;
        unlockpt(&port)?;
        let path = ptsname(&port, Vec::new())?.to_string_lossy().into_owned();
        fcntl_setfl(&port, fcntl_getfl(&port)? | OFlags::NONBLOCK)?;
        // The port exists while this end of it is open.
        let end = File::options().read(true).write(true).open(&path)?;
        let (robot, ends) = (Arc::new(Mutex::new(robot)), Arc::new(AtomicBool::new(false)));
        let mut board = Board {
            port: port.into(),
            _end: end,
            robot: robot.clone(),
            controller: C::new(setup),
            wheels: Wheels { track: f64::from(setup.track), ..Wheels::default() },
            track: f64::from(setup.track),
        };
        let is_over = ends.clone();
        let thread = thread::spawn(move || board.run(&is_over));
        Ok((Plant { robot, ends, thread: Some(thread) }, path))
    }

    /// Accesses the robot.
    pub fn with<T>(&self, act: impl FnOnce(&mut Simulation) -> T) -> T {
        act(&mut self.robot.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Drop for Plant {
    fn drop(&mut self) {
        self.ends.store(true, Ordering::Relaxed);
        let _ = self.thread.take().map(JoinHandle::join);
    }
}

/// The controller's board, and the robot around it.
struct Board<C> {
    port: File,
    _end: File,
    robot: Arc<Mutex<Simulation>>,
    controller: C,
    wheels: Wheels,
    track: f64,
}

impl<C: Controller> Board<C> {
    fn run(&mut self, is_over: &AtomicBool) {
        let time = RealTime::start();
        let mut steps = 0;
        while !is_over.load(Ordering::Relaxed) {
            steps += 1;
            let now = Instant::ZERO + STEP * steps;
            time.sleep_until(now);
            self.step(now);
        }
    }

    /// One step of the controller. A line that is full or broken loses bytes.
    fn step(&mut self, now: Instant) {
        let mut bytes = [0; 512];
        while let Ok(read @ 1..) = self.port.read(&mut bytes) {
            bytes.iter().take(read).for_each(|byte| self.controller.receive(*byte, now));
        }
        let mut robot = self.robot.lock().unwrap_or_else(PoisonError::into_inner);
        robot.advance(now);
        self.wheels.follow(&robot);
        let moves = self.controller.step(&robot, self.wheels.ways, now);
        self.moved(&mut robot, &moves, now);
        drop(robot);
        let sent = self.controller.transmit(now);
        let _ = self.port.write_all(&sent);
    }

    fn moved(&self, robot: &mut Simulation, moves: &Moves, now: Instant) {
        let [left, right] = moves.rims;
        let (speed, turn) = ((left + right) / 2.0, (right - left) / self.track);
        robot.drive(Speed::from_si(speed), AngularSpeed::from_si(turn), now);
        if let Some(bearing) = moves.bearing {
            robot.point(Angle::from_si(bearing), now);
        }
    }
}

/// The ways of both wheels, by the wheel counters of the simulated robot.
#[derive(Default)]
struct Wheels {
    track: f64,
    ways: [f64; 2],
    /// The last position and heading.
    last: Option<[f64; 3]>,
}

impl Wheels {
    /// Counts on. A counter that fails counts nothing.
    fn follow(&mut self, robot: &Simulation) {
        let Ok(motion) = robot.motion().value else { return };
        let here = [motion.x.si(), motion.y.si(), motion.heading.si()];
        let [x, y, heading] = self.last.replace(here).unwrap_or(here);
        let (sin, cos) = libm::sincos((heading + here[2]) / 2.0);
        let way = (here[0] - x) * cos + (here[1] - y) * sin;
        let across = (here[2] - heading) * self.track / 2.0;
        self.ways = [self.ways[0] + way - across, self.ways[1] + way + across];
    }
}
