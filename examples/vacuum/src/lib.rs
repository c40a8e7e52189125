//! A robot vacuum cleaner: what its devices offer, the templates of its toolbox, and the robot simulated.
//!
//! `vacuum.afp` declares the devices and the templates. Templates know the robot through the traits here alone, so that
//! the real robot is another implementation of the same traits.

pub mod templates {
    //! What `vacuum.afp` declares, as Rust.
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
    /// The way ahead; less when it went backwards.
    pub ahead: Length,
    /// The angle turned, counter-clockwise; counts on past a full turn.
    pub turned: Angle,
}

/// The driven wheels.
pub trait Wheels {
    /// Asks for a speed ahead and a turn rate, until further notice.
    fn drive(&mut self, speed: Speed, turn: AngularSpeed);

    /// What the counters say.
    fn way(&self) -> Reading<Way>;

    /// Asks for a standstill.
    fn halt(&mut self) {
        self.drive(Speed::from_si(0.0), AngularSpeed::from_si(0.0));
    }
}

/// What the robot senses.
pub trait Senses {
    /// Whether the left and the right switch of the bumper are pressed.
    fn bumper(&self) -> Reading<[bool; 2]>;
    /// Whether there is no floor below the front edge.
    fn drop(&self) -> Reading<bool>;
    /// How much dirt the nozzle takes in, 0 to 1.
    fn dirt(&self) -> Reading<f64>;
    /// Whether the button is down.
    fn button(&self) -> Reading<bool>;
}

/// The suction motor.
pub trait Nozzle {
    /// Switches it.
    fn suck(&mut self, on: bool);
}
