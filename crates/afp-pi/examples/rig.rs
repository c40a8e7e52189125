//! A test rig for the profiles `pi` and `picarx`. It prints the path of its socket, which replaces
//! the GPIO chip. It imitates motors, encoders, switches and a range sensor in a room.

use std::f64::consts::PI;
use std::io::{self, BufRead, BufReader, Write};
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard};
use std::thread;
use std::time::{Duration, Instant};

/// The measures of the project of `afpc new --profile pi`.
const TRACK: f64 = 0.14;
const METRES_PER_TICK: f64 = PI * 0.065 / 1440.0;
const AT_FULL_POWER: f64 = 0.5;
const FORWARD: f64 = 0.08;
const HALF: f64 = 0.12;
/// The time constant of the motors, in seconds.
const LAG: f64 = 0.06;
/// The time between two pings.
const PING: Duration = Duration::from_millis(60);
/// The room reaches from the origin to this corner, in metres.
const ROOM: [f64; 2] = [4.0, 3.0];

/// The robot on the rig.
pub struct State {
    /// Whether the guard enables the motors, and the time of the last change.
    pub enabled: (bool, Instant),
    /// The power of the motors, as commanded.
    pub power: [f64; 2],
    rims: [f64; 2],
    /// The ways of the rims in metres.
    pub ways: [f64; 2],
    /// Position in metres and heading in radians.
    pub pose: [f64; 3],
    /// The car of the profile `picarx` with its errors; `None` for the profile `pi`.
    pub car: Option<Car>,
    /// How often the body has touched a wall.
    pub bumps: u32,
    touches: bool,
    bearing: f64,
    stepped: Instant,
    pinged: Instant,
}

/// A car: its measures as the program knows them, and its errors.
#[derive(Clone, Copy)]
pub struct Car {
    /// The driven distance over the commanded distance.
    pub scale: f64,
    /// The real wheelbase in metres.
    pub wheelbase: f64,
    /// The angle of the front wheels at the command straight ahead, in radians to the left.
    pub aside: f64,
}

/// The track and the wheelbase of the project of `afpc new --profile picarx`.
const CAR_TRACK: f64 = 0.1167;
const WHEELBASE: f64 = 0.0872;

/// A rig that runs until the end of the program.
#[derive(Clone)]
pub struct Rig(Arc<Mutex<State>>);

impl Rig {
    /// Listens at a path, with the robot at a pose.
    pub fn start(path: &Path, pose: [f64; 3]) -> io::Result<Rig> {
        let listener = UnixListener::bind(path)?;
        let now = Instant::now();
        let rig = Rig(Arc::new(Mutex::new(State {
            enabled: (false, now),
            power: [0.0; 2],
            rims: [0.0; 2],
            ways: [0.0; 2],
            pose,
            car: None,
            bumps: 0,
            touches: false,
            bearing: 0.0,
            stepped: now,
            pinged: now,
        })));
        let served = rig.clone();
        thread::spawn(move || {
            for stream in listener.incoming().flatten() {
                let rig = served.clone();
                thread::spawn(move || rig.serve(stream));
            }
        });
        Ok(rig)
    }

    pub fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    fn serve(&self, mut stream: UnixStream) -> io::Result<()> {
        let mut lines = BufReader::new(stream.try_clone()?).lines();
        let is_board = lines.next().transpose()?.is_some_and(|line| line == "board");
        for line in lines.map_while(Result::ok) {
            match is_board {
                true => stream.write_all(self.state().step(&line).as_bytes())?,
                false => self.state().enabled = (line == "1", Instant::now()),
            }
        }
        // The pull-down resistor switches the motors off if nobody holds the line.
        if !is_board {
            self.state().enabled = (false, Instant::now());
        }
        Ok(())
    }
}

impl Car {
    /// The speed and the turn rate for the commanded speeds of the rear wheels.
    fn motion(&self, left: f64, right: f64) -> (f64, f64) {
        let asked = (left + right) / 2.0;
        let curvature = if asked.abs() < 1e-9 { 0.0 } else { (right - left) / CAR_TRACK / asked };
        let angle = (WHEELBASE * curvature).atan() + self.aside;
        let speed = asked * self.scale;
        (speed, speed * angle.tan() / self.wheelbase)
    }
}

impl State {
    /// Takes a command, and gives the readings.
    fn step(&mut self, line: &str) -> String {
        let numbers: Vec<f64> = line.split(' ').filter_map(|word| word.parse().ok()).collect();
        if let [left, right, bearing] = numbers[..] {
            (self.power, self.bearing) = ([left, right], bearing);
        }
        let now = Instant::now();
        let dt = now.duration_since(self.stepped).as_secs_f64().min(0.05);
        self.stepped = now;
        for ((rim, way), power) in self.rims.iter_mut().zip(&mut self.ways).zip(self.power) {
            let wanted = if self.enabled.0 { power * AT_FULL_POWER } else { 0.0 };
            *rim += (wanted - *rim) * (dt / LAG).min(1.0);
            *way += *rim * dt;
        }
        let [left, right] = self.rims;
        let (speed, turn) = match self.car {
            Some(car) => car.motion(left, right),
            None => ((left + right) / 2.0, (right - left) / TRACK),
        };
        let [x, y, heading] = &mut self.pose;
        let (sin, cos) = (*heading + turn * dt / 2.0).sin_cos();
        *x += speed * dt * cos;
        *y += speed * dt * sin;
        *heading += turn * dt;
        let touches = [0.0, PI].iter().any(|side| self.ray(0.0, *side) < HALF);
        self.bumps += u32::from(touches && !self.touches);
        self.touches = touches;
        let counts = self.ways.map(|way| (way / METRES_PER_TICK) as i64);
        // The switches are closed while they are free.
        format!("{} {} {} 1 {}\n", counts[0], counts[1], u8::from(!touches), self.ping(now))
    }

    fn ping(&mut self, now: Instant) -> String {
        if now.duration_since(self.pinged) < PING {
            return "-".to_owned();
        }
        self.pinged = now;
        let rays = (-3..=3).map(|at| self.ray(FORWARD, self.bearing + f64::from(at) * 0.08));
        match rays.fold(f64::INFINITY, f64::min) {
            distance if distance < 4.0 => format!("{:.4}", distance.max(0.02)),
            _ => "none".to_owned(),
        }
    }

    /// The distance of the wall in a direction, from a place ahead of the turning centre.
    fn ray(&self, ahead: f64, direction: f64) -> f64 {
        let [x, y, heading] = self.pose;
        let at = [x + ahead * heading.cos(), y + ahead * heading.sin()];
        let (sin, cos) = (heading + direction).sin_cos();
        let walls = [at[0], at[1]].into_iter().zip([cos, sin]).zip(ROOM);
        let ways = walls.map(|((at, way), far)| match way > 0.0 {
            true => (far - at) / way,
            false => at / -way,
        });
        ways.filter(|way| way.is_finite()).fold(f64::INFINITY, f64::min)
    }
}

#[allow(dead_code)]
fn main() -> io::Result<()> {
    let path = std::env::temp_dir().join(format!("afp-rig-{}", std::process::id()));
    let rig = Rig::start(&path, [1.0, 1.0, 0.5])?;
    println!("{}", path.display());
    let mut was = false;
    loop {
        thread::sleep(Duration::from_millis(10));
        let (is, _) = rig.state().enabled;
        if is != was {
            println!("{}", if is { "the motors are on" } else { "the motors are off" });
        }
        was = is;
    }
}
