//! The robot `{{name}}`: its devices, the templates of its toolbox, and its simulation.
//!
//! Templates use the robot only through these traits. The real robot is another type that
//! implements them.

pub mod templates {
    //! The declarations of `{{name}}.afp`, in Rust.
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
    /// Sets the forward speed and the turn rate until the next command.
    fn drive(&mut self, speed: Speed, turn: AngularSpeed);

    /// The distance travelled and the angle turned since the start, from the wheel counters.
    fn counted(&self) -> (Length, Angle);

    /// Stops the wheels.
    fn halt(&mut self) {
        self.drive(Speed::from_si(0.0), AngularSpeed::from_si(0.0));
    }
}

/// The bumper.
pub trait Bumper {
    /// Whether it is pressed.
    fn pressed(&self) -> Reading<bool>;
}
