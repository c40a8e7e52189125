//! The common platform and its toolbox: four sensors and a motor.

mod components;

use afp_core::devices::{ControlId, DeviceRow, Devices, FaultId};
use afp_core::{Environment, Instant, Platform, StillClock};
use afp_session::{Robot, Samples};

pub use components::{CheckBattery, CheckButton, CheckRange, CheckTouch, Drive, Hop};

pub mod templates {
    //! The templates of the toolbox as types.
    afp_macros::toolbox!("toolbox/board.afp", robot = super::Board);
}

/// Readings and a command, in memory that is opaque to the optimiser.
#[derive(Clone, Debug)]
pub struct Board {
    pub buttons: u32,
    /// Whether the bumper is pressed.
    pub touched: bool,
    /// Distance ahead in metres.
    pub range: f64,
    /// Volts.
    pub battery: f64,
    /// Metres driven since the start.
    pub odometer: f64,
    /// Commanded speed in metres per second.
    pub command: f64,
    /// The current time, if a session drives it.
    pub now: Instant,
}

impl Board {
    /// A board without events.
    pub fn quiet() -> Self {
        Board {
            buttons: 0,
            touched: false,
            range: 2.0,
            battery: 12.0,
            odometer: 1.0,
            command: 0.0,
            now: Instant::ZERO,
        }
    }
}

impl Environment for Board {
    fn stop(&mut self, _: Instant) {
        self.command = 0.0;
    }

    fn emergency_stop(&mut self) {
        self.command = 0.0;
    }
}

impl Platform for Board {
    type Clock = StillClock;

    fn clock(&self) -> StillClock {
        StillClock
    }

    #[inline]
    fn now(&self) -> Instant {
        self.now
    }

    #[inline]
    fn advance(&mut self, to: Instant) {
        self.now = to;
    }
}

/// A board without controls and faults.
pub struct NoDevices;

impl Devices for NoDevices {
    const TABLE: &'static [DeviceRow] = &[];
    type Control = ();
    type Fault = ();

    fn control(_: ControlId) -> Option<()> {
        None
    }

    fn fault(_: FaultId, _: Option<f64>) -> Option<()> {
        None
    }
}

impl Robot for Board {
    type Devices = NoDevices;

    fn sample(&self, _: &mut Samples<'_, '_>) {}
}

/// The speed for the remaining distance, in metres per second.
#[inline]
pub fn speed(left: f64, gain: f64) -> f64 {
    let wanted = left * gain;
    if wanted > 0.3 { 0.3 } else { wanted }
}
