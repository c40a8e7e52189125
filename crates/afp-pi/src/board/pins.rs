//! The board of the profile `pi`: motors, encoders and sensors on the pins of a Raspberry Pi.

use std::io;
use std::path::Path;

use afp_core::Instant;
use afp_drive::parts::{Motor, Switch, servo_pulse};
use afp_drive::{Inputs, Outputs, Setup};
use afp_platform::Settings;
use embedded_hal::pwm::SetDutyCycle;
use gpiocdev_embedded_hal::{InputPin, OutputPin};

use super::Board;
use super::lines::{Encoder, Sonar, output, switch};
use crate::parts::{Pwm, broken};
use crate::values::pair;

/// The PWM of a motor: the TB6612 takes 20 kHz, which nobody hears. The L298N is too slow for it.
const TB6612: (u32, u16) = (50, 1000);
const L298N: (u32, u16) = (1000, 1000);
/// The PWM of a servo: 50 Hz in microseconds.
const SERVO: (u32, u16) = (1000, 20_000);

pub(super) struct PinBoard {
    motors: [Motor<Pwm, OutputPin, OutputPin>; 2],
    encoders: [Encoder; 2],
    bumper: Option<Switch<InputPin>>,
    button: Option<Switch<InputPin>>,
    sonar: Option<Sonar>,
    servo: Option<Pwm>,
}

impl PinBoard {
    pub(super) fn open(chip: &str, settings: &Settings, _: &Setup) -> io::Result<PinBoard> {
        let root = Path::new(settings.get("pwm").unwrap_or("/sys/class/pwm"));
        let text = |path: &str| {
            settings.get(path).ok_or_else(|| io::Error::other(format!("'{path}' has no value")))
        };
        let line = |path: &str| -> io::Result<Option<u32>> {
            let wrong = |_| io::Error::other(format!("'{path}' is not a line"));
            settings.get(path).map(|text| text.parse().map_err(wrong)).transpose()
        };
        let lines = |path: &str| {
            let text = text(path)?;
            pair(text).ok_or_else(|| io::Error::other(format!("'{path}' cannot be '{text}'")))
        };
        let bridge = if text("drive.kind")? == "l298n" { L298N } else { TB6612 };
        let motor = |side: &str| {
            let [ahead, back] = lines(&format!("{side}.in"))?;
            let pwm = Pwm::open(root, text(&format!("{side}.pwm"))?, bridge)?;
            Ok::<_, io::Error>(Motor::new(pwm, output(chip, ahead)?, output(chip, back)?))
        };
        let encoder = |side: &str| Encoder::open(chip, lines(&format!("{side}.encoder"))?);
        let switched = |path: &str| line(path)?.map(|line| switch(chip, line)).transpose();
        let sonar = match (line("ultrasonic.trigger")?, line("ultrasonic.echo")?) {
            (Some(trigger), Some(echo)) => Some(Sonar::open(chip, trigger, echo)?),
            _ => None,
        };
        let servo = settings.get("servo.pwm").map(|channel| Pwm::open(root, channel, SERVO));
        Ok(PinBoard {
            motors: [motor("left")?, motor("right")?],
            encoders: [encoder("left")?, encoder("right")?],
            bumper: switched("bumper.pin")?,
            button: switched("button.pin")?,
            sonar,
            servo: servo.transpose()?,
        })
    }
}

impl Board for PinBoard {
    fn read(&mut self, now: Instant) -> io::Result<Inputs> {
        let [left, right] = &mut self.encoders;
        let closed = |switch: &mut Option<Switch<InputPin>>| match switch {
            Some(switch) => switch.is_closed(now).map_err(broken),
            None => Ok(false),
        };
        Ok(Inputs {
            counts: [left.count()?, right.count()?],
            bumper: closed(&mut self.bumper)?,
            button: closed(&mut self.button)?,
            ping: self.sonar.as_mut().map_or(Ok(None), |sonar| sonar.ping(now))?,
        })
    }

    fn apply(&mut self, outputs: &Outputs) -> io::Result<()> {
        for (motor, power) in self.motors.iter_mut().zip(outputs.power) {
            motor.set(power).map_err(broken)?;
        }
        if let Some(servo) = &mut self.servo {
            servo.set_duty_cycle(servo_pulse(outputs.bearing)).map_err(io::Error::other)?;
        }
        Ok(())
    }

    fn off(&mut self) {
        for motor in &mut self.motors {
            // The guard cuts the power, too.
            let _ = motor.off();
        }
    }
}
