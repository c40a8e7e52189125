//! Drivers of single parts, against the traits of `embedded-hal`.

mod hat;
mod motor;
mod pwm;
mod quadrature;
mod ranger;
mod switch;

use std::fmt::Debug;
use std::io;

pub(crate) use hat::{Hat, STEPS};
pub(crate) use motor::Motor;
pub(crate) use pwm::Pwm;
pub(crate) use quadrature::Quadrature;
pub(crate) use ranger::Ranger;
pub(crate) use switch::Switch;

/// The error of a part.
fn broken(error: impl Debug) -> io::Error {
    io::Error::other(format!("{error:?}"))
}

/// The pulse of a servo at an angle in radians, counter-clockwise, in microseconds.
pub(crate) fn servo_pulse(angle: f32) -> u16 {
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
