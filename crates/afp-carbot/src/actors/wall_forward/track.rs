//! The wall on the right as a line through the latest echoes, in the odometry frame.
//!
//! The odometry drifts little over the remembered stretch.

use crate::devices::Motion;
use heapless::Vec;

const MEMORY: usize = 32;
/// An echo farther off the line is not from this wall, metres.
const OUTLIER: f64 = 0.05;
/// This many outliers in a row are a new wall.
const NEW_WALL: u8 = 3;
/// How firmly the line keeps its direction, square metres: the variance of an echo over that of the
/// direction's change between echoes.
const FIRMNESS: f64 = 0.02;

/// An echo square from the wall: the sensor's position and the wall's distance.
#[derive(Clone, Copy, Debug)]
struct Sounding {
    x: f64,
    y: f64,
    distance: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Track {
    /// Direction of the wall, in driving direction.
    heading: f64,
    /// A point of the wall; `None` before the first echo.
    anchor: Option<(f64, f64)>,
    soundings: Vec<Sounding, MEMORY>,
    /// Index of the sounding to replace when the memory is full.
    oldest: usize,
    outliers: u8,
}

impl Track {
    /// A wall of known direction and unknown distance.
    pub(super) fn new(heading: f64) -> Self {
        Track { heading, anchor: None, soundings: Vec::new(), oldest: 0, outliers: 0 }
    }

    pub(super) fn heading(&self) -> f64 {
        self.heading
    }

    /// Perpendicular distance from the turning centre to the wall; `None` before the first echo.
    pub(super) fn distance(&self, motion: &Motion) -> Option<f64> {
        let (x, y) = self.anchor?;
        let (sin, cos) = libm::sincos(self.heading);
        Some((x - motion.x.si()) * sin - (y - motion.y.si()) * cos)
    }

    /// Converts a `distance` from a sensor mounted `forward` of the turning centre to a distance
    /// from the centre.
    pub(super) fn of_centre(&self, motion: &Motion, forward: f64, distance: f64) -> f64 {
        distance + forward * libm::sin(self.heading - motion.heading.si())
    }

    /// Adds an echo at a perpendicular `distance`.
    pub(super) fn add(&mut self, motion: &Motion, forward: f64, distance: f64) {
        let expected = self.distance(motion);
        let found = self.of_centre(motion, forward, distance);
        if expected.is_some_and(|expected| (found - expected).abs() > OUTLIER) {
            self.outliers += 1;
            if self.outliers < NEW_WALL {
                return;
            }
            (self.soundings, self.oldest) = (Vec::new(), 0);
        }
        self.outliers = 0;
        let (sin, cos) = libm::sincos(motion.heading.si());
        self.remember(Sounding {
            x: motion.x.si() + forward * cos,
            y: motion.y.si() + forward * sin,
            distance,
        });
        self.fit();
    }

    fn remember(&mut self, sounding: Sounding) {
        if let Err(sounding) = self.soundings.push(sounding)
            && let Some(oldest) = self.soundings.get_mut(self.oldest)
        {
            *oldest = sounding;
            self.oldest = (self.oldest + 1) % MEMORY;
        }
    }

    /// Fits the line to the soundings: least squares with a damped direction.
    fn fit(&mut self) {
        let (sin, cos) = libm::sincos(self.heading);
        let soundings = self.soundings.as_slice();
        let along = |s: &Sounding| s.x * cos + s.y * sin;
        let aside = |s: &Sounding| s.x * sin - s.y * cos + s.distance;
        let share = 1.0 / soundings.len() as f64;
        let mean_along = share * soundings.iter().map(along).sum::<f64>();
        let mean_aside = share * soundings.iter().map(aside).sum::<f64>();
        let (mut square, mut product) = (FIRMNESS, 0.0);
        for s in soundings {
            let (a, b) = (along(s) - mean_along, aside(s) - mean_aside);
            square += a * a;
            product += a * b;
        }
        self.anchor =
            Some((mean_along * cos + mean_aside * sin, mean_along * sin - mean_aside * cos));
        self.heading -= libm::atan(product / square);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use afp_core::quantity::{Angle, Length};

    fn at(x: f64, y: f64, heading: f64) -> Motion {
        Motion {
            x: Length::from_si(x),
            y: Length::from_si(y),
            heading: Angle::from_si(heading),
            ..Motion::default()
        }
    }

    #[test]
    fn a_slanted_wall_is_found_from_its_distances() {
        // A wall through (0, -0.5) with a slope of 4 degrees; the robot drives along the x axis.
        let slope = 4.0_f64.to_radians();
        let mut track = Track::new(0.0);
        for step in 0..40 {
            let x = f64::from(step) * 0.015;
            let distance = (0.5 - (x + 0.1) * slope.tan()) * slope.cos();
            track.add(&at(x, 0.0, 0.0), 0.1, distance);
        }
        assert!((track.heading() - slope).abs() < 0.005, "{}", track.heading());
        let there = track.distance(&at(0.585, 0.0, 0.0)).unwrap();
        assert!((there - (0.5 - 0.585 * slope.tan()) * slope.cos()).abs() < 0.003, "{there}");
    }

    #[test]
    fn one_outlier_is_dropped_and_three_outliers_are_a_new_wall() {
        let mut track = Track::new(0.0);
        for step in 0..10 {
            track.add(&at(f64::from(step) * 0.01, 0.0, 0.0), 0.1, 0.5);
        }
        let here = at(0.1, 0.0, 0.0);
        track.add(&here, 0.1, 0.65);
        assert!((track.distance(&here).unwrap() - 0.5).abs() < 1e-9);
        track.add(&here, 0.1, 0.65);
        track.add(&here, 0.1, 0.65);
        assert!((track.distance(&here).unwrap() - 0.65).abs() < 1e-9);
    }
}
