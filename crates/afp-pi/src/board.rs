//! The motors and sensors of a robot without a second controller, on the computer's own pins.

#[cfg(target_os = "linux")]
mod lines;
#[cfg(target_os = "linux")]
mod picarx;
#[cfg(target_os = "linux")]
mod pins;
mod rig;

use std::io;
use std::path::Path;

use afp_core::{Duration, Instant};
use afp_drive::{Inputs, Outputs, Setup};
use afp_platform::Settings;

use crate::guard::EnableLine;

pub(crate) use rig::Rig;

/// Motors and sensors. An error means that the robot cannot be driven on.
pub(crate) trait Board: Send {
    /// Takes the readings since the last call.
    fn read(&mut self, now: Instant) -> io::Result<Inputs>;

    /// Applies the commands, for one [`STEP`](afp_drive::STEP).
    fn apply(&mut self, outputs: &Outputs) -> io::Result<()>;

    /// Cuts the motors' power, as far as possible.
    fn off(&mut self);
}

/// A profile whose motors and sensors are on the computer's own pins.
pub(crate) trait Wired: Send + 'static {
    /// Its name.
    const PROFILE: &'static str;
    /// The time from the enabled motors to a board that can be opened.
    const SETTLES: Duration;

    /// Opens the pins.
    ///
    /// # Errors
    /// A pin cannot be opened.
    fn open(settings: &Settings, setup: &Setup) -> io::Result<Box<dyn Board>>;
}

/// The profile `pi`.
#[derive(Debug)]
pub struct Pins;

/// The profile `picarx`.
#[derive(Debug)]
pub struct PicarX;

impl Wired for Pins {
    const PROFILE: &'static str = "pi";
    const SETTLES: Duration = Duration::ZERO;

    fn open(settings: &Settings, setup: &Setup) -> io::Result<Box<dyn Board>> {
        match chip(settings)? {
            chip if is_rig(chip) => Ok(Box::new(Rig::board(chip)?)),
            #[cfg(target_os = "linux")]
            chip => Ok(Box::new(pins::PinBoard::open(chip, settings, setup)?)),
            #[cfg(not(target_os = "linux"))]
            _ => Err(not_here(setup)),
        }
    }
}

impl Wired for PicarX {
    const PROFILE: &'static str = "picarx";
    /// The enable line resets the controller of the Robot HAT, which then starts.
    const SETTLES: Duration = Duration::from_millis(500);

    fn open(settings: &Settings, setup: &Setup) -> io::Result<Box<dyn Board>> {
        match chip(settings)? {
            chip if is_rig(chip) => Ok(Box::new(Rig::without_encoders(chip, setup)?)),
            #[cfg(target_os = "linux")]
            chip => Ok(Box::new(picarx::HatBoard::open(chip, settings, setup)?)),
            #[cfg(not(target_os = "linux"))]
            _ => Err(not_here(setup)),
        }
    }
}

/// Opens the enable line of the motors on a chip, switched off.
///
/// # Errors
/// The line cannot be opened, for example because another program has it.
pub fn enable_line(chip: &str, line: u32) -> io::Result<Box<dyn EnableLine>> {
    match chip {
        chip if is_rig(chip) => Ok(Box::new(Rig::guard(chip)?)),
        #[cfg(target_os = "linux")]
        chip => Ok(Box::new(lines::Enable::open(chip, line)?)),
        #[cfg(not(target_os = "linux"))]
        _ => Err(not_here(line)),
    }
}

fn chip(settings: &Settings) -> io::Result<&str> {
    settings.get("chip").ok_or_else(|| io::Error::other("'chip' has no value"))
}

/// Whether a path belongs to a test rig: a socket instead of a device.
fn is_rig(path: &str) -> bool {
    use std::os::unix::fs::FileTypeExt;
    Path::new(path).metadata().is_ok_and(|file| file.file_type().is_socket())
}

#[cfg(not(target_os = "linux"))]
fn not_here<T>(_: T) -> io::Error {
    io::Error::other("pins need Linux")
}

/// The counts of wheels without encoders: they turn exactly as commanded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reckoned {
    /// Ticks of one step at full power.
    most: f64,
    ticks: [f64; 2],
}

impl Reckoned {
    pub(crate) fn new(setup: &Setup) -> Self {
        let way = f64::from(setup.at_full_power()) * afp_drive::STEP.as_secs_f64();
        let [left, _] = setup.metres_per_tick;
        Reckoned { most: way / f64::from(left), ticks: [0.0; 2] }
    }

    /// Adds a step.
    pub(crate) fn add(&mut self, power: [f32; 2]) {
        for (ticks, power) in self.ticks.iter_mut().zip(power) {
            *ticks += f64::from(power) * self.most;
        }
    }

    pub(crate) fn counts(&self) -> [i32; 2] {
        self.ticks.map(|ticks| ticks as i64 as i32)
    }
}
