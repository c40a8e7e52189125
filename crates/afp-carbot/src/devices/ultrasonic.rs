//! The ultrasonic range sensor on the rotator.

use super::{Invalid, Reading};
use afp_core::quantity::{Angle, Length};

/// One ping and its echo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Echo {
    /// Distance from the sensor to the nearest reflecting object; `None` if the sensor heard
    /// nothing within its range. A smooth wall at a slant reflects nothing, too.
    pub distance: Option<Length>,
    /// Bearing of the sensor at the ping, against the heading.
    pub bearing: Angle,
}

/// Mounting and range of the sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Distance of the rotator's axis in front of the turning centre.
    pub forward: Length,
    /// The beam's whole opening angle.
    pub opening: Angle,
    /// The shortest measurable distance.
    pub min: Length,
    /// The longest measurable distance.
    pub max: Length,
}

impl Beam {
    /// Makes an echo from a driver's raw distance in metres.
    ///
    /// # Errors
    /// [`Invalid::NotFinite`] for NaN and infinity, [`Invalid::OutOfRange`] outside the measurable
    /// range.
    pub fn echo(&self, raw: f64, bearing: Angle) -> Result<Echo, Invalid> {
        if !raw.is_finite() || !bearing.si().is_finite() {
            return Err(Invalid::NotFinite);
        }
        if raw < self.min.si() || raw > self.max.si() {
            return Err(Invalid::OutOfRange);
        }
        Ok(Echo { distance: Some(Length::from_si(raw)), bearing })
    }
}

/// A range sensor that pings at its own rate, many times a second.
pub trait Ultrasonic {
    /// The latest completed ping; its time is when the sound was sent. Report full precision: a
    /// sensor that repeats exactly the same distance while the robot moves counts as frozen.
    fn echo(&self) -> Reading<Echo>;

    /// Mounting and range.
    fn beam(&self) -> Beam;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_invalid_driver_value_is_not_an_echo() {
        let beam = Beam {
            forward: Length::from_si(0.1),
            opening: Angle::from_deg(30.0),
            min: Length::from_si(0.03),
            max: Length::from_si(4.0),
        };
        let ahead = Angle::from_deg(0.0);
        assert_eq!(beam.echo(f64::NAN, ahead), Err(Invalid::NotFinite));
        assert_eq!(beam.echo(f64::INFINITY, ahead), Err(Invalid::NotFinite));
        for raw in [-1.0, 0.0, 0.029, 4.001, 655.35] {
            assert_eq!(beam.echo(raw, ahead), Err(Invalid::OutOfRange), "{raw}");
        }
        let echo = beam.echo(1.5, ahead).unwrap();
        assert_eq!(echo.distance, Some(Length::from_si(1.5)));
    }
}
