//! A motor at an H-bridge with two inputs for the direction and a PWM for the power, such as the
//! TB6612 and the L298N.

use embedded_hal::digital::OutputPin;
use embedded_hal::pwm::{Error as _, SetDutyCycle};

use super::{Broken, pin};

/// A motor at its bridge.
#[derive(Debug)]
pub struct Motor<P, A, B> {
    pwm: P,
    ahead: A,
    back: B,
    /// The levels of both inputs; `None` before the first command.
    inputs: Option<[bool; 2]>,
}

impl<P: SetDutyCycle, A: OutputPin, B: OutputPin> Motor<P, A, B> {
    /// A motor at a PWM and the two inputs of its bridge: high for forwards, and high for backwards.
    pub fn new(pwm: P, ahead: A, back: B) -> Self {
        Motor { pwm, ahead, back, inputs: None }
    }

    /// Sets the power from -1 (backwards) to 1; the motor brakes at 0 and at a NaN.
    ///
    /// # Errors
    /// A pin cannot be set.
    pub fn set(&mut self, power: f32) -> Result<(), Broken> {
        if power > 0.0 {
            self.apply([true, false], power)
        } else if power < 0.0 {
            self.apply([false, true], -power)
        } else {
            self.apply([true, true], 1.0)
        }
    }

    /// Cuts the power.
    ///
    /// # Errors
    /// A pin cannot be set.
    pub fn off(&mut self) -> Result<(), Broken> {
        self.apply([false, false], 0.0)
    }

    fn apply(&mut self, inputs: [bool; 2], duty: f32) -> Result<(), Broken> {
        if self.inputs != Some(inputs) {
            // The inputs change without power, so that the bridge is never in a third state.
            self.duty(0)?;
            self.ahead.set_state(inputs[0].into()).map_err(pin)?;
            self.back.set_state(inputs[1].into()).map_err(pin)?;
            self.inputs = Some(inputs);
        }
        let all = self.pwm.max_duty_cycle();
        let duty = (duty.clamp(0.0, 1.0) * f32::from(all)) as u16;
        self.duty(duty)
    }

    fn duty(&mut self, duty: u16) -> Result<(), Broken> {
        self.pwm.set_duty_cycle(duty).map_err(|error| Broken::Pwm(error.kind()))
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use embedded_hal_mock::eh1::digital::{Mock as Pin, State, Transaction as Level};
    use embedded_hal_mock::eh1::pwm::{Mock as Duty, Transaction as Set};

    use super::*;

    fn levels(levels: &[bool]) -> Pin {
        let state = |high: &bool| if *high { State::High } else { State::Low };
        Pin::new(&levels.iter().map(|high| Level::set(state(high))).collect::<Vec<_>>())
    }

    fn duties(duties: &[u16]) -> Duty {
        let mut all = Vec::new();
        for duty in duties {
            // A change of the inputs needs no full scale.
            match duty {
                0 => all.push(Set::set_duty_cycle(0)),
                _ => all.extend([Set::max_duty_cycle(1000), Set::set_duty_cycle(*duty)]),
            }
        }
        Duty::new(&all)
    }

    #[test]
    fn the_direction_changes_without_power_and_zero_brakes() {
        let pwm = duties(&[0, 500, 250, 0, 1000, 0, 1000, 1000]);
        let mut motor = Motor::new(pwm, levels(&[true, false, true]), levels(&[false, true, true]));
        for power in [0.5, 0.25, -7.0, 0.0, f32::NAN] {
            motor.set(power).unwrap();
        }
        motor.pwm.done();
        motor.ahead.done();
        motor.back.done();
    }
}
