//! The sensor that looks at the floor.

use super::Reading;

/// The reflected share of each colour of the sensor's white light, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Color {
    /// Red.
    pub red: f64,
    /// Green.
    pub green: f64,
    /// Blue.
    pub blue: f64,
}

impl Color {
    /// Luminance: the reflected share of all light, 0 to 1, as the eye weighs it.
    pub fn reflectance(&self) -> f64 {
        0.2126 * self.red + 0.7152 * self.green + 0.0722 * self.blue
    }
}

/// A colour sensor under the front of the robot.
pub trait ColorSensor {
    /// The colour of the floor.
    fn color(&self) -> Reading<Color>;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_reflects_everything() {
        let white = Color { red: 1.0, green: 1.0, blue: 1.0 };
        assert!((white.reflectance() - 1.0).abs() < 1e-12);
    }
}
