//! The robot `{{name}}`: what its devices offer, the templates of its toolbox, the robot simulated.
//!
//! Templates know the robot through the traits here alone, so that the real robot is another type that implements them.

pub mod templates {
    //! What `{{name}}.afp` declares, as Rust.
    afp::toolbox!("{{name}}.afp", robot: super::Wheels + super::Bumper);
}

mod sim;
mod work;

pub use sim::{{Name}};
pub use work::{CheckBumper, Drive, Turn};

use afp::Reading;
use afp::quantity::{Angle, AngularSpeed, Length, Speed};

/// The driven wheels.
pub trait Wheels {
    /// Asks for a speed ahead and a turn rate, until further notice.
    fn drive(&mut self, speed: Speed, turn: AngularSpeed);

    /// The way ahead and the angle turned since the start, as the wheels count them.
    fn counted(&self) -> (Length, Angle);

    /// Asks for a standstill.
    fn halt(&mut self) {
        self.drive(Speed::from_si(0.0), AngularSpeed::from_si(0.0));
    }
}

/// The bumper.
pub trait Bumper {
    /// Whether it is pressed.
    fn pressed(&self) -> Reading<bool>;
}
