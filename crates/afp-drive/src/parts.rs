//! Drivers of single parts, against the traits of `embedded-hal`: for the second controller and for
//! a computer whose own pins drive the robot.

mod motor;
mod quadrature;
mod ranger;
mod switch;

use core::fmt;

use embedded_hal::{digital, pwm};

pub use motor::Motor;
pub use quadrature::Quadrature;
pub use ranger::Ranger;
pub use switch::Switch;

/// A pin of a part has failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Broken {
    /// An input or output.
    Pin(digital::ErrorKind),
    /// A PWM channel.
    Pwm(pwm::ErrorKind),
}

impl fmt::Display for Broken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Broken::Pin(kind) => write!(f, "a pin has failed: {kind}"),
            Broken::Pwm(kind) => write!(f, "a PWM channel has failed: {kind}"),
        }
    }
}

impl core::error::Error for Broken {}

/// The error of a pin.
fn pin(error: impl digital::Error) -> Broken {
    Broken::Pin(error.kind())
}

/// The pulse of a servo at an angle in radians, counter-clockwise, in microseconds.
pub fn servo_pulse(angle: f32) -> u16 {
    let quarter = core::f32::consts::FRAC_PI_2;
    // A NaN becomes the middle.
    let share = if angle.is_finite() { (angle / quarter).clamp(-1.0, 1.0) } else { 0.0 };
    (1500.0 + 1000.0 * share) as u16
}

#[cfg(test)]
mod tests {
    use super::servo_pulse;

    #[test]
    fn a_servo_turns_by_a_quarter_to_either_side() {
        let quarter = core::f32::consts::FRAC_PI_2;
        let pulses = [0.0, quarter, -quarter, 9.0, f32::NAN].map(servo_pulse);
        assert_eq!(pulses, [1500, 2500, 500, 2500, 1500]);
    }
}
