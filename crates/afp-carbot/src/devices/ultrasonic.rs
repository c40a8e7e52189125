//! The ultrasonic range sensor on the rotator.

use super::{Invalid, Reading};
use afp_core::quantity::{Angle, Length};

/// One ping and what came back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Echo {
    /// Distance from the sensor to the nearest thing that sent sound back, or none where the
    /// sensor listened for its whole range and heard nothing. A smooth wall at a slant also
    /// sends nothing back.
    pub distance: Option<Length>,
    /// Where the sensor pointed when it sent the ping, against the heading.
    pub bearing: Angle,
}

/// How the sensor is mounted and what it covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// The rotator's axis lies this far in front of the turning centre.
    pub forward: Length,
    /// The beam's whole opening angle.
    pub opening: Angle,
    /// The nearest distance that the sensor can measure.
    pub min: Length,
    /// The farthest distance that the sensor can measure.
    pub max: Length,
}

impl Beam {
    /// An echo from a driver's raw number in metres.
    ///
    /// # Errors
    /// [`Invalid::NotFinite`] for NaN and infinity, [`Invalid::OutOfRange`] outside of what the
    /// sensor can measure.
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

/// A range sensor that pings by itself, many times a second.
pub trait Ultrasonic {
    /// The latest completed ping; its time is when the sound was sent. Distances come as fine as they are measured: a sensor
    /// that tells exactly the same one again and again while the robot moves is taken for a frozen one.
    fn echo(&self) -> Reading<Echo>;

    /// How the sensor is mounted and what it covers.
    fn beam(&self) -> Beam;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_driver_cannot_turn_nonsense_into_an_echo() {
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
