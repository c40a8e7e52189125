//! A robot vacuum cleaner: its devices as traits, the templates of its toolbox, and its simulation.
//!
//! `vacuum.afp` declares the devices and the templates. Templates use only the traits here, so the
//! real robot is another implementation of the same traits.

pub mod templates {
    //! The declarations of `vacuum.afp` as Rust.
    afp::toolbox!("vacuum.afp", robot: super::Wheels + super::Senses + super::Nozzle);
}

mod actors;
mod room;
mod sim;
mod supervisors;

pub use actors::{Roll, Spin, Spiral, Suction};
pub use room::Room;
pub use sim::Vacuum;
pub use supervisors::{CheckBumper, CheckButton, CheckCliff, CheckDirt};

use afp::Reading;
use afp::quantity::{Angle, AngularSpeed, Length, Speed};

/// How far the wheels have turned since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Way {
    /// The distance ahead; driving backwards decreases it.
    pub ahead: Length,
    /// The angle turned, counter-clockwise, without wrapping.
    pub turned: Angle,
}

/// The driven wheels.
pub trait Wheels {
    /// Sets a speed ahead and a turn rate, until the next call.
    fn drive(&mut self, speed: Speed, turn: AngularSpeed);

    /// The counters' values.
    fn way(&self) -> Reading<Way>;

    /// Stops the wheels.
    fn halt(&mut self) {
        self.drive(Speed::from_si(0.0), AngularSpeed::from_si(0.0));
    }
}

/// The robot's sensors.
pub trait Senses {
    /// Whether the left and the right switch of the bumper are pressed.
    fn bumper(&self) -> Reading<[bool; 2]>;
    /// Whether there is no floor below the front edge.
    fn drop(&self) -> Reading<bool>;
    /// The amount of dirt in the nozzle, 0 to 1.
    fn dirt(&self) -> Reading<f64>;
    /// Whether the button is down.
    fn button(&self) -> Reading<bool>;
}

/// The suction motor.
pub trait Nozzle {
    /// Switches it.
    fn suck(&mut self, on: bool);
}
