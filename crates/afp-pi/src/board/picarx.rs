//! The board of the profile `picarx`: SunFounder's PiCar-X with a Robot HAT, which steers like a
//! car and has no encoders.

use std::io;

use afp_core::Instant;
use afp_drive::parts::servo_pulse;
use afp_drive::{Inputs, Outputs, Setup};
use afp_platform::Settings;
use embedded_hal::digital::OutputPin as _;
use embedded_hal::i2c::I2c;
use gpiocdev_embedded_hal::OutputPin;
use linux_embedded_hal::I2cdev;

use super::lines::{Sonar, output};
use super::{Board, Reckoned};
use crate::parts::Hat;

/// The channels of the Robot HAT: the steering servo, and the left and the right motor.
const STEERING: u8 = 2;
const MOTORS: [u8; 2] = [13, 12];
/// The lines of the motors' directions, and their level forwards.
const DIRECTIONS: [(u32, bool); 2] = [(23, false), (24, true)];
const TRIGGER: u32 = 27;
const ECHO: u32 = 22;
/// The frequencies of servos and motors, in hertz.
const SERVO: u32 = 50;
const MOTOR: u32 = 1758;
/// The steps of a servo's period in a microsecond.
const PER_MICROSECOND: f32 = crate::parts::STEPS as f32 / 20_000.0;
/// A slower robot keeps its steering, in m/s.
const SLOWEST: f32 = 0.005;
/// The front wheels do not steer farther, in radians.
const FARTHEST: f32 = core::f32::consts::FRAC_PI_6;
/// A motor turns only above this share of its power.
const TURNS: f32 = 0.5;

pub(super) struct HatBoard<I = I2cdev> {
    hat: Hat<I>,
    directions: [OutputPin; 2],
    sonar: Option<Sonar>,
    steering: Steering,
    reckoned: Reckoned,
}

impl HatBoard {
    pub(super) fn open(chip: &str, settings: &Settings, setup: &Setup) -> io::Result<HatBoard> {
        let bus = settings.get("bus").unwrap_or("/dev/i2c-1");
        let named = |error| io::Error::other(format!("'{bus}': {error}"));
        let mut hat = Hat::new(I2cdev::new(bus).map_err(named)?)?;
        hat.set_frequency(STEERING, SERVO)?;
        MOTORS.into_iter().try_for_each(|motor| hat.set_frequency(motor, MOTOR))?;
        let [left, right] = DIRECTIONS.map(|(line, _)| output(chip, line));
        let has_sonar = settings.get("ultrasonic.forward").is_some();
        Ok(HatBoard {
            hat,
            directions: [left?, right?],
            sonar: if has_sonar { Some(Sonar::open(chip, TRIGGER, ECHO)?) } else { None },
            steering: Steering::new(settings, setup),
            reckoned: Reckoned::new(setup),
        })
    }
}

impl<I: I2c + Send> Board for HatBoard<I> {
    fn read(&mut self, now: Instant) -> io::Result<Inputs> {
        Ok(Inputs {
            counts: self.reckoned.counts(),
            ping: self.sonar.as_mut().map_or(Ok(None), |sonar| sonar.ping(now))?,
            ..Inputs::default()
        })
    }

    fn apply(&mut self, outputs: &Outputs) -> io::Result<()> {
        self.reckoned.add(outputs.power);
        // The servo turns clockwise with longer pulses.
        let pulse = servo_pulse(-self.steering.angle(outputs.power));
        self.hat.set(STEERING, (f32::from(pulse) * PER_MICROSECOND) as u16)?;
        let wheels = MOTORS.into_iter().zip(&mut self.directions).zip(DIRECTIONS);
        for (((motor, pin), (_, ahead)), power) in wheels.zip(outputs.power) {
            pin.set_state((ahead == (power >= 0.0)).into()).map_err(io::Error::other)?;
            self.hat.set(motor, duty(power))?;
        }
        Ok(())
    }

    fn off(&mut self) {
        for motor in MOTORS {
            // The guard cuts the power, too.
            let _ = self.hat.set(motor, 0);
        }
    }
}

/// The pulse of a motor; none at a NaN.
fn duty(power: f32) -> u16 {
    match power.abs() > 0.0 {
        true => {
            ((TURNS + (1.0 - TURNS) * power.abs().min(1.0)) * f32::from(crate::parts::STEPS)) as u16
        }
        false => 0,
    }
}

/// The steering of a car.
#[derive(Clone, Copy, Debug)]
struct Steering {
    wheelbase: f32,
    track: f32,
    at_full_power: f32,
    angle: f32,
    /// The angle at which the robot drives straight ahead.
    straight: f32,
}

impl Steering {
    fn new(settings: &Settings, setup: &Setup) -> Self {
        let number = |path: &str| {
            crate::values::number("picarx", settings, path).ok().flatten().unwrap_or_default()
                as f32
        };
        Steering {
            wheelbase: number("drive.wheelbase"),
            track: setup.track,
            at_full_power: setup.at_full_power(),
            angle: 0.0,
            straight: number("drive.straight"),
        }
    }

    /// The angle of the front wheels in radians, to the left, for the power of the rear wheels.
    fn angle(&mut self, [left, right]: [f32; 2]) -> f32 {
        let speed = (left + right) / 2.0 * self.at_full_power;
        if speed.abs() > SLOWEST {
            let turn = (right - left) * self.at_full_power / self.track;
            let angle = libm::atanf(turn * self.wheelbase / speed);
            self.angle = angle.clamp(-FARTHEST, FARTHEST);
        }
        self.angle + self.straight
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_wheels_steer_into_the_curve() {
        let setup = Setup { track: 0.1167, narrowest: 0.151, ..Setup::default() };
        let settings = [("drive.wheelbase", "8.72 cm"), ("drive.straight", "2 deg")];
        let mut steering = Steering::new(&Settings::new(settings), &setup);
        assert!((steering.angle([0.3, 0.3]).to_degrees() - 2.0).abs() < 0.01);
        steering.straight = 0.0;
        let mut at = |speed: f32, radius: f32| {
            let rims = setup.rims(speed, speed / radius);
            steering.angle(rims.map(|rim| rim / setup.at_full_power())).to_degrees()
        };
        assert!((at(0.2, 0.5) - 9.9).abs() < 0.1);
        assert!((at(-0.2, 0.5) - 9.9).abs() < 0.1);
        assert!((at(0.2, -0.151) + 30.0).abs() < 0.1);
        assert!((at(0.0, 1.0) + 30.0).abs() < 0.1, "a car at rest keeps its steering");
    }

    #[test]
    fn a_motor_without_power_gets_no_pulse() {
        assert_eq!([0.0, f32::NAN, 1.0, -1.0, 9.0].map(duty), [0, 0, 4095, 4095, 4095]);
        assert!(duty(0.01) > 2000);
    }
}
